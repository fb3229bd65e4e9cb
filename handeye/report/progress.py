"""A progress bar with the current step, on standard error."""

from collections.abc import Iterator
from contextlib import contextmanager
from types import TracebackType
from typing import Self

from rich.console import Console
from rich.markup import escape
from rich.progress import BarColumn, SpinnerColumn, TextColumn
from rich.progress import Progress as RichProgress

from handeye.events import AnyEvent, ErrorRaised, RunStarted, StageStarted, StepStarted
from handeye.runs.observer import Observer


class Progress(Observer):
    """Shows the stage, the statement being executed and the cell's clock.

    Without a terminal it prints one line a stage.
    """

    def __init__(self, stages: tuple[str, ...], console: Console) -> None:
        self._stages = stages
        self._console = console
        self._bar = RichProgress(
            SpinnerColumn(),
            TextColumn("{task.fields[clock]:>7}"),
            BarColumn(bar_width=24),
            TextColumn("[bold]{task.description}"),
            TextColumn("[dim]{task.fields[text]}", markup=True),
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
        """While somebody is asked: a bar that is there is out of the way."""
        shown = self._bar.live.is_started
        self._bar.stop()
        try:
            yield
        finally:
            if shown:
                self._bar.start()

    def goes_on(self, stage: str) -> None:
        """Begin in the midst of a stage."""
        number = self._stages.index(stage)
        self._bar.update(self._task, description=escape(stage), completed=number)

    def event(self, event: AnyEvent) -> None:
        clock = f"{event.time:.1f} s"
        if isinstance(event, StageStarted):
            self.goes_on(event.stage)
            self._bar.update(self._task, clock=clock)
            if not self._console.is_terminal:
                self._console.print(f"{clock:>8}  {event.stage}", markup=False)
        elif isinstance(event, StepStarted):
            self._bar.update(self._task, text=escape(event.text), clock=clock)
        elif isinstance(event, ErrorRaised | RunStarted):
            self._bar.update(self._task, clock=clock)
