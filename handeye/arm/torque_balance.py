"""Detects a drive that does not give its commanded torque. The evidence is the torques that carry the weight of the
arm in successive motions.

In a motion through free air from rest to rest, the mean torque of a joint should be its weight torque plus the
measured friction. Any remaining torque is due to errors of masses, mass centres and drives. These errors are constant,
so each motion refines their estimate, until almost no torque remains unexplained in a motion at a new posture. The
method is recursive least squares with a prior (Gauss); the prior is the uncertainty that remains after the arm has
weighed itself. This uncertainty is computed for twice the usual errors of masses, mass centres and drives. If a torque
remains unexplained in a later motion, a drive has changed. The following figures were measured in three worlds, one of
them with errors of the level `high`. Over the table, joint 2 of the Stanford arm has a weight torque of 18 N m, and
the estimate of this torque is right to within .27 N m. Joint 3 carries a weight of 5 to 20 N, and the estimate of this
weight is right to within .6 N. A joint that carries no weight gives no information.
"""

from collections.abc import Sequence
from dataclasses import dataclass
from typing import Final

import numpy as np
from numpy.typing import NDArray

from handeye.arm.converters import sliding, torque_step
from handeye.arm.dynamics import link_weights
from handeye.arm.exertion import Exertion, columns
from handeye.arm.model import ArmModel, constants
from handeye.core.pose import Array

MASS: Final = 0.06  # of a link; twice its stated spread, as those below
CENTRE: Final = 0.058  # of the distance of a link's mass centre from its joint: 5 %, evenly spread
GAIN: Final = 0.02  # of a drive
LOAD: Final = 0.06  # of a declared load: twice the spread of parts, and half again for how it is held
DAMPING: Final = 0.6  # of viscous friction
COULOMB: Final = 0.02  # of measured friction, in addition to a quarter of a converter step
BEARS: Final = 4.0  # least weight that a joint must carry to be checked, in multiples of its friction; chosen
LIMIT: Final = 5.0
"""Limit of the unexplained torque of a joint, in multiples of its uncertainty. The unexplained torque is the
difference between the torque of the joint and the estimate. The uncertainty is one standard deviation, and is computed
from the errors above, each of which is twice its stated spread.

Assembling a pump takes about 350 motions. If two joints were checked in each motion, a limit of 4 would stop one
assembly in 20 although all drives work; a limit of 5 would stop one assembly in 2,500. In fact, the arm checks only
some of these motions: those that begin clear of all objects.
"""
OFF: Final = 0.4  # share of LIMIT above which further joints are reported with the worst one


@dataclass(frozen=True, slots=True, kw_only=True)
class Unbalanced:
    """Joints whose torques do not balance. `factors` gives the torque of each drive as a multiple of the commanded
    torque.
    """

    joints: tuple[int, ...]
    factors: tuple[float, ...]


def balanced(
    arm: ArmModel, taken: Sequence[Exertion], friction: Array, belief: Array | None, borne: Array
) -> tuple[Array, Unbalanced | None]:
    """Compare the torques of a motion with the estimate made before the motion. Returns two values. The first is the
    new estimate. The second value names the joints that do not balance; it is None if all joints balance.

    `arm` is the model with the weighed masses, and `friction` the measured friction. `belief` is the estimate, or
    None if the arm has only been weighed at its first posture. `borne` are the torques that carry a declared load.
    """
    postures, spares, _, rates = columns(taken)
    slides = sliding(arm, rates)
    each_period = spares - friction * slides, np.abs(rates), np.abs(slides)
    count = len(taken)
    spare, rate, slid = (each.sum(axis=0) / count for each in each_period)
    if belief is None:
        belief = _first_belief(arm, postures)
    H, weight = _model(arm, postures[:: max(1, count // 6)])
    rubbing = COULOMB * friction, (1 - slid) * friction
    moving = DAMPING * constants(arm).damping * rate, LOAD * borne
    noise = _doubt(arm) ** 2 + sum(np.square(each) for each in (*rubbing, *moving))
    left = spare - H @ belief[:, 0]
    known = np.sqrt(np.einsum("ij,jk,ik->i", H, belief[:, 1:], H) + noise)
    off = np.where(np.abs(weight) > BEARS * friction, np.abs(left) / known, 0.0)
    if off.max() <= LIMIT:
        return _learnt(belief, H, weight, noise, spare), None
    joints = np.flatnonzero(off > OFF * LIMIT)
    told = weight + borne + left
    factors = np.clip((weight + borne)[joints] / told[joints], 0.0, None)
    return belief, Unbalanced(joints=tuple(joints.tolist()), factors=tuple(factors.tolist()))


def weight_difference(
    arm: ArmModel, postures: Array, sliding: NDArray[np.bool_], belief: Array | None
) -> Array:
    """Return the effect that errors of masses, mass centres and drives may have on a joint that slides in both
    directions: half the greatest plausible difference between the mean torques in these directions, shape (n,).

    `arm` is the model with the weighed masses, and `belief` the estimate of its errors, as in `balanced`. `postures`
    are the positions in N servo periods, shape (N, n). `sliding`, shape (2, N, n), marks the periods in which each
    joint slid forwards, then the periods in which it slid backwards.
    """
    if belief is None:
        belief = _first_belief(arm, postures)
    masses, centres = (np.swapaxes(each, 1, 2) for each in link_weights(arm, postures))  # (N, joints, links)
    share = sliding / np.maximum(sliding.sum(axis=1, keepdims=True), 1)
    between = (share[0] - share[1]) / 2
    by_mass, by_centre = (np.einsum("Nj,Nji->ji", between, each) for each in (masses, centres))
    H = np.hstack((by_mass, by_centre, -np.diag(by_mass.sum(axis=1))))
    return np.asarray(H @ belief[:, 0] + LIMIT * np.sqrt(np.einsum("ij,jk,ik->i", H, belief[:, 1:], H)))


def _first_belief(arm: ArmModel, postures: Array) -> Array:
    """Return the estimate for an arm that has weighed itself at the first of these postures, and has not moved yet."""
    return _learnt(_prior(arm), *_model(arm, postures[:1]), _doubt(arm) ** 2)


def _doubt(arm: ArmModel) -> Array:
    """Return the least uncertainty of a mean torque: a quarter of a converter step in the torque, and a quarter of a
    step in the friction.
    """
    return np.asarray(torque_step(arm) * np.sqrt(2) / 4)


def _prior(arm: ArmModel) -> Array:
    """Return the prior of the errors of masses, mass centres and drives, shape (3n, 1 + 3n): expected values, then
    covariances.
    """
    spread = np.repeat([MASS, CENTRE, GAIN], len(arm.joints))
    return np.column_stack((np.zeros(len(spread)), np.diag(spread**2)))


def _model(arm: ArmModel, postures: Array) -> tuple[Array, Array]:
    """Return the contribution of each error to the mean joint torques, shape (n, 3n), and the mean weight torques,
    shape (n,).
    """
    masses, centres = (each.mean(axis=0).T for each in link_weights(arm, postures))
    weight = masses.sum(axis=1)
    return np.hstack((masses, centres, -np.diag(weight))), weight


def _learnt(belief: Array, H: Array, weight: Array, noise: Array, spare: Array | None = None) -> Array:
    """Update an estimate with the joint torques `spare`, which the model does not explain; by default, these torques
    are zero. `noise` is the variance of each torque.
    """
    mean, spread = belief[:, 0], belief[:, 1:]
    for j, h in enumerate(H):
        if not weight[j]:
            continue
        gain = spread @ h / (h @ spread @ h + noise[j])
        mean = mean + gain * ((0.0 if spare is None else spare[j]) - h @ mean)
        spread = spread - np.outer(gain, h @ spread)
    return np.column_stack((mean, spread))
