"""Defines the events of MAL programs: commands and answers, changes of flags, and printed lines."""

from typing import ClassVar

from handeye.core.plain_text import printable
from handeye.core.units import Measures
from handeye.program.events import Importance, SystemEvent


class TaskStarted(SystemEvent, frozen=True, kw_only=True):
    """A task began."""

    task: str

    def sentence(self, measures: Measures) -> str:
        return f"the task {self.task} begins"


class TaskEnded(SystemEvent, frozen=True, kw_only=True):
    """A task ended or was killed."""

    task: str
    killed: bool = False

    def sentence(self, measures: Measures) -> str:
        return f"the task {self.task} {'is killed' if self.killed else 'has ended'}"


class CommandSent(SystemEvent, frozen=True, kw_only=True):
    """Five bytes were sent to a microcomputer."""

    importance: ClassVar[Importance] = "debug"
    task: str
    to: str  # name of the microcomputer
    frame: str  # the bytes, hexadecimal
    means: str

    def sentence(self, measures: Measures) -> str:
        return f"{self.task} to {self.to}: {self.means} ({self.frame})"


class Answered(SystemEvent, frozen=True, kw_only=True):
    """A microcomputer answered."""

    importance: ClassVar[Importance] = "debug"
    task: str
    to: str
    answer: str  # the bytes, hexadecimal
    means: str

    def sentence(self, measures: Measures) -> str:
        return f"{self.to} answers {self.task}: {self.means} ({self.answer})"


class FlagChanged(SystemEvent, frozen=True, kw_only=True):
    """A flag was set, cleared, or taken."""

    task: str
    flag: str
    change: str  # sets, clears or takes

    def sentence(self, measures: Measures) -> str:
        return f"{self.task} {self.change} the flag {self.flag}"


class Printed(SystemEvent, frozen=True, kw_only=True):
    """A line was printed."""

    task: str
    text: str

    def sentence(self, measures: Measures) -> str:
        return f"{self.task} prints: {printable(self.text)}"


class MotorAborted(SystemEvent, frozen=True, kw_only=True):
    """A motor was stopped by the end of its rail or by a force, and the central computer has queried the motor's
    position.
    """

    importance: ClassVar[Importance] = "warning"
    task: str  # the task that had started the motion
    axis: str
    cause: str  # RAIL or FORCE
    at: float  # mm

    def sentence(self, measures: Measures) -> str:
        why = "at the end of its rail" if self.cause == "RAIL" else "by a force"
        return f"{self.axis} was stopped {why}, at {self.at:.2f} mm; {self.task} had started this motion"


class CountDoubtful(SystemEvent, frozen=True, kw_only=True):
    """A wrist sensed a force that may have turned a motor while the motor was at rest or stopping, so the motor's
    count may be wrong. If `above` is True, the wrist of the other arm sensed the force: the other arm may have hit
    this arm above the wrist.
    """

    importance: ClassVar[Importance] = "warning"
    axis: str
    force: float | None  # N; None: the wrist gave no answer
    above: bool = False

    def sentence(self, measures: Measures) -> str:
        why = "its wrist does not answer" if self.force is None else f"its wrist has felt {self.force:.1f} N"
        if self.above:
            why = f"the wrist of the other arm has felt {self.force:.1f} N, and the arms may have met"
        return f"the count of {self.axis} is doubtful: {why}; ORIGIN {self.axis} corrects the count"


class CountWrong(SystemEvent, frozen=True, kw_only=True):
    """ORIGIN has shown that the count of an axis was wrong, although no force had made the count doubtful."""

    importance: ClassVar[Importance] = "warning"
    axis: str
    off: float  # mm

    def sentence(self, measures: Measures) -> str:
        return f"{self.axis} has lost steps: at the end of its rail, its count was {self.off:.2f} mm instead of 0"


EVENTS = (
    TaskStarted,
    TaskEnded,
    CommandSent,
    Answered,
    FlagChanged,
    Printed,
    MotorAborted,
    CountDoubtful,
    CountWrong,
)
