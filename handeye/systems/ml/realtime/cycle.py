"""The cycle of the real-time level. In the order of the paper, the level samples the inputs, checks the sensors,
checks the goals, and sets the outputs.
"""

from collections.abc import Callable
from typing import Final

import numpy as np
from msgspec.structs import replace

from handeye.core.mutable_records import put_back
from handeye.ports.axes import Axes, Outputs
from handeye.program.events import SystemEvent
from handeye.systems.ml.arithmetic import wrap
from handeye.systems.ml.level import Post
from handeye.systems.ml.machine.spec import CYCLES_PER_SECOND, HUNDREDTHS, ArmSpec, MotorSpec
from handeye.systems.ml.realtime.happenings import (
    EmergencyStopped,
    Froze,
    LimitCrossed,
    Posted,
    ToolSwitched,
)
from handeye.systems.ml.realtime.safety import CAUSES, Danger, danger, emergency_text
from handeye.systems.ml.realtime.sampling import (
    ProgramCheck,
    nearest_detent,
    outside,
    packed,
    saturated,
    scaled,
    sensed,
)
from handeye.systems.ml.tables.layout import RECENT
from handeye.systems.ml.tables.records import (
    AT_GOAL,
    BOTH_OPEN,
    FROZEN,
    INSTALLED,
    LOWER_OPEN,
    MOVING,
    UPPER_OPEN,
    EmergencyLine,
    ForceLine,
    GoalLine,
    InterlockLine,
    MotorLine,
    SensorLine,
)
from handeye.systems.ml.tables.store import ArmMemory, SharedMemory, Tables

POSTS: Final[tuple[Post, ...]] = ("", "force", "goal", "emergency")  # by the value of `posted` in AR
STUCK_AFTER: Final = 1000
"""A motion is given up if its set-points stand still for this many cycles while its motors are not at their goals."""
_PROGRAM_CHECK: Final = "program_check"


class Cycles:
    """Executes the cycles of an arm, using the axes and outputs of the machine."""

    def __init__(
        self,
        spec: ArmSpec,
        axes: Axes,
        outputs: Outputs,
        shared: SharedMemory,
        tell: Callable[[SystemEvent], None] = lambda _: None,
    ) -> None:
        self.spec, self._axes, self._outputs, self._tell = spec, axes, outputs, tell
        self._memory = memory = ArmMemory()
        self._tables = Tables(memory, shared)
        for motor in spec.motors:
            line = memory.MT[motor.number - 1]
            line.lower, line.upper, line.tolerance, line.detent = (
                motor.lower, motor.upper, motor.tolerance, motor.detent
            )  # fmt: skip
            line.speed = -(-motor.peak // HUNDREDTHS)
            line.input, line.output, line.status = motor.number, motor.output, INSTALLED
        for number, first in spec.sensors.items():
            put_back(memory.ST[number - 1], first)
        for number in range(len(spec.interlocks)):
            memory.SF[number] = InterlockLine(mask=1 << number)
        self.bind()

    def bind(self) -> None:
        """Pair the motors with their lines in MT and with the numbers of their axes."""
        order = [axis.name for axis in self._axes.specs]
        self._motors: list[tuple[int, MotorSpec, MotorLine]] = [
            (order.index(motor.axis), motor, self._memory.MT[motor.number - 1]) for motor in self.spec.motors
        ]

    # -- a cycle --------------------------------------------------------------------------------------

    @property
    def now(self) -> int:
        """Number of cycles since the beginning."""
        return self._memory.now

    @property
    def enabled(self) -> bool:
        """True if the pump is on."""
        return bool(self._memory.AR[0].enabled)

    @property
    def _statement(self) -> int:
        """Number of the statement that is being executed; 0 if no statement is being executed."""
        return self._memory.AR[0].statement

    def cycle(self) -> None:
        """Execute one cycle. The caller lets time pass afterwards."""
        if self.now % self.spec.every == 0:
            self.sample()
            self.check_sensors()
            self.check_goals()
            self.output()
        self._memory.now += 1
        cycles = self._memory.CY[0]
        cycles.cycle, cycles.epoch = wrap(self.now), wrap(self.now >> 16)

    def sample(self) -> None:
        """Read all inputs. Write the positions into the table MT, and the readings into the table ST."""
        memory, reading = self._memory, self._axes.read()
        if not memory.AR[0].posted:
            memory.AR[0].waited = wrap(memory.AR[0].waited + 1)
        q, channels, checked = reading.q.tolist(), reading.channels, False
        for axis, motor, _ in self._motors:
            memory.AI[motor.number - 1] = saturated(q[axis] / motor.unit)
        for point, source in self.spec.analog.items():
            memory.AI[point - 1] = saturated(channels[source.channel] / source.count)
        for word, parts in self.spec.digital.items():
            memory.DI[word - 1] = packed([channels[part] for part in parts])
        try:
            for _, _, line in self._motors:
                line.earlier, line.last = line.last, line.position
                point = line.input - 1
                count = memory.AI[point] if 0 <= point < len(memory.AI) else 0
                position = scaled(count, line)
                line.position = saturated(position - line.offset) if line.offset else position
            at = self.now // self.spec.every % RECENT
            for number, sensor in enumerate(memory.ST):
                memory.CA[number * RECENT + at] = value = sensed(sensor, memory.AI, memory.DI)
                sensor.reading = saturated(value - sensor.offset) if sensor.offset else value
        except ProgramCheck:
            checked = True
        memory.PI[0] = packed(
            [channels[name] or (checked and name == _PROGRAM_CHECK) for name in self.spec.interlocks]
        )

    def check_sensors(self) -> None:
        """Compare the readings with their limits. Freeze all motors when a flag comes on, and stop everything in
        an emergency.
        """
        crossed = [number for number, sensor in enumerate(self._memory.ST, 1) if _leaves(sensor)]
        for number in crossed:
            self._cross(number)
        if crossed:
            self._memory.CY[0].forces = wrap(self._memory.CY[0].forces + 1)
            places = {motor.number: line.position for _, motor, line in self._motors}
            moving = [
                m.number
                for _, m, line in self._motors
                if abs(line.position - line.strategic) > line.tolerance
            ]
            self._hold()
            self._told(Froze, positions=places, moving=tuple(moving))
            self._post("force")
        self.check_interlocks()
        if self.enabled and (found := danger(self._memory, self.spec)) is not None:
            self._stop(found, self._statement)

    def check_interlocks(self) -> None:
        """Write the state of the interlocks into the table SF."""
        memory = self._memory
        for n, lock in enumerate(memory.SF):
            now = int(memory.PI[lock.word - 1] & lock.mask != 0)
            if now != lock.now:
                memory.SF[n] = replace(lock, now=now, tripped=lock.tripped | now)

    def check_goals(self) -> None:
        """Compare the positions with the strategic goals. When all goals are reached, notify (post) the background
        level.
        """
        memory, arm = self._memory, self._memory.AR[0]
        there = True
        for _, motor, line in self._motors:
            at_goal = _arrived(line, memory.fine[motor.number - 1])
            there = there and at_goal
            line.status = INSTALLED | (AT_GOAL if at_goal else MOVING) | (line.status & FROZEN)
        if arm.posted:
            return
        if there:
            memory.CY[0].goals = wrap(memory.CY[0].goals + 1)
            done = GoalLine(
                cycle=wrap(self.now), epoch=wrap(self.now >> 16), statement=self._statement, cycles=arm.waited
            )
            memory.GO[:] = [done, *memory.GO[:-1]]
            self._post("goal")
        elif arm.still > STUCK_AFTER:
            late = next(
                m.number for _, m, line in self._motors if not _arrived(line, memory.fine[m.number - 1])
            )
            self._stop(Danger("STUCK", late), self._statement)

    def output(self) -> None:
        """Advance the tactical goals toward the strategic goals, and output them to all motors and tools."""
        memory = self._memory
        if self.enabled:
            moved = [self._advance(motor, line) for _, motor, line in self._motors]
            memory.AR[0].still = 0 if any(moved) else min(memory.AR[0].still + 1, STUCK_AFTER + 1)
            self._put()
        self._switch_tools()

    def _advance(self, motor: MotorSpec, line: MotorLine) -> bool:
        """Advance the tactical goal of a motor. Returns False if the goal does not change."""
        memory, n = self._memory, motor.number - 1
        was = memory.fine[n]
        if was == HUNDREDTHS * line.tactical == HUNDREDTHS * line.strategic:
            return False
        if line.tactical != round(was / HUNDREDTHS):  # a program has written it
            was = HUNDREDTHS * line.tactical
        pace = min(max(line.speed, 0) * HUNDREDTHS, memory.pace[n] or motor.peak)
        goal = HUNDREDTHS * min(max(line.strategic, motor.lower), motor.upper)
        memory.fine[n] = min(max(goal, was - pace), was + pace)
        line.tactical = round(memory.fine[n] / HUNDREDTHS)
        return memory.fine[n] != was

    def _put(self) -> None:
        """Write the tactical goals to the output words, and send the output words to the motors."""
        memory, goal = self._memory, np.zeros(len(self._axes.specs))
        for axis, motor, line in self._motors:
            words, point = (memory.AO, line.output) if line.output > 0 else (memory.DO, -line.output)
            if 0 < point <= len(words):
                words[point - 1] = line.tactical
            goal[axis] = line.tactical * motor.unit
        self._axes.put(goal)

    def _switch_tools(self) -> None:
        memory = self._memory
        changed = memory.DO[0] ^ memory.tools
        memory.tools = memory.DO[0]
        for bit, name in enumerate(self.spec.tools):
            if changed >> bit & 1:
                on = memory.tools >> bit & 1
                self._outputs.set(name, float(on))
                self._told(ToolSwitched, tool=name, on=bool(on))

    def _cross(self, number: int) -> None:
        """Set the flag of a sensor whose reading has left its limits, and record the event."""
        memory, sensor = self._memory, self._memory.ST[number - 1]
        sensor.flag, sensor.cycle = 1, wrap(self.now)
        where = {f"m{motor.number}": line.position for _, motor, line in self._motors}
        event = ForceLine(
            cycle=wrap(self.now), epoch=wrap(self.now >> 16), sensor=number, reading=sensor.reading, **where
        )
        memory.FE[:] = [event, *memory.FE[:-1]]
        lower = None if sensor.open & LOWER_OPEN else sensor.lower
        upper = None if sensor.open & UPPER_OPEN else sensor.upper
        self._told(LimitCrossed, sensor=number, reading=sensor.reading, lower=lower, upper=upper)

    def _hold(self) -> None:
        """Make the present position of every motor its strategic goal. If a potentiometer shows a position beyond the
        end of the motor's travel, this end becomes the goal.
        """
        for _, motor, line in self._motors:
            line.strategic = min(max(nearest_detent(line.position, line.detent), motor.lower), motor.upper)
            line.status |= FROZEN

    def _post(self, what: Post) -> None:
        """Post (notify) the background level, if that level waits."""
        arm = self._memory.AR[0]
        if not arm.posted:
            arm.posted = POSTS.index(what)
            self._told(Posted, what=what, cycles=arm.waited)

    def _told(self, kind: Callable[..., SystemEvent], **facts: object) -> None:
        self._tell(kind(time=self.now / CYCLES_PER_SECOND, arm=self.spec.side, cycle=self.now, **facts))

    def _stop(self, found: Danger, statement: int) -> None:
        """Freeze all motors where they are, switch off all tools and the pump, and record the emergency."""
        memory = self._memory
        memory.EM[0] = EmergencyLine(
            cause=CAUSES.index(found.cause), number=found.number, statement=statement,
            cycle=wrap(self.now), epoch=wrap(self.now >> 16), persists=1,
        )  # fmt: skip
        memory.CY[0].emergencies = wrap(memory.CY[0].emergencies + 1)
        memory.DO[0] = 0
        self._freeze()
        self._switch_tools()
        self._power(on=False)
        self._post("emergency")
        text = emergency_text(found, self.spec)
        self._told(EmergencyStopped, cause=found.cause, statement=statement, text=text)

    def _freeze(self) -> None:
        """Command all motors to stay where they are, from now on."""
        self._hold()
        for _, motor, line in self._motors:
            line.tactical = line.strategic
            self._memory.fine[motor.number - 1] = HUNDREDTHS * line.strategic
        if self.enabled:
            self._put()

    def _power(self, *, on: bool) -> None:
        if on != self.enabled:
            self._axes.power(on)
            self._memory.AR[0].enabled = int(on)


def _leaves(sensor: SensorLine) -> bool:
    """Return True if the flag of a sensor is off, and its reading is outside its expected limits."""
    if sensor.flag or sensor.open == BOTH_OPEN:
        return False
    return outside(sensor.reading, sensor.lower, sensor.upper, sensor.open)


def _arrived(line: MotorLine, fine: int) -> bool:
    """Return True if the set-point of a motor has arrived at its goal, and the motor is at this goal."""
    return fine == HUNDREDTHS * line.strategic and abs(line.position - line.strategic) <= line.tolerance
