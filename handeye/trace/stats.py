"""The figures of a run: where the time went, and what happened how often."""

from collections import Counter
from collections.abc import Sequence

import msgspec
from rich.console import Group, RenderableType
from rich.table import Table
from rich.text import Text

from handeye import events as happened
from handeye.events import AnyEvent, Event

BROKEN_OFF = "interrupted"
"""Status of a stage whose end was not recorded."""


class Figures(msgspec.Struct, kw_only=True):
    """Figures of a part of a run."""

    seconds: float = 0.0
    """Simulated, s."""
    camera_s: float = 0.0
    """Of these, what the camera's mechanism took."""
    steps: int = 0
    motions: int = 0
    """Steps that moved the arm."""
    guards: int = 0
    """Motions that a force or torque ended."""
    errors: dict[int, int] = msgspec.field(default_factory=dict)
    """How often each error number was raised."""
    places: int = 0
    """Places that searches went on to."""
    pictures: int = 0

    def add(self, event: Event) -> None:
        """Count an event."""
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
    """Figures of a stage; one that was done more than once is counted together."""

    stage: str
    status: str = BROKEN_OFF
    """How it ended last: done, stopped, skipped, or broken off."""


class Statistics(msgspec.Struct, kw_only=True):
    """The figures of a whole run."""

    stages: list[StageFigures]
    total: Figures
    operator: int
    """How often the operator was called."""
    experiments: int
    messages: dict[str, int]
    """On each channel of the trace."""


def statistics(events: Sequence[AnyEvent], messages: dict[str, int]) -> Statistics:
    """The figures of a run.

    Args:
        messages: how many there are on each channel of its trace.
    """
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


def _stages(events: Sequence[AnyEvent]) -> list[StageFigures]:
    """The stages in the order they were begun."""
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


def statistics_table(figures: Statistics) -> RenderableType:
    """The figures for a terminal; times in simulated seconds."""
    table = Table(box=None, pad_edge=False, padding=(0, 1, 0, 0), header_style="bold")
    table.add_column("stage", overflow="fold")
    for name in ("time", "camera", "steps", "stops", "tries"):
        table.add_column(name, justify="right", no_wrap=True)
    table.add_column("errors", no_wrap=True)
    for stage in figures.stages:
        ended = "" if stage.status == "done" else f" ({stage.status})"
        table.add_row(stage.stage + ended, *_cells(stage))
    table.add_row("all", *_cells(figures.total), style="bold")
    told = f"operator called: {figures.operator}; experiments: {figures.experiments}"
    parts: list[RenderableType] = [table, Text(), Text(told)]
    if figures.messages:
        channels = ", ".join(f"{topic} {count}" for topic, count in sorted(figures.messages.items()))
        parts.append(Text(f"messages: {channels}"))
    return Group(*parts)


def _cells(figures: Figures) -> list[str]:
    counts = (figures.steps, figures.guards, figures.places)
    errors = ", ".join(f"{count} x {number}" for number, count in sorted(figures.errors.items()))
    return [
        f"{round(figures.seconds, 3):.1f}",
        f"{round(figures.camera_s, 3):.1f}",
        *map(str, counts),
        errors,
    ]
