"""Causes of errors and of operator calls, as facts in SI units. `cause_text` writes the sentences for these causes."""

from typing import Literal

from handeye.core.plain_text import counted
from handeye.core.record import Record
from handeye.program.diagnosis.cause_record import CauseRecord, JointName
from handeye.program.diagnosis.reach import NamedArm, ReachFailure
from handeye.program.diagnosis.sense_causes import SenseCause
from handeye.program.guards import GuardKind

LargeHole = Literal["largest", "second"]  # holes by which vision locates a part


# -- the arm ----------------------------------------------------------------------------------------


class ArmNames(Record, frozen=True, kw_only=True):
    """Names of an arm and of its joints, for sentences."""

    name: str
    joints: tuple[JointName, ...]

    @classmethod
    def of(cls, arm: NamedArm) -> "ArmNames":
        """Return the names of an arm."""
        joints = tuple(JointName(name=joint.name, kind=joint.kind) for joint in arm.joints)
        return cls(name=arm.name, joints=joints)


class BeyondArm(CauseRecord, frozen=True, kw_only=True):
    """The arm cannot reach a pose, or it could reach the pose but cannot carry out the motion to it. `goal` is the
    name of the position, if the position has a name.
    """

    goal: str = ""
    reason: ReachFailure
    arm: ArmNames

    def __post_init__(self) -> None:
        """Raise ValueError if the reason names a joint that the arm does not have."""
        if not all(0 <= joint < len(self.arm.joints) for joint in self.reason.named_joints):
            raise ValueError(f"the {self.arm.name} arm has {counted(len(self.arm.joints), 'joint')}")


class JointBehind(CauseRecord, frozen=True, kw_only=True):
    """A joint did not follow its set-point. `swings` is True if, during the motion, the joint swung far past its
    set-point to both sides. `of` is the part at whose place the motion should end, if there is one.
    """

    joint: str
    swings: bool = False
    of: str = ""


class HandAstray(CauseRecord, frozen=True, kw_only=True):
    """The hand is off its set-point by `distance` (m) at the end of a motion.

    `joint` is the joint with the largest following error relative to its limit. `swings` is True if, during the
    motion, this joint swung far past its set-point to both sides. `of` is the part at whose place the motion should
    end, if there is one.
    """

    distance: float
    joint: str = ""
    swings: bool = False
    of: str = ""


class HandPushed(HandAstray, frozen=True, kw_only=True):
    """The hand is off its set-point at the end of a motion in which the screwdriver turned. If the screw advances or
    retreats in its thread faster than the hand follows, the screw pushes or pulls the screwdriver.
    """


class HandStuck(CauseRecord, frozen=True, kw_only=True):
    """The hand was pressing, and stopped after it had moved by only `moved` (m)."""

    moved: float


class GuardsUnmet(CauseRecord, frozen=True, kw_only=True):
    """A motion ended, although none of its `guards` had tripped."""

    guards: tuple[GuardKind, ...]


class TravelOutside(CauseRecord, frozen=True, kw_only=True):
    """The last straight motion was too short or too long. `travel` (m) is the length of this motion."""

    travel: float
    minimum: float
    maximum: float


class HeightOutside(CauseRecord, frozen=True, kw_only=True):
    """The last motion ended too high or too low. `height` (m) is how much higher the hand is than it was at the `SAVE`
    of the difference `name`.
    """

    name: str
    height: float
    minimum: float
    maximum: float


class HeightUnknown(CauseRecord, frozen=True, kw_only=True):
    """A height check needs a saved difference that does not exist."""

    name: str


# -- the hand ---------------------------------------------------------------------------------------


class GapTooSmall(CauseRecord, frozen=True, kw_only=True):
    """The gap (m) of the closed fingers is below the minimum. If the fingers closed at the place of a part, `of` is
    that part.
    """

    gap: float
    minimum: float
    of: str = ""


class GapTooLarge(CauseRecord, frozen=True, kw_only=True):
    """The gap (m) of the closed fingers is above the maximum."""

    gap: float
    maximum: float


class NothingBetween(CauseRecord, frozen=True, kw_only=True):
    """Centring ended before both fingers touched an object."""

    gap: float


# -- vision -----------------------------------------------------------------------------------------


class NoPicture(CauseRecord, frozen=True, kw_only=True):
    """The picture to be examined has not been taken."""

    picture: str


class NoGeneral(CauseRecord, frozen=True, kw_only=True):
    """The program wanted to locate a part by its holes before a `GENERAL` had found its rough place."""


class NoOutline(CauseRecord, frozen=True, kw_only=True):
    """In the picture, no shape of the size of the part stands out from the background."""


class OutsidePicture(CauseRecord, frozen=True, kw_only=True):
    """The part is outside the close-up picture."""


class FaintPicture(CauseRecord, frozen=True, kw_only=True):
    """The contrast of the earlier picture is too low to show whether the part has changed. Grey levels are the unit of
    the contrast and of the least permissible contrast.
    """

    contrast: float
    least: float


class DarkPart(CauseRecord, frozen=True, kw_only=True):
    """The part is too dark in the earlier picture, so the pictures do not show whether the part has changed. Both
    numbers are in grey levels.
    """

    brightness: float  # the median near the screw holes
    least: float


class NoHoles(CauseRecord, frozen=True, kw_only=True):
    """The two largest holes of the part are not among the dark blobs of the picture."""

    blobs: int


class CallersVision(CauseRecord, frozen=True, kw_only=True):
    """A vision function of the calling program did not find the part, or rejected it."""

    by: str  # name of the function


class NoGasket(CauseRecord, frozen=True, kw_only=True):
    """The later picture shows no change where the gasket should be."""


class HoleFault(Record, frozen=True, kw_only=True, tag_field="fault", tag=True):
    """Base class of the faults at one hole of an inspected part."""

    hole: LargeHole


class BaseHoleUnseen(HoleFault, frozen=True, kw_only=True):
    """The hole of the base was not found in the first picture."""


class GasketHoleUnseen(HoleFault, frozen=True, kw_only=True):
    """The hole of the gasket was not found in the difference of the pictures."""


class GasketHoleOff(HoleFault, frozen=True, kw_only=True):
    """The hole of the gasket is displaced from the hole of the base by `off` (m)."""

    off: float


class GasketTorn(Record, frozen=True, kw_only=True, tag_field="fault", tag=True):
    """The gasket leaves a patch of the base's face bare. The patch has the area `bare` (m2)."""

    bare: float


GasketFault = BaseHoleUnseen | GasketHoleUnseen | GasketHoleOff | GasketTorn


class GasketWrong(CauseRecord, frozen=True, kw_only=True):
    """A gasket is present, but is out of place or torn. `faults` gives the reasons."""

    faults: tuple[GasketFault, ...]


class PartAstray(CauseRecord, frozen=True, kw_only=True):
    """A part has moved by `off` (m) relative to its surroundings. `unlike` is the fraction of the part's area that
    looks different.
    """

    off: float
    unlike: float


# -- the program ------------------------------------------------------------------------------------


class NoSearch(CauseRecord, frozen=True, kw_only=True):
    """No search has been started."""


class PlacesTried(CauseRecord, frozen=True, kw_only=True):
    """The search has tried all its places. `around` is the name of the position at which the search started, if this
    position has a name.
    """

    places: int
    around: str = ""


class Looping(CauseRecord, frozen=True, kw_only=True):
    """The program loops while no time passes. `place` is a line of the loop, such as `12` or `pins.al:12`."""

    place: str


# -- undoing ----------------------------------------------------------------------------------------


class UndoResisted(CauseRecord, frozen=True, kw_only=True):
    """The hand sensed more than the permitted force (N) while a step was reversed."""

    force: float
    limit: float


class HoldOff(CauseRecord, frozen=True, kw_only=True):
    """During the reversal of a step, the gap (m) differs from `kept` (m). This was the gap when the step was
    executed.
    """

    gap: float
    kept: float
    holding: bool


class MetEarly(CauseRecord, frozen=True, kw_only=True):
    """While the fingers closed to reverse a step, one or both of them touched an object too early, at the gap `gap`
    (m). `kept` (m) is the gap when the step was executed, and is smaller.
    """

    fingers: tuple[bool, bool]
    gap: float
    kept: float
    holding: bool


class ScrewFast(CauseRecord, frozen=True, kw_only=True):
    """The screwdriver turned left with at most `torque` (N m), but the screw rose by only `risen` (m)."""

    torque: float
    risen: float


class ScrewLost(CauseRecord, frozen=True, kw_only=True):
    """A screw was lost on the way: the hand descended by `way` (m) without sensing the force `force` (N)."""

    way: float
    force: float


class BackingOut(CauseRecord, frozen=True, kw_only=True):
    """The step turned a screw out. This cannot be reversed."""


class UndoUnknown(CauseRecord, frozen=True, kw_only=True):
    """The record that a step made for its reversal is not usable."""


SightCause = (
    NoOutline | OutsidePicture | FaintPicture | DarkPart | NoHoles | CallersVision
)  # causes for which vision does not find a part
UndoCause = UndoResisted | HoldOff | MetEarly | ScrewFast | ScrewLost | BackingOut | UndoUnknown
InspectionCause = NoGasket | GasketWrong | CallersVision
Cause = (
    BeyondArm | JointBehind | HandAstray | HandPushed | HandStuck | GuardsUnmet | TravelOutside | HeightOutside
    | HeightUnknown | GapTooSmall | GapTooLarge | NothingBetween | SenseCause | NoPicture | NoGeneral | SightCause
    | InspectionCause | PartAstray | NoSearch | PlacesTried | Looping | UndoCause
)  # fmt: skip
