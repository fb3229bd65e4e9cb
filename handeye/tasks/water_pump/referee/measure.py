"""Measurements that only a pump needs: its screws in their holes, how easily its rotor turns, and overlapping parts."""

from dataclasses import dataclass
from functools import reduce
from math import cos, pi, radians, sin
from typing import Final

import mujoco
import numpy as np
from numpy.typing import NDArray

from handeye.core.pose import inverse, pose
from handeye.judge.measured import SettledState, tilt
from handeye.tasks.stanford_cell.arm import ARM
from handeye.tasks.stanford_cell.dimensions import base_top, dimensions
from handeye.tasks.water_pump.referee.limits import ROTOR_SWING, ROTOR_TORQUE

_SWING: Final = 1.5  # s: once to one side, once to the other, and back
_BEHIND: Final = radians(2.0)  # so far behind its guide, the rotor is turned with its limit
_GAIN: Final = ROTOR_TORQUE / _BEHIND  # N m/rad
_DAMPING: Final = 0.07  # N m s/rad: with the rotor's inertia it swings into place without going beyond

BORE = 4 | 512
FLAT = 16 | 32 | 64 | 128
PIERCED = 256  # contact bits of scenes/water_pump/workcell.xml

Mask = NDArray[np.bool_]


def head_force(measured: SettledState, hole: int) -> float:
    """Force of the screw head of a hole on what lies beneath, N."""
    model, data = measured.model, measured.data
    contact, head = data.contact, model.geom(f"head{hole}").id
    tree = model.body_rootid[model.geom_bodyid[contact.geom]]
    bit = model.body_rootid[model.body("bit").id]
    mine = (contact.geom == head).any(axis=1) & ~(tree == bit).any(axis=1)
    rows = contact.efc_address[mine & (contact.efc_address >= 0)]
    return float(data.efc_force[rows].sum())


def head_gap(measured: SettledState, hole: int) -> float:
    """Height of a screw's head over the top's flange, m; negative where it is pressed in."""
    X_WT, size = measured.pose("top"), dimensions()
    middle = measured.data.geom(f"head{hole}").xpos - X_WT[:3, 3]
    return float(X_WT[:3, 2] @ middle) - size("top.flange") - size("screw.head_height") / 2


def misfit(measured: SettledState, layer: str, hole: int) -> float:
    """Distance of a screw's axis from that of its hole in gasket or top, at the worse end of the hole, m."""
    axis, mouth = measured.data.site(f"thread{hole}"), measured.data.site(f"{layer}_hole{hole}").xpos
    down = -thickness(layer) * measured.pose(layer)[:3, 2]
    ends = np.array([mouth, mouth + down]) - axis.xpos
    return float(np.hypot(*(ends @ axis.xmat.reshape(3, 3))[:, :2].T).max())


def clearance(measured: SettledState, layer: str, hole: int) -> float:
    """Radial clearance of a screw's shank in its hole in gasket or top, m."""
    model = measured.model
    return float(model.site(f"{layer}_hole{hole}").size[0] - model.geom(f"shank{hole}").size[0])


def corner_height(measured: SettledState, layer: str, holes: int) -> float:
    """Deviation of a layer's upper face from its nominal height over the base, at the worst screw hole, m."""
    X_BW = inverse(measured.pose("base"))
    corners = np.array([measured.data.site(f"{layer}_hole{k}").xpos for k in range(holes)])
    heights = corners @ X_BW[2, :3] + X_BW[2, 3]
    return float(np.abs(heights - under(layer) - thickness(layer)).max())


def thickness(layer: str) -> float:
    """Thickness of the gasket, or of the top's flange, m."""
    return dimensions()("top.flange" if layer == "top" else "gasket.thickness")


def under(layer: str) -> float:
    """Nominal height of a layer's underside over the base's, m."""
    return base_top() + (thickness("gasket") if layer == "top" else 0.0)


def thread_length(measured: SettledState, hole: int) -> float:
    """Length of a screw's thread that is in its tapped hole, m."""
    point = inverse(measured.pose("base")) @ measured.pose(f"carrier{hole}")
    return float(base_top() - point[2, 3] - dimensions()("screw.point_length"))


def thread_offset(measured: SettledState, hole: int) -> float:
    """Distance of a screw's axis from the mouth of its tapped hole, m."""
    axis, mouth = measured.data.site(f"thread{hole}"), measured.data.site(f"base_hole{hole}")
    return float(np.hypot(*((mouth.xpos - axis.xpos) @ axis.xmat.reshape(3, 3))[:2]))


def screw_lean(measured: SettledState, hole: int) -> float:
    """Angle between a screw and the base, rad."""
    axis = measured.data.site(f"thread{hole}").xmat.reshape(3, 3)
    return tilt(inverse(measured.pose("base")) @ pose(axis, np.zeros(3)))


def rotor_torque(measured: SettledState) -> float:
    """Greatest torque that it takes to swing the rotor to either side and back, N m.

    Infinite if the limit does not bring it all the way. Done on a further copy.
    """
    model = measured.model
    data = mujoco.MjData(model)
    mujoco.mj_copyData(data, model, measured.data)
    dof, adr = model.joint("rotor").dofadr[0], model.joint("rotor").qposadr[0]
    start, steps = float(data.qpos[adr]), round(_SWING / model.opt.timestep)
    swing, greatest = radians(ROTOR_SWING), 0.0
    for i in range(1, steps + 1):
        phase = pi * (1 - cos(pi * i / steps))  # sets off and stops gently
        rate = pi**2 / _SWING * sin(pi * i / steps)
        behind = swing * sin(phase) - (data.qpos[adr] - start)
        slower = swing * cos(phase) * rate - data.qvel[dof]
        torque = _GAIN * behind + _DAMPING * slower
        data.qfrc_applied[dof] = np.clip(torque, -ROTOR_TORQUE, ROTOR_TORQUE)
        mujoco.mj_step(model, data)
        if abs(behind) > 2 * _BEHIND:
            return float("inf")
        greatest = max(greatest, abs(float(data.qfrc_applied[dof])))
    return greatest


@dataclass(frozen=True, slots=True, kw_only=True)
class Overlap:
    """The deepest of some overlaps."""

    depth: float  # m
    between: str


def deepest(measured: SettledState) -> tuple[Overlap, Overlap]:
    """The deepest overlap of a shank or pin with a bore, and that of all other parts."""
    kinds = _Kinds.of(measured)
    pairs, depths = measured.overlaps(kinds.solid)
    either = pairs[:, ::-1]
    passing = reduce(
        np.logical_or, (kinds.pierced[p[:, 0]] & kinds.fastener[p[:, 1]] for p in (pairs, either))
    )
    depths[passing | kinds.arm[pairs].all(axis=1)] = 0.0
    inside = reduce(np.logical_or, (kinds.bore[p[:, 0]] & kinds.shank[p[:, 1]] for p in (pairs, either)))
    return _worst(measured, pairs, depths * inside), _worst(measured, pairs, depths * ~inside)


def _worst(measured: SettledState, pairs: NDArray[np.int32], depths: NDArray[np.float64]) -> Overlap:
    if not depths.any():
        return Overlap(depth=0.0, between="nothing")
    worst = int(np.argmax(depths))
    names = (measured.model.body(measured.model.geom_bodyid[g]).name for g in pairs[worst])
    return Overlap(depth=float(depths[worst]), between=" and ".join(names))


@dataclass(frozen=True, slots=True, kw_only=True)
class _Kinds:
    """Masks of the geoms of each kind, shape (ngeom,)."""

    solid: Mask
    pierced: Mask
    fastener: Mask  # pins, loose screws, and screws in their threads
    shank: Mask  # fasteners without heads, which go through bores
    bore: Mask
    arm: Mask

    @classmethod
    def of(cls, measured: SettledState) -> "_Kinds":
        model = measured.model
        gives, takes = model.geom_contype, model.geom_conaffinity
        names = [model.body(body).name for body in model.geom_bodyid]
        fastener = np.array([name.startswith(("pin0", "pin1", "screw", "carrier")) for name in names])
        heads = np.array(["head" in model.geom(g).name for g in range(model.ngeom)])
        return cls(
            solid=((gives | takes) != 0) & (gives & FLAT == 0),
            pierced=takes & PIERCED != 0,
            fastener=fastener,
            shank=fastener & ~heads,
            bore=gives & BORE != 0,
            arm=np.array([name.startswith(ARM) for name in names]),
        )
