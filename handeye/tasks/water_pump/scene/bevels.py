"""Bevelled edges of blocks and fixtures, for people: photographs show how light breaks on them."""

from itertools import product
from typing import Final

import numpy as np
from manifold3d import Manifold  # type: ignore[import-not-found]  # stubs, but no marker

from handeye.cell.looks import BOX, PLAIN, SEEN
from handeye.core.pose import Array
from handeye.tasks.water_pump.scene import solids
from handeye.tasks.water_pump.scene.shapes import Shaper

BEVEL: Final = 0.0005
"""m"""
_BEVELLED: Final = ("block", "enamel", "red", "iron")
"""Materials of blocks, fixtures and tools."""


def add_bevels(shaper: Shaper) -> None:
    """Show boxes of a scene with bevelled edges; the television camera still sees the boxes."""
    boxes = [geom for geom in shaper.spec.geoms if geom.type == BOX and geom.group == SEEN]
    for box in boxes:
        if box.material in _BEVELLED:
            half = box.size.copy()
            name = "bevelled_" + "_".join(f"{1e6 * side:.0f}" for side in half)
            look = shaper.scenery(box.parent, name, box.material, bevelled(half), box.pos.tolist())
            look.name = box.name and f"{box.name}_bevelled"
            box.group = PLAIN


def bevelled(half: Array) -> solids.Surface:
    """Surface of a box from -`half` to `half` (m) with bevels all around."""
    corners = np.array(list(product((-1.0, 1.0), repeat=3)))
    inner = np.where(np.eye(3, dtype=bool), half, half - BEVEL)
    return solids.surface(Manifold.hull_points((corners[:, None] * inner).reshape(-1, 3)))
