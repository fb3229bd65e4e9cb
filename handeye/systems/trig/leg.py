"""Lets TRIG run legs of a relay. In a leg, a TRIG program does not move the Purbrick arm, but the tool of the Stanford
arm.

TRIG's platter is a part of the table: its centre is at x = 20 and y = 36.5 in. X, Y and Z are parallel to the axes of
the table. If ROLL, PITCH and YAW are 0, the hand points straight down, with its finger line along Y. The leg's program
is taught on an ideal arm, by the script of the leg. So the taught places are exact. The positions in the arm
language's taught file are exact too, because they are computed from the drawing.

TRIG has no command with which a program can report that it has failed. Therefore a leg counts as successful only if
its program ends at the step FINISH.
"""

from collections.abc import Mapping, Sequence
from dataclasses import replace
from math import pi
from pathlib import Path
from typing import TYPE_CHECKING, Any, Final

import msgspec
import numpy as np

from handeye.arm.robots.stanford import STANFORD
from handeye.core.errors import BadFile, InvalidInput
from handeye.core.mutable_records import put_back
from handeye.core.pose import Array, hand
from handeye.core.record import Record, Vector3
from handeye.core.source import read_source
from handeye.core.units import INCH
from handeye.execution.tool_axes import ToolAxes
from handeye.machines.stanford_tool import LIMITS
from handeye.planfile.store import written_digest
from handeye.ports.axes import Axes, AxesReading, AxisSpec, Channel
from handeye.program.system_state import SystemState
from handeye.runs.hand_over import HandOver, StationMemory
from handeye.runs.legs import Lack, Use
from handeye.runs.setup import Setup
from handeye.runs.system import RunCallbacks
from handeye.runs.tool_leg import ToolArm, ToolLeg, ToolLegs, ToolMemory
from handeye.systems.trig import ENTRY
from handeye.systems.trig.language.axes_arm import ArmMemory, AxesArm
from handeye.systems.trig.language.command_input import Script
from handeye.systems.trig.language.graph import TOP
from handeye.systems.trig.language.no_arm import NoArm
from handeye.systems.trig.language.place import Place, is_named
from handeye.systems.trig.language.session import Session
from handeye.systems.trig.run.plan import TaughtListing, imagined, listing
from handeye.systems.trig.run.running_job import RunningJob
from handeye.systems.trig.run.state import TaughtState

if TYPE_CHECKING:
    from handeye.cell.simulated import SimulatedCell

CENTRE: Final = (20 * INCH, 36.5 * INCH)  # of the platter, in W (m)
FINISH: Final = "FINISH"
_DOWN: Final = (pi / 2, pi / 2, 0.0)  # O, A, T of a hand whose ROLL, PITCH and YAW are 0
_TRAVEL: Final = ((-0.2, 0.2), (-0.2, 0.2), (0.0, 0.3), *3 * ((-2.967, 2.967),))  # as that of TRIG's arm
_LONGEST: Final = 100_000  # characters


class LegScript(Record, frozen=True, kw_only=True):
    """The plan of a leg: its script."""

    job: str  # name of the file
    script: str


class LegState(TaughtState, kw_only=True):
    """The state of a leg between two steps."""

    tool: ToolMemory


class PlatterAxes(Axes):
    """Moves the tool of the arm along the axes of TRIG's platter: X, Y, Z, ROLL, PITCH and YAW. The gap of the hand is
    another axis.
    """

    def __init__(self, tool: ToolAxes) -> None:
        self._tool = tool
        self.told = np.array([*tool.goal, 0.0])  # last goal, as axes of the tool
        gap = tool.specs[-1]
        self._specs = (
            *tuple(
                replace(spec, lower=lower, upper=upper)
                for spec, (lower, upper) in zip(tool.specs[:-1], _TRAVEL, strict=True)
            ),
            gap,
        )

    @property
    def specs(self) -> tuple[AxisSpec, ...]:
        return self._specs

    @property
    def channels(self) -> tuple[Channel, ...]:
        return self._tool.channels

    @property
    def period(self) -> float:
        return self._tool.period

    def put(self, goal: Array) -> None:
        self.told = np.array([*on_table(Place(*map(float, goal[:6]))), float(goal[6])])
        self._tool.put(self.told)

    def read(self) -> AxesReading:
        """Return the sensed axes. The angles are the goal's angles, corrected by the rotation from the goal to the
        hand. They are not computed from the hand alone: when the hand points almost straight down, its own angles are
        ambiguous.
        """
        read = self._tool.read()
        R = hand(*read.q[:6])[:3, :3] @ hand(*self.told[:6])[:3, :3].T  # close to the identity
        turned = np.array([R[2, 1] - R[1, 2], R[0, 2] - R[2, 0], R[1, 0] - R[0, 1]]) / 2
        place = on_platter(self.told[:6])
        angles = np.array(place[3:]) + np.array([turned[2], turned[0], turned[1]])
        at = read.q[:3] - [*CENTRE, 0.0]
        return AxesReading(time=read.time, q=np.array([*at, *angles, read.q[6]]), channels=read.channels)


def on_table(place: Place) -> tuple[float, ...]:
    """Return x, y, z (m, W) and O, A, T (rad) of the hand at a place on the platter."""
    x, y, z, *angles = place
    return (x + CENTRE[0], y + CENTRE[1], z, *(a + down for a, down in zip(angles, _DOWN, strict=True)))


def on_platter(axes: "Sequence[float] | Array") -> Place:
    """Return the hand's place on the platter, if the hand is at x, y, z (m, W) and O, A, T (rad)."""
    x, y, z, *angles = map(float, axes)
    turned = ((a - down + pi) % (2 * pi) - pi for a, down in zip(angles, _DOWN, strict=True))
    return Place(x - CENTRE[0], y - CENTRE[1], z, *turned)


class _Job:
    """The job of a TRIG program that runs on the Stanford arm."""

    def __init__(self, session: Session) -> None:
        self.session = session
        self.arm: Any = session.arm
        self.axes: Any = None

    def turn(self) -> None:
        """Do nothing, because no job reverses a leg."""


class TaughtLeg(ToolLeg, RunningJob):
    """A taught program during its leg."""

    def __init__(self, setup: Setup, around: RunCallbacks, cell: "SimulatedCell") -> None:
        assert isinstance(setup.plan, LegScript)
        self._setup, self._plan = setup, setup.plan  # type: ignore[assignment]  # a leg has a plan of its own
        self._around = around
        known: TaughtListing = listing(self._plan)
        self._steps, self._numbers = known.steps, known.numbers
        self.tool = ToolArm(cell, STANFORD, around)
        imaginary = NoArm()
        session = Session(arm=imaginary, table=imaginary, desk=Script((), halted=around.halt))
        session.program = imagined(self._plan)
        self.job: Any = _Job(session)
        self._state = LegState(at=0, tool=self.tool.memory)
        self._rest, self._felt = np.zeros(3), 0.0

    @property
    def switched_on(self) -> float:
        return 0.0

    # -- taking over ----------------------------------------------------------------------------------------

    def take_over(self, stage: str, record: HandOver, station: StationMemory) -> None:
        program = self.job.session.program
        for name in {*record.named.get("place", {})} & {*program.positions}:
            position = program.positions[name]
            if not position.relative:
                position.init = position.data = on_platter(record.value(name, "place"))
        self.tool.take_over(record, station)
        self._use_arm()
        here = self.job.arm.here()
        gap = LIMITS.closed if record.held else self.tool.drive.sensed.gap
        self.job.arm.remember(ArmMemory(told=here, opening=gap, closed=bool(record.held)))
        program.begin()
        self._to(program.graph[TOP].sons[0])
        self._note()

    def _use_arm(self) -> None:
        axes = PlatterAxes(self.tool.axes)
        clock = self.cell.devices.clock
        self.job.axes = axes
        self.job.arm = self.job.session.arm = AxesArm(axes, clock, LIMITS, ready=True)

    def leave(self, record: HandOver | None) -> HandOver:
        program = self.job.session.program
        saved = {
            name: hand(*on_table(position.data))
            for name, position in program.positions.items()
            if is_named(name) and not position.relative and position.data != position.init
        }
        held = "a part" if self.job.arm.closed else ""
        return self.tool.hand_over(record, held, 0.0, saved)

    # -- running --------------------------------------------------------------------------------------------

    def _carried_out(self, step: Any) -> str | None:
        why = super()._carried_out(step)
        if why is not None:
            self.tool.stop()
        elif self._state.at is None and step.label != FINISH:
            self.tool.stop()
            self._state.at = None
            return f"the program has ended at line {step.place}, {step.text.strip()}, and not at the step {FINISH}"
        return why

    def _note(self) -> None:
        super()._note()
        self.tool.rest()

    def _hand(self) -> tuple[Vector3, float]:
        x, y, z = (round(float(value), 6) for value in self.tool.drive.hand()[:3, 3])
        return (x, y, z), round(self.tool.drive.sensed.gap, 6)

    def _force(self) -> Array:
        return -self.tool.memory.drive.wrench[:3]

    def restore(self, state: SystemState) -> None:
        if not isinstance(state, LegState):
            raise BadFile("the state of the run does not belong to a taught program")
        if state.arm is None:  # the leg has not begun
            put_back(self._state, state)
            self.tool.resume()
            return
        session = self.job.session
        state.check(session.program, len(self._steps))
        put_back(self._state, state)
        state.put_into(session.program)
        self.tool.resume()
        self._use_arm()
        self.job.arm.remember(state.arm)

    @property
    def shown(self) -> Mapping[str, Any]:
        return {} if self.job.axes is None else super().shown


class TaughtLegs(ToolLegs):
    """Legs of TRIG. A program is one leg."""

    system, language = ENTRY.name, "TRIG"
    state = LegState
    words = frozenset({
        "Move", "Change", "Test", "Jump", "Open", "Close", "Search", "Advance", "Countdown", "Assign",
        "Save", "Here",
    })  # fmt: skip

    def read(self, file: Path) -> LegScript:
        plan = LegScript(job=file.name.removesuffix(".trig"), script=read_source(file).text)
        self._check(plan, str(file))
        return plan

    def encode(self, plan: Record) -> bytes:
        return msgspec.json.encode(plan)

    def decode(self, data: bytes, name: str) -> LegScript:
        try:
            plan = msgspec.json.decode(data, type=LegScript)
        except (msgspec.DecodeError, UnicodeDecodeError, RecursionError) as error:
            raise BadFile(f"{name} is not valid: {error}") from None
        self._check(plan, name)
        return plan

    def _check(self, plan: LegScript, name: str) -> None:
        if len(plan.script) > _LONGEST:
            raise BadFile(f"{name} is not valid: its script has more than {_LONGEST} characters")
        try:
            listing(plan)
        except InvalidInput as error:
            raise BadFile(str(error)) from None

    def digest(self, plan: Record, data: bytes) -> str:
        return written_digest(data)

    def alike(self, one: Record, other: Record) -> bool:
        return one == other

    def listing(self, plan: Any) -> TaughtListing:
        return listing(plan)

    def lacks(self, plan: Any, stage: str, earlier: Sequence[str]) -> Sequence[Lack]:
        found = [*super().lacks(plan, stage, earlier)]
        if FINISH not in {step.label for step in listing(plan).steps}:
            found.append(Lack(1, f"no step is called {FINISH}, so the leg could never end successfully"))
        return found

    def writes(self, plan: Any, stage: str) -> Sequence[Use]:
        saved = {node.position for node in imagined(plan).graph.nodes.values() if node.type == "savpos"}
        return [Use(name, "place", 1) for name in sorted(filter(None, saved))]

    def build(self, setup: Setup, around: RunCallbacks, cell: "SimulatedCell") -> TaughtLeg:
        return TaughtLeg(setup, around, cell)


LEGS: Final = TaughtLegs()
