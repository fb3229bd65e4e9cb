"""Firmware of a motor, which converts commands to pulse trains. If the level at a pin of the interrupt gate rises
during a motion, the motor stops with the steepest ramp.
"""

from typing import Final, Literal

from handeye.core.mutable_records import MutableRecord
from handeye.ports.microbus import Command, Status
from handeye.systems.sigma.firmware.device import PS, Crystal, Device
from handeye.systems.sigma.motors.pulses import (
    CURVES,
    RELEASE,
    SEEK,
    Curve,
    Train,
    constant,
    profile,
    stop,
)
from handeye.systems.sigma.protocol import LONGEST_MOVE, SLOW_STEP_MM, STEP_MM, Op

Pin = Literal["low", "high", "force"]
"""A pin of the interrupt gate. It signals the low end of the rail, the high end, or excessive force."""
State = Literal["still", "moving", "stopping", "seeking", "turning", "releasing"]
"""State of a motor. During an ORIGIN, the motor is `seeking` on its way to the low end of the rail, `turning` while it
brakes there, and `releasing` until the switch of the low end opens.
"""
COUNTING: Final[frozenset[State]] = frozenset({"still", "moving", "stopping"})
"""States in which the count of a motor stays valid."""
_BITS: Final = 16
TURN: Final = (
    2_000  # microseconds for which a motor pauses before it turns round, so that its rotor keeps step
)
REST: Final = 20_000  # microseconds of this pause in ORIGIN, where the motor stops by the steepest ramp


class MotorMemory(MutableRecord, kw_only=True, tag="motor"):
    """The state of a motor's firmware."""

    state: State = "still"
    status: Status = Status.FREE
    train: Train | None = None
    began: int = 0  # ps
    sense: int = 1  # direction of the train, 1 or -1
    ended: int = -REST * PS  # ps: time at which the last train ended
    pulses: int = 0  # pulses sent to the driver before the train, forward minus backward
    zero: int = 0  # the number of these pulses at which the count is 0
    at_abort: int = 0  # count when the last abort began, or where ORIGIN ended, before it became 0
    cause: Status = Status.FREE  # cause of the stop that is under way
    pressed: int = 0  # direction of the motion that met the present force
    curve: int = 0
    limit: int = 0  # steps/s; 0: none
    low: bool = False  # levels of the motor's pins
    high: bool = False
    force: bool = False


class Motor(Device):
    """The firmware of one motor."""

    memory: MotorMemory
    tied = True
    ramped = True  # constant speeds over start/stop speed begin and end with ramps

    def __init__(self, crystal: Crystal) -> None:
        super().__init__(crystal)
        self.memory = MotorMemory()

    @property
    def status(self) -> Status:
        return self.memory.status

    # -- where it is -------------------------------------------------------------------------------------

    def sent(self, at: int) -> int:
        """Return the number of pulses sent to the driver up to the time `at`, forward pulses minus backward ones."""
        memory = self.memory
        if memory.train is None:
            return memory.pulses
        made = memory.train.pulses.count(self.crystal.ticks_in(at - memory.began))
        return memory.pulses + memory.sense * made

    def count(self, at: int) -> int:
        """Return the count (steps) at the time `at`, as a signed number of 16 bits."""
        half = 1 << _BITS - 1
        return (self.sent(at) - self.memory.zero + half) % (1 << _BITS) - half

    def speed(self, at: int) -> float:
        """Return the signed speed (steps/s) at the time `at`."""
        memory = self.memory
        if memory.train is None:
            return 0.0
        return memory.sense * memory.train.pulses.speed(self.crystal.ticks_in(at - memory.began))

    def when(self, pulse: int) -> int | None:
        """Return the time of a pulse of the train. Pulses are numbered from 1. Returns None if that pulse is never
        sent.
        """
        memory = self.memory
        if memory.train is None or not 1 <= pulse <= len(memory.train.pulses):
            return None
        # a tick is over once its last picosecond is
        return memory.began + self.crystal.ticks(int(memory.train.pulses.ticks[pulse - 1])) + 1

    # -- commands ----------------------------------------------------------------------------------------

    def execute(self, command: Command, at: int) -> bytes:
        memory, code, value = self.memory, command.detail >> 1, command.value
        sense = -1 if command.detail & 1 else 1
        match command.op:
            case Op.POSITION:
                return self._answer(self.count(at), at)
            case Op.ABORT_POSITION:
                return self._answer(memory.at_abort, at)
        memory.status = Status.FREE
        match command.op:
            case Op.MOVE if value:
                memory.curve = code & 0b111
                self._move(profile(value, self.shape, memory.limit), sense, at)
            case Op.MOVE_SLOW if value and code:
                speed = code * SLOW_STEP_MM / STEP_MM
                self._move(constant(value, speed, self.shape, memory.limit, ramped=self.ramped), sense, at)
            case Op.LIMIT_SPEED:
                memory.limit = value
            case Op.SET_POSITION:
                memory.zero = memory.pulses - value
            case Op.ORIGIN:
                self._seek(at)
        return b""

    @property
    def shape(self) -> Curve:
        """The acceleration curve that is selected."""
        return CURVES[self.memory.curve if self.memory.curve < len(CURVES) else 0]

    def _answer(self, count: int, at: int) -> bytes:
        self.memory.status = Status.FREE
        return (count & LONGEST_MOVE).to_bytes(2, "big")

    def _move(self, train: Train, sense: int, at: int) -> None:
        memory = self.memory
        if memory.low if sense < 0 else memory.high:
            self._refuse(Status.RAIL, at)
        elif memory.force and memory.pressed in (0, sense):
            memory.pressed = sense
            self._refuse(Status.FORCE, at)
        else:
            self._start("moving", train, sense, at)

    def _refuse(self, cause: Status, at: int) -> None:
        self.memory.status, self.memory.at_abort = cause, self.count(at)

    def _start(self, state: State, train: Train, sense: int, at: int) -> None:
        memory = self.memory
        begins = at if sense == memory.sense else max(at, memory.ended + self.crystal.micros(TURN))
        memory.state, memory.train, memory.sense, memory.began = state, train, sense, begins
        memory.status = Status.BUSY

    def _halt(self, at: int) -> float:
        """End the pulse train. Returns the speed (steps/s) just before the end."""
        memory, speed = self.memory, abs(self.speed(at))
        memory.pulses, memory.train, memory.state, memory.ended = self.sent(at), None, "still", at
        return speed

    def _seek(self, at: int) -> None:
        if self.memory.low:
            self._release(at)
        else:
            limit = min(SEEK, self.memory.limit or SEEK)
            self._start("seeking", profile(LONGEST_MOVE, self.shape, limit), -1, at)

    def _release(self, at: int) -> None:
        self._start("releasing", constant(LONGEST_MOVE, RELEASE, self.shape), 1, at)

    # -- what happens without a command ------------------------------------------------------------------

    @property
    def due(self) -> int | None:
        memory = self.memory
        if memory.train is None:
            return None
        return memory.began + self.crystal.ticks(memory.train.pulses.end) + 1

    def elapse(self, at: int) -> None:
        """Handle the end of the pulse train."""
        memory, ended = self.memory, self.memory.state
        self._halt(at)
        match ended:
            case "moving":
                memory.status = Status.FREE
            case "stopping":
                memory.status = memory.cause
            case "turning":
                self._release(at + self.crystal.micros(REST))
            case "seeking" | "releasing":  # the train has ended, but no switch has acted
                self._refuse(Status.RAIL, at)

    def pin(self, pin: Pin, level: bool, at: int) -> None:
        """Handle a change of the level at a pin of the interrupt gate."""
        memory = self.memory
        rose = level and not getattr(memory, pin)
        setattr(memory, pin, level)
        match memory.state, pin:
            case ("moving" | "seeking" | "releasing", "force") if rose:
                memory.pressed = memory.sense
                self._abort(Status.FORCE, at)
            case ("moving", "low" | "high") | ("releasing", "high") if rose:
                self._abort(Status.RAIL, at)
            case ("seeking", "low") if rose:
                self._brake("turning", at)
            case ("releasing", "low") if not level:
                self._halt(at)
                memory.at_abort = self.count(at)
                memory.zero, memory.status = memory.pulses, Status.FREE
        if pin == "force" and not level:
            memory.pressed = 0

    def _abort(self, cause: Status, at: int) -> None:
        self.memory.cause, self.memory.at_abort = cause, self.count(at)
        self._brake("stopping", at)

    def _brake(self, state: State, at: int) -> None:
        """Stop by the steepest ramp."""
        speed = self._halt(at)
        self._start(state, stop(speed, self.shape), self.memory.sense, at)
