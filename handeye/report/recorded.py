"""A recorded run, with all that its report is made of."""

from dataclasses import dataclass
from functools import cached_property

from handeye.planfile.plan import Plan
from handeye.program.program import Program
from handeye.results.result import Result
from handeye.trace.reading import plan_of
from handeye.trace.trace import Trace


@dataclass(frozen=True, kw_only=True, eq=False)
class RecordedRun:
    """A recorded run. Times are seconds since it began, as people see them."""

    trace: Trace
    whole: bool = True
    """The trace was read to its end; False: its file was cut short."""
    result: Result | None = None
    """What the run came to; None: nobody told."""
    end: bytes | None = None
    """The picture of its end that it has left, a PNG or WebP file; None: it left none."""
    remarks: tuple[str, ...] = ()
    """What of its folder could not be read, a sentence each."""

    @cached_property
    def plan(self) -> Plan:
        """Its plan."""
        return plan_of(self.trace)

    @property
    def program(self) -> Program:
        """Its program."""
        return self.plan.program

    @property
    def begins(self) -> float:
        """When its motions begin to be recorded: 0, but for a run taken up from a checkpoint."""
        return self.seconds(self.trace.begins)

    @property
    def ends(self) -> float:
        """The time of the last that is known of it."""
        return self.seconds(self.trace.events[-1].time)

    def seconds(self, clock: float) -> float:
        """The time for a time of the cell's clock."""
        return self.trace.elapsed(clock)
