"""Collects the pictures that a program took, and what vision found in each."""

from collections.abc import Iterator
from dataclasses import dataclass

from google.protobuf.message import DecodeError

from handeye.core.errors import BadFile
from handeye.ports.camera import Picture
from handeye.program.events import ErrorRaised, PartInspected, PartMatched, PartSeen, PictureTaken
from handeye.report.recorded import RecordedRun
from handeye.trace.channels import ANNOTATIONS, nanoseconds
from handeye.trace.messages import read_annotations
from handeye.trace.stages import done_steps
from handeye.vision.marks import Mark

Finding = PartSeen | PartInspected | PartMatched | ErrorRaised


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class SeenPicture:
    """A picture that the program took, with what vision found in it."""

    time: float  # s since the run began
    name: str
    lens: float  # Focal length, m
    picture: Picture  # Levels 0 to 15, shape (rows, columns)
    marks: tuple[Mark, ...]
    findings: tuple[Finding, ...]


def seen_pictures(run: RecordedRun) -> tuple[SeenPicture, ...]:
    """Return the pictures, the earliest first. Raises InvalidInput if a message about a picture is invalid."""
    return tuple(_seen(run))


def lost_pictures(run: RecordedRun) -> int:
    """Return the number of pictures that the trace does not contain."""
    taken = sum(isinstance(event, PictureTaken) for event in run.trace.events)
    return taken - len(run.trace.pictures)


def _seen(run: RecordedRun) -> Iterator[SeenPicture]:
    shots = {shot.time: shot.picture for shot in run.trace.pictures}
    marks, findings = _marks(run), _findings(run)
    for event in run.trace.events:
        if isinstance(event, PictureTaken) and event.time in shots:
            yield SeenPicture(
                time=event.time,
                name=event.picture,
                lens=event.lens,
                picture=shots[event.time],
                marks=marks.get(nanoseconds(event.time), ()),
                findings=tuple(findings.get(event.time, ())),
            )


def _marks(run: RecordedRun) -> dict[int, tuple[Mark, ...]]:
    """Return the last marks on each picture. The keys are the times at which the pictures were taken (ns). Each set of
    marks includes the earlier marks on that picture.
    """
    try:
        return dict(
            read_annotations(message.data) for message in run.trace.messages if message.topic == ANNOTATIONS
        )
    except DecodeError:
        raise BadFile(f"{run.trace.name}: the marks on a picture cannot be decoded") from None


def _findings(run: RecordedRun) -> dict[float, list[Finding]]:
    """Return what vision found in each picture. The keys are the times at which the pictures were taken (s)."""
    found: dict[float, list[Finding]] = {}
    taken: dict[str, float] = {}
    for step in done_steps(run.trace.events):
        taken |= {event.picture: event.time for event in step.events if isinstance(event, PictureTaken)}
        examined = run.program.steps[step.started.step].operation.examines if taken else None
        if examined in taken:
            findings = [event for event in step.events if isinstance(event, Finding)]
            found.setdefault(taken[examined], []).extend(findings)
    return found
