"""An arm as a value: a chain of joints with their limits, masses and drives."""

import hashlib
from collections.abc import Mapping
from dataclasses import dataclass, field, fields, is_dataclass
from functools import lru_cache
from typing import Final, Literal

import numpy as np
from numpy.typing import NDArray

from handeye.arm.hand import GraspModel, HandModel
from handeye.core.pose import Array, Pose, inverse

Structure = Literal["spherical wrist", "gantry", "cartesian"]
"""Structure of an arm, as far as its inverse kinematics go; `handeye.arm.ik` has a solver for each."""


@dataclass(frozen=True, slots=True, kw_only=True)
class Joint:
    """A joint and the link it moves, in standard Denavit-Hartenberg form with a = 0.

    DH frame i is reached from frame i-1 by a turn of theta about z, a shift of d along z and a turn of
    `alpha` about x. A revolute joint varies theta, a prismatic one varies d.
    Rates and limits are in rad for a revolute joint, in m for a prismatic one.
    """

    name: str
    kind: Literal["revolute", "prismatic"]
    d: float
    """m; 0 for a prismatic joint, whose position takes its place."""
    alpha: float
    """rad"""
    theta: float = 0.0
    """rad; 0 for a revolute joint, whose position takes its place."""
    lower: float
    upper: float
    speed: float
    """Greatest rate, per s."""
    acceleration: float
    """Greatest planned acceleration, per s2."""
    effort: float
    """Greatest torque (N m) or force (N) of the drive."""
    mass: float
    """kg, of the link"""
    centre: tuple[float, float, float]
    """Mass centre in the link's DH frame, m."""
    inertia: tuple[float, float, float]
    """Moments about the mass centre along the axes of the link's DH frame, kg m2; products are zero."""
    armature: float
    """Inertia of the drive seen at the joint: kg m2, or kg."""
    damping: float
    """Viscous friction of the joint: N m s, or N s/m."""
    brake: float
    """Torque (N m) or force (N) at which the set brake gives way."""


@dataclass(frozen=True, slots=True, kw_only=True)
class ServoModel:
    """Figures of the servo, and the following errors that count as a failure."""

    period: float
    """s between two torque updates."""
    frequency: tuple[float, ...]
    """Natural frequency of each joint's position error, rad/s, critically damped."""
    lag: tuple[float, ...]
    """Following error of each joint that means collision, rad or m."""
    short: float
    """Distance of the hand from its set-point at the end of a free motion that means it stands on something, m."""
    settle: int
    """Periods held at the end of a motion, and averaged for the tare of the force estimate."""
    drag: float
    """s in which the floating arm comes to rest once nobody pushes it."""


@dataclass(frozen=True, slots=True, kw_only=True)
class ComplianceModel:
    """Figures of compliant motions, in which speed follows force: an admittance."""

    gain: float
    """Speed per force, m/s/N."""
    speed: float
    """Greatest speed that force alone makes, m/s."""
    turn_gain: float
    """Rate of turning per moment, rad/s/(N m)."""
    turn_speed: float
    """Greatest rate that a moment alone makes, rad/s."""
    turn_limit: float
    """The hand is turned no farther than this, rad."""
    ramp: int
    """Servo periods in which a motion that does not press reaches its speed."""
    friction: tuple[float, ...]
    """Coulomb friction that each joint is expected to have, N m or N: what forces are checked against before a run. A
    run measures its own."""


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class ArmModel:
    """An arm of n joints with a two-finger hand.

    The last DH frame is the tool frame T: midway between the finger tips, z along the approach direction, y along
    the finger line.
    """

    name: str
    structure: Structure
    joints: tuple[Joint, ...]
    X_WB: Pose
    """Base of the arm in the world, shape (4, 4)."""
    hand: HandModel
    servo: ServoModel
    compliance: ComplianceModel
    held: Mapping[str, float] = field(default_factory=dict)
    """Joints that are no part of the inverse kinematics, by name, and where each is held, rad or m."""

    def __post_init__(self) -> None:
        """Raises ValueError if the figures do not fit together."""
        names = [joint.name for joint in self.joints]
        if len({*names}) < len(names) or not {*self.held} <= {*names}:
            raise ValueError(f"{self.name}: joints have names of their own, and only joints are held")
        figures = (self.servo.frequency, self.servo.lag, self.compliance.friction)
        if {*map(len, figures)} != {len(names)}:
            raise ValueError(
                f"{self.name}: servo and friction have figures for other than {len(names)} joints"
            )

    @property
    def lower(self) -> Array:
        """Lower joint limits, shape (n,)."""
        return constants(self).lower

    @property
    def upper(self) -> Array:
        """Upper joint limits, shape (n,)."""
        return constants(self).upper

    @property
    def middle(self) -> Array:
        """The middle of the joints' ranges, held joints where they are held; shape (n,)."""
        q = (self.lower + self.upper) / 2
        for i, joint in enumerate(self.joints):
            q[i] = self.held.get(joint.name, q[i])
        return q


_WORKING: Final = (ComplianceModel, GraspModel)
"""Figures that no plan rests on: whatever they are, a plan can be carried out as it was made."""


def digest(arm: ArmModel) -> str:
    """Twelve hexadecimal digits that change with any figure a plan may rest on, whatever its field is called."""
    return hashlib.sha256(repr(_figures(arm, _WORKING)).encode()).hexdigest()[:12]


def same_arm(one: ArmModel, other: ArmModel) -> bool:
    """All figures of two models are the same, those of the working phase as well."""
    return _figures(one, ()) == _figures(other, ())


def _figures(value: object, left_out: tuple[type, ...]) -> object:
    """The figures of a model as nested lists, but for those of some types."""
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
    """The figures of a model as arrays, computed once. Not to be written to."""

    X_BW: Pose
    prismatic: NDArray[np.bool_]
    """Shape (n,), as d to frequency."""
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
    mass: Array
    """kg of each link, the fingers included in the last."""
    centre: Array
    """Mass centre of each link in its DH frame, shape (n, 3), m."""
    inertia: Array
    """About the mass centre along the axes of the DH frame, shape (n, 3), kg m2."""
    carried: Array
    """1 where a joint (column) moves a link (row): its own and those after it; shape (n, n)."""


@lru_cache(maxsize=16)
def constants(arm: ArmModel) -> Constants:
    """The arrays of an arm."""
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
    _add_fingers(arm, mass, centre, inertia)
    return Constants(
        X_BW=inverse(arm.X_WB),
        prismatic=np.array([joint.kind == "prismatic" for joint in arm.joints]),
        cos_alpha=np.cos(alpha), sin_alpha=np.sin(alpha),
        lag=np.array(arm.servo.lag), frequency=np.array(arm.servo.frequency),
        mass=mass, centre=centre, inertia=inertia, carried=np.tri(len(arm.joints)), **columns,
    )  # fmt: skip


def _add_fingers(arm: ArmModel, mass: Array, centre: Array, inertia: Array) -> None:
    """Make the fingers, a point mass on the approach axis, part of the last link."""
    own, p = mass[-1], centre[-1].copy()
    fingers, f = arm.hand.mass, np.array([0.0, 0.0, arm.hand.centre - arm.hand.length])
    mass[-1] = own + fingers
    centre[-1] = (own * p + fingers * f) / mass[-1]
    gap = p - f
    # two point masses about their common centre; products vanish with both centres on the approach axis
    inertia[-1] += own * fingers / mass[-1] * (gap @ gap - gap * gap)
