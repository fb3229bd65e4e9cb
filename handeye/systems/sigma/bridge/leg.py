"""Lets SUPERSIGMA run legs of a relay: a MAL program moves the tool of the Stanford arm as if this tool were the hand
of arm 1. There is no bus.

The corner X1 = 0, Y1 = 0 of the board is at x = 350 and y = 800 mm on the table, and Z1 = 0 is 240 mm above the table.
The hand points straight down, with its fingers along Y. When a leg begins, the hand is brought straight to the nearest
place of the board, and the axes count from their origins. If the program uses the variables NAMEX, NAMEY and NAMEZ,
they have the coordinates (mm) of the place NAME in the record of the relay. Likewise, NAMEH has the height NAME in
this record, as a coordinate of Z1. A leg hands over the variables NAMEX, NAMEY and NAMEZ that it sets.
"""

from collections.abc import Mapping, Sequence
from math import ceil, pi
from pathlib import Path
from typing import TYPE_CHECKING, Any, Final, Literal

import numpy as np
from msgspec import field
from msgspec.structs import replace

from handeye.arm.robots.stanford import STANFORD
from handeye.core.errors import BadFile, Refused
from handeye.core.pose import hand
from handeye.core.source import Source, read_source
from handeye.core.units import INCH
from handeye.program.events import SystemEvent
from handeye.program.system_state import SystemState
from handeye.runs.hand_over import HandOver, Kind, StationMemory
from handeye.runs.legs import Lack, Use
from handeye.runs.setup import Setup
from handeye.runs.system import RunCallbacks
from handeye.runs.tool_leg import ToolArm, ToolLeg, ToolLegs, ToolMemory
from handeye.systems.sigma import ENTRY
from handeye.systems.sigma.bridge.borrowed_arm import BorrowedArm
from handeye.systems.sigma.bridge.borrowed_run import check_program
from handeye.systems.sigma.bridge.translation import DOWN
from handeye.systems.sigma.machine.perfect import TRAVEL
from handeye.systems.sigma.mal.check import checked
from handeye.systems.sigma.mal.memory import Fault
from handeye.systems.sigma.mal.virtual_machine import VirtualMachine
from handeye.systems.sigma.protocol import COMPONENTS, NUMBERS, STEP_MM
from handeye.systems.sigma.run.plan import MalPlan, listing, sound
from handeye.systems.sigma.run.running import RunningMal
from handeye.systems.sigma.run.state import MalState

if TYPE_CHECKING:
    from handeye.cell.simulated import SimulatedCell

CORNER: Final = (350.0, 800.0, 240.0)  # mm in W: the place of the tool at X1 = Y1 = Z1 = 0; Z1 points down
OPEN: Final = 3.4 * INCH * 1e3  # mm: this wide open, the hand fits over the hub of the pump's top
_MM: Final = 1e-3
_TURNING: Final = 0.5  # rad/s
_SPEED: Final = 0.1  # m/s, to the nearest place of the board
_SETTLES: Final = 20  # servo periods
_AXES: Final = tuple(f"{component}1" for component in COMPONENTS)


class MalLegState(MalState, kw_only=True):
    """The state of a leg between two statements."""

    tool: ToolMemory
    limits: dict[int, float] = field(default_factory=dict)  # N, by motor
    slow: list[int] = field(default_factory=list)  # motors whose motion has a constant speed
    felt: tuple[float, ...] = (0.0, 0.0, 0.0)  # N
    most: float = 0.0  # N
    zero: float = 0.0  # time of the cell (s) at which the leg began
    begun: bool = False


class LegArm(BorrowedArm):
    """The arm of a leg. Building this object does not move the arm."""

    def __init__(self, tool: ToolArm) -> None:
        super(BorrowedArm, self).__init__()
        self._tool = tool
        self._drive, self._axes, self._at = tool.drive, tool.axes, CORNER[:2]
        self._top, self._open = CORNER[2], OPEN
        self._limits = dict.fromkeys(map(NUMBERS.__getitem__, _AXES))
        self._slow, self.felt, self.most, self._zero = set(), np.zeros(3), 0.0, 0.0

    def begin_leg(self) -> None:
        """Bring the hand, pointing straight down, to the nearest place of the board. Set the step counts of the axes
        to this place.
        """
        self._axes = self._tool.axes
        here = self._axes.read().q
        goal = np.array([*here[:3], *DOWN, here[6] if self._hand_open else -0.02])
        for index, component in enumerate(COMPONENTS):
            axis, sign = f"{component}1", -1 if component == "Z" else 1
            steps = round(sign * (here[index] / _MM - CORNER[index]) / STEP_MM)
            steps = min(max(steps, 0), TRAVEL[component])
            goal[index] = (CORNER[index] + sign * steps * STEP_MM) * _MM
            motor = self._memory.motors[NUMBERS[axis]]
            motor.count = motor.place = steps
        turn = (goal[3:6] - here[3:6] + pi) % (2 * pi) - pi
        far = float(np.abs(goal - here)[:3].max())
        periods = ceil(max(far / _SPEED, float(np.abs(turn).max()) / _TURNING) / self._axes.period)
        start = np.array([*here[:3], *(goal[3:6] - turn), goal[6]])
        for share in [*np.linspace(0, 1, periods + 1)[1:], *np.ones(_SETTLES)]:
            self._drive_to(start + share * (goal - start))
        self._axes.tare()
        self._zero = self._drive.cell.clock.now

    @property
    def _hand_open(self) -> bool:
        return not self._memory.devices[NUMBERS["HAND1"]].get(0)

    def hold(self) -> None:
        """Let the program begin with a closed hand, because the hand holds a part."""
        self._memory.devices[NUMBERS["HAND1"]][0] = 1


class MalLeg(ToolLeg, RunningMal):
    """A MAL program during its leg."""

    def __init__(self, setup: Setup, around: RunCallbacks, cell: "SimulatedCell") -> None:
        assert isinstance(setup.plan, MalPlan)
        super(RunningMal, self).__init__(setup, around, listing(setup.plan))
        self._plan = setup.plan
        self._early, self._begun = [], False
        self._gantries = self._witness = None
        self._watched = 0
        self.tool = ToolArm(cell, STANFORD, around)
        self._machine: Any = LegArm(self.tool)
        self.vm = VirtualMachine(
            setup.plan.program,
            self._machine,
            self._tell,
            poll=self._poll,
            statement_us=setup.plan.statement_us,
        )
        self._state: Any = MalLegState(
            memory=self.vm.memory, machine=self._machine.memory, tool=self.tool.memory
        )

    def _tell(self, event: SystemEvent) -> None:
        self._around.emit(replace(event, time=self.time))

    # -- taking over ------------------------------------------------------------------------------------------

    def take_over(self, stage: str, record: HandOver, station: StationMemory) -> None:
        found = {}
        for use in LEGS.reads(self._plan, stage):
            if use.kind == "height":
                found[f"{use.name}H"] = CORNER[2] - record.height(use.name) / _MM
            else:
                place = _on_board(record.value(use.name, "place").tolist())
                found |= {use.name + axis: value for axis, value in zip("XYZ", place, strict=True)}
        self.vm.memory.variables |= found
        self.tool.take_over(record, station)
        if record.held:
            self._machine.hold()
        self._machine.begin_leg()
        memory = self.vm.memory
        for axis in _AXES:
            memory.counts[axis] = self._machine.memory.motors[NUMBERS[axis]].count
        memory.originated = _AXES
        self._begun = self._state.begun = True
        self.vm.begin()
        self._stand()
        self._call()
        self._rest()

    def leave(self, record: HandOver | None) -> HandOver:
        variables = self.vm.memory.variables
        places = {
            use.name: hand(*_on_table(*(variables[use.name + axis] for axis in "XYZ")), *DOWN)
            for use in LEGS.writes(self._plan, "")
            if all(use.name + axis in variables for axis in "XYZ")
        }
        held = "" if self._machine._hand_open else "a part"
        return self.tool.hand_over(record, held, 0.0, places)

    # -- running ----------------------------------------------------------------------------------------------

    def step(self) -> None:
        vm = self.vm
        try:
            super().step()
        except Refused as refused:
            task = vm.memory.last
            at = vm.memory.tasks[task].pc if task in vm.memory.tasks else 0
            vm.memory.fault = Fault(kind="fail", task=task, address=at, told=str(refused))
            self._stand()
            self._call()
        if self._state.stopped is not None:
            self.tool.stop()
        self._rest()

    def _rest(self) -> None:
        """After a statement, copy the state of the arm to the state that is saved."""
        self.tool.rest()
        state, arm = self._state, self._machine
        state.limits = {number: limit for number, limit in arm._limits.items() if limit is not None}
        state.slow, state.felt = sorted(arm._slow), tuple(map(float, arm.felt))
        state.most, state.zero = arm.most, arm._zero

    def restore(self, state: SystemState) -> None:
        if not isinstance(state, MalLegState):
            raise BadFile("the state of the run does not fit this program")
        super().restore(state)
        self._begun = state.begun
        self.tool.resume()
        arm = self._machine
        arm._axes = self.tool.axes
        arm._limits = {number: state.limits.get(number) for number in arm._limits}
        arm._slow, arm.felt, arm.most, arm._zero = {*state.slow}, np.array(state.felt), state.most, state.zero

    @property
    def figures(self) -> Mapping[str, float]:
        return {}


def _on_board(numbers: Sequence[float]) -> tuple[float, ...]:
    """Return X1, Y1, Z1 (mm) of a place (m, W)."""
    x, y, z = (value / _MM for value in numbers[:3])
    return x - CORNER[0], y - CORNER[1], CORNER[2] - z


def _on_table(x: float, y: float, z: float) -> tuple[float, float, float]:
    """Return x, y, z (m, W) of a place on the board."""
    return (CORNER[0] + x) * _MM, (CORNER[1] + y) * _MM, (CORNER[2] - z) * _MM


def _variables(plan: MalPlan, op: Literal["PUSHV", "POPV"]) -> set[str]:
    """Return the names of the variables that a program reads (PUSHV) or sets (POPV)."""
    return {each.operand for each in plan.program.code if each.op == op and isinstance(each.operand, str)}


def _counted(plan: MalPlan) -> set[str]:
    """Return the counting variables of all FORs, and the variables for which an INPUT asks."""
    return {str(each.operand) for each in plan.program.code if each.op in ("FOR", "IN")}


def _line_of(plan: MalPlan, name: str) -> int:
    """Return the number of the first line that contains a name."""
    return next((line.number for line in plan.program.lines if name in line.text), 0)


class MalLegs(ToolLegs):
    """Legs of SUPERSIGMA. A program is one leg."""

    system, language = ENTRY.name, "MAL"
    state = MalLegState
    words = frozenset({
        "Move", "Change", "Test", "Jump", "Open", "Close", "Search", "Advance", "Countdown", "Assign", "Wait", "Save",
        "Travel", "Height", "Here", "Restore", "Tool",
    })  # fmt: skip

    def read(self, file: Path) -> MalPlan:
        source = read_source(file)
        plan = MalPlan(name=file.name, text=source.text)
        sound(plan)
        check_program(checked(source)[0])
        return plan

    def lacks(self, plan: Any, stage: str, earlier: Sequence[str]) -> Sequence[Lack]:
        try:
            check_program(checked(Source(name=plan.name, text=plan.text))[0])
        except BadFile as error:
            return [Lack(1, str(error))]
        return super().lacks(plan, stage, earlier)

    def reads(self, plan: Any, stage: str) -> Sequence[Use]:
        """Return the places and heights in variables that the program reads but never sets."""
        given = _variables(plan, "PUSHV") - _variables(plan, "POPV") - _counted(plan)
        kinds: dict[str, Kind] = {"X": "place", "Y": "place", "Z": "place", "H": "height"}
        return [
            Use(name[:-1], kinds[name[-1]], _line_of(plan, name))
            for name in sorted(given)
            if name[-1] in kinds
        ]

    def build(self, setup: Setup, around: RunCallbacks, cell: "SimulatedCell") -> MalLeg:
        return MalLeg(setup, around, cell)

    def writes(self, plan: Any, stage: str) -> Sequence[Use]:
        names = _variables(plan, "POPV")
        whole = {name[:-1] for name in names if {name[:-1] + axis for axis in "XYZ"} <= names}
        return [Use(name, "place", 1) for name in sorted(whole)]


LEGS: Final = MalLegs()
