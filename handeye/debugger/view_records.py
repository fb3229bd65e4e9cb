"""The views of a paused run as records with values in inches, degrees and ounces."""

from typing import Any

from msgspec import UNSET, UnsetType

from handeye.core.record import Record, Vector3

Six = tuple[float, float, float, float, float, float]


class JointView(Record, frozen=True, kw_only=True):
    """The position of a joint."""

    name: str
    value: float
    unit: str  # `deg` or `in`


class HandView(Record, frozen=True, kw_only=True):
    """The pose of the hand in W. The angles of the pose are O, A, T."""

    at_in: Vector3
    angles_deg: Vector3


class ErrorView(Record, frozen=True, kw_only=True):
    """The error for which the next step tests."""

    number: int
    sentence: str


class SearchView(Record, frozen=True, kw_only=True):
    """A search in progress. Places are numbered from 1."""

    place: int
    places: int
    offset_in: tuple[float, float]


class PartPose(Record, frozen=True, kw_only=True):
    """The pose of an upright part in W."""

    at_in: Vector3
    yaw_deg: float


class PartShown(Record, frozen=True, kw_only=True):
    """The planned and the measured pose of a part, and their difference."""

    planned: PartPose
    measured: PartPose | None
    difference: PartPose | None


class PositionView(Record, frozen=True, kw_only=True):
    """A position in the frame in which it was taught: x, y, z (in), and O, A, T (deg)."""

    at: Six
    of: str | None
    moved: bool  # redefined by `HERE` or by an experiment


class PictureShown(Record, frozen=True, kw_only=True):
    """The last picture, with what vision found in it."""

    name: str
    file: str | None


class TaskView(Record, frozen=True, kw_only=True, omit_defaults=True):
    """The place in the program that one of several tasks has reached."""

    task: str
    step: int  # the step that the task does next
    file: str = ""  # the required file that contains the line of this step; empty for the script itself
    line: int
    text: str
    waits_for: str = ""  # what the task waits for, in words; empty if it waits only for its turn


class RunViews(Record, frozen=True, kw_only=True):
    """The views for which the user asked. The fields of all other views are left out."""

    time_s: float | UnsetType = UNSET
    joints: tuple[JointView, ...] | UnsetType = UNSET
    hand: HandView | UnsetType = UNSET
    force_oz: Vector3 | UnsetType | None = UNSET  # on the world, in W; None if there is no estimate here
    gap_in: float | UnsetType = UNSET
    switches: tuple[bool, bool] | UnsetType = UNSET  # on the +y and -y side of the hand
    error: ErrorView | UnsetType | None = UNSET
    saved_in: dict[str, Vector3] | UnsetType = UNSET
    restored_in: dict[str, Vector3] | UnsetType = UNSET
    search: SearchView | UnsetType | None = UNSET
    parts: dict[str, PartShown] | UnsetType = UNSET
    picture: PictureShown | UnsetType | None = UNSET
    positions: dict[str, PositionView] | UnsetType = UNSET
    tasks: tuple[TaskView, ...] | UnsetType = UNSET
    state: dict[str, Any] | UnsetType = UNSET  # the rest of a system's state, which has no view of its own
