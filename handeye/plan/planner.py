"""The planning phase: a program and an arm make a plan. No clock, no randomness, no simulator.

The planner walks the program in the order of its text, each motion beginning where the one before was planned
to end. What cannot be reached, or would go through the table, is found here and not at run time.
"""

import math
import re
from dataclasses import dataclass, field

import msgspec
import numpy as np

from handeye.arm.kinematics import IKResult, forward, jacobian, solve
from handeye.arm.model import ArmModel, digest
from handeye.arm.samples import Samples
from handeye.cell.ports import TICK
from handeye.diagnostics import Diagnostic, Label
from handeye.plan.motions import NoWay, change_samples, move_trajectory, turn_samples
from handeye.plan.plan import Joints, Motion, Plan
from handeye.plan.program import Change, Here, Move, Program, Step, Stop, Turn
from handeye.plan.world import WorldModel
from handeye.pose import Array
from handeye.source import Source, Span
from handeye.units import INCH, OUNCE_FORCE, OUNCE_INCH

SPEED = 0.40
"""Free motions use this share of the arm's speeds, and its square of the accelerations. Fitted: with the
invented acceleration limits it makes the whole job take about the four minutes of 1973 (layout study, section
5); one datum, so no evidence of how slow the real arm was."""
HOME = "PARK"
"""The position a program starts from."""

RIDDLE = (
    "in the print of 1973 the second stop of the pin insertion can be read as 60 or as 600 oz; "
    "60 it must have been, for at 600 the search would never end"
)
"""Reference D1."""


def make_plan(
    program: Program, arm: ArmModel, *, speed: float = SPEED, start: Array | None = None
) -> tuple[Plan | None, list[Diagnostic]]:
    """The plan of a program for an arm, or what stands in its way.

    A position that only a `HERE` defines is in the plan where the hand is planned to be then.

    Args:
        start: where the arm stands when the program begins, shape (6,), rad and m; by default at `HOME`, or at
            the first goal of a program that has none.
    """
    walk = _Walk(program=program, arm=arm, speed=speed, world=WorldModel.of(program))
    walk.go(start)
    if walk.problems:
        return None, walk.problems
    positions = {**walk.world.moved, **program.positions}
    plan = Plan(
        arm=arm.name, arm_digest=digest(arm), speed=speed, motions=walk.motions,
        program=msgspec.structs.replace(program, positions=positions),
    )  # fmt: skip
    return plan, []


@dataclass(slots=True, kw_only=True)
class _Walk:
    program: Program
    arm: ArmModel
    speed: float
    world: WorldModel
    """Nothing in it is measured; what has moved in it, a `HERE` has defined."""
    q: Array = field(init=False)
    motions: dict[int, Motion] = field(default_factory=dict)
    problems: list[Diagnostic] = field(default_factory=list)

    def go(self, start: Array | None) -> None:
        if start is not None:
            self.q = start
        elif not self._start():
            return
        for number, step in enumerate(self.program.steps):
            operation = step.operation
            if isinstance(operation, Move):
                self._move(number, step, operation)
            elif isinstance(operation, Change):
                self._sampled(number, step, change_samples(self.arm, self.q, operation), _facing(operation))
            elif isinstance(operation, Turn):
                centre = self.world.position(operation.centre)
                self._sampled(number, step, turn_samples(self.arm, self.q, centre, operation), operation.stop)
            elif isinstance(operation, Here):
                self._define(operation.position)

    def _define(self, name: str) -> None:
        known = self.program.positions.get(name)
        of = None if known is None else known.of
        self.world.moved[name] = self.world.seen_from(of, forward(self.arm, self.q))

    def _start(self) -> bool:
        """Begin at the rest position, or at the first goal of a program that has none."""
        known = self.program.positions
        moves = [s.operation for s in self.program.steps if isinstance(s.operation, Move)]
        goals = [move.goal for move in moves if move.goal in known]
        first = HOME if HOME in known else (goals[0] if goals else None)
        self.q = (self.arm.lower + self.arm.upper) / 2
        if first is None:
            return True
        start = solve(self.arm, self.world.position(first), self.q)
        if start.q is not None:
            self.q = start.q
            return True
        step = next((s for s in self.program.steps if getattr(s.operation, "goal", None) == first), None)
        if step is None:
            step = self.program.steps[0]
        self._unreachable(step, first, start)
        return False

    def _move(self, number: int, step: Step, operation: Move) -> None:
        places = (*operation.via, operation.goal)
        *via, X_WT = (self.world.position(name) for name in places)
        for name, X in zip(places, (*via, X_WT), strict=True):
            if X[2, 3] < 0:
                self._problem(
                    step, name, "hand-through-table",
                    f"the hand would be {-X[2, 3] / INCH:.2f} in below the table at {name}",
                    help="the table top is z = 0; raise the position",
                )  # fmt: skip
                return
        trajectory = move_trajectory(self.arm, self.q, via, X_WT, operation, self.speed)
        if isinstance(trajectory, NoWay):
            self._unreachable(step, trajectory.name, trajectory.why)
            return
        knots = tuple(_joints(q) for q in trajectory.knots)
        self.motions[number] = Motion(knots=knots, times=tuple(float(t) for t in trajectory.times))
        self.q = np.array(knots[-1])
        self._check_stop(step, operation.stop)

    def _sampled(self, number: int, step: Step, samples: Samples | IKResult, stop: Stop | None) -> None:
        if isinstance(samples, IKResult):
            self._unreachable(step, step.text.split()[0], samples)
            return
        end = samples.q[-1] if len(samples.q) else self.q
        height = float(forward(self.arm, end)[2, 3])
        if height < 0 and stop is None:
            self._problem(
                step, step.text.split()[0], "hand-through-table",
                f"the hand would end {-height / INCH:.2f} in below the table",
                help="shorten the motion, or give it a STOP if it is to meet something",
            )  # fmt: skip
            return
        self._check_stop(step, stop)
        self.motions[number] = Motion(knots=(_joints(self.q), _joints(end)), times=(len(samples.q) * TICK,))
        self.q = end

    def _check_stop(self, step: Step, stop: Stop | None) -> None:
        """A force or moment the arm cannot exert can never stop it."""
        J = jacobian(self.arm, self.q)
        if stop is not None and stop.force is not None:
            self._check_exerted(step, "press", J[:3], np.array(stop.force) / OUNCE_FORCE, OUNCE_FORCE, "oz")
        if stop is not None and stop.moment is not None:
            self._check_exerted(step, "turn", J[3:], np.array(stop.moment) / OUNCE_INCH, OUNCE_INCH, "oz-in")

    def _check_exerted(self, step: Step, verb: str, J: Array, wanted: Array, si: float, unit: str) -> None:
        """What is wanted, along or about the rows of a Jacobian, in a unit and its SI value."""
        torque = np.abs(J.T @ wanted) * si
        limit = np.array([joint.effort for joint in self.arm.joints])
        if (torque <= limit).all():
            return
        joint = int(np.argmax(torque / limit))
        size = float(np.linalg.norm(wanted))
        self._problem(
            step, step.text.split()[0], "stop-beyond-arm",
            f"the arm cannot {verb} with {size:.0f} {unit} here, so the stop would never fire",
            note=RIDDLE if round(size) == 600 and verb == "press" else None,
            help=f"{self.arm.joints[joint].name} gives out at {size * limit[joint] / torque[joint]:.0f} {unit}",
        )  # fmt: skip

    def _unreachable(self, step: Step, word: str, failure: IKResult) -> None:
        self._problem(
            step, word, "unreachable-position", f"{word} cannot be reached by the {self.arm.name} arm",
            note=failure.message(self.arm),
        )  # fmt: skip

    def _problem(
        self,
        step: Step,
        word: str,
        code: str,
        message: str,
        *,
        note: str | None = None,
        help: str | None = None,
    ) -> None:
        self.problems.append(
            Diagnostic(
                code=code, message=message, help=help, notes=(note,) if note else (),
                primary=Label(span=_span(self.program.whole, step, word)),
            )
        )  # fmt: skip


def _facing(operation: Change) -> Stop | None:
    """The stop of a straight motion as a force along a vector, if it is one: a stop on whatever opposes it, too."""
    stop = operation.stop
    if stop is None or stop.against is None:
        return stop
    x, y, z = operation.displacement
    scale = stop.against / math.hypot(x, y, z)
    return Stop(force=(x * scale, y * scale, z * scale), moment=stop.moment)


def _span(whole: Source, step: Step, word: str) -> Span:
    """Where `word` stands on the source line of a step, or of a `VIA` above it."""
    source = next(text for text in whole.texts if text.key == step.file)
    begin = whole.begins[step.file]
    via = isinstance(step.operation, Move) and word in step.operation.via
    for number in range(step.line, 0, -1) if via else (step.line,):
        line = source.line_span(number)
        found = re.search(rf"(?<!\w){re.escape(word)}(?!\w)", source.text[line.start : line.end])
        if found is not None:
            line = Span(start=line.start + found.start(), end=line.start + found.end())
            break
    else:
        line = source.line_span(step.line)
    return Span(start=begin + line.start, end=begin + line.end)


def _joints(q: Array) -> Joints:
    a, b, c, d, e, f = (float(x) for x in q)
    return a, b, c, d, e, f
