"""Plans the frames of a video: the time, the view and the caption of each."""

from collections.abc import Sequence
from dataclasses import dataclass
from typing import Any, Final

import numpy as np

from handeye.cell.photograph import Near
from handeye.core.diagnostics import quoted, visible
from handeye.core.errors import BadArgument, NoSuchName
from handeye.core.pose import Array
from handeye.program.events import StepFinished
from handeye.program.stage_names import stage_index
from handeye.report.facts.seen import SeenPicture
from handeye.report.page.figures import clock
from handeye.trace.reading import stage_names
from handeye.trace.stages import BROKEN_OFF, Stage
from handeye.trace.trace import SHOWN, Trace
from handeye.video.captions import Caption
from handeye.video.formats import RATE
from handeye.video.passages import Passage, Span, at_speed, passage_at, passages, within
from handeye.video.request import FOLLOW, LONGEST, ORBIT, SECONDS, VideoRequest

View = str | Near
_FAR: Final = 0.95  # distance of the camera from the cell's middle, in units of the cell's size
_SWAY_DEG: Final = 34.0
_CLOSE, _WIDE = 0.4, 0.6  # Distance of the camera from the hand's work: least, m; per m of the hand's range
_AROUND: Final = 0.15  # m; points closer together than this belong to one place of work
_AMID: Final = np.array([0.5, 0.5, -0.1])
"""Point at which the view is aimed. Each coordinate is a fraction of the hand's range, measured from the lower corner
of the range. The point lies under the middle of the range, a tenth of its height below its lowest place, because the
hand works near the table.
"""
_STILL_M: Final = 0.05
_GLIDE: Final = 0.9  # s between the views of two stages


def views(trace: Trace, camera: str, stages: Sequence[int], rate: float) -> list[View]:
    """Return the view of each frame. Raises InvalidInput if there is no such camera.

    Args:
        camera: name of a camera in the scene, or `orbit` or `follow`.
        stages: index of each frame's stage in `trace.stages_both_ways`, shape (n,).
        rate: frames per second.
    """
    cameras = [trace.scene.camera(number).name for number in range(trace.scene.ncam)]
    if camera == ORBIT:
        return list(_orbit(trace.scene, trace.overview, len(stages)))
    if camera == FOLLOW:
        return list(_follow(trace, trace.overview, stages, rate))
    if camera not in cameras:
        raise NoSuchName(
            f"there is no camera {camera}; the cameras are {', '.join([ORBIT, FOLLOW, *cameras])}"
        )
    return [camera] * len(stages)


def _orbit(scene: Any, side: str, frames: int) -> list[View]:
    (x, y, z), distance = scene.stat.center.tolist(), _FAR * float(scene.stat.extent)
    turns = _SWAY_DEG * (1 - np.cos(np.linspace(0, 2 * np.pi, frames))) / 2  # to the other side and back
    return [Near(camera=side, place=(x, y, z), distance=distance, turned=turned) for turned in turns.tolist()]


def _follow(trace: Trace, side: str, stages: Sequence[int], rate: float) -> list[View]:
    """Return views close to the work of each stage. The views glide from one stage to the next."""
    at = _smooth(np.array(_targets(trace))[np.maximum(stages, 0)], round(_GLIDE * rate))
    return [Near(camera=side, place=(x, y, z), distance=distance) for x, y, z, distance in at.tolist()]


def _targets(trace: Trace) -> list[Array]:
    """Return, for each stage, the point at which the camera looks (m) and the distance of the camera from it
    (m), shape (n, 4).

    A stage in which the hand hardly moves gets the values of the next stage or of the previous stage.
    """
    found = [_target(np.array(_hands(trace, stage))) for stage in trace.stages_both_ways]
    return [_nearest(found, number, trace) for number in range(max(len(found), 1))]


def _hands(trace: Trace, stage: Stage) -> list[tuple[float, float, float]]:
    """Return the position of the hand after each step of a stage (m)."""
    return [
        event.hand
        for event in trace.events
        if isinstance(event, StepFinished) and event.hand and stage.begin < event.time <= stage.end
    ]


def _target(hands: Array) -> Array | None:
    """Return the point at which the camera looks, and the distance of the camera from it. The view contains the region
    in which most of the positions of the hand lie. These positions are `hands`, shape (n, 3). Returns None if the
    positions hardly differ.

    Later positions have more weight, so that the view shows the place where a part is put down rather than the place
    from which it is fetched.
    """
    if not len(hands) or np.ptp(hands, axis=0).max() < _STILL_M:
        return None
    near = np.linalg.norm(hands[:, None] - hands, axis=2) < _AROUND
    work = hands[near[(near @ np.arange(1, len(hands) + 1)).argmax()]]
    low, size = work.min(axis=0), np.ptp(work, axis=0)
    return np.array([*low + _AMID * size, _CLOSE + _WIDE * np.linalg.norm(size)])


def _nearest(found: Sequence[Array | None], number: int, trace: Trace) -> Array:
    for target in (*found[number:], *found[number::-1]):
        if target is not None:
            return target
    return np.array([*trace.scene.stat.center, _FAR * trace.scene.stat.extent])


def _smooth(values: Array, window: int) -> Array:
    """Return smoothed values, shape (n, m)."""
    weights = np.hanning(2 * (window // 2) + 3)[1:-1]
    around = np.pad(values, ((window // 2,) * 2, (0, 0)), mode="edge")
    weights /= weights.sum()
    return np.stack([np.convolve(column, weights, mode="valid") for column in around.T], axis=1)


_HELD: Final = 0.1, 1.5  # Duration of the last frame: fraction of the video, and s at most


@dataclass(frozen=True, slots=True, kw_only=True)
class Frame:
    """A frame of a video."""

    time: float  # s by the cell's clock
    view: View
    caption: Caption | None
    looked_at: SeenPicture | None  # picture in a corner


@dataclass(frozen=True, slots=True, kw_only=True)
class Storyboard:
    """The frames of a video in order. `held` is the number of further frame periods for which the last frame stays."""

    frames: tuple[Frame, ...]
    held: int

    @property
    def seconds(self) -> float:
        """Duration of the video (s)."""
        return (len(self.frames) + self.held) / RATE


def storyboard(trace: Trace, wanted: VideoRequest) -> Storyboard:
    """Plan a video of a recorded run."""
    shown = passages(trace, _span(trace, wanted), looks=wanted.captions)
    lasts, held = _paced(shown, wanted)
    frames = max(round(lasts.sum() * RATE), 1)
    at, over = passage_at(lasts, np.linspace(0, lasts.sum(), frames))
    chosen = [shown[number] for number in at]
    eyes = views(trace, wanted.camera, [passage.stage for passage in chosen], RATE)
    program = stage_names(trace)
    return Storyboard(
        frames=tuple(
            Frame(
                time=time,
                view=view,
                caption=_caption(trace, program, passage, time) if wanted.captions else None,
                looked_at=passage.looked_at,
            )
            for passage, time, view in zip(chosen, _times(chosen, over), eyes, strict=True)
        ),
        held=held,
    )


def _times(chosen: Sequence[Passage], over: Array) -> list[float]:
    """Return a time of the run (s) for each passage. At this time, the fraction `over` of the passage has been shown;
    `over` has one value for each passage.
    """
    spans = np.array([(passage.begin, passage.end) for passage in chosen])
    return list((spans[:, 0] + over * np.ptp(spans, axis=1)).tolist())


def _span(trace: Trace, wanted: VideoRequest) -> Span:
    """Return the requested time span, as far as it was recorded."""
    program, (begin, end) = stage_names(trace), trace.covers
    first, last = (
        None if given is None else stage_index(str(given), program) for given in (wanted.first, wanted.last)
    )
    if first is not None and last is not None and last < first:
        raise BadArgument(
            f"the last stage, {quoted(program[last])}, comes before the first, {quoted(program[first])}"
        )
    if first is not None:
        begin = max(begin, _recorded(trace, program[first])[0].begin)
    if last is not None:
        end = min(end, _recorded(trace, program[last])[-1].end)
    return begin, end


def _recorded(trace: Trace, name: str) -> list[Stage]:
    """Return all recorded executions of a stage. Raises BadArgument if there are no such executions."""
    stages = [stage for stage in trace.stages if stage.end > trace.begins]
    found = [stage for stage in stages if stage.name == name]
    if not found:
        there = ", ".join(map(quoted, dict.fromkeys(stage.name for stage in stages)))
        raise BadArgument(f"{trace.name} does not show stage {quoted(name)}; it shows {there or 'no stages'}")
    return found


def _paced(shown: tuple[Passage, ...], wanted: VideoRequest) -> tuple[Array, int]:
    """Return the durations of the passages (s), and the number of frame periods for which the last frame is
    held."""
    share, most = _HELD
    if wanted.speed is None:
        periods = max(round((wanted.seconds or SECONDS) * RATE), 1)
        held = round(min(share * periods, most * RATE))
        return within(shown, (periods - held) / RATE), held
    lasts = at_speed(shown, wanted.speed)
    if lasts.sum() > LONGEST:
        raise BadArgument(
            f"at {wanted.speed:g} times the speed of the run, the video would take {lasts.sum():.0f} s; the limit "
            f"is {LONGEST:g} s"
        )
    return lasts, round(min(share * lasts.sum(), most) * RATE)


def _caption(trace: Trace, program: tuple[str, ...], passage: Passage, time: float) -> Caption:
    stage = trace.stages_both_ways[passage.stage] if passage.stage >= 0 else None
    name = "" if stage is None else stage.name
    shown = visible(name)
    number = program.index(name) + 1 if name in program else 0
    stopped = stage is not None and stage.status in (BROKEN_OFF, "stopped") and time >= stage.end - SHOWN
    way = "undo: " if stage is not None and stage.back else ""
    words = f"{number}  {way}{shown}" if number else f"{way}{shown}"
    return Caption(
        words=f"{words}: stopped" if stopped else words,
        clock=clock(time),
        stages=max(len(program), 1),
        begun=number,
        stopped=stopped,
    )
