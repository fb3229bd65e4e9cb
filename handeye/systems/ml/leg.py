"""Lets ML run legs of a relay: a program in ML moves the tool of the Stanford arm.

The motors have the numbers of the rectilinear arm. Motors 4, 3 and 2 are X, Y and Z (down). Motor 8 is the roll of a
hand that points straight down, and motor 11 is the gap of the fingers. The unit of the slides is .001 inch, and the
unit of the roll is .01 degree. When all slides are at 0, the tool is at x = 24, y = 42 and z = 5 in. When the roll is
0, the finger line is along Y. Sensors 2 to 4 read the force on the hand along X, Y and Z (up) in grams, and sensors 9
and 10 read the switches of the fingers. A cycle takes a servo period of the arm, 1/60 s, instead of 10 ms.

A remark `* NAME IS &n` reads the height NAME from the hand-over record, and puts it into the variable n as a position
of motor 2. A remark `* &n IS NAME` hands the variable n over as the height NAME. ML has no word with which a program
can report a failure. Therefore, a program has succeeded only if the last line that it printed is 0.
"""

import re
from collections.abc import Mapping, Sequence
from math import pi
from pathlib import Path
from typing import TYPE_CHECKING, Any, Final

import numpy as np
from msgspec.structs import replace

from handeye.arm.robots.stanford import STANFORD
from handeye.core.errors import BadFile, Refused
from handeye.core.pose import Array
from handeye.core.source import read_source
from handeye.core.units import INCH
from handeye.execution.tool_axes import ToolAxes
from handeye.ports.axes import Axes, AxesReading, AxisSpec, Channel, Outputs
from handeye.ports.clock import Clock
from handeye.program.events import SystemEvent
from handeye.program.system_state import SystemState
from handeye.runs.hand_over import HandOver, StationMemory
from handeye.runs.legs import Lack, Use
from handeye.runs.setup import Setup
from handeye.runs.system import RunCallbacks
from handeye.runs.tool_leg import ToolArm, ToolLeg, ToolLegs, ToolMemory
from handeye.systems.ml import ENTRY
from handeye.systems.ml.happenings import Printed
from handeye.systems.ml.machine.rectilinear import axes_of
from handeye.systems.ml.machine.spec import (
    GRAM_FORCE,
    LINEAR,
    ROTARY,
    AnalogInput,
    ArmSpec,
    MotorSpec,
    analog,
    digital,
)
from handeye.systems.ml.realtime.machine import Machine
from handeye.systems.ml.run.hardware import Hardware, Tell
from handeye.systems.ml.run.plan import MlPlan, sound
from handeye.systems.ml.run.running import RunningMl
from handeye.systems.ml.run.state import MlState

if TYPE_CHECKING:
    from handeye.cell.simulated import SimulatedCell

HAND: Final = 11  # number of the motor of the fingers
ZERO: Final = (24 * INCH, 42 * INCH, 5 * INCH)  # x, y, z of the tool in W (m) with all slides at 0
_DOWN: Final = (pi / 2, pi / 2, 0.0)  # O, A, T
_SLIDE: Final = {"lower": -10_039, "upper": 10_039, "tolerance": 60}
"""Ends of the travel of a slide of the rectilinear arm, and the tolerance of its goals, in thousandths of an inch. The
tolerance is our choice: friction may stop the Stanford arm up to 1.5 mm from its goal.
"""

SPEC: Final = ArmSpec(
    side="right",
    motors=(
        MotorSpec(number=2, axis="z", peak=13_000, output=1, **_SLIDE),
        MotorSpec(number=3, axis="y", peak=13_000, output=2, **_SLIDE),
        MotorSpec(number=4, axis="x", peak=13_000, output=3, **_SLIDE),
        MotorSpec(
            number=8,
            axis="roll",
            unit=ROTARY,
            lower=-17_500,
            upper=17_500,
            peak=6000,
            tolerance=150,
            output=4,
        ),
        MotorSpec(number=11, axis="separation", lower=0, upper=4000, peak=3000, tolerance=4000, output=7),
    ),
    analog={17 + n: AnalogInput(channel=f"pushed_{part}", count=GRAM_FORCE) for n, part in enumerate("xyz")},
    digital={2: ("touch_1", "touch_2")},
    sensors={**{2 + n: analog(17 + n) for n in range(3)}, 9: digital(2, 1), 10: digital(2, 2)},
)
"""The Stanford arm, as the real-time level sees it. The separation of the fingers counts as within the tolerance of
its goal at every value, because a part may stop the fingers.
"""
_GIVES: Final = re.compile(r"\*\s*([A-Z][A-Z0-9]*) IS &(\d+)\s*", re.ASCII)
_TAKES: Final = re.compile(r"\*\s*&(\d+) IS ([A-Z][A-Z0-9]*)\s*", re.ASCII)


class MlLegState(MlState, kw_only=True):
    """The state of a leg between two statements."""

    tool: ToolMemory
    begun: bool = False
    printed: str = ""  # the last line that the program has printed


class SlideAxes(Axes):
    """Moves the tool of the arm as the slides of the rectilinear arm would move it."""

    name = "slides"

    def __init__(self, tool: ToolAxes) -> None:
        self.tool = tool
        self.roll = 0.0

    @property
    def specs(self) -> tuple[AxisSpec, ...]:
        return axes_of(SPEC)

    @property
    def channels(self) -> tuple[Channel, ...]:
        return (Channel(name="pushed", unit="N", width=3), Channel(name="touch", width=2))

    @property
    def period(self) -> float:
        return self.tool.period

    def power(self, on: bool) -> None:
        """Do nothing. The servo of the arm is a program in the computer. This program ends when the brakes are set, so
        there is no power to switch.
        """

    def put(self, goal: Array) -> None:
        z, y, x, self.roll, gap = map(float, goal)
        closed = -0.02 if gap <= 0 else gap
        o, a, t = _DOWN
        self.tool.put(np.array([x + ZERO[0], y + ZERO[1], ZERO[2] - z, o + self.roll, a, t, closed]))

    def read(self) -> AxesReading:
        read = self.tool.read()
        turned = (read.q[3] - _DOWN[0] - self.roll + pi) % (2 * pi) - pi
        upright = (
            abs(abs(read.q[4]) - pi / 2) < 0.05
        )  # then O says little about the roll: assume the roll of the goal
        roll = self.roll + (0.0 if upright else turned)
        q = np.array([ZERO[2] - read.q[2], read.q[1] - ZERO[1], read.q[0] - ZERO[0], roll, read.q[6]])
        channels = {
            **{f"pushed_{part}": -read.channels[f"force_{part}"] for part in "xyz"},
            **{part: read.channels[part] for part in ("touch_1", "touch_2")},
        }
        return AxesReading(time=read.time, q=q, channels=channels)


class _NoOutputs(Outputs):
    """The arm has no tools that ML could switch."""

    name = "no outputs"

    @property
    def names(self) -> tuple[str, ...]:
        return ()

    def set(self, name: str, value: float) -> None:
        raise Refused(f"there is no tool {name}")


class _Cycles(Clock):
    """Lets a servo period pass in each cycle."""

    def __init__(self, axes: SlideAxes, clock: Clock) -> None:
        self._axes, self._clock = axes, clock

    @property
    def now(self) -> float:
        return self._clock.now

    @property
    def period(self) -> float:
        return self._axes.period

    def advance(self, seconds: float) -> None:
        self._clock.advance(self._axes.period)


class LegHardware(Hardware):
    """The arm of a leg."""

    def __init__(self, tool: ToolArm, tell: Tell) -> None:
        self.axes = SlideAxes(tool.axes)
        clock = _Cycles(self.axes, tool.cell.devices.clock)
        self.machine = Machine({"right": (SPEC, self.axes, _NoOutputs())}, clock, tell)

    def signal(self, interlock: str, *, on: bool) -> None:
        raise Refused("the cell has no interlocks that ML could sense")


class MlLeg(ToolLeg, RunningMl):
    """A program in ML during its leg."""

    def __init__(self, setup: Setup, around: RunCallbacks, cell: "SimulatedCell") -> None:
        self.tool = ToolArm(cell, STANFORD, around)
        super().__init__(setup, around)
        plain = self._state
        self._state: Any = MlLegState(
            **{name: getattr(plain, name) for name in plain.__struct_fields__}, tool=self.tool.memory
        )

    def _open(self) -> Hardware:
        return LegHardware(self.tool, self._tell)

    @property
    def _slides(self) -> SlideAxes:
        hardware = self._hardware
        assert isinstance(hardware, LegHardware)
        return hardware.axes

    @property
    def figures(self) -> Mapping[str, float]:
        return {}

    def _watch(self) -> None:
        """Do nothing: the drive of the arm already reports every servo period."""

    def _tell(self, event: SystemEvent) -> None:
        if isinstance(event, Printed):
            self._state.printed = event.text
        super()._tell(replace(event, time=self.time))

    # -- taking over ------------------------------------------------------------------------------------------

    def take_over(self, stage: str, record: HandOver, station: StationMemory) -> None:
        self._held = None
        self.recorder.restart()  # as when a run is resumed
        known = {name: record.height(name) for name in _given(self._plan)}
        for name, variable in _given(self._plan).items():
            value = round((ZERO[2] - known[name]) / LINEAR)
            self.machine.levels["right"].write("VR", variable, 1, value)
        self.tool.take_over(record, station)
        self._slides.tool = self.tool.axes
        self._turn_down(held=bool(record.held))
        level = self.machine.levels["right"]
        level.enable()
        if record.held:  # as after HAND 0: the fingers go on pressing
            line = level.memory.MT[HAND - 1]
            line.strategic = line.tactical = level.memory.fine[HAND - 1] = 0
        self.tool.axes.tare()
        self.interpreters["right"].run(self._plan.first)
        self._stand()
        self._state.begun = True
        self.recorder.statement()
        self.tool.rest()

    def _turn_down(self, *, held: bool) -> None:
        """Turn the hand straight down at its present place. The slides begin at the positions that belong to this
        place.
        """
        axes, here = self.tool.axes, self.tool.axes.read().q
        self._slides.roll = (here[3] - _DOWN[0] + pi) % (2 * pi) - pi if abs(here[4] - pi / 2) < 0.5 else 0.0
        goal = np.array([*here[:3], _DOWN[0] + self._slides.roll, *_DOWN[1:], -0.02 if held else here[6]])
        for _ in range(40):
            axes.put(goal)
            self.tool.drive.cell.clock.advance(axes.period)
        axes.read()

    def leave(self, record: HandOver | None) -> HandOver:
        heights = {
            name: ZERO[2] - self.machine.memory.shared.VR[variable - 1] * LINEAR
            for name, variable in _taken(self._plan).items()
        }
        gap = self.machine.levels["right"].goal(HAND)
        made = self.tool.hand_over(record, "a part" if gap <= 0 else "", 0.0, {})
        named = {
            **made.named,
            "height": {**made.named.get("height", {}), **{n: (h,) for n, h in heights.items()}},
        }
        return replace(made, named=named)

    # -- running ----------------------------------------------------------------------------------------------

    def step(self) -> None:
        try:
            super().step()
        except Refused as refused:
            self._stop(str(refused), self._state.at or 0)
        state = self._state
        if state.at is None and state.stopped is None and state.printed != "0":
            self._stop(
                f"the program has ended, but the last line that it printed is {state.printed!r}, not 0", 0
            )
        if state.stopped is not None:
            self.tool.stop()
        self.tool.rest()

    def restore(self, state: SystemState) -> None:
        if not isinstance(state, MlLegState):
            raise BadFile("the state of the run does not fit this program")
        super().restore(state)
        mine = self._state
        mine.begun, mine.printed = state.begun, state.printed
        from handeye.core.mutable_records import put_back

        put_back(mine.tool, state.tool)
        self.tool.resume()
        self._slides.tool = self.tool.axes
        self._slides.roll = self.machine.memory.arms["right"].MT[7].tactical * ROTARY


def _given(plan: MlPlan) -> dict[str, int]:
    """Return the variables that receive heights from the hand-over record. The keys are the names of the heights."""
    return {
        found[1]: int(found[2])
        for line in plan.text.splitlines()
        if (found := _GIVES.fullmatch(line.strip()))
    }


def _taken(plan: MlPlan) -> dict[str, int]:
    """Return the variables that a program hands over as heights. The keys are the names of the heights."""
    return {
        found[2]: int(found[1])
        for line in plan.text.splitlines()
        if (found := _TAKES.fullmatch(line.strip()))
    }


class MlLegs(ToolLegs):
    """Legs of ML. A program is one leg."""

    system, language = ENTRY.name, "ML"
    state = MlLegState
    words = frozenset({
        "Move", "Change", "Test", "Jump", "Open", "Close", "Search", "Advance", "Countdown", "Assign", "Save", "Here",
        "Travel", "Height", "Turn", "Restore",
    })  # fmt: skip

    def read(self, file: Path) -> MlPlan:
        plan = MlPlan(name=file.name, text=read_source(file).text)
        sound(plan)
        return plan

    def reads(self, plan: Any, stage: str) -> Sequence[Use]:
        return [Use(name, "height", 1) for name in sorted(_given(plan))]

    def writes(self, plan: Any, stage: str) -> Sequence[Use]:
        return [Use(name, "height", 1) for name in sorted(_taken(plan))]

    def lacks(self, plan: Any, stage: str, earlier: Sequence[str]) -> Sequence[Lack]:
        motors = {motor.number for motor in SPEC.motors}
        found = [*super().lacks(plan, stage, earlier)]
        for number, line in plan.lines.items():
            statement = line.statement
            if statement.code in ("MOTOR", "DMOTOR") and str(statement).split()[1].isdigit():
                if int(str(statement).split()[1]) not in motors:
                    found.append(Lack(number, f"{statement} needs a motor that this arm does not have"))
            elif statement.code in ("MOVE", "DMOVE", "GOPOINT"):
                found.append(Lack(number, f"{statement.code} moves all motors of the rectilinear arm"))
        return found

    def build(self, setup: Setup, around: RunCallbacks, cell: "SimulatedCell") -> MlLeg:
        return MlLeg(setup, around, cell)


LEGS: Final = MlLegs()
