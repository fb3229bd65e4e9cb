"""Shows a progress bar with the current step on standard error."""

from collections.abc import Iterator
from contextlib import contextmanager
from types import TracebackType
from typing import Final, Self

from rich.console import Console
from rich.markup import escape
from rich.progress import BarColumn, ProgressColumn, SpinnerColumn, TextColumn
from rich.progress import Progress as RichProgress
from rich.table import Column

from handeye.program.events import (
    AnyEvent,
    ErrorRaised,
    GuardFaint,
    RunStarted,
    StageStarted,
    StageUndone,
    StepStarted,
)
from handeye.runs.observer import Observer
from handeye.trace.sentences import sentence

_CLOCK: Final = 7  # Columns of the time
_BAR: Final = 12
_STATEMENT: Final = 8  # Columns that are too few for a recognisable statement
_CALIBRATING: Final = "calibrating: view {} of {}"


class Progress(Observer):
    """Shows the calibration, the stage, the statement and the time of a run in a progress bar. If standard error is
    not a terminal, one line is printed for each stage instead.
    """

    def __init__(self, stages: tuple[str, ...], console: Console) -> None:
        self._stages = stages
        self._console = console
        self._place = ""
        longest = max(map(len, (*stages, _CALIBRATING.format(100, 100))))
        self._bar = RichProgress(
            *_columns(console.width, longest),
            console=console,
            transient=True,
            disable=not console.is_terminal,
        )
        self._task = self._bar.add_task(
            "setting up the cell", total=len(stages), text="", clock=""
        )  # fmt: skip

    def __enter__(self) -> Self:
        self._bar.__enter__()
        return self

    def __exit__(
        self, kind: type[BaseException] | None, value: BaseException | None, trace: TracebackType | None
    ) -> None:
        self._bar.__exit__(kind, value, trace)

    @contextmanager
    def aside(self) -> Iterator[None]:
        """Hide the progress bar while this context is open, so that the program can ask the operator."""
        shown = self._bar.live.is_started
        self._bar.stop()
        try:
            yield
        finally:
            if shown:
                self._bar.start()

    def viewed(self, number: int, views: int) -> None:
        """Show that the camera is taking calibration view `number` of `views`."""
        said = _CALIBRATING.format(number, views)
        self._bar.update(self._task, description=said, completed=number - 1, total=views)
        if number == 1:
            self._line("", "calibrating the camera")

    def goes_on(self, stage: str) -> None:
        """Begin the bar of a resumed run in the middle of the stage."""
        number = self._stages.index(stage)
        self._bar.update(
            self._task, description=escape(stage), text="", completed=number, total=len(self._stages)
        )

    def event(self, event: AnyEvent) -> None:
        clock = f"{event.time:.1f} s"
        if isinstance(event, StageStarted):
            self.goes_on(event.stage)
            self._line(clock, event.stage)
        elif isinstance(event, StageUndone):
            self._line(clock, f"{event.stage}: undone")
        elif isinstance(event, StepStarted):
            self._place = event.place
            self._bar.update(self._task, text=escape(event.text))
        elif isinstance(event, GuardFaint):
            self._console.print(
                f"warning: line {self._place}: {sentence(event)}", markup=False, soft_wrap=True
            )
        if isinstance(event, StageStarted | StepStarted | ErrorRaised | RunStarted):
            self._bar.update(self._task, clock=clock)

    def _line(self, clock: str, text: str) -> None:
        """Print a line if standard error is not a terminal."""
        if not self._console.is_terminal:
            self._console.print(f"{clock:>8}  {text}", markup=False)


def _columns(width: int, longest: int) -> Iterator[ProgressColumn]:
    """Yield the columns that fit on a line of `width` characters. Time and stage always appear; a bar and the
    statement appear if there is space.
    """

    def text(form: str, columns: int, style: str = "none") -> TextColumn:
        column = Column(no_wrap=True, overflow="ellipsis", min_width=columns, max_width=columns)
        return TextColumn(form, style, markup=False, table_column=column)

    stage = max(1, min(longest, width - _CLOCK - 1))
    room = width - _CLOCK - 1 - stage
    bar = room >= _BAR + 3
    if bar:
        room -= _BAR + 3
        yield SpinnerColumn()
    yield text("{task.fields[clock]:>7}", _CLOCK)
    if bar:
        yield BarColumn(bar_width=_BAR)
    yield text("{task.description}", stage, "bold")
    if room > _STATEMENT:
        yield text("{task.fields[text]}", room - 1, "dim")
