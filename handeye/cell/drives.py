"""The arm's motors and brakes, the hand's motor and its lamp."""

from typing import Final

import mujoco
import numpy as np

from handeye.pose import Array
from handeye.units import JIFFY

BRAKE: Final = np.array([200.0, 200.0, 600.0, 30.0, 30.0, 20.0])
"""Friction torque of the brakes, N m, joint 3 N. Placeholder: over twice what the drives can do."""
_BRAKE_STIFFNESS: Final = ((0.004, 1.0), (0.999, 0.9999, 0.001, 0.5, 2.0))  # creeps under .01 deg in 10 s

GAP_SPEED: Final = 0.08  # m/s, of the opening. Data sheet of 1974: 8 cm/s free.
GAP_MAX: Final = 0.105  # m. Data sheet of 1974: 10.5 cm.
GRIP_MAX: Final = 80.0  # N per finger: the strongest grip the assembly study measured.
_GIVE: Final = 0.004  # m by which the fingers must be held up to press with all the force allowed. Chosen.
_LAG: Final = 0.03  # s, time constant of the finger servo. Assembly study: 60 N s/m over 2000 N/m.


class SimulatedArm:
    """Six torque motors and six brakes.

    A brake is dry friction in the joint, as on the real arm: it holds where the arm is and gives way to
    a torque greater than its own.
    """

    def __init__(self, model: mujoco.MjModel, data: mujoco.MjData) -> None:
        names = [f"stanford/j{i}" for i in range(1, 7)]
        joints = [model.joint(name).id for name in names]
        self.qpos = model.jnt_qposadr[joints]
        self.dofs = model.jnt_dofadr[joints]
        self._motors = np.array([model.actuator(name).id for name in names])
        self._limits = model.actuator_ctrlrange[self._motors, 1].copy()
        self._friction = model.dof_frictionloss[self.dofs].copy()
        self._model, self._data = model, data
        model.dof_solref[self.dofs] = _BRAKE_STIFFNESS[0]
        model.dof_solimp[self.dofs] = _BRAKE_STIFFNESS[1]

    def put(self, torque: Array, *, brakes: bool) -> None:
        """Hold `torque`, shape (6,), or the brakes from now on."""
        self._model.dof_frictionloss[self.dofs] = BRAKE if brakes else self._friction
        self._data.ctrl[self._motors] = 0.0 if brakes else np.clip(torque, -self._limits, self._limits)


class HandDrive:
    """The motor that opens and closes both fingers together, under position control with limited force."""

    def __init__(self, model: mujoco.MjModel, data: mujoco.MjData) -> None:
        self._model, self._data = model, data
        self._motor = model.actuator("stanford/grip").id
        fingers = [model.joint(f"stanford/finger_{side}").id for side in "ab"]
        self._fingers = model.jnt_qposadr[fingers]
        self.set_point = self.gap
        """Where the finger servo is to be at the end of this tick, m."""
        model.actuator_ctrllimited[self._motor] = 0

    @property
    def gap(self) -> float:
        """The true opening between the finger tips, m."""
        return float(self._data.qpos[self._fingers].sum())

    def put(self, gap: float, grip: float) -> None:
        """Move the set-point towards `gap` (m) for a tick; press with at most `grip` (N).

        The set-point never runs far ahead of fingers that are held up, so that they can turn round at once.
        """
        goal = min(max(gap, 0.0), GAP_MAX)
        here, step = self.gap, GAP_SPEED * JIFFY
        start = min(max(self.set_point, here - _GIVE), here + _GIVE)
        if (goal - here) * (start - here) < 0 and abs(start - here) > step:
            start = here
        moved = min(max(goal - start, -step), step)
        self.set_point = start + moved
        self._press(min(max(grip, 0.0), GRIP_MAX), ahead=moved * (_LAG / JIFFY - 0.5))

    def _press(self, grip: float, ahead: float) -> None:
        """Set the force limit, and a stiffness in proportion to it: a light grip is a soft one.

        `ahead` (m) makes up for the servo's lag and for the set-point's steps.
        """
        model, motor = self._model, self._motor
        model.actuator_gainprm[motor, 0] = grip / _GIVE
        model.actuator_biasprm[motor, 1:3] = (-grip / _GIVE, -grip / _GIVE * _LAG)
        model.actuator_forcerange[motor] = (-grip, grip)
        self._data.ctrl[motor] = self.set_point + ahead


class Lamp:
    """The lamp on the hand: a frosted bulb, dull when it is off."""

    _LIT: Final = ((1.0, 0.96, 0.85, 1.0), 1.0)

    def __init__(self, model: mujoco.MjModel) -> None:
        self._model = model
        self._material = model.material("stanford/lamp").id
        self._dark = (tuple(model.mat_rgba[self._material]), 0.0)

    def put(self, lit: bool) -> None:
        """Switch it."""
        rgba, emission = self._LIT if lit else self._dark
        self._model.mat_rgba[self._material] = rgba
        self._model.mat_emission[self._material] = emission
