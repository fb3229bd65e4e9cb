"""Plans a program for an arm. The planner uses no clock, random numbers or simulator.

The planner goes through the program in text order. Each motion begins where the previous motion was planned to end.
The planner finds collisions, goals that are out of reach, and loads that are too heavy, before the program runs.
"""

from collections.abc import Callable, Sequence
from dataclasses import dataclass, field
from typing import Any, Final

import msgspec
import numpy as np

from handeye.arm.ik import IKResult, solve
from handeye.arm.ik.result import SLACK
from handeye.arm.kinematics import forward
from handeye.arm.model import ArmModel, digest
from handeye.arm.samples import Samples
from handeye.core.diagnostics import Diagnostic
from handeye.core.pose import Array
from handeye.core.source import Source
from handeye.planfile.plan import Joints, Plan, PlannedMotion
from handeye.planning.motion_checks import Checks, Demand, FindingList, to_press, to_stop
from handeye.planning.motions import Unreachable, change_samples, move_trajectory, turn_samples
from handeye.program.diagnosis.plan_findings import GoalBelowTable, NoConfiguration, PlanFinding
from handeye.program.flow_operations import Here
from handeye.program.language import Language
from handeye.program.motion_operations import Change, Move, Turn
from handeye.program.operation import Operation
from handeye.program.program import Program, Step
from handeye.program.taught import Taught
from handeye.program.world_model import WorldModel

SPEED = 0.40
"""Speed of free motions as a fraction of the rate limits of the arm. Accelerations are scaled by the square of this
fraction.

Fitted: with the assumed acceleration limits, the whole job takes about four minutes, as in 1973 (layout study,
section 5). Because the fraction was fitted, the duration of the job is no evidence of the speed of the real arm.
"""
HOME = "PARK"  # the position a program starts from
_COLLISION_STRIDE = (
    2  # servo periods between checks of a free motion: under .6 in of motion at the pump's speeds
)


def make_plan(
    program: Program, arm: ArmModel, *, task: str, speed: float = SPEED, start: Array | None = None
) -> tuple[Plan | None, list[PlanFinding]]:
    """Plan a program for an arm. Returns the plan and the findings. The plan is None if there are errors.

    A position that only a `HERE` defines gets the pose in which the plan brings the arm to this `HERE`. The arm begins
    at `start`, shape (n,), rad and m. By default, the arm begins at the position `HOME`, or at the first goal if the
    program has no `HOME`.
    """
    findings = FindingList()
    walk = _Walk(
        program=program, arm=arm, speed=speed, world=WorldModel.of(program), findings=findings,
        checks=Checks(arm, program, findings),
    )  # fmt: skip
    walk.go(start)
    if findings.is_fatal:
        return None, findings.findings
    positions = {**walk.world.state.moved, **program.positions}
    plan = Plan(
        task=task, arm=arm.name, arm_digest=digest(arm), speed=speed, motions=walk.motions,
        program=msgspec.structs.replace(program, positions=positions),
    )  # fmt: skip
    return plan, findings.findings


@dataclass(slots=True, kw_only=True)
class _Walk:
    program: Program
    arm: ArmModel
    speed: float
    world: WorldModel  # planned poses only; `HERE` alone moves positions
    findings: FindingList
    checks: Checks
    q: Array = field(init=False)
    known: bool = True
    """False after a jump and after an impossible motion. The configuration of the arm is then unknown, and `q` is
    only a guess.
    """
    motions: dict[int, PlannedMotion] = field(default_factory=dict)

    def go(self, start: Array | None) -> None:
        if start is None:
            self._start()
        else:
            self.q = start
        ahead = {0}
        for number, step in enumerate(self.program.steps):
            if number not in ahead:
                self.known = False
                self.checks.forget()
            if step.operation.moves:
                ahead = set()
            ahead.update(way for way in step.ways if way is not None)
            plan = _PLANNED.get(type(step.operation))
            if plan is not None:
                plan(self, number, step, step.operation)
            self.checks.follow(number, step)

    def change(self, number: int, step: Step, operation: Change) -> None:
        samples = change_samples(self.arm, self.q, operation)
        demands = [*to_stop(operation.guards, operation.displacement), *to_press(operation)]
        self._sampled(number, step, samples, operation.meets, demands)

    def turn(self, number: int, step: Step, operation: Turn) -> None:
        samples = turn_samples(self.arm, self.q, self.world.position(operation.centre), operation)
        self._sampled(number, step, samples, bool(operation.guards), to_stop(operation.guards))

    def define(self, _: int, __: Step, operation: Here) -> None:
        name = operation.position
        known = self.program.positions.get(name)
        of = None if known is None else known.of
        self.world.state.moved[name] = self.world.seen_from(of, forward(self.arm, self.q))

    def _start(self) -> None:
        """Begin at the position `HOME`, or at the first goal if the program has no `HOME`."""
        known = self.program.positions
        led_to = (step.operation.goal_position for step in self.program.steps)
        goals = [goal for goal in led_to if goal in known]
        first = HOME if HOME in known else (goals[0] if goals else None)
        self.q = self.arm.middle
        if first is None:
            self.known = False
            return
        start = solve(self.arm, self.world.position(first), self.q)
        if start.q is not None:
            self.q = start.q
            return
        self.known = False
        if first not in goals:
            self._no_configuration(0, first, start)

    def move(self, number: int, step: Step, operation: Move) -> None:
        places = (*operation.via, operation.goal)
        *via, X_WT = (self.world.position(name) for name in places)
        for name, X in zip(places, (*via, X_WT), strict=True):
            if X[2, 3] < -SLACK:
                self.known = False
                self.findings.add(GoalBelowTable(step=number, position=name, depth=-float(X[2, 3])))
                return
        trajectory = move_trajectory(self.arm, self.q, via, X_WT, operation, self.speed)
        if isinstance(trajectory, Unreachable):
            self.known = False
            self._no_configuration(number, trajectory.name, trajectory.why)
            return
        knots = tuple(_joints(q) for q in trajectory.knots)
        self.motions[number] = PlannedMotion(knots=knots, times=tuple(float(t) for t in trajectory.times))
        begin = 0.0 if self.known else float(trajectory.times[:-1].sum())  # the approach is known in any case
        count = 2 + int((trajectory.duration - begin) / (_COLLISION_STRIDE * self.arm.servo.period))
        q = trajectory.at(np.linspace(begin, trajectory.duration, count)).q
        if not operation.guards:
            self.checks.clear(number, step, q)
        self.checks.strong(number, q, to_stop(operation.guards))
        self.checks.told_from_friction(number, q[0], to_stop(operation.guards))
        self.q, self.known = np.array(knots[-1]), True

    def _sampled(
        self, number: int, step: Step, samples: Samples | IKResult, guarded: bool, demands: Sequence[Demand]
    ) -> None:
        """Add a motion that is given by all its set-points. `guarded` is True if the motion should make contact."""
        if isinstance(samples, IKResult):
            if self.known:
                self._no_configuration(number, None, samples)
            self.known = False
            return
        q = np.vstack([self.q, samples.q])
        if self.known:
            if not guarded:
                self.checks.clear(number, step, q)
            self.checks.strong(number, q, demands)
            self.checks.told_from_friction(number, q[0], demands)
        seconds = len(samples.q) * self.arm.servo.period
        self.motions[number] = PlannedMotion(knots=(_joints(self.q), _joints(q[-1])), times=(seconds,))
        self.q = q[-1]

    def _no_configuration(self, number: int, position: str | None, failure: IKResult) -> None:
        """Report a position or a motion for which there are no joint positions."""
        assert failure.reason is not None
        about = position if failure.along is None else None
        self.findings.add(
            NoConfiguration(step=number, position=about, reason=failure.reason, along=failure.along)
        )


_PLANNED: Final[dict[type[Operation], Callable[[_Walk, int, Step, Any], None]]] = {
    Move: _Walk.move,
    Change: _Walk.change,
    Turn: _Walk.turn,
    Here: _Walk.define,
}  # steps that move the arm, or need its pose


def _joints(q: Array) -> Joints:
    return tuple(float(x) for x in q)


@dataclass(frozen=True, slots=True, kw_only=True)
class PlannedScript:
    """The plan of a script (None if the script has errors), and the diagnostics."""

    source: Source
    plan: Plan | None
    diagnostics: list[Diagnostic]


def plan_source(
    source: Source,
    taught: Taught,
    arm: ArmModel,
    language: Language,
    *,
    task: str,
    start: Array | None = None,
) -> PlannedScript:
    """Compile and plan a script. `make_plan` describes `task` and `start`."""
    program, diagnostics = language.compile(source, taught)
    if program is None:
        return PlannedScript(source=source, plan=None, diagnostics=diagnostics)
    plan, problems = plan_program(program, arm, language, task=task, start=start)
    return PlannedScript(source=source, plan=plan, diagnostics=[*diagnostics, *problems])


def plan_program(
    program: Program, arm: ArmModel, language: Language, *, task: str = "", start: Array | None = None
) -> tuple[Plan | None, list[Diagnostic]]:
    """Plan a program. Returns the plan, and diagnostics in the words of the program's language. The plan is None if
    there are errors. `task` does not affect the planning; it is only stored in the plan.
    """
    plan, findings = make_plan(program, arm, task=task, start=start)
    return plan, language.phrase(program, arm, findings)
