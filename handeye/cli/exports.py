"""Commands that export worlds, states of runs, and traces to other programs."""

from pathlib import Path
from typing import TYPE_CHECKING, Annotated

from cyclopts import Parameter

from handeye.cli.common import Json, Overwrite, answer, note, say
from handeye.cli.programs import check_task, made_known
from handeye.cli.reports import read_recorded
from handeye.cli.trace_files import RunOrTrace, run_or_newest, trace_file
from handeye.cli.world_options import ANY_WORLD, WorldOptions
from handeye.core.diagnostics import quoted
from handeye.core.errors import BadArgument, CannotWrite
from handeye.core.files import check_place, write_over
from handeye.core.plain_text import counted

if TYPE_CHECKING:
    from handeye.report.recorded import RecordedRun
    from handeye.results.export import Export
    from handeye.runs.exported_state import ExportedState
    from handeye.trace.tables import Format
    from handeye.trace.trace import Trace

State = Annotated[
    Path | None,
    Parameter(
        name="RUN",
        help="The folder of a run, or a checkpoint. Default: the world of --seed, before any run.",
    ),
]


def mjcf(
    run: State = None,
    /,
    *,
    output: Annotated[Path, Parameter(name=["--out", "-o"], help="The folder to write to.")],
    overwrite: Overwrite = False,
    json: Json = False,
    world: WorldOptions = ANY_WORLD,
) -> int:
    """Write a scene that plain MuJoCo can load: scene.xml, its meshes and textures, and a README.

    Exit code 0: written; 2: bad input.
    """
    from handeye.results.export import export_mjcf

    return _told(export_mjcf(output, lambda: _exhibit(run, world), overwrite=overwrite), json=json)


def glb(
    run: State = None,
    /,
    *,
    output: Annotated[Path, Parameter(name=["--out", "-o"], help="File for the solids (.glb).")],
    overwrite: Overwrite = False,
    part: Annotated[str, Parameter(help="What to export: the whole `cell`, or the `pump`.")] = "cell",
    json: Json = False,
    world: WorldOptions = ANY_WORLD,
) -> int:
    """Write the solids of a scene for programs that show or measure shapes; check that each solid is closed and has the
    right mass.

    Exit code 0: written, whatever the checks found; 2: bad input.
    """
    from handeye.results.export import export_glb

    return _told(export_glb(output, lambda: _exhibit(run, world), part=part, overwrite=overwrite), json=json)


def urdf(
    *,
    output: Annotated[Path, Parameter(name=["--out", "-o"], help="File for the arm (.urdf).")],
    overwrite: Overwrite = False,
    json: Json = False,
) -> int:
    """Write the arm to a URDF file, with the dimensions of its drawing, and list the joints of the arm.

    Exit code 0: written; 2: bad input.
    """
    from handeye.results.arm_export import export_urdf

    written = export_urdf(output, overwrite=overwrite)
    return answer(written, tuple(written.lines), json=json)


def _told(written: "Export", *, json: bool) -> int:
    """Report the written files."""
    return answer(written, (f"{written.path}: {written.shows}", *written.remarks), json=json)


def _exhibit(run: Path | None, world: WorldOptions) -> "ExportedState":
    """Return the state to export. Prints a note for each file of the run that cannot be used, and a note if the run is
    not finished. Raises InvalidInput if `run` is neither the folder of a run nor a checkpoint.
    """
    from handeye.runs.exported_state import initial_state, kept_state

    wanted = made_known(world.task)
    if run is None:
        return initial_state(world.spec, world.work.name)
    if world.chosen:
        raise BadArgument(
            f"{run} has its own world; --seed, --level, --without, --set and --scale cannot be given with it"
        )
    exhibit, faults = kept_state(run)
    check_task(wanted, exhibit.task, run)
    for fault in faults:
        note(f"left out: {fault}")
    if exhibit.moment == "unfinished":
        note(f"the run in {run} is not finished; its newest state is exported")
    return exhibit


Folder = Annotated[Path, Parameter(name=["--out", "-o"], help="The folder to write to.")]


def plot(
    run: RunOrTrace = None,
    /,
    *,
    output: Annotated[Path, Parameter(name=["--out", "-o"], help="File for the plot: .png, .svg or .pdf.")],
    overwrite: Overwrite = False,
    stage: Annotated[
        str | None, Parameter(help="Only this stage, given by its number, its name, or part of its name.")
    ] = None,
) -> int:
    """Plot joints, hand force and events of a run against time; needs the extra `plot` (matplotlib).

    Exit code 0: written; 1: written, but the trace was cut short; 2: bad input.
    """
    from handeye.trace.plot import KINDS, drawn
    from handeye.trace.plot import plot as plot_of

    kind = KINDS.get(output.suffix.lower())
    if kind is None:
        raise BadArgument(
            f"the name of a plot must end in {', '.join(KINDS)}, but {quoted(output.name)} does not"
        )
    check_place(output, kind, overwrite=overwrite)
    recorded = read_recorded(run_or_newest(run))
    write_over(output, drawn(plot_of(recorded.trace, stage), output.suffix.lower()), kind)
    say(str(output))
    return _cut(recorded)


def csv(run: RunOrTrace = None, /, *, output: Folder, overwrite: Overwrite = False) -> int:
    """Write tables of a run as CSV, with a README that describes the columns.

    Exit code 0: written; 1: written, but the trace was cut short; 2: bad input.
    """
    return _exported(run_or_newest(run), output, "csv", overwrite=overwrite)


def parquet(run: RunOrTrace = None, /, *, output: Folder, overwrite: Overwrite = False) -> int:
    """Write tables of a run as Parquet, with a README that describes the columns; needs the extra `export` (pyarrow).

    Exit code 0: written; 1: written, but the trace was cut short; 2: bad input.
    """
    return _exported(run_or_newest(run), output, "parquet", overwrite=overwrite)


def _exported(run: Path, output: Path, kind: "Format", *, overwrite: bool) -> int:
    from handeye.trace.tables import export_tables

    recorded: list[RecordedRun] = []

    def trace() -> "Trace":
        recorded.append(read_recorded(run))
        return recorded[0].trace

    written = export_tables(output, trace, kind, overwrite=overwrite)
    said = ", ".join(f"{table.name} ({counted(table.rows, 'row')})" for table in written)
    say(f"{output}: {said}")
    return _cut(recorded[0])


def _cut(recorded: "RecordedRun") -> int:
    """The exit code: 1, with a printed note, if the trace was cut short; 0 if the trace is complete."""
    name = recorded.trace.name
    if recorded.whole or name.endswith(".part"):  # a .part file has a note of its own
        return 0
    note(f"{name} was cut short; only the recorded part is written")
    return 1


def thin(
    run: RunOrTrace = None,
    /,
    *,
    output: Annotated[Path, Parameter(name=["--out", "-o"], help="File for the thinned trace (.mcap).")],
    overwrite: Overwrite = False,
) -> int:
    """Shrink a trace to about a tenth of its size, for sharing; the smaller trace keeps the motion that is needed to
    show the run.

    Every command can read the thinned trace except `trace verify`, which needs the whole trace.
    """
    from handeye.core.files import check_place
    from handeye.trace.reading import TRACE, read_trace
    from handeye.trace.thinning import write_thinned

    whole = trace_file(run_or_newest(run))
    trace = read_trace(whole)
    check_place(output, TRACE)
    if output.exists() and output.samefile(whole):
        raise CannotWrite(f"{output} is the trace to be thinned; choose another file")
    check_place(output, TRACE, overwrite=overwrite)
    kept = write_thinned(trace, output)
    say(f"{output}: {kept} of {counted(len(trace.times), 'servo period')}")
    return 0
