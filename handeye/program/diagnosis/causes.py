"""Causes of errors and of operator calls, as facts in SI units; `cause_text` words them."""

from typing import Literal

from handeye.core.plain_text import counted
from handeye.core.record import Record, Vector3
from handeye.program.diagnosis.reach import NamedArm, ReachFailure
from handeye.program.guards import GuardKind

LargeHole = Literal["largest", "second"]  # holes that vision locates a part by


class CauseRecord(Record, frozen=True, kw_only=True, tag_field="cause", tag=True):
    """Base of the causes."""


# -- the arm ----------------------------------------------------------------------------------------


class JointName(Record, frozen=True, kw_only=True):
    """Name and kind of a joint."""

    name: str
    kind: str


class ArmNames(Record, frozen=True, kw_only=True):
    """Names of an arm and its joints."""

    name: str
    joints: tuple[JointName, ...]

    @classmethod
    def of(cls, arm: NamedArm) -> "ArmNames":
        """The names of an arm."""
        joints = tuple(JointName(name=joint.name, kind=joint.kind) for joint in arm.joints)
        return cls(name=arm.name, joints=joints)


class BeyondArm(CauseRecord, frozen=True, kw_only=True):
    """The arm cannot reach a pose, or cannot move there; `goal` is the position's name, if it has one."""

    goal: str = ""
    reason: ReachFailure
    arm: ArmNames

    def __post_init__(self) -> None:
        """Raises ValueError for a joint that the arm does not have."""
        if not all(0 <= joint < len(self.arm.joints) for joint in self.reason.named_joints):
            raise ValueError(f"the {self.arm.name} arm has {counted(len(self.arm.joints), 'joint')}")


class JointBehind(CauseRecord, frozen=True, kw_only=True):
    """A joint did not keep up with its set-point; `swings`: it was far off on both sides in this motion.

    `of`: the part at whose place the motion should end, if any.
    """

    joint: str
    swings: bool = False
    of: str = ""


class HandAstray(CauseRecord, frozen=True, kw_only=True):
    """The hand is not at its set-point at the end of a motion, by `distance` (m).

    `joint` is furthest behind for its limit; `swings`: it was far off on both sides in this motion; `of`: the part at
    whose place the motion should end, if any.
    """

    distance: float
    joint: str = ""
    swings: bool = False
    of: str = ""


class HandStuck(CauseRecord, frozen=True, kw_only=True):
    """The hand moved only this far (m) while it pressed."""

    moved: float


class GuardsUnmet(CauseRecord, frozen=True, kw_only=True):
    """A motion ended without meeting any of its guards."""

    guards: tuple[GuardKind, ...]


class TravelOutside(CauseRecord, frozen=True, kw_only=True):
    """The last straight motion was too short or too long (m)."""

    travel: float
    minimum: float
    maximum: float


class HeightOutside(CauseRecord, frozen=True, kw_only=True):
    """The hand is too high or too low (m) over where a difference was saved."""

    name: str
    height: float
    minimum: float
    maximum: float


class HeightUnknown(CauseRecord, frozen=True, kw_only=True):
    """The difference to compare a height with was not saved."""

    name: str


# -- the hand ---------------------------------------------------------------------------------------


class GapTooSmall(CauseRecord, frozen=True, kw_only=True):
    """The gap (m) of the closed fingers is below the minimum; `of`: the part at whose place they closed, if any."""

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
    """Finger switches are closed although the fingers have been opened; `fingers` are those, as `Sensed.touch`."""

    fingers: tuple[bool, bool]


class SwitchesOpen(CauseRecord, frozen=True, kw_only=True):
    """Switches of `fingers` are open although something holds the driven fingers apart at `gap` (m)."""

    fingers: tuple[bool, bool]
    gap: float


class SwitchesCrossed(CauseRecord, frozen=True, kw_only=True):
    """The switches of `fingers` stay closed although the hand has gone to that side by `moved` (m)."""

    fingers: tuple[bool, bool]
    moved: float


class SwitchesHard(CauseRecord, frozen=True, kw_only=True):
    """Switches of `fingers` are open although the fingers are driven together with `force` (N)."""

    fingers: tuple[bool, bool]
    force: float


class GapJumped(CauseRecord, frozen=True, kw_only=True):
    """The gap (m) has changed faster than the fingers can move; `held`: they touched something, or something kept them
    apart."""

    gap: float
    before: float
    held: bool = False


class GapUnlike(CauseRecord, frozen=True, kw_only=True):
    """The gap (m) is not that of an object of known thickness (m), by its name in the taught file."""

    gap: float
    thickness: float
    held: str


class GapAstray(CauseRecord, frozen=True, kw_only=True):
    """The gap (m) is not what the fingers were driven to."""

    gap: float
    goal: float


class GapStill(CauseRecord, frozen=True, kw_only=True):
    """The gap (m) reads the same after the fingers were driven together by `driven` (m)."""

    gap: float
    driven: float


class ForceInAir(CauseRecord, frozen=True, kw_only=True):
    """The hand feels a force (N, table axes, no tare) where it should touch nothing; `load` is the declared weight."""

    force: Vector3
    limit: float
    load: float


class JointSensesApart(CauseRecord, frozen=True, kw_only=True):
    """A joint's two sensors disagree on how far it went in a motion, or (`braked`) under brakes, which may slip."""

    joint: JointName
    potentiometer: float
    tachometer: float
    braked: bool = False


class JointAlone(CauseRecord, frozen=True, kw_only=True):
    """A joint takes a torque (N m, N if prismatic) that no force at the hand explains; `friction` is what it took at
    first, None where it does not get on at all; `one_way`: it moved one way only, and a weight would feel the same."""

    joint: JointName
    torque: float
    friction: float | None = None
    one_way: bool = False


class DrivesUnlike(CauseRecord, frozen=True, kw_only=True):
    """The drives of these joints give these multiples of the commanded torque, or something bears on the hand."""

    joints: tuple[JointName, ...]
    factors: tuple[float, ...]


class CurrentUnlike(CauseRecord, frozen=True, kw_only=True):
    """The motor showed this torque (N m), where a known one was."""

    torque: float
    known: float


class CurrentShort(CauseRecord, frozen=True, kw_only=True):
    """The motor was held fast and showed this torque (N m) for a second, less than that asked for."""

    torque: float
    asked: float


class MotorSlow(CauseRecord, frozen=True, kw_only=True):
    """The motor had started after this share of the time that it takes."""

    share: float


class CurrentSilent(CauseRecord, frozen=True, kw_only=True):
    """The screwdriver ran, and its motor current showed at most this torque (N m)."""

    torque: float


class PictureRepeated(CauseRecord, frozen=True, kw_only=True):
    """A picture equals an earlier one, pixel by pixel."""

    picture: str
    earlier: str


class PictureBlank(CauseRecord, frozen=True, kw_only=True):
    """A picture has one intensity all over."""

    picture: str


class PictureNoisy(CauseRecord, frozen=True, kw_only=True):
    """A picture has more noise (sigma, levels) than a sound camera's, which has `most`."""

    picture: str
    noise: float
    most: float


# -- vision -----------------------------------------------------------------------------------------


class NoPicture(CauseRecord, frozen=True, kw_only=True):
    """The picture to be examined was not taken."""

    picture: str


class NoGeneral(CauseRecord, frozen=True, kw_only=True):
    """The part was not located roughly before it was to be located by its holes."""


class NoOutline(CauseRecord, frozen=True, kw_only=True):
    """Nothing of the part's size stands out in the picture."""


class OutsidePicture(CauseRecord, frozen=True, kw_only=True):
    """The part is outside the close picture."""


class NoHoles(CauseRecord, frozen=True, kw_only=True):
    """The part's two largest holes are not among the dark blobs."""

    blobs: int


class NoGasket(CauseRecord, frozen=True, kw_only=True):
    """The later picture shows nothing new where the gasket should be."""


class HoleFault(Record, frozen=True, kw_only=True, tag_field="fault", tag=True):
    """Base class of the faults at one hole of an inspected part."""

    hole: LargeHole


class BaseHoleUnseen(HoleFault, frozen=True, kw_only=True):
    """The base's hole is not found in the picture before."""


class GasketHoleUnseen(HoleFault, frozen=True, kw_only=True):
    """The gasket's hole is not found in the difference picture."""


class GasketHoleOff(HoleFault, frozen=True, kw_only=True):
    """The gasket's hole is off the base's by `off` (m)."""

    off: float


class GasketWrong(CauseRecord, frozen=True, kw_only=True):
    """A gasket is present but lies wrong."""

    faults: tuple[BaseHoleUnseen | GasketHoleUnseen | GasketHoleOff, ...]


class PartAstray(CauseRecord, frozen=True, kw_only=True):
    """A part has moved by `off` (m) against its surroundings; a fraction `unlike` of it looks different."""

    off: float
    unlike: float


# -- the program ------------------------------------------------------------------------------------


class NoSearch(CauseRecord, frozen=True, kw_only=True):
    """No search was set up."""


class PlacesTried(CauseRecord, frozen=True, kw_only=True):
    """The search has tried all its places; `around` is the position it started from, if it has a name."""

    places: int
    around: str = ""


class Looping(CauseRecord, frozen=True, kw_only=True):
    """The program loops without time passing; `place` is the line, as `12` or `pins.al:12`."""

    place: str


# -- undoing ----------------------------------------------------------------------------------------


class UndoResisted(CauseRecord, frozen=True, kw_only=True):
    """The hand felt more than the allowed force (N) while a step was reversed."""

    force: float
    limit: float


class HoldOff(CauseRecord, frozen=True, kw_only=True):
    """The gap (m) differs from `kept`, the gap when the step was executed."""

    gap: float
    kept: float
    holding: bool


class MetEarly(CauseRecord, frozen=True, kw_only=True):
    """Closing fingers touched at a wider gap (m) than `kept`, the gap when the step was executed."""

    fingers: tuple[bool, bool]
    gap: float
    kept: float
    holding: bool


class ScrewFast(CauseRecord, frozen=True, kw_only=True):
    """The driver turned left, at most at this torque (N m), and the screw rose only `risen` (m)."""

    torque: float
    risen: float


class ScrewLost(CauseRecord, frozen=True, kw_only=True):
    """A screw was not carried along: going down `way` (m), the hand did not meet `force` (N)."""

    way: float
    force: float


class BackingOut(CauseRecord, frozen=True, kw_only=True):
    """The step turned a screw out, which is not reversed."""


class UndoUnknown(CauseRecord, frozen=True, kw_only=True):
    """The record that the step left for its reversal cannot be used."""


SightCause = NoOutline | OutsidePicture | NoHoles  # causes for which vision does not find a part
SenseCause = (
    SwitchesClosed | SwitchesOpen | SwitchesCrossed | SwitchesHard | GapAstray | GapStill | GapJumped | GapUnlike
    | CurrentUnlike | CurrentShort | MotorSlow | DrivesUnlike | ForceInAir | JointSensesApart | JointAlone
    | CurrentSilent | PictureRepeated | PictureBlank | PictureNoisy
)  # fmt: skip
UndoCause = UndoResisted | HoldOff | MetEarly | ScrewFast | ScrewLost | BackingOut | UndoUnknown
InspectionCause = NoGasket | GasketWrong
Cause = (
    BeyondArm | JointBehind | HandAstray | HandStuck | GuardsUnmet | TravelOutside | HeightOutside | HeightUnknown
    | GapTooSmall | GapTooLarge | NothingBetween | SenseCause | NoPicture | NoGeneral | SightCause | InspectionCause
    | PartAstray | NoSearch | PlacesTried | Looping | UndoCause
)  # fmt: skip
