"""Friction of the joints as the hand feels it.

The force estimate has no friction. A joint at rest takes up any torque up to its Coulomb friction f_i, a sliding one
takes up all of it, and what the estimate cannot explain is felt as the wrench J^-T tau (statics, by virtual work: Paul
1981). So the box of torques |tau_i| <= f_i is felt as a polytope of wrenches, which along a unit vector u reaches the
sum over the joints of |u J^-T_i f_i|.
"""

from typing import Final

import numpy as np

from handeye.arm.computed_torque import external_wrench
from handeye.arm.kinematics import jacobian
from handeye.arm.model import ArmModel
from handeye.core.pose import Array
from handeye.program.guards import HandLoad

MARGIN: Final = 3.0
"""Forces below this multiple of the felt friction are hard to tell from it.

The tare may contain friction of one sign and the motion of the other: that is twice. Measured in four drawn worlds on
48 straight motions in free air: 95 % of what was felt was within 1.6 times, all of it within 2.2; the rest is masses
and converters.
"""


def felt_friction(arm: ArmModel, q: Array, friction: Array) -> Array:
    """Wrench felt from each joint's Coulomb friction (N m, N), as columns, shape (6, n): N and N m, in W."""
    return external_wrench(jacobian(arm, q), np.diag(friction))


def faint(felt: Array, exerted: HandLoad) -> float | None:
    """The most that `felt_friction` adds to a force (N) or moment (N m), if that is hard to tell from it; else None."""
    vector = np.array(exerted.vector)
    size = float(np.linalg.norm(vector))
    most = float(np.abs(vector @ (felt[3:] if exerted.turning else felt[:3])).sum()) / size
    return most if size < MARGIN * most else None
