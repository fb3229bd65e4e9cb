"""What is handed to other programs, written where somebody says, and told as a record."""

from collections.abc import Callable
from pathlib import Path
from typing import Literal

from handeye.core.errors import BadArgument
from handeye.core.files import check_place, write_over
from handeye.core.folders import check_folder, write_folder
from handeye.core.record import Record
from handeye.core.variation import WorldSpec
from handeye.results.exported_scene import EXPORT, scene_files, shows
from handeye.results.exported_solids import GLB, WHOLE, ExportedSolids, checks, exported_solids
from handeye.runs.exported_state import ExportedState, MomentKind

Shown = Callable[[], ExportedState]
"""Makes what is exported; it takes a while, so it is asked for after the place has been looked at."""


class Weight(Record, frozen=True, kw_only=True):
    """What a body of known metal weighs, kg."""

    body: str
    by_volume: float
    in_model: float


class Export(Record, frozen=True, kw_only=True):
    """An export that was written."""

    path: str
    format: Literal["mjcf", "glb"]
    moment: MomentKind
    """`drawn`: before anything happened; `final`: the program has come to its end; `unfinished`."""
    shows: str
    """What it shows, for people."""
    world: WorldSpec
    solids: int | None = None
    """How many there are; None: it is no GLB file."""
    open: tuple[str, ...] = ()
    """Names of those whose surface is not closed."""
    weights: tuple[Weight, ...] = ()
    remarks: tuple[str, ...] = ()
    """What the solids are found to be, a line each."""


def export_mjcf(path: Path, shown: Shown, *, overwrite: bool) -> Export:
    """Write the folder of a scene; raises InvalidInput if it cannot be written there, there is nothing to show, or its
    task exports no scene.
    """
    check_folder(path, EXPORT, overwrite=overwrite)
    exhibit = shown()
    write_folder(path, scene_files(exhibit))
    return Export(
        path=str(path), format="mjcf", moment=exhibit.moment, shows=shows(exhibit), world=exhibit.world
    )


def export_glb(path: Path, shown: Shown, *, part: str = WHOLE) -> Export:
    """Write the solids of a cell, or of a part of it, in the place of any GLB file that is there; raises InvalidInput
    if it cannot be written there, there is nothing to show, or its task has no such part.
    """
    check_place(path, GLB)
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
        weights=tuple(_weights(made)),
        remarks=tuple(checks(made)),
    )


def _weights(made: ExportedSolids) -> list[Weight]:
    return [Weight(body=each.body, by_volume=each.mass, in_model=each.mass_there) for each in made.weighed]


def export(path: Path, shown: Shown, *, part: str | None, overwrite: bool) -> Export:
    """Write solids to a file whose name ends in .glb, and a scene to any other folder; raises InvalidInput if it cannot
    be written there, or a part of a scene is asked for.
    """
    if path.suffix == GLB.ending:
        return export_glb(path, shown, part=WHOLE if part is None else part)
    if part is not None:
        raise BadArgument(f"a part goes into a file whose name ends in {GLB.ending}, not into {path}")
    return export_mjcf(path, shown, overwrite=overwrite)
