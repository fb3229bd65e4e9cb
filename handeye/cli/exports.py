"""Commands that hand worlds, and what runs have left, to other programs."""

from pathlib import Path
from typing import TYPE_CHECKING, Annotated

from cyclopts import Parameter

from handeye.cli.common import Json, note, put_json, say
from handeye.cli.programs import check_task, made_known
from handeye.cli.world_options import ANY_WORLD, WorldOptions
from handeye.core.errors import BadArgument
from handeye.tasks import planned

if TYPE_CHECKING:
    from handeye.results.export import Export
    from handeye.runs.exported_state import ExportedState

Run = Annotated[
    Path, Parameter(help="The folder of a run, or a checkpoint; without one, a world as it is drawn.")
]


def mjcf(
    run: Run | None = None,
    /,
    *,
    output: Annotated[Path, Parameter(name=["--output", "-o"], help="The folder to write.")],
    overwrite: Annotated[bool, Parameter(help="Replace the export that is in the folder.")] = False,
    json: Json = False,
    world: WorldOptions = ANY_WORLD,
) -> int:
    """Write a scene that plain MuJoCo opens: scene.xml, its meshes and textures, and a README.

    Exit code 0: it is written; 2: bad input.
    """
    from handeye.results.export import export_mjcf

    return _told(export_mjcf(output, lambda: _exhibit(run, world), overwrite=overwrite), json=json)


def glb(
    run: Run | None = None,
    /,
    *,
    output: Annotated[Path, Parameter(name=["--output", "-o"], help="The file, .glb.")],
    part: Annotated[str, Parameter(help="What of it: `cell` or `pump`.")] = "cell",
    json: Json = False,
    world: WorldOptions = ANY_WORLD,
) -> int:
    """Write solids for programs that show or measure shapes, and check that they are closed and weigh what they should.

    Exit code 0: it is written, whatever the checks found; 2: bad input.
    """
    from handeye.results.export import export_glb

    return _told(export_glb(output, lambda: _exhibit(run, world), part=part), json=json)


def _told(written: "Export", *, json: bool) -> int:
    """Tell what was written."""
    if json:
        put_json(written)
    else:
        for line in (f"{written.path}: {written.shows}", *written.remarks):
            say(line)
    return 0


def _exhibit(run: Path | None, world: WorldOptions) -> "ExportedState":
    """What is to be exported; a note says what is wrong with it. Raises InvalidInput if there is no such run."""
    from handeye.runs.exported_state import initial_state, kept_state

    wanted = made_known(world.task)
    if run is None:
        return initial_state(world.spec, planned(world.work).name)
    if world.chosen:
        raise BadArgument(
            f"{run} brings its own world; --seed, --level, --without and --set do not go with it"
        )
    exhibit, faults = kept_state(run)
    check_task(wanted, exhibit.task, run)
    for fault in faults:
        note(f"left out: {fault}")
    if exhibit.moment == "unfinished":
        note(f"the run in {run} is not finished")
    return exhibit
