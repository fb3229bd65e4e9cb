"""Force of the hand reckoned from what joints and drives did, for traces of before it was recorded.

It is the program's own estimate, but for one thing: inertia, gravity and Jacobian are taken where the sensors say the
joints were, and not at their set-points, which a trace does not hold.
"""

from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from typing import Final

import numpy as np

from handeye.arm.computed_torque import felt_wrench
from handeye.arm.dynamics import bias, mass_matrix
from handeye.arm.kinematics import forward, jacobian
from handeye.arm.model import ArmModel
from handeye.core.pose import Array
from handeye.planfile.plan import Plan
from handeye.planfile.store import decode
from handeye.program.events import AnyEvent, ErrorRaised, GuardTripped, RunStarted
from handeye.program.guards import unmet
from handeye.program.operation import Operation
from handeye.tasks import task
from handeye.touch.guards import monitor
from handeye.trace.forces import Forces, looked_at
from handeye.trace.motion import Motion
from handeye.trace.steps import DoneStep, Span, done_steps

AROUND: Final = 4
"""Servo periods to either side from which the way of the hand is taken: between two, noise would make half of it."""


@dataclass(frozen=True, slots=True, kw_only=True)
class _Feeling:
    """A motion in which force was felt."""

    operation: Operation
    tare: slice
    """Servo periods in which the hand held still, for the tare."""
    felt: slice
    """Servo periods in which force was estimated, as far as the drives were on."""


def reckoned_forces(head: RunStarted, plan: bytes, events: Sequence[AnyEvent], motion: Motion) -> Forces:
    """Forces in the guarded and compliant motions of a run.

    Raises:
        InvalidInput: the plan is not for the arm of its task as it is here.
    """
    made, arm, forces = decode(plan, head.program), task(head.task).arm, _nothing(motion.times)
    task(head.task).check_arm(made)
    for feeling in _feelings(made, arm, events, motion.times):
        _reckon(forces, feeling, arm, motion)
        _guard(forces, feeling, arm, motion)
    return forces


def _nothing(times: Array) -> Forces:
    """No forces at all."""
    n = len(times)
    return Forces(
        times=times,
        force=np.full((n, 3), np.nan),
        moment=np.full((n, 3), np.nan),
        estimated=np.zeros(n, dtype=np.bool_),
        guard=np.full(n, "", dtype="<U7"),
        axis=np.full((n, 3), np.nan),
        value=np.full(n, np.nan),
        limit=np.full(n, np.nan),
        recorded=False,
    )


def _feelings(plan: Plan, arm: ArmModel, events: Sequence[AnyEvent], times: Array) -> Iterator[_Feeling]:
    """The motions in which force was felt."""
    settle = arm.servo.settle
    for step in done_steps(events):
        operation = plan.program.steps[step.started.step].operation
        if not (operation.guards or operation.complies):
            continue
        rows = _under_way(step, operation, settle, times)
        tare, felt = slice(rows.start, rows.start + settle), slice(rows.start + settle, rows.stop)
        if tare.start > 0 and felt.stop > felt.start:  # of what was before the first period, nothing is known
            yield _Feeling(operation=operation, tare=tare, felt=felt)


def _under_way(step: DoneStep, operation: Operation, settle: int, times: Array) -> slice:
    """The servo periods of a motion, those of its tare included."""
    trip = next((event.time for event in step.events if isinstance(event, GuardTripped)), None)
    if trip is not None:
        return Span(step.span.begin, trip).rows(times)
    rows = step.span.rows(times)
    errors = {event.number for event in step.events if isinstance(event, ErrorRaised)}
    ran_out = bool(operation.guards) and unmet(operation.guards) in errors
    holds = ran_out and not operation.complies  # still, at the end of its way, and no longer feeling
    return slice(rows.start, rows.stop - settle if holds else rows.stop)


def _reckon(forces: Forces, feeling: _Feeling, arm: ArmModel, motion: Motion) -> None:
    """Fill in what was felt in a motion."""
    first, last, settle = feeling.tare.start, feeling.felt.stop, arm.servo.settle
    q, qd, after = (
        motion.joints[first - 1 : last - 1],
        motion.rates[first - 1 : last - 1],
        motion.rates[first:last],
    )
    M, h, J, tau = mass_matrix(arm, q), bias(arm, q, qd), jacobian(arm, q), motion.efforts[first:last]
    felt = np.array(
        [
            felt_wrench(M[i], h[i], J[i], tau[i], qd[i], after[i], arm.servo.period)
            for i in range(last - first)
        ]
    )
    wrench = felt[:settle].mean(axis=0) - felt[settle:]  # of the hand on the world
    known = np.any(tau[settle:], axis=1)  # no drive tells what brakes bear
    forces.estimated[feeling.felt] = known
    forces.force[feeling.felt] = np.where(known[:, None], wrench[:, :3], np.nan)
    forces.moment[feeling.felt] = np.where(known[:, None], wrench[:, 3:], np.nan)


def _guard(forces: Forces, feeling: _Feeling, arm: ArmModel, motion: Motion) -> None:
    """Fill in the guard that watched in a motion, if one did."""
    watching, felt = monitor(feeling.operation.guards[:1]), feeling.felt
    if watching is None:
        return
    ways = _ways(feeling, arm, motion)
    for row, way in zip(range(felt.start, felt.stop), ways, strict=True):
        (active,) = watching.active(way)
        if forces.estimated[row]:
            forces.guard[row], forces.limit[row] = active.guard, active.limit
            forces.axis[row] = np.nan if active.axis is None else active.axis
    forces.value[felt] = looked_at(
        forces.guard[felt], forces.axis[felt], forces.force[felt], forces.moment[felt], forces.value[felt]
    )


def _ways(feeling: _Feeling, arm: ArmModel, motion: Motion) -> Array:
    """Unit vectors along which the hand went, shape (periods, 3)."""
    operation, felt = feeling.operation, feeling.felt
    if operation.straight_way is not None:
        way = np.array(operation.straight_way)
        return np.tile(way / np.linalg.norm(way), (felt.stop - felt.start, 1))
    hands = forward(arm, motion.joints[felt])[:, :3, 3]
    row, last = np.arange(len(hands)), len(hands) - 1
    went = hands[np.minimum(row + AROUND, last)] - hands[np.maximum(row - AROUND, 0)]
    return np.asarray(went / np.maximum(np.linalg.norm(went, axis=1, keepdims=True), 1e-12))
