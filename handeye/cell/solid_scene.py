"""A scene as bodies with their solids, and what can be found out about these: are they closed, what do they weigh."""

from collections.abc import Collection, Iterator, Mapping, Sequence
from dataclasses import dataclass
from typing import Self

import mujoco
import trimesh

from handeye.cell.solids import Solid, placed, solids_of


@dataclass(frozen=True, slots=True, kw_only=True)
class Weighed:
    """A body that is of metal throughout, weighed by its volume."""

    body: str
    mass: float
    """By volume and density, kg."""
    mass_there: float
    """In the scene, kg."""


@dataclass(frozen=True, slots=True, kw_only=True)
class SolidScene:
    """Bodies of a scene with their solids."""

    spec: mujoco.MjSpec
    model: mujoco.MjModel
    """The specification, compiled."""
    bodies: Mapping[str, tuple[Solid, ...]]
    """By the names of bodies, as in the scene."""

    @classmethod
    def of(cls, spec: mujoco.MjSpec, wanted: Collection[str] | None) -> Self:
        """Those of some bodies, by default of all, the world itself with what stands around for people included."""
        model = spec.compile()
        bodies = [body for body in spec.bodies if wanted is None or body.name in wanted]
        return cls(
            spec=spec, model=model, bodies={body.name: tuple(solids_of(spec, model, body)) for body in bodies}
        )

    @property
    def open(self) -> tuple[str, ...]:
        """Names of the solids whose surface is not closed."""
        found = (solid for body in self.bodies.values() for solid in body if not solid.shape.is_watertight)
        return tuple(dict.fromkeys(solid.name for solid in found))

    def weighed(self, densities: Mapping[str, float]) -> Iterator[Weighed]:
        """The bodies of which every solid has a density, by the names of the solids, kg/m3."""
        for name, body in self.bodies.items():
            if body and all(solid.name in densities for solid in body):
                mass = float(self.model.body(name).mass[0])
                yield Weighed(body=name, mass=_mass(body, densities), mass_there=mass)


def _mass(body: Sequence[Solid], densities: Mapping[str, float]) -> float:
    """Mass of solids by their volumes, kg; what lies in two of one density counts once."""
    total = 0.0
    for density in sorted({densities[solid.name] for solid in body}):
        shapes = [placed(solid) for solid in body if densities[solid.name] == density]
        total += density * float(trimesh.boolean.union(shapes).volume)
    return total
