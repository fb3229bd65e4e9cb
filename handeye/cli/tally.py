"""Progress of a batch on standard error: finished trials, and the estimated remaining time."""

import time
from collections.abc import Callable, Iterable, Iterator
from contextlib import contextmanager
from types import TracebackType
from typing import Final, Self, TypeVar

from rich.console import Console
from rich.progress import BarColumn, Progress, TextColumn

from handeye.cli.common import notes, say

T = TypeVar("T")

LINES: Final = 20  # Progress lines for all trials without a terminal; one more for the first trial


class Tally:
    """A progress bar on a terminal; without a terminal, an occasional line."""

    def __init__(
        self,
        total: int,
        what: str,
        console: Console = notes,
        clock: Callable[[], float] = time.monotonic,
        *,
        silent: bool = False,
        kept: int = 0,
    ) -> None:
        """Start counting. `total` is the number of trials, and `kept` is the number of trials that have already
        finished. If `silent` is true, no lines are printed for trials, because the caller reports each trial.
        """
        self._silent, self._kept = silent, kept
        self._total, self._what, self._console, self._clock = total, what, console, clock
        self._ended, self._began = kept, clock()
        self._bar = Progress(
            TextColumn("{task.description}"), BarColumn(bar_width=20), console=console, transient=True,
            disable=not console.is_terminal,
        )  # fmt: skip
        self._task = self._bar.add_task(self._told(), total=total, completed=kept)

    def __enter__(self) -> Self:
        self._bar.start()
        return self

    def __exit__(
        self, kind: type[BaseException] | None, value: BaseException | None, trace: TracebackType | None
    ) -> None:
        self._bar.stop()

    def counting(self, trials: Iterable[T], tell: Callable[[T], None] | None = None) -> Iterator[T]:
        """Yield the trials as they end. If there is a function `tell`, it receives each trial before the trial is
        counted.
        """
        with self:
            for trial in trials:
                yield trial
                if tell is not None:
                    with self.aside():
                        tell(trial)
                self.one_more()

    def one_more(self) -> None:
        """Count a trial that has ended."""
        self._ended += 1
        self._bar.update(self._task, completed=self._ended, description=self._told())
        share = self._ended * LINES // self._total
        due = self._ended == self._kept + 1 or share > (self._ended - 1) * LINES // self._total
        if not self._silent and not self._console.is_terminal and due:
            say(self._told(), self._console)

    @contextmanager
    def aside(self) -> Iterator[None]:
        """While the context is open, the bar is hidden, so that other output can be printed."""
        self._bar.stop()
        try:
            yield
        finally:
            self._bar.start()

    def _told(self) -> str:
        left = self._total - self._ended
        said = f"{self._ended} of {self._total} {self._what}"
        if not left or self._ended == self._kept:
            return said
        return f"{said}, {duration((self._clock() - self._began) / (self._ended - self._kept) * left)} to go"


def duration(seconds: float) -> str:
    """A duration in words, such as `about 40 s` or `about 12 min`."""
    if seconds < 90:
        return f"about {max(10, round(seconds, -1)):.0f} s"
    return f"about {seconds / 60:.0f} min"
