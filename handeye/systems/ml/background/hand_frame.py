"""Computes motions in the frame of the right arm's gripper. In MOS, the host computes these motions.

When all three angles are 0, the gripper's axes are parallel to those of the slides: x to the right (motor 4), y back
(motor 3), and z down (motor 2), along the fingers. Roll (motor 8) turns about z, then yaw (9) about x, then pitch (10)
about y. The three axes meet in the wrist.
"""

from collections.abc import Mapping
from math import asin, atan2, cos, hypot, pi, radians, sin
from typing import Final

import numpy as np

from handeye.core.pose import Array

TIPS: Final = 5906  # units from the wrist to the fingertips
_X, _Y, _Z, _ROLL, _YAW, _PITCH = 4, 3, 2, 8, 9, 10
MOTORS: Final = (_X, _Y, _Z, _ROLL, _YAW, _PITCH)


def translated(goals: Mapping[int, int], along: tuple[int, int, int]) -> dict[int, int]:
    """Return the goals of a motion along the axes of the gripper (ML units)."""
    moved = _frame(goals) @ np.array(along, float)
    return {motor: goals[motor] + round(float(by)) for motor, by in zip((_X, _Y, _Z), moved, strict=True)}


def rotated(goals: Mapping[int, int], yaw: int, pitch: int, roll: int) -> dict[int, int]:
    """Return the new goals of the motors for a rotation of the gripper about its own axes. The unit of the angles is
    .01 deg. The fingertips stay in place.
    """
    before = _frame(goals)
    after = before @ _rotation({_ROLL: roll, _YAW: yaw, _PITCH: pitch})
    shift = TIPS * (before[:, 2] - after[:, 2])
    angles = _angles(after, goals)
    slides = {motor: goals[motor] + round(float(by)) for motor, by in zip((_X, _Y, _Z), shift, strict=True)}
    return slides | angles


def _frame(goals: Mapping[int, int]) -> Array:
    return _rotation({motor: goals[motor] for motor in (_ROLL, _YAW, _PITCH)})


def _rotation(angles: Mapping[int, int]) -> Array:
    (cr, sr), (cy, sy), (cp, sp) = (
        (cos(radians(angles[motor] / 100)), sin(radians(angles[motor] / 100)))
        for motor in (_ROLL, _YAW, _PITCH)
    )
    about_z = np.array([[cr, -sr, 0], [sr, cr, 0], [0, 0, 1.0]])
    about_x = np.array([[1.0, 0, 0], [0, cy, -sy], [0, sy, cy]])
    about_y = np.array([[cp, 0, sp], [0, 1.0, 0], [-sp, 0, cp]])
    return np.asarray(about_z @ about_x @ about_y)


def _angles(frame: Array, near: Mapping[int, int]) -> dict[int, int]:
    """Return the angles of the motors (.01 deg) that give the gripper the orientation `frame`. Of the two solutions,
    the function returns the solution that is nearer to the angles `near`.
    """
    yaw = asin(min(max(float(frame[2, 1]), -1.0), 1.0))
    if hypot(frame[2, 0], frame[2, 2]) < 1e-9:  # roll and pitch turn about the same axis: keep the pitch
        pitch = radians(near[_PITCH] / 100)
        total = atan2(frame[1, 0], frame[0, 0])
        solutions = [(total - pitch if yaw > 0 else total + pitch, yaw, pitch)]
    else:
        pitch, roll = atan2(-frame[2, 0], frame[2, 2]), atan2(-frame[0, 1], frame[1, 1])
        solutions = [(roll, yaw, pitch), (roll + pi, pi - yaw, pitch + pi)]
    found = [
        {
            motor: _nearest(angle, near[motor])
            for motor, angle in zip((_ROLL, _YAW, _PITCH), each, strict=True)
        }
        for each in solutions
    ]
    return min(found, key=lambda each: sum(abs(each[motor] - near[motor]) for motor in each))


def _nearest(angle: float, near: int) -> int:
    """Convert an angle from radians to .01 deg, and add whole turns until it is within half a turn of `near`."""
    units = round(angle * 18_000 / pi)
    return units - 36_000 * round((units - near) / 36_000)
