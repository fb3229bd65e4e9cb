"""Bars of aluminium: the parts that the hand takes from a cradle or out of a bin."""

from math import acos, atan2, degrees, pi
from typing import Final

import mujoco
import numpy as np

from handeye.core.pose import Array

LONG: Final = 0.050  # m: length of a bar, along its y axis
WIDE: Final = 0.014  # m: side of a bar, along its x and z axes
DENSITY: Final = 2700.0  # kg/m3: a bar weighs 26.5 g

SOFT: Final = [0.0, 0.99, 0.0005, 0.5, 2.0]
"""Impedance of a contact that begins softly. While the bars sink the first half millimetre into each other, the
impedance rises from 0 to the value of other contacts.

If a bar lies on the edges of other bars, its contacts are at corners, and these contacts come and go. If the impedance
begins at .95 instead of 0, such a bar rocks for ever, at up to 16 mm/s, and keeps the pile awake.
"""


def add_bar(
    spec: mujoco.MjSpec, name: str, at: Array, quat: Array, friction: float, *, wide: float = WIDE,
    long: float = LONG, density: float = DENSITY, soft: bool = False,
) -> None:  # fmt: skip
    """Put a bar into a scene, with its middle at `at` (m).

    Args:
        soft: True if the bar's contacts with other bars begin softly, so that the bar comes to rest in a pile.
    """
    body = spec.worldbody.add_body(name=name, pos=at.tolist(), quat=quat.tolist())
    body.add_freejoint(name=name)
    geom = body.add_geom(
        name=name, type=mujoco.mjtGeom.mjGEOM_BOX, size=[wide / 2, long / 2, wide / 2], density=density,
        friction=[friction, 0.003, 0.0001], rgba=[0.72, 0.73, 0.75, 1], group=1,
    )  # fmt: skip
    if soft:
        geom.solimp[:] = SOFT


def turned(axis: str, angle: float) -> Array:
    """Return the quaternion of a rotation about x, y or z."""
    quat = np.zeros(4)
    quat[0], quat[1 + "xyz".index(axis)] = np.cos(angle / 2), np.sin(angle / 2)
    return quat


def after(one: Array, other: Array) -> Array:
    """Return the quaternion of the rotation `other` followed by the rotation `one`."""
    product = np.empty(4)
    mujoco.mju_mulQuat(product, one, other)
    return product


def off_attitude(R: Array, along: Array, up: Array) -> float:
    """Return the angle (deg) by which a bar of orientation `R` differs from the required attitude. In the required
    attitude, one end of the bar (either of the two) points along `along`, and one of the four long sides faces in the
    direction `up`.
    """
    length = acos(min(abs(float(R[:, 1] @ along)), 1.0))
    side = atan2(float(R[:, 0] @ up), float(R[:, 2] @ up)) % (pi / 2)
    return degrees(max(length, min(side, pi / 2 - side)))
