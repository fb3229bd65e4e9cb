"""What a run was told by its senses, and told people, one after another."""

from typing import Final, NamedTuple

from handeye.program import events as happened
from handeye.program.events import AnyEvent
from handeye.report.recorded import RecordedRun

SENSED: Final = (
    happened.Adjusted,
    happened.CameraBusy,
    happened.CameraStarted,
    happened.ErrorRaised,
    happened.ErrorTested,
    happened.ExperimentMade,
    happened.GuardFaint,
    happened.GuardTripped,
    happened.HandTold,
    happened.LineTyped,
    happened.OperatorAnswered,
    happened.OperatorCalled,
    happened.PanicStopped,
    happened.PartInspected,
    happened.PartMatched,
    happened.PartSeen,
    happened.PictureTaken,
    happened.PositionDefined,
    happened.Saved,
    happened.SearchAdvanced,
    happened.SystemEvent,
)
"""Events worth a caption."""


class CaptionedEvent(NamedTuple):
    """An event worth a caption."""

    time: float
    """s since the run began."""
    event: AnyEvent


def told(run: RecordedRun) -> tuple[CaptionedEvent, ...]:
    """All of them, in order."""
    return tuple(
        CaptionedEvent(run.seconds(event.time), event)
        for event in run.trace.events
        if isinstance(event, SENSED)
    )
