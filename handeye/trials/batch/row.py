"""What one trial of a batch came to, as it is kept."""

from typing import Annotated, Final, Literal

import msgspec

from handeye.core.errors import ERRORS
from handeye.core.record import Record
from handeye.results.result import Result
from handeye.trials.batch.contacts import Contact, SearchEnd

Ended = Literal["ended", "raised", "killed", "simulated limit", "wall limit", "not built"]
"""How a trial ended: by its program; by an exception; because its process was killed; at a limit of simulated seconds,
or of the host's; before there was anything to take apart."""
Verdict = Literal["assembled", "apart", "silent", "stopped", "failed", "not built"]
"""The referee found all right; everything was where the run had found it; the program said done and it was not; the
program called for help; the run broke off; what was to be taken apart was not built."""

_LEFT_RESULT: Final = ("ended", "not built")
_BROKEN_OFF: Final[dict[Ended, str]] = {
    "killed": "its process was killed twice",
    "simulated limit": "over the limit of simulated time",
    "wall limit": "over the limit of wall time",
}


class Row(Record, frozen=True, kw_only=True):
    """One trial. Equal trials have equal rows, but for the host's seconds and how often a process was killed."""

    trial: Annotated[int, msgspec.Meta(ge=0)]
    seed: Annotated[int, msgspec.Meta(ge=0)]
    ended: Ended
    raised: str = ""
    """Type and words of the exception."""
    result: Result | None = None
    """None: the run broke off."""
    line: str | None = None
    """Of the script, where the program stopped."""
    events: str = ""
    """Sixteen hexadecimal digits that stand for everything that happened."""
    contacts: tuple[Contact, ...] = ()
    """Contact operations that were begun."""
    searches: tuple[SearchEnd, ...] = ()
    force: float | None = None
    """Greatest force that the hand met while it undid, N; None: nothing was undone."""
    killed: Annotated[int, msgspec.Meta(ge=0)] = 0
    """How often its process was killed."""
    wall_s: float = 0.0
    cpu_s: float = 0.0

    def __post_init__(self) -> None:
        """Raises ValueError if there is no result, and nothing that says why."""
        if self.result is None and self.ended in _LEFT_RESULT:
            raise ValueError(f"a trial that counts as {self.ended!r} has left no result")

    @property
    def verdict(self) -> Verdict:
        """How it counts."""
        if self.ended == "not built":
            return "not built"
        if self.result is None or self.ended != "ended":
            return "failed"
        right: Verdict = "apart" if self.result.apart is True else "assembled"
        codes: dict[int, Verdict] = {0: right, 1: "stopped", 3: "silent"}
        return codes[self.result.exit_code]

    @property
    def stage(self) -> str:
        """The stage in which it failed; for one that came to its end, the referee."""
        if self.result is None:
            return ""
        return "referee" if self.result.completed else self.result.stopped_at or "setting up"

    @property
    def cause(self) -> str:
        """Cause of a failure, the same words for the same cause; empty if there was none."""
        if self.ended not in _LEFT_RESULT or self.result is None:
            return self.raised or _BROKEN_OFF.get(self.ended, "")
        if not self.result.completed:
            return ERRORS.get(self.result.error or 0, self.result.message)
        return ", ".join(name for name, check in self.result.referee.items() if check.refuses)

    @property
    def detail(self) -> str:
        """The same with its figures."""
        if self.ended not in _LEFT_RESULT or self.result is None:
            return self.cause
        if not self.result.completed:
            return self.result.message
        return "; ".join(check.told for check in self.result.referee.values() if check.refuses)
