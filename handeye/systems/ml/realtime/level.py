"""The real-time level of an arm, as the background level uses it."""

from collections.abc import Collection, Mapping, Sequence
from typing import Final

from msgspec.structs import replace

from handeye.core.errors import BadFile
from handeye.core.mutable_records import MutableRecord, put_back
from handeye.systems.ml.errors import MlError
from handeye.systems.ml.level import Level, Post, Shape, View
from handeye.systems.ml.machine.spec import HUNDREDTHS
from handeye.systems.ml.realtime.cycle import POSTS, Cycles
from handeye.systems.ml.realtime.happenings import GoalRounded, PumpSwitched, TableWritten
from handeye.systems.ml.realtime.safety import CAUSES, Danger, danger, emergency_text
from handeye.systems.ml.realtime.sampling import nearest_detent
from handeye.systems.ml.tables.layout import RECENT, SENSORS, SHAPES
from handeye.systems.ml.tables.records import ANALOG, BOTH_OPEN, DIGITAL, FROZEN, MotorLine, SensorLine
from handeye.systems.ml.tables.store import ArmMemory

_FULL: Final = 0xFFFF


class RealTime(Cycles, Level):
    """The real-time level of an arm."""

    @property
    def posted(self) -> Post:
        return POSTS[self._memory.AR[0].posted]

    @property
    def memory(self) -> ArmMemory:
        return self._memory

    def remember(self, memory: MutableRecord) -> None:
        if not isinstance(memory, ArmMemory) or not _fits(memory, self._memory):
            raise BadFile("the saved state does not belong to this arm")
        put_back(self._memory, memory)
        self.bind()

    # -- tables ---------------------------------------------------------------------------------------

    @property
    def shapes(self) -> Mapping[str, Shape]:
        return SHAPES

    def read(self, table: str, line: int, word: int) -> int:
        return self._tables.read(table, line, word)

    def write(self, table: str, line: int, word: int, value: int) -> None:
        was = self._tables.read(table, line, word)
        self._tables.write(table, line, word, value)
        if table not in ("RG", "VR"):  # the interpreter itself writes these two tables
            self._told(TableWritten, table=table, line=line, word=word, was=was, value=value)

    def view(self, table: str, contents: View) -> None:
        self._tables.views[table] = contents

    # -- sensors --------------------------------------------------------------------------------------

    @property
    def flags(self) -> Collection[int]:
        return [number for number, sensor in enumerate(self._memory.ST, 1) if sensor.flag]

    def _sensor(self, number: int) -> SensorLine:
        if not 1 <= number <= SENSORS:
            raise MlError("M11", f"there is no sensor {number}; sensors have the numbers 1 to {SENSORS}")
        return self._memory.ST[number - 1]

    def expect(self, sensor: int, lower: int, upper: int) -> None:
        line = self._sensor(sensor)
        if lower >= upper:
            raise MlError(
                "M04", f"the lower limit of sensor {sensor}, {lower}, must be below the upper limit, {upper}"
            )
        line.lower, line.upper, line.open, line.flag = lower, upper, 0, 0

    def open(self, sensor: int | None = None) -> None:
        for line in self._memory.ST if sensor is None else [self._sensor(sensor)]:
            line.open, line.flag = BOTH_OPEN, 0

    def reading(self, sensor: int) -> int:
        return self._sensor(sensor).reading

    def calibrate(self, sensors: Sequence[int]) -> None:
        analog = [n for n, line in enumerate(self._memory.ST, 1) if line.kind == ANALOG and line.input]
        lines = [(number, self._sensor(number)) for number in sensors or analog]
        taken = min(self.now // self.spec.every, RECENT)
        for number, line in lines:
            if taken:
                recent = self._memory.CA[(number - 1) * RECENT :][:taken]
                line.offset = round(sum(recent) / taken)

    def wand(self, sensor: int) -> None:
        line = self._sensor(sensor)
        if self.spec.wand is None:
            raise MlError("M11", f"the {self.spec.side} arm has no wand")
        line.kind, (line.input, line.mask) = DIGITAL, self.spec.wand
        line.numerator, line.denominator, line.offset = 1, 1, 0
        self.expect(sensor, -1, 1)

    # -- motors ---------------------------------------------------------------------------------------

    @property
    def motors(self) -> tuple[int, ...]:
        return tuple(motor.number for motor in self.spec.motors)

    def _motor(self, number: int) -> MotorLine:
        if number not in self.motors:
            raise MlError("M09", f"the {self.spec.side} arm has no motor {number}")
        return self._memory.MT[number - 1]

    def position(self, motor: int) -> int:
        return self._motor(motor).position

    def goal(self, motor: int) -> int:
        return self._motor(motor).strategic

    def start(self, goals: Mapping[int, int]) -> bool:
        memory, arm = self._memory, self._memory.AR[0]
        if not self.enabled:
            raise MlError("M15", f"the pump of the {self.spec.side} arm is off; ENABLE switches it on")
        if self.flags:
            return False
        rounded = {motor: nearest_detent(goal, self._motor(motor).detent) for motor, goal in goals.items()}
        for motor, goal in rounded.items():
            self._check_travel(motor, goal)
        for motor, goal in rounded.items():
            if goal != goals[motor]:
                self._told(GoalRounded, motor=motor, asked=goals[motor], goal=goal)
            memory.MT[motor - 1].strategic = goal
        for line in memory.MT:
            line.status &= ~FROZEN
        arm.posted = arm.waited = arm.still = 0
        self._set_paces()
        return True

    def _check_travel(self, motor: int, goal: int) -> None:
        line, space = self._motor(motor), self._memory.WS[motor - 1]
        lower, upper = max(line.lower, space.lower), min(line.upper, space.upper)
        if not lower <= goal <= upper:
            raise MlError("M10", f"motor {motor} can go from {lower} to {upper}, not to {goal}")

    def _set_paces(self) -> None:
        """Set the speeds of the motors. If the table AR requires it, the motors arrive at their goals together. If
        not, each motor moves as fast as it can.
        """
        memory = self._memory
        memory.pace[:] = [0] * len(memory.pace)
        if not memory.AR[0].coordinate:
            return
        ways = {
            motor.number - 1: abs(HUNDREDTHS * line.strategic - memory.fine[motor.number - 1])
            for _, motor, line in self._motors
        }
        limits = {
            motor.number - 1: max(min(line.speed * HUNDREDTHS, motor.peak), 1)
            for _, motor, line in self._motors
        }
        cycles = max(-(-way // limits[n]) for n, way in ways.items())
        for n, way in ways.items():
            memory.pace[n] = -(-way // cycles) if cycles else 0

    # -- power and devices ----------------------------------------------------------------------------

    def enable(self) -> None:
        if self.enabled:
            return
        if (found := self._danger()) is not None:
            raise MlError("M14", f"the pump stays off: {emergency_text(found, self.spec)}")
        self._power(on=True)
        self._freeze()
        memory = self._memory
        memory.SF[:] = [replace(lock, tripped=0) for lock in memory.SF]
        memory.EM[0] = replace(memory.EM[0], persists=0)
        self._told(PumpSwitched, on=True)

    def look(self) -> None:
        if self.enabled and (found := self._danger()) is not None:
            self._stop(found, self._statement)

    def _danger(self) -> Danger | None:
        """Read all inputs. Returns the cause of an emergency that the inputs show, or None."""
        self.sample()
        self.check_interlocks()
        return danger(self._memory, self.spec)

    def disable(self) -> None:
        if not self.enabled:
            return
        self._freeze()
        self._power(on=False)
        self._post("force")
        self._told(PumpSwitched, on=False)

    def emergency(self, cause: str, statement: int) -> None:
        self._stop(Danger(cause), statement)

    def statement(self, number: int) -> None:
        self._memory.AR[0].statement = number

    @property
    def stopped(self) -> str:
        line = self._memory.EM[0]
        return emergency_text(Danger(CAUSES[line.cause], line.number), self.spec) if line.persists else ""

    def analog_in(self, point: int) -> int:
        return self._tables.read("AI", point, 1)

    def analog_out(self, point: int, value: int) -> None:
        self._refuse_while_enabled()
        self.write("AO", point, 1, value)

    def digital_out(self, word: int, value: int, mask: int) -> None:
        self._refuse_while_enabled()
        was = self._tables.read("DO", word, 1)
        bits = (was & ~mask | value & mask) & _FULL
        self.write("DO", word, 1, bits - (bits >> 15 << 16))

    def _refuse_while_enabled(self) -> None:
        if self.enabled:
            raise MlError("M15", "outputs can be tested only while the pump is off; DISABLE switches it off")


def _fits(memory: ArmMemory, own: ArmMemory) -> bool:
    """Return True if the tables of a state are as long as this arm's own tables, and no word in the state has an
    impossible value.
    """
    return (
        all(
            not isinstance(table := getattr(memory, name), list) or len(table) == len(getattr(own, name))
            for name in memory.__struct_fields__
        )
        and memory.now >= 0
        and 0 <= memory.AR[0].posted < len(POSTS)
        and 0 <= memory.EM[0].cause < len(CAUSES)
        and all(0 < lock.word <= len(memory.PI) for lock in memory.SF)
    )
