"""Causes of errors and of calls of the operator: facts, which `handeye.program.cause_text` puts into words.

SI units.
"""

from typing import Literal

from handeye.core.record import Record, Vector3
from handeye.program.guards import GuardKind
from handeye.program.reason_text import NamedArm
from handeye.program.reasons import Reason

LargeHole = Literal["largest", "second"]
"""The holes by which vision locates a part."""


class CauseRecord(Record, frozen=True, kw_only=True, tag_field="cause", tag=True):
    """Base of the causes."""


# -- the arm ----------------------------------------------------------------------------------------


class JointName(Record, frozen=True, kw_only=True):
    """A joint, as people are told of it."""

    name: str
    kind: str


class ArmNames(Record, frozen=True, kw_only=True):
    """An arm, as people are told of it."""

    name: str
    joints: tuple[JointName, ...]

    @classmethod
    def of(cls, arm: NamedArm) -> "ArmNames":
        """The names of an arm."""
        joints = tuple(JointName(name=joint.name, kind=joint.kind) for joint in arm.joints)
        return cls(name=arm.name, joints=joints)


class BeyondArm(CauseRecord, frozen=True, kw_only=True):
    """The arm cannot be there, or not go there."""

    goal: str = ""
    """The position that it cannot go to, if it is one with a name."""
    reason: Reason
    arm: ArmNames

    def __post_init__(self) -> None:
        """Raises ValueError if it tells of a joint that the arm does not have."""
        if not all(0 <= joint < len(self.arm.joints) for joint in self.reason.named_joints):
            raise ValueError(f"the {self.arm.name} arm has {len(self.arm.joints)} joints")


class JointBehind(CauseRecord, frozen=True, kw_only=True):
    """A joint did not keep up with its set-point."""

    joint: str


class HandAstray(CauseRecord, frozen=True, kw_only=True):
    """The hand is not at its set-point at the end of a motion."""

    distance: float


class HandStuck(CauseRecord, frozen=True, kw_only=True):
    """The hand moved only so far while it pressed."""

    moved: float


class GuardsUnmet(CauseRecord, frozen=True, kw_only=True):
    """A motion ended without meeting any of its guards."""

    guards: tuple[GuardKind, ...]


class TravelOutside(CauseRecord, frozen=True, kw_only=True):
    """The last straight motion did not go as far as it should, or farther."""

    travel: float
    minimum: float
    maximum: float


class HeightOutside(CauseRecord, frozen=True, kw_only=True):
    """The hand stands too high over where a difference was saved, or too low."""

    name: str
    height: float
    minimum: float
    maximum: float


class HeightUnknown(CauseRecord, frozen=True, kw_only=True):
    """The difference that a height should be compared with was not saved."""

    name: str


# -- the hand ---------------------------------------------------------------------------------------


class GapTooSmall(CauseRecord, frozen=True, kw_only=True):
    """The gap of the closed fingers is below the minimum."""

    gap: float
    minimum: float


class GapTooLarge(CauseRecord, frozen=True, kw_only=True):
    """The gap of the closed fingers is above the maximum."""

    gap: float
    maximum: float


class NothingBetween(CauseRecord, frozen=True, kw_only=True):
    """Centring ended before both fingers touched."""

    gap: float


# -- senses -----------------------------------------------------------------------------------------


class SwitchesClosed(CauseRecord, frozen=True, kw_only=True):
    """Finger switches are closed although the fingers have gone apart."""

    fingers: tuple[bool, bool]
    """As `Sensed.touch`: those that are closed."""


class SwitchesOpen(CauseRecord, frozen=True, kw_only=True):
    """Finger switches are open although something holds the fingers apart that are driven shut."""

    fingers: tuple[bool, bool]
    """Those that are open."""
    gap: float


class GapAstray(CauseRecord, frozen=True, kw_only=True):
    """The gap is not what the fingers were driven to."""

    gap: float
    goal: float


class GapStill(CauseRecord, frozen=True, kw_only=True):
    """The gap reads the same while the fingers are driven together."""

    gap: float
    driven: float
    """By how much, m."""


class ForceInAir(CauseRecord, frozen=True, kw_only=True):
    """The force on the hand, before any tare, where it should touch nothing."""

    force: Vector3
    """N, table coordinates."""
    limit: float
    load: float
    """Weight that was declared, N."""


class JointSensesApart(CauseRecord, frozen=True, kw_only=True):
    """Ways of a joint since the motion began, by its two sensors."""

    joint: JointName
    potentiometer: float
    tachometer: float
    braked: bool = False
    """Since the brakes were set: then it may be a brake that slips."""


class CurrentSilent(CauseRecord, frozen=True, kw_only=True):
    """The greatest torque that the motor's current showed while the screwdriver ran."""

    torque: float


class PictureRepeated(CauseRecord, frozen=True, kw_only=True):
    """A picture is the same as an earlier one, point by point."""

    picture: str
    earlier: str


class PictureBlank(CauseRecord, frozen=True, kw_only=True):
    """A picture is of one intensity all over."""

    picture: str


# -- vision -----------------------------------------------------------------------------------------


class NoPicture(CauseRecord, frozen=True, kw_only=True):
    """The picture to be looked at was not taken."""

    picture: str


class NoGeneral(CauseRecord, frozen=True, kw_only=True):
    """The part was not found roughly before it was to be located by its holes."""


class NoOutline(CauseRecord, frozen=True, kw_only=True):
    """Nothing of the part's size stands out in the picture."""


class OutsidePicture(CauseRecord, frozen=True, kw_only=True):
    """The part is not in the field of the close picture."""


class NoHoles(CauseRecord, frozen=True, kw_only=True):
    """The two largest holes of the part are not among the dark blobs that were found."""

    blobs: int


class NoGasket(CauseRecord, frozen=True, kw_only=True):
    """The picture after shows nothing new where the gasket should be."""


class HoleFault(Record, frozen=True, kw_only=True, tag_field="fault", tag=True):
    """Base of the faults at one hole of an inspected part."""

    hole: LargeHole


class BaseHoleUnseen(HoleFault, frozen=True, kw_only=True):
    """The base's hole is not found in the picture before."""


class GasketHoleUnseen(HoleFault, frozen=True, kw_only=True):
    """The gasket's hole is not found in what the picture after has more."""


class GasketHoleOff(HoleFault, frozen=True, kw_only=True):
    """The gasket's hole is not where the base's is."""

    off: float


class GasketWrong(CauseRecord, frozen=True, kw_only=True):
    """There is a gasket, and it does not lie as it should."""

    faults: tuple[BaseHoleUnseen | GasketHoleUnseen | GasketHoleOff, ...]


class PartAstray(CauseRecord, frozen=True, kw_only=True):
    """The part does not stand in the later picture as in the earlier one."""

    off: float
    """By how much it has moved against what is around it, m."""
    unlike: float
    """Share of it, from 0 to 1, that looks otherwise."""


# -- the program ------------------------------------------------------------------------------------


class NoSearch(CauseRecord, frozen=True, kw_only=True):
    """No search was set up."""


class PlacesTried(CauseRecord, frozen=True, kw_only=True):
    """The search has been at all its places."""

    places: int
    around: str = ""
    """The position that it went out from, if it has moved to one."""


class Looping(CauseRecord, frozen=True, kw_only=True):
    """The program runs in a circle in which no time passes."""

    place: str
    """Its line, as people are told: `12`, or `pins.al:12`."""


# -- undoing ----------------------------------------------------------------------------------------


class UndoResisted(CauseRecord, frozen=True, kw_only=True):
    """While the arm undid a step, the hand felt more force (N) than it may."""

    force: float
    limit: float


class HoldOff(CauseRecord, frozen=True, kw_only=True):
    """The fingers stand at another gap (m) than when the step was executed."""

    gap: float
    kept: float
    """As it was then."""
    holding: bool
    """They held something then."""


class MetEarly(CauseRecord, frozen=True, kw_only=True):
    """Fingers that closed met something at a wider gap (m) than when the step was executed."""

    fingers: tuple[bool, bool]
    """Those that touch it, as `Sensed.touch`."""
    gap: float
    kept: float
    """As it was then."""
    holding: bool
    """They held something then."""


class ScrewFast(CauseRecord, frozen=True, kw_only=True):
    """The driver turned left on a screw, and it did not come out."""

    torque: float
    """The most that the driver has shown, N m."""
    risen: float
    """m"""


class ScrewLost(CauseRecord, frozen=True, kw_only=True):
    """A screw that was turned out has not come along to where it was taken: nothing bears the hand there."""

    way: float
    """That the hand goes down, m."""
    force: float
    """That it does not meet, N."""


class BackingOut(CauseRecord, frozen=True, kw_only=True):
    """In the step the driver turned left; that is not undone."""


class UndoUnknown(CauseRecord, frozen=True, kw_only=True):
    """What the step has left cannot be used."""


class Recorded(CauseRecord, frozen=True, kw_only=True):
    """Words that an older handeye recorded where there is a fact today."""

    words: str


SightCause = NoOutline | OutsidePicture | NoHoles
"""Causes for which vision does not find a part."""
SenseCause = (
    SwitchesClosed | SwitchesOpen | GapAstray | GapStill | ForceInAir | JointSensesApart | CurrentSilent
    | PictureRepeated | PictureBlank
)  # fmt: skip
"""Causes for which a sense is not believed."""
UndoCause = UndoResisted | HoldOff | MetEarly | ScrewFast | ScrewLost | BackingOut | UndoUnknown
"""Causes for which the arm does not go on undoing what it did."""
InspectionCause = NoGasket | GasketWrong
"""Causes for which a part does not pass its inspection."""
Cause = (
    BeyondArm | JointBehind | HandAstray | HandStuck | GuardsUnmet | TravelOutside | HeightOutside | HeightUnknown
    | GapTooSmall | GapTooLarge | NothingBetween | SenseCause | NoPicture | NoGeneral | SightCause | InspectionCause
    | PartAstray | NoSearch | PlacesTried | Looping | UndoCause | Recorded
)  # fmt: skip
"""All there are."""
