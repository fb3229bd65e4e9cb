"""Friction of the joints as the hand feels it.

The force estimate knows nothing of friction. A joint that stands takes up any torque as far as its Coulomb friction
f_i, one that slides takes up all of that, and what the estimate cannot explain is felt as the wrench J^-T tau (statics,
by virtual work: Paul 1981). So the box of torques |tau_i| <= f_i is felt as a polytope of wrenches. Along a unit vector
u it reaches as far as the sum over the joints of |u J^-T_i f_i|.
"""

from typing import Final

import numpy as np

from handeye.arm.computed_torque import external_wrench
from handeye.arm.kinematics import jacobian
from handeye.arm.model import ArmModel
from handeye.core.pose import Array
from handeye.program.guards import Exerted

MARGIN: Final = 3.0
"""A force less than so many times what friction can be felt as is hard to tell from it. The tare has friction on one
side, and the motion may have it on the other: that is twice. Measured in four drawn worlds on 48 straight motions in
free air: 95 % of what was felt was within 1.6 times, all of it within 2.2; the rest is masses and converters."""


def felt_friction(arm: ArmModel, q: Array, friction: Array) -> Array:
    """What the hand feels of the friction of each joint, a joint a column, shape (6, n): N, and N m, in W.

    Args:
        q: configuration, shape (n,).
        friction: Coulomb friction, shape (n,), N m and (prismatic joints) N.
    """
    return external_wrench(jacobian(arm, q), np.diag(friction))


def faint(felt: Array, exerted: Exerted) -> float | None:
    """The most that friction is felt as along a force (N), or about a moment (N m), that is hard to tell from it.

    Args:
        felt: friction of each joint as it is felt, shape (6, n).

    Returns:
        None if the force or moment is clear of it.
    """
    vector = np.array(exerted.vector)
    size = float(np.linalg.norm(vector))
    most = float(np.abs(vector @ (felt[3:] if exerted.turning else felt[:3])).sum()) / size
    return most if size < MARGIN * most else None
