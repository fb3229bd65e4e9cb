"""The solids of a cell in one file, and what can be said against them."""

from collections.abc import Iterable, Iterator
from dataclasses import dataclass
from itertools import groupby
from typing import Final

from handeye.cell.gltf import glb
from handeye.cell.solids import SolidScene, Weighed
from handeye.core.diagnostics import quoted, suggestion
from handeye.core.errors import NoSuchName
from handeye.core.files import Kind
from handeye.core.plain_text import counted
from handeye.results.exported_scene import told
from handeye.runs.exported_state import ExportedState
from handeye.tasks import task

GLB: Final = Kind("GLB file", rb"glTF", ending=".glb")
WHOLE: Final = "cell"
"""The part that is everything."""
TOLERANCE: Final = 0.01
"""Of a mass: a cylinder is a prism of 64 sides in the file, .2 per cent lighter."""


@dataclass(frozen=True, slots=True, kw_only=True)
class ExportedSolids:
    """The solids of a cell, or of a part of it."""

    file: bytes
    """GLB."""
    solids: int
    open: tuple[str, ...]
    """Names of those whose surface is not closed."""
    weighed: tuple[Weighed, ...]
    """Bodies of which the density is known."""


def exported_solids(exhibit: ExportedState, part: str) -> ExportedSolids:
    """The solids of an exhibit; equal exhibits give equal bytes; raises InvalidInput if its task exports no scene, or
    has no such part.
    """
    exported = task(exhibit.task).exported(exhibit.world, exhibit.truth, exhibit.moment)
    parts = {**exported.parts, WHOLE: None}
    if part not in parts:
        near = suggestion(part, parts) or f"there are {', '.join(map(quoted, parts))}"
        raise NoSuchName(f"there is no part {quoted(part)} to export; {near}")
    scene = SolidScene.of(exported.spec, parts[part])
    return ExportedSolids(
        file=glb(scene, told(exhibit)),
        solids=sum(map(len, scene.bodies.values())),
        open=scene.open,
        weighed=tuple(scene.weighed(exported.densities)),
    )


def checks(exported: ExportedSolids) -> Iterator[str]:
    """What can be said of the solids, a line each."""
    count = counted(exported.solids, "solid")
    yield f"{count}, not closed: {', '.join(exported.open)}" if exported.open else f"{count}, all closed"
    right = [body for body in exported.weighed if agrees(body)]
    if right:
        yield f"by volume and density as heavy as in the model, within {TOLERANCE:.0%}: {_names(right)}"
    wrong = [body for body in exported.weighed if not agrees(body)]
    for (mass, there), bodies in groupby(
        wrong, key=lambda body: (f"{body.mass:.3g}", f"{body.mass_there:.3g}")
    ):
        yield f"by volume and density {mass} kg, and {there} kg in the model: {_names(bodies)}"


def agrees(body: Weighed) -> bool:
    """See whether a body weighs in the model what its volume says."""
    return abs(body.mass - body.mass_there) <= TOLERANCE * body.mass_there


def _names(bodies: Iterable[Weighed]) -> str:
    return ", ".join(body.body for body in bodies)
