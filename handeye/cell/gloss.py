"""Gloss of a scene's materials in people's photographs. The television camera looks at dull surfaces."""

from typing import Final

import mujoco

_TOLD: Final = "gloss/"
"""Begins the names of the figures in which a scene tells how metallic and how rough a material is."""


def polish(scene: mujoco.MjvScene, model: mujoco.MjModel) -> None:
    """Give the shapes of a prepared scene the gloss that is told of their materials."""
    told = _told(model)
    for shape in scene.geoms[: scene.ngeom]:
        if shape.matid in told:
            metallic, roughness = told[shape.matid]
            shape.specular = 0.1 + 0.8 * metallic * (1 - 0.3 * roughness)
            shape.shininess = 0.7 * (1 - roughness)


def _told(model: mujoco.MjModel) -> dict[int, tuple[float, float]]:
    """How metallic and how rough, by the number of the material."""
    figures = {
        model.numeric(number).name: tuple(model.numeric(number).data.tolist())
        for number in range(model.nnumeric)
    }
    return {
        number: figures[name]
        for number in range(model.nmat)
        if (name := _TOLD + model.material(number).name) in figures
    }
