"""The Stanford arm replaces arm 1: the axes X1, Y1 and Z1 move the tool of the Stanford arm along its coordinates, and
there is no bus.

The central computer gives this arm the same commands as the motors of SUPERSIGMA. The commands are not sent as bytes;
instead, they set a new goal of the tool in each servo period of 1/60 s (`execution/tool_axes.py`). Commands, places
and times are handled as for perfect motors, except that each motion takes as long as this arm needs.
"""

import math
from collections.abc import Callable
from typing import Final

import numpy as np

from handeye.arm.robots.stanford import STANFORD
from handeye.cell.compiled_arm import CompiledArm
from handeye.core.errors import Refused
from handeye.core.pose import Array
from handeye.core.variation import WorldSpec
from handeye.execution.drive import ArmDrive
from handeye.execution.friction_measurement import measure_joints
from handeye.execution.state import DriveState
from handeye.execution.tool_axes import ToolAxes
from handeye.ports.microbus import Command, Status
from handeye.systems.sigma.bridge.translation import AT, DOWN, OPEN, TOP
from handeye.systems.sigma.firmware.force import CONVERTER_N
from handeye.systems.sigma.machine.perfect import MotorMemory, PerfectMotors
from handeye.systems.sigma.protocol import (
    COMPONENTS,
    FORCE_STEP_N,
    NUMBERS,
    SLOW_STEP_MM,
    STANDARD,
    STEP_MM,
    Op,
)
from handeye.tasks.water_pump.cell import build_cell
from handeye.tasks.water_pump.world.pump_world import PumpWorld

FASTEST: Final = 150.0  # mm/s: at this speed, the arm feels up to about 5 N in free motion
QUINTIC: Final = 1.875  # a smooth motion from rest to rest: greatest speed / mean speed
SETTLES: Final = 0.15  # s from the last goal until the arm has arrived
HAND_S: Final = 1.0  # s in which the fingers open or close
_START_SPEED: Final = 0.1  # m/s, on the way to the places of the axes at power-on
_AXES: Final = tuple(NUMBERS[f"{component}1"] for component in COMPONENTS)
_FORCE: Final = NUMBERS["FORCE1"]
_HAND: Final = NUMBERS["HAND1"]
_MM: Final = 0.001


class BorrowedArm(PerfectMotors):
    """Moves the tool of an arm as the motors of arm 1 would move the hand of arm 1.

    There is no reflex at the standard limit, because this arm feels several newtons even in free motion. If LIMIT has
    set a force for an axis, a motion of this axis stops at most one servo period after this force is exceeded. The
    motors of SUPERSIGMA stop within a millisecond.
    """

    def __init__(self, drive: ArmDrive, at: tuple[float, float] = AT) -> None:
        """Take control of an arm that the servo holds in place. Then bring the tool to the place that the axes have at
        power-on.
        """
        super().__init__()
        self._drive, self._axes, self._at = drive, ToolAxes(drive), at
        self._top, self._open = TOP, OPEN  # mm
        self._limits: dict[int, float | None] = dict.fromkeys(_AXES)  # N
        self._slow: set[int] = set()  # motors whose motion has a constant speed
        self.felt = np.zeros(3)  # N on the hand, along X, Y and Z
        self.most = 0.0  # N: the greatest force so far, along any axis
        self._approach()
        self._axes.tare()
        self._zero = drive.cell.clock.now

    # -- time ------------------------------------------------------------------------------------------------

    def wait(self, until: int) -> int:
        event = self.next_event
        end = until if event is None else min(until, event)
        while self._next_period() <= end:
            self._memory.now = max(self._memory.now, self._next_period())
            if self._period():
                break
        else:
            return super().wait(until)
        return self._memory.now

    def _next_period(self) -> int:
        """Return the time at which the next servo period ends (microseconds)."""
        passed = self._drive.cell.clock.now - self._zero
        return math.ceil((passed + self._axes.period) * 1e6 - 1e-3)

    def _period(self) -> bool:
        """Drive the arm for a servo period. Returns True if a force has stopped a motor."""
        self._drive_to(self._goal())
        return self._feel()

    def _drive_to(self, goal: Array) -> None:
        """Drive the tool towards a goal for a servo period. Raises Refused if the arm cannot go to the goal."""
        try:
            self._axes.put(goal)
        except Refused as refused:
            places = zip(COMPONENTS, (self._place(number) for number in _AXES), strict=False)
            told = ", ".join(f"{component}1 = {place:.4g}" for component, place in places)
            why = str(refused).partition(": ")[2]
            raise Refused(f"the Stanford arm does not reach {told} mm: {why}") from None
        self._drive.cell.clock.advance(self._axes.period)

    def _feel(self) -> bool:
        told = self._axes.read().channels
        self.felt = np.array([-told["force_x"], -told["force_y"], told["force_z"]])
        self.most = max(self.most, float(np.abs(self.felt).max()))
        stopped = False
        for index, number in enumerate(_AXES):
            limit, motor = self._limits[number], self._memory.motors[number]
            if limit is not None and motor.status == Status.BUSY and abs(self.felt[index]) > limit:
                self._stop(number, motor)
                stopped = True
        return stopped

    def _stop(self, number: int, motor: MotorMemory) -> None:
        done = round(motor.steps * self._share(number, motor))
        motor.count, motor.place = motor.count + done, motor.place + done
        motor.status, motor.steps, motor.until = Status.FORCE, 0, self._memory.now
        motor.aborted_at = motor.count

    @property
    def error(self) -> float:
        """The greatest distance of the tool from its goal along one axis (mm)."""
        return float(np.abs(self._axes.read().q - self._goal())[:3].max()) / _MM

    # -- goals -----------------------------------------------------------------------------------------------

    def _goal(self) -> Array:
        """Return the goal of the tool now: x, y, z (m), O, A, T (rad), and the gap (m)."""
        places = [self._place(number) for number in _AXES]
        x, y, z = places
        tool = ((self._at[0] + x) * _MM, (self._at[1] + y) * _MM, (self._top - z) * _MM)
        gap = 0.0 if self._memory.devices[_HAND].get(0) else self._open * _MM
        return np.array([*tool, *DOWN, gap])

    def _place(self, number: int) -> float:
        """Return where an axis should be now (mm)."""
        motor = self._memory.motors[number]
        return (motor.place + motor.steps * self._share(number, motor)) * STEP_MM

    def _share(self, number: int, motor: MotorMemory) -> float:
        """Return the fraction of a motor's motion that should be complete by now."""
        if not motor.steps:
            return 0.0
        s = (self._memory.now - motor.begun) / max(1.0, motor.until - motor.begun - SETTLES * 1e6)
        s = min(max(s, 0.0), 1.0)
        return s if number in self._slow else s**3 * (10 - 15 * s + 6 * s * s)

    def _approach(self) -> None:
        """Move the tool along a straight line to the place where the axes are at power-on."""
        here, goal = self._axes.read().q, self._goal()
        steps = math.ceil(float(np.abs(goal - here)[:3].max()) / _START_SPEED / self._axes.period)
        for share in [*np.linspace(0, 1, steps + 1)[1:], *np.ones(20)]:
            self._drive_to(here + share * (goal - here))
        self._axes.read()

    # -- commands --------------------------------------------------------------------------------------------

    def _accept(self, command: Command) -> bytes | None:
        if command.number != _FORCE:
            return super()._accept(command)
        if command.op == Op.THRESHOLD:
            standard = command.value == STANDARD
            self._limits[_AXES[command.detail]] = None if standard else command.value * FORCE_STEP_N
            if not standard:
                self._axes.tare()
            return None
        if command.op in (Op.FORCE, Op.PEAK_FORCE):
            force = float(self.felt[command.detail])
            steps = round(round(force / CONVERTER_N) * CONVERTER_N / FORCE_STEP_N)
            return steps.to_bytes(2, "big", signed=True)
        return None

    def _hand(self, command: Command) -> bytes | None:
        answer = super()._hand(command)
        if command.op == Op.ACTUATE and command.detail == 0:
            self._memory.hands[command.number] = self._memory.free_at + round(HAND_S * 1e6)
        return answer

    def _begin(self, motor: MotorMemory, steps: int, time: int, ends: Status = Status.FREE) -> None:
        number = next(number for number, each in self._memory.motors.items() if each is motor)
        self._slow.discard(number)
        speed = min(FASTEST, motor.limit * STEP_MM or FASTEST)
        taken = QUINTIC * abs(steps) * STEP_MM / speed + SETTLES
        super()._begin(motor, steps, round(taken * 1e6), ends)

    def _move(self, motor: MotorMemory, axis: str, command: Command, steps: int, was: Status) -> None:
        super()._move(motor, axis, command, steps, was)
        if command.op == Op.MOVE_SLOW and motor.steps:
            speed = min(FASTEST, (command.detail >> 1) * SLOW_STEP_MM)
            self._slow.add(command.number)
            taken = abs(motor.steps) * STEP_MM / speed + SETTLES
            motor.until = motor.begun + round(taken * 1e6)


def borrowed(
    spec: WorldSpec, at: tuple[float, float], poll: Callable[[], None] = lambda: None
) -> BorrowedArm:
    """Return the Stanford arm over the table of a world of the water pump. The arm has already measured the friction
    of its joints.

    Args:
        at: where the board's corner X1 = 0, Y1 = 0 lies on the table (mm).
        poll: called repeatedly during the measurement; may raise an exception.
    """
    cell = build_cell(PumpWorld.draw(spec), camera="ray").devices
    state = DriveState.holding(cell.sense(), STANFORD)

    def halt() -> bool:
        poll()
        return False

    measured = measure_joints(cell, STANFORD, state, halt, CompiledArm)
    state.friction, state.links = measured.friction, measured.links
    return BorrowedArm(ArmDrive(cell=cell, arm=STANFORD, state=state, arithmetic=CompiledArm), at)
