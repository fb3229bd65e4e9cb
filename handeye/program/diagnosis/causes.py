"""Causes of errors and of operator calls, as facts in SI units. `cause_text` has their sentences."""

from typing import Literal

from handeye.core.plain_text import counted
from handeye.core.record import Record, Vector3
from handeye.program.diagnosis.reach import NamedArm, ReachFailure
from handeye.program.guards import GuardKind

LargeHole = Literal["largest", "second"]  # holes that vision locates a part by


class CauseRecord(Record, frozen=True, kw_only=True, tag_field="cause", tag=True):
    """Base of all causes."""


# -- the arm ----------------------------------------------------------------------------------------


class JointName(Record, frozen=True, kw_only=True):
    """Name and kind of a joint."""

    name: str
    kind: str


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
    """The arm cannot reach a pose, or cannot move there. `goal` is the name of the position, if it has one."""

    goal: str = ""
    reason: ReachFailure
    arm: ArmNames

    def __post_init__(self) -> None:
        """Raise ValueError if the reason names a joint that the arm does not have."""
        if not all(0 <= joint < len(self.arm.joints) for joint in self.reason.named_joints):
            raise ValueError(f"the {self.arm.name} arm has {counted(len(self.arm.joints), 'joint')}")


class JointBehind(CauseRecord, frozen=True, kw_only=True):
    """A joint did not follow its set-point. `swings` is True if it was far off on both sides during the motion.

    `of` is the part at whose place the motion should end, if any.
    """

    joint: str
    swings: bool = False
    of: str = ""


class HandAstray(CauseRecord, frozen=True, kw_only=True):
    """The hand is off its set-point by `distance` (m) at the end of a motion.

    `joint` is the joint with the largest following error relative to its limit. `swings` is True if it was far off
    on both sides during the motion. `of` is the part at whose place the motion should end, if any.
    """

    distance: float
    joint: str = ""
    swings: bool = False
    of: str = ""


class HandStuck(CauseRecord, frozen=True, kw_only=True):
    """The hand moved only by `moved` (m) while it pressed."""

    moved: float


class GuardsUnmet(CauseRecord, frozen=True, kw_only=True):
    """A motion ended, and none of these guards had tripped."""

    guards: tuple[GuardKind, ...]


class TravelOutside(CauseRecord, frozen=True, kw_only=True):
    """The last straight motion, `travel` (m), was too short or too long."""

    travel: float
    minimum: float
    maximum: float


class HeightOutside(CauseRecord, frozen=True, kw_only=True):
    """The hand is too high or too low, by its height (m) above the place at which a difference was saved."""

    name: str
    height: float
    minimum: float
    maximum: float


class HeightUnknown(CauseRecord, frozen=True, kw_only=True):
    """A height check needs a saved difference that does not exist."""

    name: str


# -- the hand ---------------------------------------------------------------------------------------


class GapTooSmall(CauseRecord, frozen=True, kw_only=True):
    """The gap (m) of the closed fingers is below the minimum. `of` is the part at whose place the fingers closed,
    if any.
    """

    gap: float
    minimum: float
    of: str = ""


class GapTooLarge(CauseRecord, frozen=True, kw_only=True):
    """The gap (m) of the closed fingers is above the maximum."""

    gap: float
    maximum: float


class NothingBetween(CauseRecord, frozen=True, kw_only=True):
    """Centring ended before both fingers touched."""

    gap: float


# -- senses -----------------------------------------------------------------------------------------


class SwitchesClosed(CauseRecord, frozen=True, kw_only=True):
    """The switches of `fingers` are closed although the fingers have been opened. The order is that of
    `Sensed.touch`.
    """

    fingers: tuple[bool, bool]


class SwitchesOpen(CauseRecord, frozen=True, kw_only=True):
    """The switches of `fingers` are open although an object holds the driven fingers apart at `gap` (m).

    `fits` is True if the gap fits the object that should be held. If the gap does not fit, or if the thickness of
    the object is unknown, another object may stand between the fingers where no switch feels it.
    """

    fingers: tuple[bool, bool]
    gap: float
    fits: bool = False


class SwitchesCrossed(CauseRecord, frozen=True, kw_only=True):
    """The switches of `fingers` stay closed although the hand has moved by `moved` (m) to the side of that finger."""

    fingers: tuple[bool, bool]
    moved: float


class SwitchesHard(CauseRecord, frozen=True, kw_only=True):
    """The switches of `fingers` are open although the fingers press together with `force` (N)."""

    fingers: tuple[bool, bool]
    force: float


class GapJumped(CauseRecord, frozen=True, kw_only=True):
    """The gap (m) has changed faster than the fingers can move. `held` is True if the fingers touched an object or
    an object kept them apart.
    """

    gap: float
    before: float
    held: bool = False


class GapUnlike(CauseRecord, frozen=True, kw_only=True):
    """The gap (m) does not fit an object of known thickness (m). `held` is the name of the object in the taught
    file.
    """

    gap: float
    thickness: float
    held: str


class GapAstray(CauseRecord, frozen=True, kw_only=True):
    """The gap (m) differs from the goal to which the fingers were driven."""

    gap: float
    goal: float


class GapStill(CauseRecord, frozen=True, kw_only=True):
    """The gap (m) reads the same as before, although the fingers were driven together by `driven` (m)."""

    gap: float
    driven: float


class ForceInAir(CauseRecord, frozen=True, kw_only=True):
    """The hand senses a force (N, table axes, before taring) where it should touch nothing. `load` is the declared
    weight (N).
    """

    force: Vector3
    limit: float
    load: float


class JointSensesApart(CauseRecord, frozen=True, kw_only=True):
    """The two sensors of a joint disagree on its displacement in a motion. If `braked` is True, they disagree while
    the brakes are set, and the brakes may have slipped.
    """

    joint: JointName
    potentiometer: float
    tachometer: float
    braked: bool = False


class RateScatters(CauseRecord, frozen=True, kw_only=True):
    """The rate reading of a joint scatters by `scatter` while the arm holds still. A sound one scatters by at most
    `limit`. Both are median deviations from the median, rad/s or m/s.
    """

    joint: JointName
    scatter: float
    limit: float


class JointAlone(CauseRecord, frozen=True, kw_only=True):
    """A joint takes a torque (N m, or N if prismatic) that no force on the hand explains. `friction` is the torque
    that was measured first; None if the joint does not move at all. `one_way` is True if the joint moved in only
    one direction, so that a weight would have the same effect.
    """

    joint: JointName
    torque: float
    friction: float | None = None
    one_way: bool = False


class DrivesUnlike(CauseRecord, frozen=True, kw_only=True):
    """The drives of these joints give these multiples of the commanded torque, or an external force acts on the
    hand.
    """

    joints: tuple[JointName, ...]
    factors: tuple[float, ...]


class CurrentUnlike(CauseRecord, frozen=True, kw_only=True):
    """The motor of the screwdriver showed the torque `torque` (N m) at a moment when the torque should be `known`
    (N m).
    """

    torque: float
    known: float


class CurrentShort(CauseRecord, frozen=True, kw_only=True):
    """The motor was held fast. For a second it showed the torque `torque` (N m), which is less than the requested
    torque `asked` (N m).
    """

    torque: float
    asked: float


class MotorSlow(CauseRecord, frozen=True, kw_only=True):
    """The motor started in this fraction of its usual time."""

    share: float


class MotorFast(CauseRecord, frozen=True, kw_only=True):
    """The motor ran free, and had not started after this multiple of its usual time."""

    times: float


class ScrewHard(CauseRecord, frozen=True, kw_only=True):
    """While a screw advanced, the motor showed the torque `torque` (N m). A sound screw takes at most `limit`."""

    torque: float
    limit: float


class CurrentSilent(CauseRecord, frozen=True, kw_only=True):
    """The screwdriver ran, but the current of its motor showed at most this torque (N m)."""

    torque: float


class PictureRepeated(CauseRecord, frozen=True, kw_only=True):
    """A picture is equal to an earlier picture, point by point."""

    picture: str
    earlier: str


class PictureBlank(CauseRecord, frozen=True, kw_only=True):
    """All points of a picture have the same intensity."""

    picture: str


class PictureNoisy(CauseRecord, frozen=True, kw_only=True):
    """A picture has more noise (standard deviation, in levels) than `most`, the greatest noise of a sound camera."""

    picture: str
    noise: float
    most: float


# -- vision -----------------------------------------------------------------------------------------


class NoPicture(CauseRecord, frozen=True, kw_only=True):
    """The picture to be examined has not been taken."""

    picture: str


class NoGeneral(CauseRecord, frozen=True, kw_only=True):
    """A part was to be located by its holes, but had not been located roughly before."""


class NoOutline(CauseRecord, frozen=True, kw_only=True):
    """In the picture, no shape of the size of the part stands out from the background."""


class OutsidePicture(CauseRecord, frozen=True, kw_only=True):
    """The part is outside the close-up picture."""


class NoHoles(CauseRecord, frozen=True, kw_only=True):
    """The two largest holes of the part are not among the dark blobs of the picture."""

    blobs: int


class NoGasket(CauseRecord, frozen=True, kw_only=True):
    """The later picture shows no change where the gasket should be."""


class HoleFault(Record, frozen=True, kw_only=True, tag_field="fault", tag=True):
    """Base of the faults at one hole of an inspected part."""

    hole: LargeHole


class BaseHoleUnseen(HoleFault, frozen=True, kw_only=True):
    """The hole of the base was not found in the first picture."""


class GasketHoleUnseen(HoleFault, frozen=True, kw_only=True):
    """The hole of the gasket was not found in the difference of the pictures."""


class GasketHoleOff(HoleFault, frozen=True, kw_only=True):
    """The hole of the gasket is displaced from the hole of the base by `off` (m)."""

    off: float


class GasketWrong(CauseRecord, frozen=True, kw_only=True):
    """A gasket is present but lies wrong. `faults` gives the reasons."""

    faults: tuple[BaseHoleUnseen | GasketHoleUnseen | GasketHoleOff, ...]


class PartAstray(CauseRecord, frozen=True, kw_only=True):
    """A part has moved by `off` (m) relative to its surroundings, and a fraction `unlike` of it looks different."""

    off: float
    unlike: float


# -- the program ------------------------------------------------------------------------------------


class NoSearch(CauseRecord, frozen=True, kw_only=True):
    """No search has been started."""


class PlacesTried(CauseRecord, frozen=True, kw_only=True):
    """The search has tried all its places. `around` is the name of the position at which it started, if that has a
    name.
    """

    places: int
    around: str = ""


class Looping(CauseRecord, frozen=True, kw_only=True):
    """The program loops while no time passes. `place` is the line, such as `12` or `pins.al:12`."""

    place: str


# -- undoing ----------------------------------------------------------------------------------------


class UndoResisted(CauseRecord, frozen=True, kw_only=True):
    """The hand sensed more than the permitted force (N) while a step was reversed."""

    force: float
    limit: float


class HoldOff(CauseRecord, frozen=True, kw_only=True):
    """The gap (m) differs from `kept` (m), the gap at the time of the step."""

    gap: float
    kept: float
    holding: bool


class MetEarly(CauseRecord, frozen=True, kw_only=True):
    """Closing fingers touched at a wider gap (m) than `kept` (m), the gap at the time of the step."""

    fingers: tuple[bool, bool]
    gap: float
    kept: float
    holding: bool


class ScrewFast(CauseRecord, frozen=True, kw_only=True):
    """The screwdriver turned left with at most `torque` (N m), but the screw rose only by `risen` (m)."""

    torque: float
    risen: float


class ScrewLost(CauseRecord, frozen=True, kw_only=True):
    """A screw was lost on the way: the hand descended by `way` (m) and did not sense `force` (N)."""

    way: float
    force: float


class BackingOut(CauseRecord, frozen=True, kw_only=True):
    """The step turned a screw out. This cannot be reversed."""


class UndoUnknown(CauseRecord, frozen=True, kw_only=True):
    """The record that a step made for its reversal is not usable."""


SightCause = NoOutline | OutsidePicture | NoHoles  # causes for which vision does not find a part
SenseCause = (
    SwitchesClosed | SwitchesOpen | SwitchesCrossed | SwitchesHard | GapAstray | GapStill | GapJumped | GapUnlike
    | CurrentUnlike | CurrentShort | MotorSlow | MotorFast | ScrewHard | DrivesUnlike | ForceInAir
    | JointSensesApart | RateScatters | JointAlone | CurrentSilent | PictureRepeated | PictureBlank | PictureNoisy
)  # fmt: skip
UndoCause = UndoResisted | HoldOff | MetEarly | ScrewFast | ScrewLost | BackingOut | UndoUnknown
InspectionCause = NoGasket | GasketWrong
Cause = (
    BeyondArm | JointBehind | HandAstray | HandStuck | GuardsUnmet | TravelOutside | HeightOutside | HeightUnknown
    | GapTooSmall | GapTooLarge | NothingBetween | SenseCause | NoPicture | NoGeneral | SightCause | InspectionCause
    | PartAstray | NoSearch | PlacesTried | Looping | UndoCause
)  # fmt: skip
