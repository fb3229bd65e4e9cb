"""The model of an arm as a value: a chain of joints with limits, masses and drives, and a two-finger hand."""

from collections.abc import Mapping
from dataclasses import dataclass, field, fields, is_dataclass
from functools import lru_cache
from typing import Final, Literal

import numpy as np
from numpy.typing import NDArray

from handeye.core.brief import Brief
from handeye.core.obb import Box
from handeye.core.plain_text import counted
from handeye.core.pose import Array, Pose, inverse


@dataclass(frozen=True, slots=True, kw_only=True)
class GraspModel:
    """Parameters of opening and closing the fingers."""

    speed: float  # m/s of the opening, free
    centring: float  # m/s of the opening while centring
    settle: int  # servo periods pressed before the gap is read; half as many after centring
    give: float = 0.004  # m that the set-point leads fingers that press with all the force allowed; chosen

    def lag(self, force: float, grip: float) -> float:
        """Return the distance (m) by which the gap lags behind its set-point when the fingers press with `force`.
        `force` is at most `grip`; both are in N.
        """
        return self.give * force / grip


@dataclass(frozen=True, slots=True, kw_only=True)
class HandModel:
    """A hand: two fingers that open and close together, a palm and a wrist. Lengths are in m."""

    length: float  # wrist centre to finger tips
    mass: float  # of both fingers, in kg; not included in the last link's `mass`
    centre: float  # wrist centre to the fingers' mass centre, along the approach direction
    gap_max: float
    gap_speed: float  # m/s, at most
    grip: float  # N, of each finger at most
    finger_width: float
    finger_thickness: float
    finger_length: float  # from tip to palm
    palm: Box
    wrist: Box
    grasp: GraspModel
    lamp: tuple[float, float, float] | None = None  # in T; shows the camera where the hand is

    def boxes(self, gap: float) -> tuple[Box, ...]:
        """Return the boxes of both fingers, of the palm and of the wrist. The fingers have the opening `gap` (m)."""
        x, inner, outer = self.finger_width / 2, gap / 2, gap / 2 + self.finger_thickness
        return (
            (-x, inner, -self.finger_length, x, outer, 0.0),
            (-x, -outer, -self.finger_length, x, -inner, 0.0),
            self.palm,
            self.wrist,
        )


Structure = Literal["spherical wrist", "gantry", "cartesian"]
"""Kinematic structure of an arm. `handeye.arm.ik` has a solver for each structure."""


@dataclass(frozen=True, slots=True, kw_only=True)
class Joint:
    """A joint and the link that it moves, in standard Denavit-Hartenberg form with a = 0.

    Frame i is reached from DH frame i-1 by a turn of `theta` about z, a shift of `d` along z and a turn of `alpha`
    about x. A revolute joint varies theta, a prismatic joint varies d. Positions, rates and limits are in rad or m.
    """

    name: str
    kind: Literal["revolute", "prismatic"]
    d: float  # m; 0 if prismatic
    alpha: float  # rad
    theta: float = 0.0  # rad; 0 if revolute
    lower: float
    upper: float
    speed: float  # rad/s or m/s, at most
    acceleration: float  # of planned motions, in rad/s2 or m/s2
    effort: float  # of the drive, in N m or N
    mass: float  # of the link, in kg
    centre: tuple[float, float, float]  # mass centre in the link's DH frame, in m
    inertia: tuple[float, float, float]  # about the mass centre, DH axes, in kg m2; products are zero
    armature: float  # drive inertia at the joint, in kg m2 or kg
    damping: float  # viscous friction, in N m s or N s/m
    brake: float  # torque at which the set brake slips, in N m or N


@dataclass(frozen=True, slots=True, kw_only=True)
class ServoModel:
    """Parameters of the servo. If the set-point error exceeds one of its limits, the motion has failed."""

    period: float  # s between torque updates
    frequency: tuple[float, ...]  # of each joint's error, in rad/s, critically damped
    lag: tuple[float, ...]  # following error that means collision, in rad or m
    short: float  # m; a distance from the set-point that means contact, after a free motion
    settle: int  # periods held after a motion, and averaged for the tare
    drag: float  # s for the floating arm to come to rest


@dataclass(frozen=True, slots=True, kw_only=True)
class ComplianceModel:
    """Parameters of compliant motions, in which the sensed force sets the speed of the hand (admittance control)."""

    gain: float  # m/s/N
    speed: float  # m/s by force alone, at most
    turn_gain: float  # rad/s/(N m)
    turn_speed: float  # rad/s by moment alone, at most
    turn_limit: float  # rad, at most
    ramp: int  # servo periods to full speed of a motion that does not press
    friction: tuple[float, ...]
    """Expected Coulomb friction of each joint, in N m or N. This friction is used for checks before a run; during a
    run, the measured friction is used.
    """


@dataclass(frozen=True, slots=True, kw_only=True, eq=False, repr=False)
class ArmModel(Brief):
    """An arm of n joints with a two-finger hand.

    The last DH frame is the tool frame T: midway between the finger tips, z along the approach direction, y along
    the finger line.
    """

    name: str
    structure: Structure
    joints: tuple[Joint, ...]
    X_WB: Pose  # base of the arm, (4, 4)
    hand: HandModel
    servo: ServoModel
    compliance: ComplianceModel
    held: Mapping[str, float] = field(default_factory=dict)
    """Position (rad or m), by joint name, of each joint that inverse kinematics leaves fixed."""

    def __post_init__(self) -> None:
        """Raise ValueError if the values contradict each other."""
        names = [joint.name for joint in self.joints]
        if len({*names}) < len(names) or not {*self.held} <= {*names}:
            raise ValueError(
                f"{self.name}: two joints have the same name, or a name in `held` is not a joint"
            )
        figures = (self.servo.frequency, self.servo.lag, self.compliance.friction)
        if {*map(len, figures)} != {len(names)}:
            raise ValueError(
                f"{self.name}: servo and friction need one value for each of {counted(len(names), 'joint')}"
            )

    @property
    def lower(self) -> Array:
        return constants(self).lower

    @property
    def upper(self) -> Array:
        return constants(self).upper

    @property
    def middle(self) -> Array:
        """Middle of the joints' ranges, with held joints at their fixed positions; shape (n,)."""
        q = (self.lower + self.upper) / 2
        for i, joint in enumerate(self.joints):
            q[i] = self.held.get(joint.name, q[i])
        return q


_WORKING: Final = (ComplianceModel, GraspModel)  # parts that no plan depends on


def digest(arm: ArmModel) -> str:
    """Compute a digest (12 hexadecimal digits) of all values on which a plan may depend. Names of fields do not
    affect the digest.
    """
    import hashlib

    return hashlib.sha256(repr(_figures(arm, _WORKING)).encode()).hexdigest()[:12]


def same_arm(one: ArmModel, other: ArmModel) -> bool:
    """Return True if all values of two arm models are equal, including the values on which no plan depends."""
    return _figures(one, ()) == _figures(other, ())


def _figures(value: object, left_out: tuple[type, ...]) -> object:
    """Convert the values of a model to nested lists, without values of the types `left_out`."""
    if is_dataclass(value):
        parts = [getattr(value, each.name) for each in fields(value)]
        return [_figures(part, left_out) for part in parts if not isinstance(part, left_out)]
    if isinstance(value, Mapping):
        return sorted(value.items())
    if isinstance(value, tuple):
        return [_figures(each, left_out) for each in value]
    return value.tolist() if isinstance(value, np.ndarray) else value


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class Constants:
    """The values of an arm model as arrays, computed once. The arrays must not be modified.

    The fields from `prismatic` to `rate_gain` have shape (n,).
    """

    X_BW: Pose
    prismatic: NDArray[np.bool_]
    d: Array
    theta: Array
    cos_alpha: Array
    sin_alpha: Array
    lower: Array
    upper: Array
    speed: Array
    acceleration: Array
    effort: Array
    armature: Array
    damping: Array
    brake: Array
    lag: Array
    frequency: Array
    position_gain: Array  # acceleration for each unit of position error, in 1/s2
    rate_gain: Array  # acceleration for each unit of rate error, in 1/s
    mass: Array  # of each link, in kg, fingers included in the last
    centre: Array  # in the DH frame, (n, 3), in m
    inertia: Array  # about the mass centre, DH axes, (n, 3), in kg m2
    carried: Array  # 1 where a joint (column) moves a link (row), (n, n)


@lru_cache(maxsize=16)
def constants(arm: ArmModel) -> Constants:
    """Convert the values of an arm to arrays."""
    names = (
        "d",
        "theta",
        "lower",
        "upper",
        "speed",
        "acceleration",
        "effort",
        "armature",
        "damping",
        "brake",
    )
    columns = {name: np.array([getattr(joint, name) for joint in arm.joints]) for name in names}
    alpha = np.array([joint.alpha for joint in arm.joints])
    mass = np.array([joint.mass for joint in arm.joints])
    centre = np.array([joint.centre for joint in arm.joints])
    inertia = np.array([joint.inertia for joint in arm.joints])
    frequency = np.array(arm.servo.frequency)
    _add_fingers(arm, mass, centre, inertia)
    return Constants(
        X_BW=inverse(arm.X_WB),
        prismatic=np.array([joint.kind == "prismatic" for joint in arm.joints]),
        cos_alpha=np.cos(alpha), sin_alpha=np.sin(alpha),
        lag=np.array(arm.servo.lag), frequency=frequency,
        position_gain=frequency * frequency, rate_gain=2 * frequency,  # critically damped
        mass=mass, centre=centre, inertia=inertia, carried=np.tri(len(arm.joints)), **columns,
    )  # fmt: skip


def _add_fingers(arm: ArmModel, mass: Array, centre: Array, inertia: Array) -> None:
    """Add the fingers to the last link, as a point mass on the approach axis."""
    own, p = mass[-1], centre[-1].copy()
    fingers, f = arm.hand.mass, np.array([0.0, 0.0, arm.hand.centre - arm.hand.length])
    mass[-1] = own + fingers
    centre[-1] = (own * p + fingers * f) / mass[-1]
    gap = p - f
    # two point masses about their common centre; products vanish with both centres on the approach axis
    inertia[-1] += own * fingers / mass[-1] * (gap @ gap - gap * gap)
