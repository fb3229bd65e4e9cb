"""Which passages of a run a video shows, and for how long each."""

from collections.abc import Iterable, Iterator
from dataclasses import dataclass
from itertools import pairwise
from typing import Final

import numpy as np

from handeye.core.errors import Refused
from handeye.core.pose import Array
from handeye.program.events import CameraBusy
from handeye.report.facts.seen import SeenPicture, seen_pictures
from handeye.report.recorded import Recorded
from handeye.trace.trace import Trace

PATIENCE: Final = 1.0
"""s that is left of a wait for the camera's mechanism."""
_LOOK: Final = 0.7
"""s of the video for which a picture is looked at."""
_LOOKING: Final = 0.4
"""Of a video that may go into that, at most."""
_LEAST: Final = 2 / 3
"""Of the time that every stage would have if all had the same: what each has at least."""

Span = tuple[float, float]
"""From when to when, s on the cell's clock."""


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class Passage:
    """A time of the run that is shown without a cut, within one stage; or a moment of it, for a picture's sake."""

    begin: float
    """s, on the cell's clock"""
    end: float
    stage: int
    """Counted through the stages as the arm went through them, either way; -1 before the first."""
    looked_at: SeenPicture | None = None
    """The picture that is shown while the run stands still."""


def passages(trace: Trace, span: Span, *, looks: bool) -> tuple[Passage, ...]:
    """The passages of a time, without waits for the camera's mechanism; raises InvalidInput if there is no motion in
    that time.

    Args:
        looks: the run stands still where a picture was taken, so that it can be looked at.
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
        raise Refused(f"{trace.name} has no motion in what the video is to show")
    return tuple(found)


def _pictures(trace: Trace) -> dict[float, SeenPicture]:
    """The pictures that were taken, by the clock."""
    clocks = {trace.elapsed(picture.time): picture.time for picture in trace.pictures}
    return {clocks[picture.time]: picture for picture in seen_pictures(Recorded(trace=trace))}


def _without_waits(trace: Trace, span: Span) -> Iterator[Span]:
    """What is left of a time where waits are cut out."""
    begin, end = span
    for event in trace.events:
        if isinstance(event, CameraBusy) and event.seconds > PATIENCE:
            cut = min(event.time - event.seconds + PATIENCE, end)
            if begin < cut:
                yield begin, cut
            begin = max(begin, event.time)
    if begin < end:
        yield begin, end


def _pieces(spans: Iterable[Span], edges: list[float]) -> Iterator[Span]:
    """Times, cut at edges."""
    for begin, end in spans:
        cuts = [begin, *(edge for edge in edges if begin < edge < end), end]
        yield from pairwise(cuts)


def at_speed(shown: tuple[Passage, ...], speed: float) -> Array:
    """How long each passage is in the video (s), shape (n,), if all are so many times as fast as they were."""
    return _took(shown) / speed + _LOOK * _still(shown)


def within(shown: tuple[Passage, ...], seconds: float) -> Array:
    """How long each passage is in the video (s), shape (n,), if they take so long together.

    All are equally fast, but for those of short stages: slower, so that each can be seen.
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
    """1 for those that stand still, 0 for others."""
    return np.array([float(passage.looked_at is not None) for passage in shown])


def _shares(took: Array, least: float) -> Array:
    """Shares of the whole as `took` has them, but none below `least`, shape (n,)."""
    short = np.zeros(len(took), dtype=bool)
    while True:
        rest = 1 - least * short.sum()
        shares = np.where(short, least, took / took[~short].sum() * rest)
        if (shares >= least - 1e-9).all():
            return shares
        short |= shares < least


def passage_at(lasts: Array, times: Array) -> tuple[Array, Array]:
    """The number of the passage that stands at each time of the video (s), and how much of it is over by then."""
    ends = np.cumsum(lasts)
    at = np.minimum(np.searchsorted(ends, times, side="right"), len(lasts) - 1)
    return at, np.clip((times - (ends - lasts)[at]) / lasts[at], 0, 1)
