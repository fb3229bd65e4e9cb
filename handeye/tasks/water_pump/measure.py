"""Measurements that only a pump needs: how hard its screws clamp, how easily its rotor turns."""

from math import degrees
from typing import Final

import mujoco

from handeye.judge.measured import Measured
from handeye.tasks.water_pump.limits import ROTOR_TORQUE, ROTOR_TURN

_RAMP: Final = 1.0  # s over which the torque on the rotor grows to its limit


def head_force(measured: Measured, hole: int) -> float:
    """Force of the screw head of a hole on what lies beneath, N."""
    model, data = measured.model, measured.data
    contact, head = data.contact, model.geom(f"head{hole}").id
    tree = model.body_rootid[model.geom_bodyid[contact.geom]]
    bit = model.body_rootid[model.body("bit").id]
    mine = (contact.geom == head).any(axis=1) & ~(tree == bit).any(axis=1)
    rows = contact.efc_address[mine & (contact.efc_address >= 0)]
    return float(data.efc_force[rows].sum())


def rotor_torque(measured: Measured) -> float:
    """Torque that turns the rotor (N m); infinite if the limit does not. Done on a further copy."""
    model = measured.model
    data = mujoco.MjData(model)
    mujoco.mj_copyData(data, model, measured.data)
    dof, adr = model.joint("rotor").dofadr[0], model.joint("rotor").qposadr[0]
    start, steps = float(data.qpos[adr]), round(_RAMP / model.opt.timestep)
    for i in range(1, steps + 1):
        data.qfrc_applied[dof] = ROTOR_TORQUE * i / steps
        mujoco.mj_step(model, data)
        if degrees(abs(data.qpos[adr] - start)) > ROTOR_TURN:
            return ROTOR_TORQUE * i / steps
    return float("inf")
