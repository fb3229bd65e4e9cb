"""Actions of the hand: opening, closing and centring, with checks of the sensors of the hand."""

from typing import Final

import numpy as np

from handeye.arm.kinematics import forward
from handeye.core import errors
from handeye.core.pose import translated
from handeye.execution.context import Action, ExecutionContext
from handeye.execution.state import Fault
from handeye.program.diagnosis.causes import Cause, GapTooLarge, GapTooSmall, NothingBetween
from handeye.program.diagnosis.sense_causes import (
    GapAstray,
    GapStill,
    GapUnlike,
    SwitchesClosed,
    SwitchesCrossed,
    SwitchesHard,
    SwitchesOpen,
)
from handeye.program.motion_operations import Center, Close, Open
from handeye.program.operation import Operation
from handeye.touch.centring import Centring
from handeye.touch.senses import (
    EMPTY_GAP,
    FREE_OPENING,
    GAP_ERROR,
    SKEW,
    SWITCH_FORCE,
    at_least,
    at_most,
    followed,
    least_gap,
    stood_still,
    thick,
)

SHUT: Final = -0.02  # gap set-point, in m, beyond any closed gap: the fingers press with full force


def open_hand(run: ExecutionContext, operation: Open) -> Fault | None:
    """Drive the fingers to a gap."""
    start = run.drive.sensed.gap
    run.state.grasping = False
    _to_gap(run, operation.gap)
    run.drive.hold(run.arm.hand.grasp.settle)
    gap, touch = run.drive.sensed.gap, _touch(run)
    if not followed(gap, operation.gap):
        return _gap_wrong(GapAstray(gap=round(gap, 6), goal=operation.gap))
    if any(touch) and operation.gap - start > FREE_OPENING:
        return _switch_wrong(SwitchesClosed(fingers=touch))
    return None


def _to_gap(run: ExecutionContext, goal: float) -> None:
    drive = run.drive
    start = drive.state.gap = drive.sensed.gap
    ticks = max(1, round(abs(goal - start) / (run.arm.hand.grasp.speed * drive.period)))
    for i in range(1, ticks + 1):
        drive.state.gap = start + (goal - start) * i / ticks
        drive.hold(1)


def close(run: ExecutionContext, operation: Close) -> Fault | None:
    """Close the fingers until both finger switches show a touch, or until the gap is too small for any object. Then
    check that the hand holds the expected object.
    """
    fault = _begin_to_close(run)
    if fault is not None:
        return fault
    drive, grasp = run.drive, run.arm.hand.grasp
    start = drive.state.gap = drive.sensed.gap
    least = least_gap(operation.minimum)
    floor = min(least, drive.state.gap)
    while not all(_touch(run)) and drive.sensed.gap > floor - 1e-4 and drive.state.gap > SHUT:
        drive.state.gap -= grasp.speed * drive.period
        drive.hold(1)
    driven = _driven(start, drive.state.gap)
    drive.state.gap = SHUT
    drive.hold(grasp.settle)
    return _still(run, start, driven) or _held(run, least, operation.maximum)


def center(run: ExecutionContext, operation: Center) -> Fault | None:
    """Close the fingers on an object, and move the arm so that the object stays in place."""
    if "centring" in run.without:
        fault = close(run, Close(minimum=operation.minimum))  # the object moves to the middle of the hand
        run.state.finger_line = forward(run.arm, run.drive.state.q)[:3, 1] if fault is None else None
        run.state.travel = 0.0
        return fault
    fault = _begin_to_close(run)
    if fault is not None:
        return fault
    drive, grasp = run.drive, run.arm.hand.grasp
    X_WT = forward(run.arm, drive.state.q)
    begun, line = X_WT[:3, 3], X_WT[:3, 1]
    here = drive.dynamics()
    start = drive.state.gap = drive.sensed.gap
    centring = Centring(minimum=operation.minimum, speed=grasp.centring)
    while not centring.done:
        step = centring.step(touch=_touch(run), gap=drive.sensed.gap, period=drive.period)
        drive.state.gap += step.gap
        X_WT = translated(X_WT, step.hand * line)
        outcome = drive.shift(here, X_WT)
        if outcome.error is not None:
            return Fault(number=outcome.error, cause=outcome.cause)
    driven = _driven(start, drive.state.gap)
    drive.hold(1)
    lead = grasp.lag(SWITCH_FORCE, drive.state.grip)
    if not centring.error:
        drive.state.gap = drive.sensed.gap - lead
    drive.hold(grasp.settle // 2 - 1)
    for _ in range(0 if centring.error or "touch" in run.without else grasp.settle // 4):
        if all(_touch(run)):  # a jerk of the arm may open a switch for a period
            break
        # Pressure makes a leaning object stand up. The fingers must follow it to press as hard as before.
        drive.state.gap = min(drive.state.gap, drive.sensed.gap - lead)
        drive.hold(1)
    run.state.travel = abs(float((X_WT[:3, 3] - begun) @ line))
    still = _still(run, start, driven)
    if still is not None:
        return still
    if centring.error == errors.SWITCH_WRONG:
        touch = drive.sensed.touch
        return _switch_wrong(SwitchesCrossed(fingers=touch, moved=round(centring.eased, 6)))
    least = least_gap(operation.minimum)
    if centring.error and "touch" not in run.without:
        gap = (
            run.drive.sensed.gap
        )  # if an object holds the fingers apart, a switch has not noticed the contact
        if at_least(gap, least + FREE_OPENING):
            return _switches_open(run)
        return Fault(number=errors.NOTHING_HELD, cause=NothingBetween(gap=round(gap, 6)))
    run.state.finger_line = (
        np.zeros(3) if "touch" in run.without else line
    )  # without touch, CENTER measures nothing
    thin = _thick_enough(run, least)
    first, second = _touch(run)
    if thin is None and "touch" not in run.without and not (first and second):
        return _switch_wrong(SwitchesHard(fingers=(not first, not second), force=round(SWITCH_FORCE, 6)))
    return thin


def _touch(run: ExecutionContext) -> tuple[bool, bool]:
    """Return the state of the finger switches, or (False, False) if touch is switched off."""
    return (False, False) if "touch" in run.without else run.drive.sensed.touch


# -- what the senses say of it ------------------------------------------------------------------------


def _begin_to_close(run: ExecutionContext) -> Fault | None:
    """Check that no finger touches an object before the hand closes. If a touch switch is on, open the hand a little,
    and return an error if a switch is still on.
    """
    drive, already = run.drive, run.state.grasping
    run.state.grasping, drive.state.in_air = True, False
    drive.state.clear = drive.state.clear and already  # what is grasped stands on something
    if already or not any(_touch(run)):
        return None
    _to_gap(run, drive.sensed.gap + FREE_OPENING)
    drive.hold(run.arm.hand.grasp.settle // 2)
    touch = drive.sensed.touch
    return _switch_wrong(SwitchesClosed(fingers=touch)) if any(touch) else None


def _driven(start: float, goal: float) -> float:
    """Return the distance (m) by which the fingers were driven together. A negative goal counts as 0."""
    return start - max(goal, 0.0)


def _still(run: ExecutionContext, start: float, driven: float) -> Fault | None:
    """Check that the gap changed while the fingers were driven by the distance `driven` (m). If touch is switched off,
    nothing is checked.
    """
    if "touch" in run.without or not stood_still(start - run.drive.sensed.gap, driven):
        return None
    return _gap_wrong(GapStill(gap=round(run.drive.sensed.gap, 6), driven=round(driven, 6)))


def _held(run: ExecutionContext, least: float, maximum: float | None) -> Fault | None:
    """Check by the gap and by both switches that the hand holds an object."""
    gap, touching = run.drive.sensed.gap, all(_touch(run)) or "touch" in run.without
    unlike = _unlike(run, least, maximum) if all(_touch(run)) else None
    if unlike is not None:
        return _gap_wrong(unlike)
    thin = _thick_enough(run, least)
    if thin is not None:
        return thin
    if not touching and at_least(gap, GAP_ERROR):
        return _switches_open(run)
    if maximum is not None and not at_most(gap, maximum):
        return Fault(number=errors.WRONG_THICKNESS, cause=GapTooLarge(gap=round(gap, 6), maximum=maximum))
    return None


def _unlike(run: ExecutionContext, least: float, maximum: float | None) -> GapUnlike | None:
    """Compare the gap with the nominal thickness of the object that the hand should hold at this place. Returns None
    if the two agree, if the hand is empty, or if the object is unknown.

    The program gives limits for the gap. When the gap is outside these limits for the first time, the gap is not
    reported here, because the object may be askew in the hand. If the gap is the same at the next
    grasp, the gap is reported.
    """
    state, gap = run.state, run.drive.sensed.gap
    name, thickness = _nominal(run)
    if thickness is None or gap <= EMPTY_GAP or thick(gap, thickness):
        return None
    again = state.unlike is not None and abs(gap - state.unlike) <= SKEW
    state.unlike = gap
    within = at_least(gap, least) and (maximum is None or at_most(gap, maximum))
    return GapUnlike(gap=round(gap, 6), thickness=thickness, held=name) if again or within else None


def _nominal(run: ExecutionContext) -> tuple[str, float | None]:
    """Return the name of the object that the hand should hold at its present position, and the object's nominal
    thickness (m). Returns "" and None if the object is not known.
    """
    objects = run.plan.program.held.items()
    known = ((name, held.thickness) for name, held in objects if run.state.place in held.positions)
    return next(known, ("", None))


def _thick_enough(run: ExecutionContext, least: float) -> Fault | None:
    gap = run.drive.sensed.gap
    if at_least(gap, least):
        return None
    cause = GapTooSmall(gap=round(gap, 6), minimum=least, of=run.part_here)
    return Fault(number=errors.NOTHING_HELD, cause=cause)


def _switches_open(run: ExecutionContext) -> Fault:
    (first, second), gap = run.drive.sensed.touch, run.drive.sensed.gap
    _, thickness = _nominal(run)
    fits = thickness is not None and thick(gap, thickness)
    return _switch_wrong(SwitchesOpen(fingers=(not first, not second), gap=round(gap, 6), fits=fits))


def _switch_wrong(cause: Cause) -> Fault:
    return Fault(number=errors.SWITCH_WRONG, cause=cause)


def _gap_wrong(cause: Cause) -> Fault:
    return Fault(number=errors.GAP_WRONG, cause=cause)


HAND_ACTIONS: Final[dict[type[Operation], Action]] = {Open: open_hand, Close: close, Center: center}
