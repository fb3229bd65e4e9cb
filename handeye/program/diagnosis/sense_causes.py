"""Reasons to doubt a sensor, a motor or a drive, as facts in SI units. `sense_text` writes the sentences for these
reasons.
"""

from handeye.core.record import Vector3
from handeye.program.diagnosis.cause_record import CauseRecord, JointName


class SwitchesClosed(CauseRecord, frozen=True, kw_only=True):
    """The switches of `fingers` are closed although the fingers have been opened. The fingers are in the order of
    `Sensed.touch`.
    """

    fingers: tuple[bool, bool]


class SwitchesOpen(CauseRecord, frozen=True, kw_only=True):
    """The switches of `fingers` are open although an object holds the driven fingers apart at `gap` (m).

    `fits` is True if the gap fits the object that should be held. If the gap does not fit, or if the thickness of
    the object is unknown, the fingers may have met a wrong object at a point where no switch feels it.
    """

    fingers: tuple[bool, bool]
    gap: float
    fits: bool = False


class SwitchesCrossed(CauseRecord, frozen=True, kw_only=True):
    """The switch of one of the `fingers` stays closed, although the hand has moved this finger away from the part, by
    `moved` (m).
    """

    fingers: tuple[bool, bool]
    moved: float


class SwitchesHard(CauseRecord, frozen=True, kw_only=True):
    """The switches of `fingers` are open although the fingers press together with `force` (N)."""

    fingers: tuple[bool, bool]
    force: float


class GapJumped(CauseRecord, frozen=True, kw_only=True):
    """The gap (m) has changed faster than the fingers can move. `held` is True if the fingers touched an object, or if
    an object kept them apart.
    """

    gap: float
    before: float
    held: bool = False


class GapUnlike(CauseRecord, frozen=True, kw_only=True):
    """The gap (m) does not fit an object of known thickness (m). `held` is the object's name, as given in the taught
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
    """The hand senses a force (N, table axes, before taring) where it should touch nothing. `load` is the weight (N)
    that the program has declared for the object in the hand.
    """

    force: Vector3
    limit: float
    load: float


class JointSensesApart(CauseRecord, frozen=True, kw_only=True):
    """The two sensors of a joint disagree on its displacement in a motion. If `braked` is True, the sensors disagree
    while the brakes are set, and the brakes may have slipped.
    """

    joint: JointName
    potentiometer: float
    tachometer: float
    braked: bool = False


class RateScatters(CauseRecord, frozen=True, kw_only=True):
    """The rate reading of a joint scatters by `scatter` while the arm holds still. The readings of an intact
    tachometer scatter by at most `limit`. `scatter` and `limit` are median deviations from the median, in rad/s or
    m/s.
    """

    joint: JointName
    scatter: float
    limit: float


class JointAlone(CauseRecord, frozen=True, kw_only=True):
    """A joint needs a torque (N m, or N if prismatic) that no force on the hand explains. `friction` is the torque
    that was measured before the program began; `friction` is None if the joint does not move at all. `one_way` is True
    if the joint moved in only one direction. In this case, the cause may also be that the arm has tilted: in one
    direction, an additional weight on the joint has the same effect as friction.
    """

    joint: JointName
    torque: float
    friction: float | None = None
    one_way: bool = False


class DrivesUnlike(CauseRecord, frozen=True, kw_only=True):
    """Either the drives of `joints` do not give the commanded torques, or an external force acts on the arm. In the
    first case, each drive multiplies the commanded torque by one of `factors`.
    """

    joints: tuple[JointName, ...]
    factors: tuple[float, ...]


class CurrentUnlike(CauseRecord, frozen=True, kw_only=True):
    """The motor of the screwdriver showed the torque `torque` (N m) in a situation in which it should show the torque
    `known` (N m).
    """

    torque: float
    known: float


class CurrentShort(CauseRecord, frozen=True, kw_only=True):
    """The motor was held fast. For a second, the motor showed the torque `torque` (N m), which is less than the
    requested torque `asked` (N m).
    """

    torque: float
    asked: float


class MotorSlow(CauseRecord, frozen=True, kw_only=True):
    """The motor turns too slowly. Its final speed must be too low, because it reached that speed in only a fraction,
    `share`, of the usual time.
    """

    share: float


class MotorFast(CauseRecord, frozen=True, kw_only=True):
    """The motor turns too fast. Nothing loads the motor, but its speed increased for more than `times` times the usual
    time.
    """

    times: float


class ScrewHard(CauseRecord, frozen=True, kw_only=True):
    """While a screw advanced, the motor showed the torque `torque` (N m). A sound screw needs at most the torque
    `limit` (N m).
    """

    torque: float
    limit: float


class CurrentSilent(CauseRecord, frozen=True, kw_only=True):
    """The screwdriver ran, but the current of its motor never showed more than `torque` (N m)."""

    torque: float


class PictureRepeated(CauseRecord, frozen=True, kw_only=True):
    """A picture is equal to an earlier picture, point by point."""

    picture: str
    earlier: str


class PictureBlank(CauseRecord, frozen=True, kw_only=True):
    """All points of a picture have the same intensity."""

    picture: str


class PictureNoisy(CauseRecord, frozen=True, kw_only=True):
    """A picture has more noise than a sound camera gives. `noise` is the noise of the picture, and `most` is the
    greatest noise of a sound camera; both are standard deviations, in levels.
    """

    picture: str
    noise: float
    most: float


SenseCause = (
    SwitchesClosed | SwitchesOpen | SwitchesCrossed | SwitchesHard | GapAstray | GapStill | GapJumped | GapUnlike
    | CurrentUnlike | CurrentShort | MotorSlow | MotorFast | ScrewHard | DrivesUnlike | ForceInAir
    | JointSensesApart | RateScatters | JointAlone | CurrentSilent | PictureRepeated | PictureBlank | PictureNoisy
)  # fmt: skip
