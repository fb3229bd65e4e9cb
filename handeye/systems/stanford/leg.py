"""Lets the system of 1973 run legs of a relay: each leg is a stage of a plan of motions."""

from collections.abc import Iterator, Mapping, Sequence
from pathlib import Path
from typing import Final

import numpy as np

from handeye.cell.simulated import SimulatedCell
from handeye.core.diagnostics import has_errors, quoted
from handeye.core.entries import PLANNED
from handeye.core.errors import BadFile, NoSuchName
from handeye.core.pose import hand
from handeye.execution.hand_actions import SHUT
from handeye.execution.state import ExecutionState
from handeye.planfile.plan import Plan
from handeye.program.motion_operations import Close, Height
from handeye.program.program import Position, Step
from handeye.program.world_model import rounded_place
from handeye.runs.hand_over import HandOver, Kind, StationMemory, place_now
from handeye.runs.legs import Lack, LegSystem, RunningLeg, Use
from handeye.runs.scripts import plan_script
from handeye.runs.setup import Setup
from handeye.runs.system import RunCallbacks
from handeye.systems.stanford.executor_run import RunningPlan
from handeye.touch.senses import EMPTY_GAP

UNNAMED: Final = "a part"  # what the hand holds if the program has no name for it


class PlanLeg(RunningPlan, RunningLeg):
    """A plan during its legs."""

    def stand_at(self, stage: str) -> None:
        steps = LEGS.steps(self.plan, stage)
        if self.state.at not in steps:
            self.state.at = steps[0]

    def take_over(self, stage: str, record: HandOver, station: StationMemory) -> None:
        found = {kind: self._found(stage, kind, record) for kind in ("difference", "height", "place")}
        self._take_station(station)
        state, world = self.state, self.context.world
        state.drive.hold_anew(self._cell.devices.sense(), self.arm)
        state.drive.load, state.grasping = record.load, bool(record.held)
        if record.held:
            state.drive.gap = SHUT  # the fingers go on pressing
        state.pending = state.search = state.finger_line = state.held = None
        state.stage = state.stopped = state.onward = None
        state.saved |= found["difference"]
        state.heights |= {name: float(numbers[0]) for name, numbers in found["height"].items()}
        for name, numbers in found["place"].items():
            if name in world.parts:
                world.measure(name, hand(*numbers))
            else:
                x, y, z, o, a, t = map(float, numbers)
                state.world.moved[name] = Position(at=(x, y, z, o, a, t))

    def _found(self, stage: str, kind: Kind, record: HandOver) -> Mapping[str, np.ndarray]:
        """Return those values of the record whose names this program uses. Raises Refused if a value that the stage
        needs is neither in this program nor in the record, or if it is of the wrong kind in the record.
        """
        program, state = self.plan.program, self.state
        own = {"difference": {*state.saved}, "height": {*state.heights}, "place": {*program.positions}}[kind]
        needed = {use.name for use in LEGS.reads(self.plan, stage) if use.kind == kind} - own
        known = {*program.written("difference")}
        if kind == "place":
            known = {*program.positions, *program.parts}
        names = needed | (known & {*record.named.get(kind, {})})
        return {name: record.value(name, kind) for name in sorted(names)}

    def take_back(self, station: StationMemory) -> None:
        self._take_station(station)
        drive = self.state.drive
        load, gap = drive.load, drive.gap
        drive.hold_anew(self._cell.devices.sense(), self.arm)
        drive.load, drive.gap = load, gap

    def leave(self, record: HandOver | None) -> HandOver:
        run, state = self.context, self.state
        run.drive.state.tool = 0.0
        run.drive.stop()
        named: dict[Kind, dict[str, tuple[float, ...]]] = {
            "place": {
                **{name: rounded_place(X) for name, X in state.world.measured.items()},
                **{name: rounded_place(run.world.position(name)) for name in state.world.moved},
            },
            "difference": {name: tuple(map(float, value)) for name, value in state.saved.items()},
            "height": {name: (value,) for name, value in state.heights.items()},
        }
        earlier = {} if record is None else record.named
        return HandOver(
            hand=place_now(run.drive.sensed, self.arm),
            gap=round(run.drive.sensed.gap, 6),
            held=self._held(),
            load=state.drive.load,
            named={kind: {**earlier.get(kind, {}), **values} for kind, values in named.items()},
        )

    def _held(self) -> str:
        """Return the name of the part that is in the hand according to the program."""
        if not self.state.grasping or self.context.drive.sensed.gap < EMPTY_GAP:
            return ""
        held = self.plan.program.held.items()
        return next((name for name, each in held if self._grasped in each.positions), UNNAMED)

    @property
    def _grasped(self) -> str:
        """The position of the last MOVE before the hand closed."""
        steps = self.plan.program.steps
        closed = False
        for done in reversed(self.state.done):
            operation = steps[done.step].operation
            closed = closed or isinstance(operation, Close)
            if closed and operation.goal_position is not None:
                return operation.goal_position
        return ""

    @property
    def station(self) -> StationMemory:
        state, drive = self.state, self.state.drive
        return StationMemory(
            friction=drive.friction,
            links=drive.links,
            weights=drive.weights,
            calibration=state.calibration,
            lens=state.lens,
            camera_ready=state.camera_ready,
        )

    def _take_station(self, station: StationMemory) -> None:
        state, drive = self.state, self.state.drive
        drive.friction, drive.links, drive.weights = station.friction, station.links, station.weights
        state.calibration, state.camera_ready = station.calibration, station.camera_ready
        if station.lens is not None:
            state.lens = station.lens
        self._take_calibration()


class PlanLegs(LegSystem):
    """The legs of a relay that are stages of a plan of motions."""

    system = PLANNED
    state = ExecutionState
    stages_in_text = undoes = True

    def read(self, file: Path) -> Plan:
        made = plan_script(file)
        if made.plan is None or has_errors(made.diagnostics):
            first = next(
                (each.message for each in made.diagnostics if each.severity == "error"), "it has errors"
            )
            raise BadFile(f"{file} cannot be planned: {first}; `handeye check {file}` shows all mistakes")
        return made.plan

    def steps(self, plan: Plan, stage: str) -> range:  # type: ignore[override]  # as `read` has made it
        stages = plan.program.stages
        if stage not in stages:
            raise NoSuchName(
                f"{plan.program.name} has no stage {quoted(stage)}; its stages are "
                f"{', '.join(map(quoted, stages))}"
            )
        numbers = [n for n, step in enumerate(plan.program.steps) if stages[step.stage] == stage]
        return range(numbers[0], numbers[-1] + 1) if numbers else range(0)

    def reads(self, plan: Plan, stage: str) -> Sequence[Use]:  # type: ignore[override]
        steps = [plan.program.steps[number] for number in self.steps(plan, stage)]
        own = {use.name for step in steps for use in step.operation.writes if use.kind == "difference"}
        found: dict[tuple[str, Kind], Use] = {}
        for step in steps:
            for name, kind in _needed(step):
                if name not in own:
                    found.setdefault((name, kind), Use(name, kind, step.line))
        return [*found.values()]

    def writes(self, plan: Plan, stage: str) -> Sequence[Use]:  # type: ignore[override]
        kinds: dict[str, tuple[Kind, ...]] = {
            "difference": ("difference", "height"), "position": ("place",), "part": ("place",),
        }  # fmt: skip
        return [
            Use(use.name, kind, step.line)
            for step in (plan.program.steps[number] for number in self.steps(plan, stage))
            for use in step.operation.writes
            for kind in kinds.get(use.kind, ())
        ]

    def lacks(self, plan: Plan, stage: str, earlier: Sequence[str]) -> Sequence[Lack]:  # type: ignore[override]
        program, numbers = plan.program, self.steps(plan, stage)
        steps = [program.steps[number] for number in numbers]
        before = [program.steps[number] for each in earlier for number in self.steps(plan, each)]
        taken = {
            use.name for step in (*before, *steps) for use in step.operation.writes if use.kind == "picture"
        }
        found = [
            Lack(step.line, f"no earlier leg of this program takes the picture {use.name}")
            for step in steps
            for use in step.operation.reads
            if use.kind == "picture" and use.name not in taken
        ]
        return found + [
            Lack(
                step.line,
                f"this step can lead into the middle of the stage {quoted(program.stages[there.stage])}",
            )
            for step in steps
            for there in (program.steps[way] for way in step.ways if way is not None and way not in numbers)
            if program.steps.index(there) != self.steps(plan, program.stages[there.stage])[0]
        ]

    def takes_pictures(self, plan: Plan) -> bool:  # type: ignore[override]
        return bool(plan.program.written("picture"))

    def build(self, setup: Setup, around: RunCallbacks, cell: SimulatedCell) -> PlanLeg:
        return PlanLeg(setup, around, cell)


def _needed(step: Step) -> Iterator[tuple[str, Kind]]:
    """Yield the saved values that a step reads. HEIGHT reads a height, and RESTORE reads a difference."""
    kind: Kind = "height" if isinstance(step.operation, Height) else "difference"
    for use in step.operation.reads:
        if use.kind == "difference":
            yield use.name, kind


LEGS: Final = PlanLegs()
