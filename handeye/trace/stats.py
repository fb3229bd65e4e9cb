"""Computes statistics of a run: how long each part took, and how often each kind of event happened."""

from collections import Counter
from collections.abc import Sequence
from typing import Final

import msgspec
from rich.console import Group, RenderableType
from rich.table import Table
from rich.text import Text

from handeye.core.plain_text import printable
from handeye.program import events as happened
from handeye.program.events import AnyEvent, Event

BROKEN_OFF = "interrupted"  # status of a stage whose end was not recorded


class Figures(msgspec.Struct, kw_only=True):
    """Statistics of a part of a run."""

    seconds: float = 0.0  # simulated, s
    camera_s: float = 0.0  # part of `seconds` that the camera's mechanism took
    steps: int = 0
    motions: int = 0  # steps that moved the arm
    guards: int = 0  # motions that a force or torque ended
    errors: dict[int, int] = msgspec.field(default_factory=dict)  # count of each error number
    places: int = 0  # places that searches went on to
    pictures: int = 0

    def add(self, event: Event) -> None:
        match event:
            case happened.StepStarted():
                self.steps += 1
            case happened.StepFinished():
                self.motions += event.planned is not None
            case happened.GuardTripped():
                self.guards += 1
            case happened.ErrorRaised():
                self.errors[event.number] = self.errors.get(event.number, 0) + 1
            case happened.SearchAdvanced():
                self.places += 1
            case happened.PictureTaken():
                self.pictures += 1
            case happened.CameraBusy():
                self.camera_s += event.seconds


class StageFigures(Figures, kw_only=True):
    """Statistics of a stage. If the stage was repeated, the figures of all its executions are added up."""

    stage: str
    status: str = BROKEN_OFF  # how its last execution ended: done, stopped, skipped, or interrupted


class Statistics(msgspec.Struct, kw_only=True):
    """Statistics of a whole run."""

    stages: list[StageFigures]
    total: Figures
    operator: int  # calls to the operator
    experiments: int
    messages: dict[str, int]  # on each channel of the trace


def statistics(events: Sequence[AnyEvent], messages: dict[str, int]) -> Statistics:
    """Compute the statistics of a run. `messages` is the number of messages on each channel of the run's trace."""
    total = Figures()
    for event in events:
        total.add(event)
    total.seconds = events[-1].time - events[0].time if events else 0.0
    kinds = Counter(type(event) for event in events)
    return Statistics(
        stages=_stages(events),
        total=total,
        operator=kinds[happened.OperatorCalled],
        experiments=kinds[happened.ExperimentMade],
        messages=messages,
    )


NARROW: Final = 60  # columns of a terminal that has no room for a table
_HEADS: Final = ("time", "camera", "steps", "stops", "tries", "errors")


def _stages(events: Sequence[AnyEvent]) -> list[StageFigures]:
    stages: dict[str, StageFigures] = {}
    here: StageFigures | None = None
    before = 0.0
    for event in events:
        if isinstance(event, happened.StageStarted):
            here = stages.setdefault(event.stage, StageFigures(stage=event.stage))
            here.status, before = BROKEN_OFF, event.time
        if here is None:
            continue
        here.add(event)
        here.seconds += event.time - before
        before = event.time
        if isinstance(event, happened.StageFinished):
            here.status, here = event.status, None
    return list(stages.values())


def statistics_table(figures: Statistics, columns: int) -> RenderableType:
    """Return the statistics as a table for a terminal with `columns` columns. Times are in simulated seconds."""
    table = _table(figures) if columns >= NARROW else _lines(figures)
    told = f"operator called: {figures.operator}; experiments: {figures.experiments}"
    parts: list[RenderableType] = [table, Text(), Text(told)]
    if figures.messages:
        channels = ", ".join(f"{topic} {count}" for topic, count in sorted(figures.messages.items()))
        parts.append(Text(printable(f"messages: {channels}")))
    return Group(*parts)


def _table(figures: Statistics) -> Table:
    table = Table(box=None, pad_edge=False, padding=(0, 1, 0, 0), header_style="bold")
    table.add_column("stage", overflow="fold")
    for name in _HEADS:
        table.add_column(name, justify="left" if name == "errors" else "right", no_wrap=True)
    for stage in figures.stages:
        table.add_row(Text(_name(stage)), *_cells(stage))
    table.add_row("all", *_cells(figures.total), style="bold")
    return table


def _lines(figures: Statistics) -> Group:
    """Return the statistics as one paragraph per stage and one for the total. These paragraphs are for a narrow
    terminal, on which a table would break words.
    """
    rows = [*((_name(stage), _cells(stage)) for stage in figures.stages), ("all", _cells(figures.total))]
    told = (
        (name, ", ".join(f"{cell} {head}" for head, cell in zip(_HEADS, cells, strict=True) if cell))
        for name, cells in rows
    )
    return Group(*(Text(f"{name}: {cells}") for name, cells in told))


def _name(stage: StageFigures) -> str:
    return printable(stage.stage if stage.status == "done" else f"{stage.stage} ({stage.status})")


def _cells(figures: Figures) -> list[str]:
    counts = (figures.steps, figures.guards, figures.places)
    errors = ", ".join(f"{count} x {number}" for number, count in sorted(figures.errors.items()))
    return [
        f"{round(figures.seconds, 3):.1f}",
        f"{round(figures.camera_s, 3):.1f}",
        *map(str, counts),
        errors,
    ]
