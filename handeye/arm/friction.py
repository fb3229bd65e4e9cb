"""The force that the hand senses in free air. This force comes from unknown joint friction and from the converter
steps.

The force estimate takes only the known part of joint friction into account. In a joint at rest, friction takes up any
torque up to the Coulomb friction f_i. In a sliding joint, it takes up exactly f_i. The estimate reports the torque
residual tau as the wrench J^-T tau (statics, by virtual work: Paul 1981). The box of torques |tau_i| <= f_i is thus
sensed as a polytope of wrenches. Along a unit vector u the polytope extends to the sum over the joints of |u J^-T_i
f_i|.

An arm that has measured its friction compensates the measured part. The arm senses the rest of the friction,
`unknown_friction`, as a force during the whole motion. In addition, the steps of the converters are sensed as a force
in each servo period. The output torque is rounded by up to half a step. The change of a joint's rate in a period is
read in steps of a converter. Multiplied by the inertia and divided by the period, a step appears as a torque. The
errors of both roundings are uniformly distributed, with the variance step^2 / 12.

Measured on 120 straight motions in free air, in three worlds with twice the usual errors: the mean force over a motion
was at most 1.02 times the force computed from unknown friction. The scatter of single servo periods was 1.05 times
the scatter computed from the converter steps (1.28 times at most).
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

UNKNOWN: Final = 0.02  # of measured friction, in addition to a quarter of a converter step
PEAK: Final = 4.0
"""Margin of a guard, in standard deviations of the force or moment that is sensed in a single servo period. In one of
30,000 servo periods, the noise exceeds this margin.
"""


def unknown_friction(arm: ArmModel, friction: Array) -> Array:
    """Return, for each joint, an upper bound on the friction that is still unknown after friction has been
    measured; shape (n,), in N m or N.
    """
    return np.asarray(torque_step(arm) / 4 + UNKNOWN * friction)


def felt_friction(arm: ArmModel, q: Array, friction: Array) -> Array:
    """Return the wrench (N and N m, in W) that the hand appears to sense because of the friction of each joint, as
    shape (6, n). Each column belongs to one joint. `friction` is the Coulomb friction of the joints (N m, or N).
    """
    return external_wrench(jacobian(arm, q), np.diag(friction))


def felt_in_air(arm: ArmModel, q: Array, friction: Array, exerted: HandLoad) -> float:
    """Return the greatest force (N) or moment (N m) along `exerted` that the hand senses in free air."""
    vector = np.array(exerted.vector)
    wrenches = external_wrench(jacobian(arm, q), np.eye(len(q)))
    along = vector @ (wrenches[3:] if exerted.turning else wrenches[:3]) / np.linalg.norm(vector)
    gained = along @ mass_matrix(arm, q) * rate_step(arm) / arm.servo.period
    scatter = np.sqrt((np.square(along * torque_step(arm)) + 2 * np.square(gained)).sum() / 12)
    return float(np.abs(along) @ unknown_friction(arm, friction) + PEAK * scatter)


def faint(arm: ArmModel, q: Array, friction: Array, exerted: HandLoad) -> float | None:
    """Return the greatest force (N) or moment (N m) sensed in free air, or None if this value does not exceed
    `exerted`. If the value exceeds `exerted`, a guard at `exerted` may trip without contact.
    """
    most = felt_in_air(arm, q, friction, exerted)
    return most if float(np.linalg.norm(np.array(exerted.vector))) < most else None
