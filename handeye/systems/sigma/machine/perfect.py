"""Perfect motors behind the bus interface. Each command takes its time, but nothing slips, there are no
obstacles, and no byte is lost.
"""

from typing import Final

from msgspec import field

from handeye.core.errors import BadFile, Refused
from handeye.core.mutable_records import MutableRecord, put_back
from handeye.ports.microbus import COMMAND_BYTES, PAGE, Command, MicrobusPort, NoAnswer, Status
from handeye.systems.sigma.machine.profiles import move_us, slow_us
from handeye.systems.sigma.protocol import ANSWERS, AXES, NUMBERS, SLOW_STEP_MM, STEP_MM, Op

BYTE_US: Final = 20  # microseconds: a slot of the bus
ANSWER_US: Final = 100  # microseconds: a byte of an answer
TIMEOUT_US: Final = 5000
HAND_US: Final = 150_000  # microseconds in which a hand closes or opens
TRAVEL: Final = {"X": 16_000, "Y": 10_667, "Z": 5_333}  # steps
SWITCHED_ON_AT: Final = 400  # steps from the end of the rail to the axis when the power comes on
BACK: Final = 3000  # steps/s on the way to the end of the rail
FORWARD: Final = 500  # steps/s on the way off its switch
RELEASE: Final = 20  # steps after which the switch is released
_AXIS: Final = {NUMBERS[axis]: axis for axis in AXES}
_FORCES: Final = (NUMBERS["FORCE1"], NUMBERS["FORCE2"])
_HANDS: Final = (NUMBERS["HAND1"], NUMBERS["HAND2"])


class MotorMemory(MutableRecord, kw_only=True):
    """The state of a motor: its count, and the command in progress."""

    count: int = 0  # steps: the count of the motor
    place: int = SWITCHED_ON_AT  # steps: the true distance from the end of the rail
    limit: int = 0  # steps/s; 0: none
    status: int = Status.FREE
    until: int = 0  # microseconds: time at which the command ends
    begun: int = 0  # microseconds: time at which the command began
    steps: int = 0  # signed steps of the command
    ends: int = Status.FREE  # status at the end of the command
    aborted_at: int = 0  # count at the last abort, or where ORIGIN ended, before it became 0


class PerfectMemory(MutableRecord, kw_only=True):
    """The complete state of the machine."""

    now: int = 0
    free_at: int = 0  # time at which the bus is free
    motors: dict[int, MotorMemory] = field(
        default_factory=lambda: {number: MotorMemory() for number in _AXIS}
    )
    hands: dict[int, int] = field(default_factory=lambda: dict.fromkeys(_HANDS, 0))  # when each hand is free
    devices: dict[int, dict[int, int]] = field(default_factory=lambda: {number: {} for number in _HANDS})
    answer: bytes | None = None
    asked: tuple[int, int, int] = (0, 0, 0)  # number, bytes of the answer, bytes that are wanted


class PerfectMotors(MicrobusPort):
    """The ten microcomputers of SUPERSIGMA, connected to perfect motors."""

    def __init__(self) -> None:
        self._memory = PerfectMemory()

    @property
    def now(self) -> int:
        return self._memory.now

    @property
    def next_event(self) -> int | None:
        memory = self._memory
        times = [motor.until for motor in memory.motors.values() if motor.until > memory.now]
        times += [until for until in (*memory.hands.values(), memory.free_at) if until > memory.now]
        return min(times, default=None)

    def wait(self, until: int) -> int:
        event = self.next_event
        self._memory.now = max(self._memory.now, until if event is None else min(until, event))
        for motor in self._memory.motors.values():
            if motor.status == Status.BUSY and motor.until <= self._memory.now:
                _finish(motor)
        return self._memory.now

    @property
    def free(self) -> bool:
        return self._memory.now >= self._memory.free_at

    def begin(self, command: Command, answer: int = 0) -> None:
        if not self.free:
            raise Refused(
                "the bus still carries a command; wait until the bus is free before sending the next command"
            )
        self._memory.free_at = self._memory.now + COMMAND_BYTES * BYTE_US
        self._memory.answer = None
        if answer:
            self._memory.asked = command.number, 0, answer
        taken = self._accept(command)
        if answer and taken is not None:
            self._memory.asked = command.number, len(taken), answer
            self._memory.answer = taken
            self._memory.free_at += len(taken) * ANSWER_US
        elif answer:
            self._memory.free_at += TIMEOUT_US

    def answer(self) -> bytes:
        if not self.free:
            raise Refused("the answer is still being sent; wait until it has ended")
        number, came, wanted = self._memory.asked
        if self._memory.answer is None or came != wanted:
            raise NoAnswer(number, came, wanted)
        return self._memory.answer

    def page(self, number: int) -> int:
        return sum(self._status(PAGE * number + n) << 2 * n for n in range(PAGE))

    def _status(self, number: int) -> int:
        if number in _AXIS:
            return self._memory.motors[number].status
        if number in _FORCES:
            return Status.BUSY
        if number in _HANDS:
            return Status.BUSY if self._memory.hands[number] > self._memory.now else Status.FREE
        return Status.FREE

    @property
    def interrupt(self) -> bool:
        return any(motor.status >= Status.RAIL for motor in self._memory.motors.values())

    @property
    def memory(self) -> PerfectMemory:
        return self._memory

    def remember(self, memory: MutableRecord) -> None:
        if not isinstance(memory, PerfectMemory):
            raise BadFile("the saved state does not belong to a machine with perfect motors")
        if {*memory.motors} != {*_AXIS} or {*memory.hands} != {*_HANDS}:
            raise BadFile("the saved state belongs to a machine with other motors or hands")
        put_back(self._memory, memory)

    # -- microcomputers -------------------------------------------------------------------------------

    def _accept(self, command: Command) -> bytes | None:
        """Let a microcomputer take a command if it is listening. Returns its answer, or None."""
        number, busy = command.number, self._status(command.number) == Status.BUSY
        if number in _FORCES:  # the answer is a force of 0, because nothing is in the way
            return bytes(ANSWERS[Op.FORCE]) if command.op == Op.FORCE else None
        if busy:
            return None
        if number in _HANDS:
            return self._hand(command)
        if number in _AXIS:
            return self._motor(self._memory.motors[number], _AXIS[number], command)
        return None

    def _hand(self, command: Command) -> bytes | None:
        if command.op == Op.BEAM:
            return bytes(1)
        if command.op == Op.ACTUATE:
            self._memory.devices[command.number][command.detail] = command.value
            if command.detail == 0:
                self._memory.hands[command.number] = self._memory.free_at + HAND_US
        return bytes(1) if command.op == Op.SELF_TEST else None

    def _motor(self, motor: MotorMemory, axis: str, command: Command) -> bytes | None:
        op, was = command.op, motor.status
        motor.status = Status.FREE
        steps = -command.value if command.detail & 1 else command.value
        if op in (Op.POSITION, Op.ABORT_POSITION):
            count = motor.count if op == Op.POSITION else motor.aborted_at
            return (count & 0xFFFF).to_bytes(2, "big")
        if op == Op.SELF_TEST:
            return bytes(1)
        if op == Op.SET_POSITION:
            motor.count = command.value - (command.value >> 15 << 16)
        elif op == Op.LIMIT_SPEED:
            motor.limit = command.value
        elif op == Op.ORIGIN:
            time = motor.place * 1_000_000 // BACK + RELEASE * 1_000_000 // FORWARD
            self._begin(motor, -motor.place, time)
            motor.aborted_at = motor.count - motor.place
            motor.count = motor.place  # the motor counts from the end of the rail
        elif op in (Op.MOVE, Op.MOVE_SLOW):
            self._move(motor, axis, command, steps, Status(was))
        return None

    def _move(self, motor: MotorMemory, axis: str, command: Command, steps: int, was: Status) -> None:
        speed = (command.detail >> 1) * SLOW_STEP_MM / STEP_MM
        there = min(max(motor.place + steps, 0), TRAVEL[axis[0]])
        possible = there - motor.place
        slow = command.op == Op.MOVE_SLOW

        def time(way: int) -> int:
            if not way:
                return 0
            return (
                slow_us(abs(way), speed) if slow else move_us(abs(way), command.detail >> 1 & 7, motor.limit)
            )

        if possible == steps:
            self._begin(motor, steps, time(steps))
        else:
            self._begin(motor, possible, time(possible), ends=Status.RAIL)

    def _begin(self, motor: MotorMemory, steps: int, time: int, ends: Status = Status.FREE) -> None:
        motor.status, motor.steps, motor.ends = Status.BUSY, steps, ends
        motor.begun = self._memory.free_at
        motor.until = motor.begun + max(1, time)


def _finish(motor: MotorMemory) -> None:
    """End the command of a motor."""
    motor.count += motor.steps
    motor.place += motor.steps
    motor.status, motor.steps = motor.ends, 0
    if motor.ends == Status.RAIL:
        motor.aborted_at = motor.count
