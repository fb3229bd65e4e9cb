"""What is kept of one trial of a planned program."""

from collections.abc import Mapping
from typing import Final

from handeye.core.errors import ERRORS
from handeye.results.result import Result
from handeye.trials.plans.contacts import Contact, SearchEnd
from handeye.trials.sweep import Standing, TrialRow

OUTCOMES: Final[Mapping[str, Standing]] = {"assembled": "right", "silent": "silent", "stopped": "wrong"}
"""The referee found all right; the program said done and it was not; the program called for help."""
APART: Final[Mapping[str, Standing]] = {
    "apart": "right", "silent": "silent", "stopped": "wrong", "not built": "uncounted",
}  # fmt: skip
"""Everything was where the run had found it; and there was something to take apart."""


class Row(TrialRow, frozen=True, kw_only=True):
    """One trial of a planned program."""

    result: Result | None = None
    """None: the run broke off."""
    place: str | None = None
    """Line of the script where the program stopped."""
    events: str = ""
    """Sixteen hexadecimal digits that stand for everything that happened."""
    contacts: tuple[Contact, ...] = ()
    """Contact operations that were begun."""
    searches: tuple[SearchEnd, ...] = ()
    force: float | None = None
    """Greatest force that the hand met while it undid, N; None: nothing was undone."""

    def __post_init__(self) -> None:
        """Raises ValueError if there is no result, and nothing that says why."""
        if self.result is None and not self.broken_off:
            raise ValueError(f"a trial that counts as {self.ended!r} has left no result")

    @property
    def outcome(self) -> str:
        if self.ended == "not built" or self.result is None:
            return "not built"
        right = "apart" if self.result.apart is True else "assembled"
        return {0: right, 1: "stopped", 3: "silent"}[self.result.exit_code]

    @property
    def stage(self) -> str:
        if self.result is None:
            return ""
        return "referee" if self.result.completed else self.result.stopped_at or "setting up"

    @property
    def line(self) -> str | None:
        return self.place

    @property
    def cause(self) -> str:
        if self.broken_off or self.result is None:
            return super().detail
        if not self.result.completed:
            return ERRORS.get(self.result.error or 0, self.result.message)
        return ", ".join(name for name, check in self.result.referee.items() if check.refuses)

    @property
    def detail(self) -> str:
        if self.broken_off or self.result is None:
            return super().detail
        if not self.result.completed:
            return self.result.message
        return "; ".join(check.told for check in self.result.referee.values() if check.refuses)

    @property
    def measures(self) -> Mapping[str, float]:
        if self.result is None or self.broken_off:
            return {}
        if self.force is not None:
            return {"greatest force, N": self.force} if self.outcome == "apart" else {}
        return {"arm time, s": self.result.timing.manipulation_s}
