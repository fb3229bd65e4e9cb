"""Takes the photographs of a recorded run for its report: one main photograph, and one for each stage."""

from collections.abc import Iterator, Sequence
from dataclasses import dataclass, replace
from typing import Final

import cv2
import numpy as np

from handeye.cell.photograph import Near, Photographer
from handeye.cell.photograph import Photograph as Points
from handeye.cell.posed import posed
from handeye.core.errors import InvalidInput
from handeye.core.markup import Markup, data_address, element
from handeye.program.events import GuardTripped, StepFinished
from handeye.report.facts.outcome import Outcome, outcome
from handeye.report.recorded import RecordedRun
from handeye.tasks import known
from handeye.tasks.interface import AnyTask
from handeye.trace.stages import Stage

MOST: Final = 24
_QUALITY: Final = 80
_NEAR: Final = 0.62  # m from the hand to the camera


@dataclass(frozen=True, slots=True, kw_only=True)
class Photograph:
    """A photograph, or the reason why there is no photograph."""

    time: float  # s since the run began
    shows: str
    width: int
    height: int
    webp: bytes | None  # The file; None: it could not be taken
    missing: str = ""


@dataclass(frozen=True, slots=True, kw_only=True)
class _PrintSize:
    """Size and image quality of photographs."""

    width: int
    height: int
    finer: int  # Rendered pixels for each pixel of the photograph, along a side
    shadow: int  # Pixels along a side of the shadow map


LARGE: Final = _PrintSize(width=960, height=720, finer=2, shadow=4096)
SMALL: Final = _PrintSize(width=480, height=360, finer=1, shadow=2048)


@dataclass(frozen=True, slots=True, kw_only=True)
class _PhotographRequest:
    """A request for a photograph: the time, the view, and the caption."""

    time: float  # s since the run began
    view: str | Near
    shows: str


@dataclass(frozen=True, slots=True, kw_only=True)
class Album:
    """The photographs of a run."""

    leading: Photograph
    stages: tuple[Photograph, ...]


def album(run: RecordedRun) -> Album:
    """Take the photographs of a run: a main photograph, and one of each stage. The main photograph shows the end of
    the run or, if the run failed, the moment of failure.
    """
    return Album(leading=_leading(run, outcome(run)), stages=_of_stages(run))


def no_album(run: RecordedRun, why: str) -> Album:
    """Return an album without photographs. The album gives the reason `why` in place of the main photograph."""
    leading = _none(_PhotographRequest(time=outcome(run).time, view=_room(run), shows="The run"), LARGE, why)
    return Album(leading=leading, stages=())


def _leading(run: RecordedRun, outcome: Outcome) -> Photograph:
    """Take the main photograph, which shows the finished work, or the moment at which the run failed."""
    shows = "The end of the run" if outcome.ended else "The hand at the end of the run"
    wanted = _PhotographRequest(time=outcome.time, view=_leading_view(run, outcome), shows=shows)
    (taken,) = _taken(run, [wanted], LARGE)
    left = run.end if outcome.ended else None
    return taken if taken.webp is not None or left is None else _left(left, taken)


def _leading_view(run: RecordedRun, outcome: Outcome) -> str | Near:
    """Return the view of the main photograph. The view shows the hand if the program did not end, and the work if the
    referee judged the work. In all other cases, it shows the whole cell.
    """
    if not outcome.ended:
        return _at_hand(run, outcome.time)
    task = known(run.trace.head.task)
    judged = outcome.kind in ("right", "wrong")
    return task.photographs[-1] if judged and task is not None and task.photographs else _room(run)


def _left(picture: bytes, missing: Photograph) -> Photograph:
    """Replace the photograph `missing`, which could not be taken, by the picture that the run saved at its end."""
    points = cv2.imdecode(np.frombuffer(picture, dtype=np.uint8), cv2.IMREAD_COLOR_RGB)
    if points is None:
        return missing
    return replace(missing, webp=_webp(points.astype(np.uint8, copy=False), LARGE), missing="")


def _of_stages(run: RecordedRun) -> tuple[Photograph, ...]:
    """Take a photograph of each stage or, if there are many stages, of some of them."""
    stages = [(number, stage) for number, stage in enumerate(run.trace.stages, 1) if stage.end > run.begins]
    every = -(-len(stages) // MOST) or 1
    return _taken(run, [_of_stage(run, number, stage) for number, stage in stages[::every]], SMALL)


def _of_stage(run: RecordedRun, number: int, stage: Stage) -> _PhotographRequest:
    """Choose the moment of a stage to photograph. This is the last moment at which a guard tripped. If no guard
    tripped, it is the end of the stage.
    """
    trips = [
        event.time
        for event in run.trace.events
        if isinstance(event, GuardTripped) and stage.begin <= event.time <= stage.end
    ]
    time = trips[-1] if trips else stage.end
    return _PhotographRequest(
        time=time, view=_at_hand(run, time) if trips else _room(run), shows=f"{number} {stage.name}"
    )


def _room(run: RecordedRun) -> str:
    """Return the name of the camera that shows the whole cell."""
    task = known(run.trace.head.task)
    return AnyTask.camera if task is None else task.camera


def _at_hand(run: RecordedRun, time: float) -> str | Near:
    """Return a close view of the hand at a time (s). The view is centred on the position of the hand after the last
    step that ended before this time.
    """
    ended = [
        event.hand
        for event in run.trace.events
        if isinstance(event, StepFinished) and event.hand is not None and event.time <= time + 0.1
    ]
    return Near(camera=_room(run), place=ended[-1], distance=_NEAR) if ended else _room(run)


def _taken(
    run: RecordedRun, wanted: Sequence[_PhotographRequest], size: _PrintSize
) -> tuple[Photograph, ...]:
    """Take the photographs. If they cannot be taken, return the reason in place of each photograph."""
    try:
        return tuple(_take(run, wanted, size))
    except InvalidInput as fault:
        return tuple(_none(each, size, f"No photograph: {fault}.") for each in wanted)


def _none(wanted: _PhotographRequest, size: _PrintSize, why: str) -> Photograph:
    return Photograph(
        time=wanted.time, shows=wanted.shows, width=size.width, height=size.height, webp=None, missing=why
    )


def _take(run: RecordedRun, wanted: Sequence[_PhotographRequest], size: _PrintSize) -> Iterator[Photograph]:
    wide, high = size.finer * size.width, size.finer * size.height
    photographer = Photographer(run.trace.scene, width=wide, height=high, shadow=size.shadow)
    begin, end = run.trace.covers
    for each in wanted:
        moment = run.trace.at(min(max(each.time, begin), end))
        fine = photographer.take(*posed(run.trace.scene, moment.poses, moment.time), each.view)
        yield Photograph(
            time=each.time, shows=each.shows, width=size.width, height=size.height, webp=_webp(fine, size)
        )


def _webp(fine: Points, size: _PrintSize) -> bytes:
    """Encode a photograph at its final size as a WebP file."""
    small = cv2.resize(fine, (size.width, size.height), interpolation=cv2.INTER_AREA)
    done, data = cv2.imencode(".webp", small[:, :, ::-1], [cv2.IMWRITE_WEBP_QUALITY, _QUALITY])
    assert done
    return data.tobytes()


def shown(photograph: Photograph, **attributes: str | None) -> Markup:
    """Return a photograph with its caption or, if there is no photograph, the reason."""
    if photograph.webp is None:
        return element("p", photograph.missing, class_="missing")
    image = element(
        "img",
        src=data_address("image/webp", photograph.webp),
        alt=photograph.shows,
        width=photograph.width,
        height=photograph.height,
    )
    return element("figure", image, element("figcaption", photograph.shows), **attributes)
