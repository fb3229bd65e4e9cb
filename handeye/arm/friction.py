"""What the hand feels where it meets nothing: friction of the joints that is not known, and steps of the converters.

The force estimate has no friction beyond what is known. A joint at rest takes up any torque up to its Coulomb
friction f_i, a sliding one takes up all of it, and what the estimate cannot explain is felt as the wrench J^-T tau
(statics, by virtual work: Paul 1981). So the box of torques |tau_i| <= f_i is felt as a polytope of wrenches, which
along a unit vector u reaches the sum over the joints of |u J^-T_i f_i|.

An arm that has measured its friction overcomes what it knows. It feels the rest, `unknown_friction`, all the way. From
one servo period to the next it feels the steps of its converters besides: torques are put out to half a step, and the
rate that a period has gained is read in steps, which inertia makes a torque. Both are even errors, of step^2 / 12.

Measured on 120 straight motions in free air, in three worlds with twice the errors: the mean over a motion was within
1.02 times the first, the scatter of its periods 1.05 times the second (1.28 at most).
"""

from typing import Final

import numpy as np

from handeye.arm.computed_torque import external_wrench
from handeye.arm.converters import rate_step, torque_step
from handeye.arm.dynamics import mass_matrix
from handeye.arm.kinematics import jacobian
from handeye.arm.model import ArmModel
from handeye.core.pose import Array
from handeye.program.guards import HandLoad

UNKNOWN: Final = 0.02  # of measured friction, beside a quarter of a step of the converter
PEAK: Final = 4.0
"""Times the scatter of a servo period that a guard should leave room for: one period of 30,000 goes beyond."""


def unknown_friction(arm: ArmModel, friction: Array) -> Array:
    """What is not known of each joint's friction when it has been measured, shape (n,), N m or N."""
    return np.asarray(torque_step(arm) / 4 + UNKNOWN * friction)


def felt_friction(arm: ArmModel, q: Array, friction: Array) -> Array:
    """Wrench felt from each joint's Coulomb friction (N m, N), as columns, shape (6, n): N and N m, in W."""
    return external_wrench(jacobian(arm, q), np.diag(friction))


def felt_in_air(arm: ArmModel, q: Array, friction: Array, exerted: HandLoad) -> float:
    """The most that the hand feels along a force (N) or about a moment (N m) where it meets nothing."""
    vector = np.array(exerted.vector)
    wrenches = external_wrench(jacobian(arm, q), np.eye(len(q)))
    along = vector @ (wrenches[3:] if exerted.turning else wrenches[:3]) / np.linalg.norm(vector)
    gained = along @ mass_matrix(arm, q) * rate_step(arm) / arm.servo.period
    scatter = np.sqrt((np.square(along * torque_step(arm)) + 2 * np.square(gained)).sum() / 12)
    return float(np.abs(along) @ unknown_friction(arm, friction) + PEAK * scatter)


def faint(arm: ArmModel, q: Array, friction: Array, exerted: HandLoad) -> float | None:
    """The most that is felt in free air (N, N m), if a guard on `exerted` may be met by it; else None."""
    most = felt_in_air(arm, q, friction, exerted)
    return most if float(np.linalg.norm(np.array(exerted.vector))) < most else None
