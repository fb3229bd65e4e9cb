"""Lines of tables, with a named field for each word. The fields are in the order of the words in the table. Lines that
change in every cycle are mutable. All other lines are immutable: a new line replaces the old line. Saved states can
therefore share the immutable lines.
"""

from typing import Annotated, Final

import msgspec

from handeye.core.mutable_records import MutableRecord
from handeye.core.record import Record
from handeye.systems.ml.arithmetic import HIGHEST, LOWEST

Word = Annotated[int, msgspec.Meta(ge=LOWEST, le=HIGHEST)]

# bits of MotorLine.status
INSTALLED: Final = 1
MOVING: Final = 2
AT_GOAL: Final = 4
FROZEN: Final = 8

# bits of SensorLine.open and SensorLine.emergency_open
LOWER_OPEN: Final = 1
UPPER_OPEN: Final = 2
BOTH_OPEN: Final = LOWER_OPEN | UPPER_OPEN

ANALOG, DIGITAL, COUNT = 0, 1, 2  # SensorLine.kind


class MotorLine(MutableRecord):
    """A line of MT. Positions and goals are in the units of the motor."""

    position: Word = 0
    last: Word = 0  # position one cycle ago
    earlier: Word = 0  # position two cycles ago
    strategic: Word = 0  # the goal of the program
    tactical: Word = 0  # the goal of this cycle, on the way to the strategic goal
    lower: Word = 0  # ends of the travel
    upper: Word = 0
    speed: Word = 0  # greatest advance of the tactical goal, in units per cycle
    tolerance: Word = 0  # greatest distance from a goal that has been reached
    detent: Word = 0  # the motor can stop at multiples of it; 0: anywhere
    input: Word = 0  # point of AI
    output: Word = 0  # point of AO; a negative number is a word of DO
    numerator: Word = 1  # numerator / denominator: units per count of the input
    denominator: Word = 1
    offset: Word = 0  # in units; it is subtracted
    status: Word = 0


class SensorLine(MutableRecord):
    """A line of ST: a logical sensor. Limits are in the units of the sensor's reading."""

    kind: Word = ANALOG
    input: Word = 0  # point of AI, or word of DI
    mask: Word = 0  # bits of a digital input
    numerator: Word = 1
    denominator: Word = 1
    offset: Word = 0  # in units; it is subtracted: the zero that CALIB finds
    reading: Word = 0
    lower: Word = 0  # the reading is expected between the two, and equal to neither
    upper: Word = 0
    open: Word = BOTH_OPEN  # limits that are not checked
    flag: Word = 0  # 1: the reading has left its limits since SENSOR was executed
    cycle: Word = 0  # low word of the cycle at which the flag came on
    lower_emergency: Word = 0
    upper_emergency: Word = 0
    emergency_open: Word = BOTH_OPEN
    spare: Word = 0


class ForceLine(Record, frozen=True):
    """A line of FE: a force event, in which all motors were frozen. The latest event is in line 1."""

    cycle: Word = 0  # low and high word
    epoch: Word = 0
    sensor: Word = 0
    reading: Word = 0
    m1: Word = 0  # positions of the motors
    m2: Word = 0
    m3: Word = 0
    m4: Word = 0
    m5: Word = 0
    m6: Word = 0
    m7: Word = 0
    m8: Word = 0
    m9: Word = 0
    m10: Word = 0
    m11: Word = 0
    m12: Word = 0


class GoalLine(Record, frozen=True):
    """A line of GO: a motion that has reached its goal. The latest motion is in line 1."""

    cycle: Word = 0
    epoch: Word = 0
    statement: Word = 0
    cycles: Word = 0  # cycles that the motion took


class EmergencyLine(Record, frozen=True):
    """The line of EM: the latest emergency."""

    cause: Word = 0  # number in `CAUSES`; 0: there was none
    number: Word = 0  # number of the sensor, or of the line of SF
    statement: Word = 0  # the statement that was being executed; 0: none
    cycle: Word = 0
    epoch: Word = 0
    persists: Word = 0  # 1 until ENABLE


class CycleLine(MutableRecord):
    """The only line of the table CY, with statistics of the cycles."""

    cycle: Word = 0
    epoch: Word = 0
    period: Word = 10  # ms
    used: Word = 8  # ms of each period that the real-time level uses
    share: Word = 10  # statements that the background level can execute in the rest of a period
    forces: Word = 0  # force events
    goals: Word = 0  # goal events
    emergencies: Word = 0


class ArmLine(MutableRecord):
    """The only line of the table AR, which describes the arm."""

    enabled: Word = 0  # 1: the pump is on
    posted: Word = 2  # 0 while a motion is under way, 1 force, 2 goal, 3 emergency
    statement: Word = 0  # the statement that is being executed; 0: none
    coordinate: Word = 0  # 1: motors of a motion arrive together
    waited: Word = 0  # cycles of the motion under way
    still: Word = 0  # cycles of the motion in which no tactical goal advanced


class InterlockLine(Record, frozen=True):
    """A line of SF: an interlock, which can stop the arm. The interlock is one bit of a process-interrupt word."""

    word: Word = 1  # word of the table PI
    mask: Word = 0
    now: Word = 0  # 1: the interlock says stop
    tripped: Word = 0  # 1: the interlock has said stop since ENABLE


class SpaceLine(Record, frozen=True):
    """A line of WS: the work space of a motor, within its travel."""

    lower: Word = LOWEST
    upper: Word = HIGHEST


class FrameLine(Record, frozen=True):
    """A line of PF: a page frame in main memory."""

    table: Word = 0  # name of the external table; 0: the frame is free
    page: Word = 0
    used: Word = 0  # low word of the cycle of its last use
