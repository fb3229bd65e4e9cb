"""What happened, as plain records. Simulated time only, so that two runs with one seed give the same bytes."""

from typing import Literal

import msgspec

from handeye.plan.program import Record


class Event(Record, frozen=True, kw_only=True, tag_field="event", tag=True):
    """Base of the events; `time` is the cell's clock in seconds."""

    time: float


class RunStarted(Event, frozen=True, kw_only=True):
    """The working phase begins."""

    program: str
    steps: int


class StageStarted(Event, frozen=True, kw_only=True):
    """A stage begins."""

    stage: str


class StageFinished(Event, frozen=True, kw_only=True):
    """A stage ended."""

    stage: str
    status: Literal["done", "stopped"]


class StepStarted(Event, frozen=True, kw_only=True):
    """A step begins; `line` and `text` are the source's."""

    step: int
    line: int
    text: str


class StepFinished(Event, frozen=True, kw_only=True):
    """A step ended; where the hand is by the arm's own sensors (m), and the finger gap (m)."""

    step: int
    hand: tuple[float, float, float]
    gap: float


class Adjusted(Event, frozen=True, kw_only=True):
    """A goal was moved off its planned value before the motion began: by how much (m)."""

    goal: str
    shift: tuple[float, float, float]


class GuardTripped(Event, frozen=True, kw_only=True):
    """A guard ended a motion."""

    guard: str
    value: float
    limit: float


class ErrorRaised(Event, frozen=True, kw_only=True):
    """An action raised an error."""

    number: int
    detail: str


class ErrorTested(Event, frozen=True, kw_only=True):
    """The program asked for an error; `occurred` is the answer."""

    number: int
    occurred: bool


class SearchAdvanced(Event, frozen=True, kw_only=True):
    """The search goes on to its place number `count` (0 is the first)."""

    count: int
    offset: tuple[float, float]


class Saved(Event, frozen=True, kw_only=True):
    """A difference was saved (m)."""

    name: str
    difference: tuple[float, float, float]


class Restored(Event, frozen=True, kw_only=True):
    """A saved difference was added to a goal (m)."""

    name: str
    goal: str
    difference: tuple[float, float, float]


class PictureTaken(Event, frozen=True, kw_only=True):
    """A picture was taken through a lens (focal length in m)."""

    picture: str
    lens: float


class PartSeen(Event, frozen=True, kw_only=True):
    """Vision measured a part: x, y (m) and yaw (rad), or no yaw from a general look."""

    part: str
    x: float
    y: float
    yaw: float | None


class PartInspected(Event, frozen=True, kw_only=True):
    """Vision compared two pictures."""

    part: str
    ok: bool
    sentence: str


class CameraBusy(Event, frozen=True, kw_only=True):
    """The camera's mechanism needed this long (s)."""

    action: str
    seconds: float


class OperatorCalled(Event, frozen=True, kw_only=True):
    """Brakes are set and the operator is told."""

    message: str
    error: int | None


class RunFinished(Event, frozen=True, kw_only=True):
    """The working phase ended."""

    completed: bool


_encoder = msgspec.json.Encoder()


def to_line(event: Event) -> bytes:
    """The event as one line of JSON."""
    return _encoder.encode(event) + b"\n"
