"""Names for MuJoCo's shape types, and for the geom groups that decide where a shape is seen."""

from typing import Final

import mujoco

BOX: Final = mujoco.mjtGeom.mjGEOM_BOX
CYLINDER: Final = mujoco.mjtGeom.mjGEOM_CYLINDER
MESH: Final = mujoco.mjtGeom.mjGEOM_MESH

SPHERE: Final = mujoco.mjtGeom.mjGEOM_SPHERE

SCENERY: Final = 1
"""Geom group of decorative shapes, which the television camera does not see."""
SEEN: Final = 2  # group of the shapes that show a body
PLAIN: Final = 5  # group of shapes for the television camera; photographs show finer shapes instead
LATENT: Final = 4
"""Geom group of shapes that appear only after an event. For example, the screw of a thread is in this group while the
thread is empty.
"""
