"""Overlap of the parts of the cell, whatever the contact classes of the scene let meet.

Left out are pairs that overlap as they are drawn: lands and seats, which stand for flat metal around holes that other
shapes have; flange and casting, drawn whole over screw holes, with what passes those; the arm with itself; and, as in
all of MuJoCo, a body with what is hinged to it: a tapped hole with its screw.
"""

from dataclasses import dataclass
from functools import reduce

import numpy as np
from numpy.typing import NDArray

from handeye.judge.measured import Measured
from handeye.tasks.water_pump.scene.arm import ARM

FASTENER = 8
BORE = 4 | 512
FLAT = 16 | 32 | 64 | 128
PIERCED = 256
"""Contact bits of scenes/water_pump/workcell.xml."""

Mask = NDArray[np.bool_]


@dataclass(frozen=True, slots=True, kw_only=True)
class Overlap:
    """The deepest of some overlaps."""

    depth: float
    """m"""
    between: str


def deepest(measured: Measured) -> tuple[Overlap, Overlap]:
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


def _worst(measured: Measured, pairs: NDArray[np.int32], depths: NDArray[np.float64]) -> Overlap:
    if not depths.any():
        return Overlap(depth=0.0, between="nothing")
    worst = int(np.argmax(depths))
    names = (measured.model.body(measured.model.geom_bodyid[g]).name for g in pairs[worst])
    return Overlap(depth=float(depths[worst]), between=" and ".join(names))


@dataclass(frozen=True, slots=True, kw_only=True)
class _Kinds:
    """Which geoms are what, shape (geoms,)."""

    solid: Mask
    pierced: Mask
    fastener: Mask
    """Pins, loose screws, and screws in their threads."""
    shank: Mask
    """What goes through bores: fasteners without heads."""
    bore: Mask
    arm: Mask

    @classmethod
    def of(cls, measured: Measured) -> "_Kinds":
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
