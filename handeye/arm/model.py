"""An arm as a value: a chain of joints with their limits, masses and drives."""

import hashlib
from dataclasses import dataclass, fields
from functools import lru_cache
from typing import Literal

import numpy as np
from numpy.typing import NDArray

from handeye.pose import Array, Pose, inverse


@dataclass(frozen=True, slots=True, kw_only=True)
class Joint:
    """A joint and the link it moves, in standard Denavit-Hartenberg form with a = 0.

    DH frame i is reached from frame i-1 by a turn of theta about z, a shift of d along z and a turn of
    `alpha` about x. A revolute joint varies theta, a prismatic one varies d (and has theta = 0).
    Rates and limits are in rad for a revolute joint, in m for a prismatic one.
    """

    name: str
    kind: Literal["revolute", "prismatic"]
    d: float
    """m; 0 for a prismatic joint, whose position takes its place."""
    alpha: float
    """rad"""
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


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class ArmModel:
    """A six-joint arm with a two-finger hand.

    DH frame 6 is the tool frame T: midway between the finger tips, z along the approach direction, y along
    the finger line. Its distance from the wrist centre is the hand length, which is also the last joint's d.
    """

    name: str
    joints: tuple[Joint, Joint, Joint, Joint, Joint, Joint]
    X_WB: Pose
    """Base of the arm in the world, shape (4, 4)."""
    hand_length: float
    """m"""
    hand_mass: float
    """Mass of both fingers, kg; a part of link 6 that its `mass` does not include."""
    hand_centre: float
    """Distance of the fingers' mass centre from the wrist centre along the approach direction, m."""
    gap_max: float
    """Greatest opening of the fingers, m."""
    gap_speed: float
    """Greatest rate of the opening, m/s."""

    @property
    def lower(self) -> Array:
        """Lower joint limits, shape (6,)."""
        return constants(self).lower

    @property
    def upper(self) -> Array:
        """Upper joint limits, shape (6,)."""
        return constants(self).upper


def digest(arm: ArmModel) -> str:
    """Twelve hexadecimal digits that change with any figure of the model."""
    figures = [getattr(arm, field.name) for field in fields(arm)]
    text = repr([figure.tolist() if isinstance(figure, np.ndarray) else figure for figure in figures])
    return hashlib.sha256(text.encode()).hexdigest()[:12]


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class Constants:
    """The figures of a model as arrays, computed once. Not to be written to."""

    X_BW: Pose
    prismatic: NDArray[np.bool_]
    """Shape (6,), as d to damping."""
    d: Array
    cos_alpha: Array
    sin_alpha: Array
    lower: Array
    upper: Array
    speed: Array
    acceleration: Array
    effort: Array
    armature: Array
    damping: Array
    mass: Array
    """kg of each link, the fingers included in link 6."""
    centre: Array
    """Mass centre of each link in its DH frame, shape (6, 3), m."""
    inertia: Array
    """About the mass centre along the axes of the DH frame, shape (6, 3), kg m2."""


@lru_cache(maxsize=16)
def constants(arm: ArmModel) -> Constants:
    """The arrays of an arm."""
    names = ("d", "lower", "upper", "speed", "acceleration", "effort", "armature", "damping")
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
        mass=mass, centre=centre, inertia=inertia, **columns,
    )  # fmt: skip


def _add_fingers(arm: ArmModel, mass: Array, centre: Array, inertia: Array) -> None:
    """Make the fingers, a point mass on the approach axis, part of link 6."""
    own, p = mass[5], centre[5].copy()
    fingers, f = arm.hand_mass, np.array([0.0, 0.0, arm.hand_centre - arm.hand_length])
    mass[5] = own + fingers
    centre[5] = (own * p + fingers * f) / mass[5]
    gap = p - f
    # two point masses about their common centre; products vanish with both centres on the approach axis
    inertia[5] += own * fingers / mass[5] * (gap @ gap - gap * gap)
