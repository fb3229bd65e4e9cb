"""Shapes of the MuJoCo model that pictures and traces show, and what they are called there."""

from typing import Final

import mujoco

BOX: Final = mujoco.mjtGeom.mjGEOM_BOX
CYLINDER: Final = mujoco.mjtGeom.mjGEOM_CYLINDER
MESH: Final = mujoco.mjtGeom.mjGEOM_MESH

SPHERE: Final = mujoco.mjtGeom.mjGEOM_SPHERE

SCENERY: Final = 1
"""Group of the decorative shapes, which the television camera does not see."""
SEEN: Final = 2  # group of the shapes by which a body is seen
PLAIN: Final = 5  # group of the shapes that the television camera sees, where photographs show finer ones
LATENT: Final = 4
"""Group of shapes that an event will show: of screws, for one, that are not in their threads yet."""
