"""Selects the parts of a run that a video shows, and determines how long the video shows each part."""

from collections.abc import Iterable, Iterator
from dataclasses import dataclass
from itertools import pairwise
from typing import Final

import numpy as np

from handeye.core.errors import Refused
from handeye.core.pose import Array
from handeye.program.events import CameraBusy
from handeye.report.facts.seen import SeenPicture, seen_pictures
from handeye.report.recorded import RecordedRun
from handeye.trace.trace import Trace

MAX_WAIT_S: Final = 1.0  # Greatest part of a wait for the camera's mechanism that is shown
_LOOK: Final = 0.7  # s of the video to show a picture
_LOOKING: Final = 0.4  # fraction of a video for pictures, at most
_LEAST: Final = 2 / 3  # Least duration of a stage, as a fraction of an equal share

Span = tuple[float, float]  # begin, end, s by the cell's clock


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class Passage:
    """A continuous part of the run within one stage, or a moment at which the video stops to show a picture."""

    begin: float  # s by the cell's clock
    end: float
    stage: int  # Index in `Trace.stages_both_ways`; -1 before the first stage
    looked_at: SeenPicture | None = None  # picture shown while the run stands still


def passages(trace: Trace, span: Span, *, looks: bool) -> tuple[Passage, ...]:
    """Return the passages of a time span. Times during which the program waits for the camera are left out. If `looks`
    is True, the video stops at pictures.
    """
    pictures = _pictures(trace) if looks else {}
    edges = sorted({*pictures, *(stage.begin for stage in trace.stages_both_ways)})
    found: list[Passage] = []
    begun = [stage.begin for stage in trace.stages_both_ways]
    for begin, end in _pieces(_without_waits(trace, span), edges):
        stage = int(np.searchsorted(begun, begin, side="right")) - 1
        found.append(Passage(begin=begin, end=end, stage=stage))
        if end in pictures:
            found.append(Passage(begin=end, end=end, stage=stage, looked_at=pictures[end]))
    if not found:
        raise Refused(f"{trace.name} has no motion in the part that the video would show")
    return tuple(found)


def _pictures(trace: Trace) -> dict[float, SeenPicture]:
    """Return the pictures. The keys are the times (s) at which the pictures were taken."""
    return {picture.time: picture for picture in seen_pictures(RecordedRun(trace=trace))}


def _without_waits(trace: Trace, span: Span) -> Iterator[Span]:
    """Yield the parts of a span in which the program does not wait for the camera."""
    begin, end = span
    for event in trace.events:
        if isinstance(event, CameraBusy) and event.seconds > MAX_WAIT_S:
            cut = min(event.time - event.seconds + MAX_WAIT_S, end)
            if begin < cut:
                yield begin, cut
            begin = max(begin, event.time)
    if begin < end:
        yield begin, end


def _pieces(spans: Iterable[Span], edges: list[float]) -> Iterator[Span]:
    """Cut spans at edges, and yield the pieces."""
    for begin, end in spans:
        cuts = [begin, *(edge for edge in edges if begin < edge < end), end]
        yield from pairwise(cuts)


def at_speed(shown: tuple[Passage, ...], speed: float) -> Array:
    """Return how long the video shows each passage (s), shape (n,). The run is shown at `speed` times its real
    speed.
    """
    return _took(shown) / speed + _LOOK * _still(shown)


def within(shown: tuple[Passage, ...], seconds: float) -> Array:
    """Return how long the video shows each passage (s), shape (n,). The whole video lasts `seconds`.

    All passages have the same speed, except those of short stages, which are slower so that they can be seen.
    """
    still, took = _still(shown), _took(shown)
    look = min(_LOOK, _LOOKING * seconds / max(still.sum(), 1))
    stages, stage = np.unique([passage.stage for passage in shown], return_inverse=True)
    took_stage = np.bincount(stage, took).astype(float)
    slowed = _shares(took_stage, _LEAST / len(stages)) / took_stage
    moving = seconds - look * float(still.sum())
    return np.asarray(look * still + took * slowed[stage] * moving)


def _took(shown: tuple[Passage, ...]) -> Array:
    return np.array([passage.end - passage.begin for passage in shown])


def _still(shown: tuple[Passage, ...]) -> Array:
    """Return 1 for each passage that stops at a picture, and 0 for all others."""
    return np.array([float(passage.looked_at is not None) for passage in shown])


def _shares(took: Array, least: float) -> Array:
    """Return shares, shape (n,), that are proportional to the durations `took`, but not less than the share `least`,
    and add up to 1.
    """
    short = np.zeros(len(took), dtype=bool)
    while True:
        rest = 1 - least * short.sum()
        shares = np.where(short, least, took / took[~short].sum() * rest)
        if (shares >= least - 1e-9).all():
            return shares
        short |= shares < least


def passage_at(lasts: Array, times: Array) -> tuple[Array, Array]:
    """Return, for each time of the video (s), the index of the passage at this time, and the fraction of this passage
    that has been shown.
    """
    ends = np.cumsum(lasts)
    at = np.minimum(np.searchsorted(ends, times, side="right"), len(lasts) - 1)
    return at, np.clip((times - (ends - lasts)[at]) / lasts[at], 0, 1)
