"""A toy train. The peg at the front of each wagon goes into the hole at the rear of the vehicle ahead."""

from typing import Final

import mujoco
import numpy as np

from handeye.core.pose import Array

LONG: Final = 0.060  # m, body of a vehicle along y
WIDE: Final = 0.024
HIGH: Final = 0.040
REACH: Final = 0.042  # m from the middle of a body to its hole and to its peg
TAB: Final = (0.010, 0.016)  # m, heights of the lower and upper side of the tab with the hole
PEG: Final = 0.00635  # m, diameter
THICKER: Final = 0.001  # m by which a thick peg is too thick
CLEARANCE: Final = 0.0003  # m: difference of the diameters of hole and peg
TIP: Final = 0.009  # m, height of the lower end of a peg
_SHOULDER: Final = 0.0163  # m, height at which a peg widens
_ARM: Final = 0.024  # m: height of the upper side of the bar that carries a peg
_CHAMFER: Final = 0.001  # m
_RIM: Final = 0.009  # m, outer radius of a tab
_PARTS: Final = 16  # sectors of a ring
_BRASS, _WOOD = 8000.0, 600.0  # kg/m3


def add_vehicle(
    spec: mujoco.MjSpec, name: str, at: tuple[float, float], turned: float, friction: float, clearance: float, *,
    peg: float = PEG, blocked: bool = False,
) -> None:  # fmt: skip
    """Put the engine, or a wagon with its peg, on the table. `at` gives x and y in coordinates of the slides (m).

    Args:
        peg: diameter of the vehicle's peg (m); 0 if the vehicle has lost its peg.
        blocked: whether the vehicle's hole is blocked.
    """
    wagon = name != "engine"
    turn = [np.cos(turned / 2), 0, 0, -np.sin(turned / 2)]
    body = spec.worldbody.add_body(name=name, pos=[at[0], -at[1], 0], quat=turn)
    body.add_freejoint(name=name)
    colour = [0.62, 0.20, 0.16, 1] if wagon else [0.75, 0.62, 0.25, 1]
    rubbing = [friction, 0.003, 0.0001]

    def box(size: tuple[float, float, float], at: tuple[float, float, float]) -> None:
        body.add_geom(
            type=mujoco.mjtGeom.mjGEOM_BOX, size=[each / 2 for each in size], pos=at, friction=rubbing,
            density=_WOOD if wagon else _BRASS, rgba=colour, group=1,
        )  # fmt: skip

    box((WIDE, LONG, HIGH), (0, 0, HIGH / 2))
    tab, neck = TAB[1] - TAB[0], REACH - _RIM - LONG / 2 + 0.002
    box((0.012, neck, tab), (0, -(LONG / 2 + neck / 2), sum(TAB) / 2))  # y of the scene points ahead
    for number in range(_PARTS):
        mesh = f"{name}_ring_{number}"
        spec.add_mesh(name=mesh, uservert=_wedge(number, (PEG + clearance) / 2, tab).ravel().tolist())
        body.add_geom(
            type=mujoco.mjtGeom.mjGEOM_MESH, meshname=mesh, pos=[0, -REACH, TAB[1]], friction=[0.2, 0.003, 0.0001],
            density=_WOOD, rgba=colour, group=1,
        )  # fmt: skip
    if blocked:
        box((0.010, 0.010, tab), (0, -REACH, sum(TAB) / 2))
    if not wagon:
        return
    long = REACH + PEG - LONG / 2
    box((0.012, long, _ARM - _SHOULDER), (0, LONG / 2 + long / 2, (_ARM + _SHOULDER) / 2))
    if not peg:
        return
    body.add_geom(
        name=f"{name}_peg", type=mujoco.mjtGeom.mjGEOM_CYLINDER, size=[peg / 2, (_SHOULDER - TIP) / 2, 0],
        pos=[0, REACH, (_SHOULDER + TIP) / 2], friction=[0.2, 0.003, 0.0001], density=_BRASS,
        rgba=[0.7, 0.7, 0.72, 1], group=1,
    )  # fmt: skip


def _wedge(number: int, radius: float, high: float) -> Array:
    """Return the corners of one sector of a ring. The hole of the ring is chamfered, and the upper side of the ring is
    at z = 0.
    """
    turns = 2 * np.pi * np.array([number, number + 1]) / _PARTS
    flat = np.cos(np.pi / _PARTS)  # so that the sides of the hole touch its circle
    profile = (
        (radius / flat, -high),
        (radius / flat, -_CHAMFER),
        ((radius + _CHAMFER) / flat, 0.0),
        (_RIM, 0.0),
        (_RIM, -high),
    )
    return np.array([(r * np.cos(turn), r * np.sin(turn), z) for turn in turns for r, z in profile])
