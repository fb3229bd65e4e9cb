"""Writes exports for other programs: one or more files, and a record that describes them."""

from collections.abc import Callable, Iterable, Iterator
from dataclasses import dataclass
from itertools import groupby
from pathlib import Path
from typing import Final, Literal

import msgspec

from handeye.cell.mjcf import MESHES, SCENE, TEXTURES, mjcf_files
from handeye.cell.solids import SolidScene, WeighedBody, glb
from handeye.core.diagnostics import quoted, suggestion
from handeye.core.errors import BadArgument, NoSuchName
from handeye.core.files import Kind, check_place, write_over
from handeye.core.folders import FolderKind, check_folder, write_folder
from handeye.core.plain_text import counted, printable
from handeye.core.record import Record
from handeye.core.variation import WorldSpec
from handeye.core.versions import HANDEYE, versions
from handeye.runs.exported_state import ExportedState, MomentKind
from handeye.tasks import task

README: Final = "README.md"
_MARK: Final = "exported by handeye; README.md describes the scene"
EXPORT: Final = FolderKind(
    name="an export of handeye",
    known_by=SCENE,
    begins=f"<!-- {_MARK} -->".encode(),
    holds=(SCENE, README, f"{MESHES}/*.obj", f"{TEXTURES}/*.png"),
)


def scene_files(exhibit: ExportedState) -> dict[str, bytes]:
    """Return the files of an MJCF export, by name. The same state gives the same bytes. Raises InvalidInput if
    the cell has no scene.
    """
    scene = task(exhibit.task).exported(exhibit.world, exhibit.truth, exhibit.moment)
    files = mjcf_files(scene.spec, _MARK, told(exhibit))
    return {README: _readme(exhibit, scene.about).encode(), **files}


def told(exhibit: ExportedState) -> dict[str, str]:
    """Return the metadata for the files of an export, by name."""
    return {
        "moment": exhibit.moment,
        "shows": shows(exhibit),
        "world": msgspec.json.encode(exhibit.world).decode(),
        "handeye": HANDEYE,
    }


def shows(exhibit: ExportedState) -> str:
    """Return the part of a sentence that says what an export shows."""
    world = f"the world of {exhibit.world}"
    if exhibit.moment == "drawn":
        return f"{world} at its start"
    program = printable(exhibit.program or "")
    done = f"{program} in {world}, after {counted(exhibit.steps, 'step')}"
    if exhibit.moment == "final":
        return f"{done}, at its end"
    where = "" if exhibit.stage is None else f", at “{printable(exhibit.stage)}”"
    return f"{done}{where}: unfinished"


def _readme(exhibit: ExportedState, about: str) -> str:
    made = ", ".join(f"{name} {version}" for name, version in versions().items())
    return f"""# A scene of handeye

This shows {shows(exhibit)}.

`{SCENE}` is a MuJoCo model that needs only the folders next to it:
`mujoco.MjModel.from_xml_path("{SCENE}")`. Its last keyframe, `{exhibit.moment}`,
is the state shown; the model also begins in this state. Lengths are in m, angles in rad, masses in kg. World frame:
origin at a corner of the table, z up, table top z = 0. The texts in `<custom>` give the same facts to programs:
`moment` (`drawn`, `final` or `unfinished`), `shows`, and `world`.

{about.strip()}

Made with {made}.
"""


GLB: Final = Kind("GLB file", rb"glTF", ending=".glb")
WHOLE: Final = "cell"
TOLERANCE: Final = 0.01
"""Greatest relative difference between the mass computed from the file and the mass in the model. Some difference is
expected: in the file, a cylinder is a prism of 64 sides, which is .2 per cent lighter than the cylinder.

"""


@dataclass(frozen=True, slots=True, kw_only=True)
class ExportedSolids:
    """The solids of a cell, or of a part of the cell."""

    file: bytes  # GLB
    solids: int
    open: tuple[str, ...]  # names of bodies whose surface is not closed
    weighed: tuple[WeighedBody, ...]
    """Bodies of known density, each with its computed mass and its mass in the model."""


def exported_solids(exhibit: ExportedState, part: str) -> ExportedSolids:
    """Return the solids of an export. The same state gives the same bytes. Raises InvalidInput if there is no
    part called `part`."""
    exported = task(exhibit.task).exported(exhibit.world, exhibit.truth, exhibit.moment)
    parts = {**exported.parts, WHOLE: None}
    if part not in parts:
        near = suggestion(part, parts) or f"the parts are {', '.join(map(quoted, parts))}"
        raise NoSuchName(f"there is no part {quoted(part)} to export; {near}")
    scene = SolidScene.of(exported.spec, parts[part])
    return ExportedSolids(
        file=glb(scene, told(exhibit)),
        solids=sum(map(len, scene.bodies.values())),
        open=scene.open,
        weighed=tuple(scene.weighed(exported.densities)),
    )


def checks(exported: ExportedSolids) -> Iterator[str]:
    """Yield remarks on the exported solids. Each remark is one line."""
    count = counted(exported.solids, "solid")
    yield f"{count}, not closed: {', '.join(exported.open)}" if exported.open else f"{count}, all closed"
    right = [body for body in exported.weighed if agrees(body)]
    if right:
        yield f"the mass computed from volume and density agrees with the model within {TOLERANCE:.0%}: {_names(right)}"
    wrong = [body for body in exported.weighed if not agrees(body)]
    for (mass, there), bodies in groupby(
        wrong, key=lambda body: (f"{body.mass:.3g}", f"{body.mass_there:.3g}")
    ):
        yield f"the mass computed from volume and density is {mass} kg, but {there} kg in the model: {_names(bodies)}"


def agrees(body: WeighedBody) -> bool:
    """Return True if the mass of a body, computed from its volume and density, agrees within `TOLERANCE` with
    its mass in the model."""
    return abs(body.mass - body.mass_there) <= TOLERANCE * body.mass_there


def _names(bodies: Iterable[WeighedBody]) -> str:
    return ", ".join(body.body for body in bodies)


Shown = Callable[[], ExportedState]
"""Function that makes the state to export. It takes a while, so it is called only after the destination has been
checked.
"""


class Weight(Record, frozen=True, kw_only=True):
    """Two masses (kg) of a body of known metal: one computed from its volume, and one from the simulator's model."""

    body: str
    by_volume: float
    in_model: float


class Export(Record, frozen=True, kw_only=True):
    """Describes an export file that handeye has written."""

    path: str
    format: Literal["mjcf", "glb"]
    moment: MomentKind
    """`drawn` (the initial state), `final` (after the end of the program) or `unfinished` (in between)."""
    shows: str
    """Caption of the export."""
    world: WorldSpec
    solids: int | None = None
    """Number of solids; None if the export is not a GLB file."""
    open: tuple[str, ...] = ()
    """Names of the solids whose surface is not closed."""
    weights: tuple[Weight, ...] = ()
    remarks: tuple[str, ...] = ()
    """Remarks on the solids. Each remark is one line."""


def export_mjcf(path: Path, shown: Shown, *, overwrite: bool) -> Export:
    """Write a scene for MuJoCo to a folder. Raises InvalidInput if the cell has no scene, or if the folder
    cannot be written.
    """
    check_folder(path, EXPORT, overwrite=overwrite)
    exhibit = shown()
    write_folder(path, scene_files(exhibit))
    return Export(
        path=str(path), format="mjcf", moment=exhibit.moment, shows=shows(exhibit), world=exhibit.world
    )


def export_glb(path: Path, shown: Shown, *, part: str = WHOLE, overwrite: bool = False) -> Export:
    """Write the solids of a cell, or of a part of the cell, to a GLB file. Raises InvalidInput if the file
    cannot be written.
    """
    check_place(path, GLB, overwrite=overwrite)
    exhibit = shown()
    made = exported_solids(exhibit, part)
    write_over(path, made.file, GLB)
    return Export(
        path=str(path),
        format="glb",
        moment=exhibit.moment,
        shows=f"{part}, {shows(exhibit)}",
        world=exhibit.world,
        solids=made.solids,
        open=made.open,
        weights=tuple(
            Weight(body=each.body, by_volume=each.mass, in_model=each.mass_there) for each in made.weighed
        ),
        remarks=tuple(checks(made)),
    )


def export(path: Path, shown: Shown, *, part: str | None, overwrite: bool) -> Export:
    """If the path ends in .glb, write the solids to this file. If it does not, write a scene for MuJoCo to a folder
    with this path. Raises InvalidInput if the export cannot be written.
    """
    if path.suffix == GLB.ending:
        return export_glb(path, shown, part=WHOLE if part is None else part, overwrite=overwrite)
    if part is not None:
        raise BadArgument(f"a part must be exported to a file whose name ends in {GLB.ending}, not to {path}")
    return export_mjcf(path, shown, overwrite=overwrite)
