"""Measures an assembled pump: the screws in their holes, the torque of the rotor, and overlaps of parts."""

import copy
from dataclasses import dataclass
from functools import reduce
from itertools import permutations
from math import cos, pi, radians, sin
from typing import Final

import mujoco
import numpy as np
from numpy.typing import NDArray

from handeye.core.pose import inverse, pose
from handeye.judge.measured import SettledState, tilt
from handeye.tasks.stanford_cell.arm import ARM
from handeye.tasks.stanford_cell.dimensions import base_top, dimensions
from handeye.tasks.water_pump.referee.limits import ROTOR_TORQUE

_SWING: Final = 8.0
"""Time (s) of the whole swing: a full turn one way, then back through the start to a full turn the other way, then
back to the start.
"""
_BEHIND: Final = radians(2.0)  # lag behind the set-point at which the greatest permitted torque is applied
_GAIN: Final = ROTOR_TORQUE / _BEHIND  # N m/rad
_DAMPING: Final = 0.04  # N m s/rad: with the rotor's inertia, there is no overshoot

PINS: Final = ("pin0", "pin1")

BORE = 4 | 512
FLAT = 16 | 32 | 64 | 128
PIERCED = 256  # contact bits of scenes/water_pump/workcell.xml

Mask = NDArray[np.bool_]


def head_force(measured: SettledState, hole: int) -> float:
    """Return the force that the screw head at a hole exerts on the part beneath the head (N)."""
    model, data = measured.model, measured.data
    contact, head = data.contact, model.geom(f"head{hole}").id
    tree = model.body_rootid[model.geom_bodyid[contact.geom]]
    bit = model.body_rootid[model.body("bit").id]
    mine = (contact.geom == head).any(axis=1) & ~(tree == bit).any(axis=1)
    rows = contact.efc_address[mine & (contact.efc_address >= 0)]
    return float(data.efc_force[rows].sum())


def head_gap(measured: SettledState, hole: int) -> float:
    """Return the height of a screw's head above the top's flange (m); negative if the head is pressed into the
    flange."""
    X_WT, size = measured.pose("top"), dimensions()
    middle = measured.data.geom(f"head{hole}").xpos - X_WT[:3, 3]
    return float(X_WT[:3, 2] @ middle) - size("top.flange") - size("screw.head_height") / 2


def misfit(measured: SettledState, layer: str, hole: int) -> float:
    """Return the distance (m) of a screw's axis from the axis of its hole in the gasket or the top. The distance is
    measured at both ends of the hole, and the greater value is returned.
    """
    axis, mouth = measured.data.site(f"thread{hole}"), measured.data.site(f"{layer}_hole{hole}").xpos
    down = -thickness(layer) * measured.pose(layer)[:3, 2]
    ends = np.array([mouth, mouth + down]) - axis.xpos
    return float(np.hypot(*(ends @ axis.xmat.reshape(3, 3))[:, :2].T).max())


def clearance(measured: SettledState, layer: str, hole: int) -> float:
    """Return the radial clearance (m) of a screw's shank in a hole of the gasket or the top."""
    model = measured.model
    return float(model.site(f"{layer}_hole{hole}").size[0] - model.geom(f"shank{hole}").size[0])


def corner_height(measured: SettledState, layer: str, holes: int) -> float:
    """Return the deviation of a layer's upper face from its nominal height above the base (m), at the screw hole where
    this deviation is greatest.
    """
    X_BW = inverse(measured.pose("base"))
    corners = np.array([measured.data.site(f"{layer}_hole{k}").xpos for k in range(holes)])
    heights = corners @ X_BW[2, :3] + X_BW[2, 3]
    return float(np.abs(heights - under(layer) - thickness(layer)).max())


def pins_away(measured: SettledState) -> float:
    """Measure, for each pin, the distance (m) between the middle of its shoulder and the mouth of its hole in the
    base, and return the greatest distance. A pin may stand in any of the holes for pins, but each hole takes only one
    pin.
    """
    mouths = [
        measured.data.site(f"base_hole{int(hole)}").xpos
        for hole in dimensions().all("base.screw_holes.pinned")
    ]
    pins = [measured.pose(name)[:3, 3] for name in PINS]
    pairs = ([pin - mouth for pin, mouth in zip(pins, order, strict=True)] for order in permutations(mouths))
    return min(float(np.linalg.norm(ways, axis=1).max()) for ways in pairs)


def pins_lean(measured: SettledState) -> float:
    """Return the greatest angle between a pin and the axis of the base (rad)."""
    return max(tilt(measured.relative(name, "base")) for name in PINS)


def thickness(layer: str) -> float:
    """Return the thickness of the gasket, or of the top's flange (m)."""
    return dimensions()("top.flange" if layer == "top" else "gasket.thickness")


def under(layer: str) -> float:
    """Return the nominal height of a layer's underside above the underside of the base (m)."""
    return base_top() + (thickness("gasket") if layer == "top" else 0.0)


def thread_length(measured: SettledState, hole: int) -> float:
    """Return the length of a screw's thread inside its tapped hole (m)."""
    point = inverse(measured.pose("base")) @ measured.pose(f"carrier{hole}")
    return float(base_top() - point[2, 3] - dimensions()("screw.point_length"))


def thread_offset(measured: SettledState, hole: int) -> float:
    """Return the distance of a screw's axis from the mouth of its tapped hole (m)."""
    axis, mouth = measured.data.site(f"thread{hole}"), measured.data.site(f"base_hole{hole}")
    return float(np.hypot(*((mouth.xpos - axis.xpos) @ axis.xmat.reshape(3, 3))[:2]))


def screw_lean(measured: SettledState, hole: int) -> float:
    """Return the angle between a screw and the normal of the base (rad)."""
    axis = measured.data.site(f"thread{hole}").xmat.reshape(3, 3)
    return tilt(inverse(measured.pose("base")) @ pose(axis, np.zeros(3)))


def loosening_torque(measured: SettledState, hole: int) -> float:
    """Return the torque that would turn a screw back (N m): the friction of its thread, minus the torque with
    which the clamping force turns the screw back.
    """
    model = measured.model
    friction = float(model.dof_frictionloss[model.joint(f"thread_turn{hole}").dofadr[0]])
    return friction - dimensions()("screw.pitch") / (2 * pi) * head_force(measured, hole)


def screw_deviation(measured: SettledState, screw: int, hole: int) -> float:
    """Return the greatest difference (m) between a length or radius of a screw and its value in the design. The loose
    screw and the carrier that replaces it in its thread are both measured.
    """
    model, size = measured.model, dimensions()
    length, tip, head = size("screw.length"), size("screw.point_length"), size("screw.head_height")
    shank, point = (size(f"screw.{name}_radius") for name in ("shank", "point"))
    loose = np.flatnonzero(
        (model.geom_bodyid == model.body(f"screw{screw}").id) & (model.geom_conaffinity != 0)
    )
    cylinders = [*loose, *(model.geom(f"{name}{hole}").id for name in ("shank", "head"))]
    made = np.array([(*model.geom_size[geom][:2] * (1, 2), model.geom_pos[geom][2]) for geom in cylinders])
    wide = (size("screw.head_radius"), head, length + head / 2)
    long = (shank, length - tip, (length + tip) / 2)
    drawn = np.array([long, (point, tip, tip / 2), wide, long, wide])
    return float(np.abs(made - drawn).max()) if made.shape == drawn.shape else length


def rotor_deviation(measured: SettledState) -> float:
    """Return the greater of two distances (m): from the rotor to its bearing on the top, and from the end of the crank
    pin to its nominal position.
    """
    model, size = measured.model, dimensions()
    height = size("top.flange") + size("top.hub_height")
    away = measured.relative("rotor", "top")[:3, 3] - (0.0, 0.0, height)
    crank, end = model.geom("crank"), size("rotor.arm_height") + size("rotor.crank_height")
    aside = np.array([*crank.pos[:2], crank.pos[2] + crank.size[1]]) - (-size("rotor.crank_radius"), 0.0, end)
    return float(max(np.linalg.norm(away), np.linalg.norm(aside)))


def rotor_lean(measured: SettledState) -> float:
    """Return the angle between the rotor's axis and the top's axis (rad)."""
    return tilt(measured.relative("rotor", "top"))


def rotor_torque(measured: SettledState) -> float:
    """Turn the rotor all the way round in both directions, and return the greatest torque on the way (N m).

    The result is infinite if the greatest permitted torque does not turn the rotor all the way. The torque is
    measured on a copy of the cell in which everything but the rotor is fixed, and in which any obstacle stops
    the crank.
    """
    model, data = _alone(measured)
    dof, adr = model.joint("rotor").dofadr[0], model.joint("rotor").qposadr[0]
    rest, start = data.qpos.copy(), float(data.qpos[adr])
    steps, greatest = round(_SWING / model.opt.timestep), 0.0
    for i in range(1, steps + 1):
        phase = pi * (1 - cos(pi * i / steps))  # starts and stops gently
        rate = pi**2 / _SWING * sin(pi * i / steps)
        behind = 2 * pi * sin(phase) - (data.qpos[adr] - start)
        slower = 2 * pi * cos(phase) * rate - data.qvel[dof]
        torque = float(np.clip(_GAIN * behind + _DAMPING * slower, -ROTOR_TORQUE, ROTOR_TORQUE))
        if abs(behind) > 2 * _BEHIND:
            return float("inf")
        greatest = max(greatest, abs(torque))
        turned, going = data.qpos[adr], data.qvel[dof]
        data.qpos[:], data.qvel[:], data.qpos[adr], data.qvel[dof] = rest, 0.0, turned, going
        data.qfrc_applied[dof] = torque
        mujoco.mj_step(model, data)
    return greatest


def _alone(measured: SettledState) -> tuple[mujoco.MjModel, mujoco.MjData]:
    """Return a copy of the cell in which only the rotor's joint has friction, only the rotor touches other solid
    shapes, and no equality constraint is active.
    """
    model, rotor = copy.deepcopy(measured.model), measured.model.body("rotor").id
    crank = model.geom_bodyid == rotor
    solid = (model.geom_contype | model.geom_conaffinity) != 0
    model.geom_contype[:], model.geom_conaffinity[:] = crank & solid, ~crank & solid
    model.body_contype[:], model.body_conaffinity[:] = 0, 1
    model.body_contype[rotor] = 1
    model.dof_frictionloss[model.dof_bodyid != rotor] = 0.0
    data = mujoco.MjData(model)
    mujoco.mj_copyData(data, model, measured.data)
    data.eq_active[:] = 0
    return model, data


@dataclass(frozen=True, slots=True, kw_only=True)
class Overlap:
    """The depth of an overlap (m), and the names of the two shapes that overlap."""

    depth: float  # m
    between: str


def deepest(measured: SettledState) -> tuple[Overlap, Overlap]:
    """Return the deepest overlap of a shank or pin with a bore, and the deepest overlap of any other two
    shapes."""
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
    names = (_part(measured, int(geom)) for geom in pairs[worst])
    return Overlap(depth=float(depths[worst]), between=" and ".join(names))


def _part(measured: SettledState, geom: int) -> str:
    """Return the name of the part to which a shape belongs. Its lands and bores are separate bodies, fixed to it."""
    model = measured.model
    body, parent = (int(b) for b in (model.geom_bodyid[geom], model.body_parentid[model.geom_bodyid[geom]]))
    fixed = parent != 0 and model.body_jntnum[body] == 0
    return model.body(parent if fixed else body).name


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
