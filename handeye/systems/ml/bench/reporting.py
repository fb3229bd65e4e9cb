"""Programs that end by printing two numbers. The first number is 0 if all went well, or else the number of a problem.
The second number is a count.
"""

from __future__ import annotations

from abc import abstractmethod
from collections.abc import Mapping
from typing import TYPE_CHECKING, ClassVar, Final

from handeye.cell.mechanism import Mechanism
from handeye.core.errors import BadFile
from handeye.core.faults import Catalogue
from handeye.core.record import Record
from handeye.core.variation import Variation, WorldSpec
from handeye.systems.ml.bench.hardware import ArmTask, StationHardware
from handeye.systems.ml.bench.station import Station
from handeye.systems.ml.bench.world import ArmWorld
from handeye.systems.ml.run.hardware import Ending, Hardware, Tell

if TYPE_CHECKING:
    import mujoco

    from handeye.systems.ml.run.plan import MlPlan

_MOST: Final = 200  # lines


class Printed(Record, frozen=True, kw_only=True):
    """The lines that the program has printed."""

    lines: tuple[str, ...] = ()


def counted(heard: object) -> int:
    """Return the count in the last printed line. If this line does not have the form `0 COUNT`, return 0."""
    assert isinstance(heard, Printed)
    words = heard.lines[-1].split() if heard.lines else []
    return int(words[1]) if len(words) == 2 and words[0] == "0" else 0


def calls_of(troubles: Mapping[str, str]) -> tuple[str, ...]:
    """Return one message for each trouble: the sentence for the trouble, followed by `({count})`. The declarations of
    faults quote these messages.
    """
    return tuple(f"{sentence} ({{count}})" for sentence in troubles.values())


class Listener(Mechanism[Printed]):
    """Keeps the lines that the program prints."""

    name, kind = "heard", Printed

    def __init__(self) -> None:
        self.heard = Printed()

    def hear(self, line: str) -> None:
        """Keep a printed line."""
        self.heard = Printed(lines=(*self.heard.lines, line)[:_MOST])

    def state(self) -> Printed:
        return self.heard

    def check(self, state: Printed) -> None:
        if len(state.lines) > _MOST:
            raise BadFile("the saved run has more lines of output than the program can print")

    def restore(self, state: Printed) -> None:
        self.heard = state


class ReportingHardware(StationHardware):
    """A station whose program reports a problem by printing the number of the problem."""

    def __init__(self, station: Station, tell: Tell, troubles: Mapping[str, str]) -> None:
        """Open a station.

        Args:
            troubles: a sentence for each number that the program may print.
        """
        station.others = (*station.others, listener := Listener())
        super().__init__(station, tell)
        self._listener, self._troubles = listener, troubles

    def hear(self, text: str) -> None:
        self._listener.hear(text)

    @property
    def heard(self) -> tuple[str, ...]:
        """The lines that the program has printed."""
        return self._listener.heard.lines

    def ending(self, statement: int) -> Ending | None:
        lines = self.heard
        trouble, _, count = lines[-1].partition(" ") if lines else ("0", "", "")
        if trouble not in self._troubles:
            return None
        return Ending(done=False, text=f"{self._troubles[trouble]} ({self.counted(count.strip() or '0')})")

    def counted(self, count: str) -> str:
        """Describe in words the count that the program prints after the number of a problem."""
        return f"done before: {count}"


class ReportingTask(ArmTask):
    """A job whose program reports a problem by printing the number of the problem."""

    quantities: ClassVar[Variation]
    troubles: ClassVar[Mapping[str, str]]
    """A sentence for each number that the program may print."""
    planted: ClassVar[Catalogue]
    """The faults that the job can have."""

    def variation(self) -> Variation:
        return self.quantities

    def faults(self, world: WorldSpec) -> Catalogue:
        return self.planted

    @abstractmethod
    def station(self, world: ArmWorld) -> Station:
        """Return the station with the parts of the job."""

    def scene(self, spec: WorldSpec) -> mujoco.MjModel:
        return self.station(self.world(spec)).bench.model

    def hardware(self, plan: MlPlan, world: WorldSpec, tell: Tell) -> Hardware:
        return ReportingHardware(self.station(self.world(world)), tell, self.troubles)
