"""The command that shows a cell in a browser: a live run, or a recorded one."""

from pathlib import Path
from threading import Event
from typing import Annotated, Final

from cyclopts import Parameter

from handeye.cli.common import Camera, CameraKind, Out, Overwrite, WholeNumber, note, say
from handeye.cli.panic_button import PanicButton
from handeye.cli.programs import compiled, made_known, plan_or_own
from handeye.cli.reports import page_of
from handeye.cli.teaching import CellOptions, left_unsaved, teacher_of
from handeye.cli.world_options import ANY_WORLD, Faults, WorldOptions, broken
from handeye.core.errors import BadArgument
from handeye.runs.unnamed_runs import newest_run

DEMO: Final = ("pace 1x", "continue")
_RECORDED: Final = (".mcap", ".part", ".jsonl")


def view(
    file: Annotated[
        Path | None,
        Parameter(
            help="A plan made by `handeye plan` (.plan.json), the name of a program, or the folder or trace of a "
            "run. A run is shown as its report. Default: the newest run in the folder `runs`. If there is no run, "
            "or if a world or --out is given, the default is the plan of the pump."
        ),
    ] = None,
    /,
    *,
    demo: Annotated[
        bool,
        Parameter(
            negative="",
            help=(
                "Run a program of handeye's own, in real time: it inserts a pin into a hole, and takes no pictures."
            ),
        ),
    ] = False,
    teach: Annotated[
        Path | None,
        Parameter(
            help="Teach positions in the browser, as `handeye teach` does in the terminal; no plan runs. Give a "
            "taught file, or the script to which the taught file belongs."
        ),
    ] = None,
    port: Annotated[WholeNumber, Parameter(help="Port on this computer; 0 for any free port.")] = 0,
    world: WorldOptions = ANY_WORLD,
    fault: Faults = None,
    camera: Camera = "auto",
    out: Out = None,
    overwrite: Overwrite = False,
) -> int:
    """Step through a run or teach positions in a browser, which shows the live cell. Or show a recorded run.

    Prints the address to open, which contains a secret and works on this computer only. Several pages can show the
    run, but only one page controls the run; the other pages neither change nor slow the run. The exit codes are those
    of `handeye run` or, with --teach, those of `handeye teach`. For a recorded run, Ctrl-C ends the command with exit
    code 0.
    """
    from handeye.cli.job import Job, work
    from handeye.core import resources
    from handeye.runs.setup import Setup
    from handeye.runs.snapshot import Checkpoint
    from handeye.view.link import Link
    from handeye.view.server import Server

    if demo and file is not None:
        raise BadArgument("--demo has its own program; give either a plan or --demo")
    if teach is not None:
        if demo or file is not None or out is not None or overwrite:
            raise BadArgument("--teach runs no plan and saves no run; leave out the plan, --demo and --out")
        return _teach(teach, port, world, fault, camera)
    if file is not None and (file.is_dir() or file.suffix in _RECORDED):
        made_known(world.task)
        if world.chosen or fault or camera != "auto" or out is not None or overwrite:
            raise BadArgument(f"{file} is a recorded run; it takes no option except --port")
        return _play(file, port)
    untold = not (demo or world.chosen or world.task or fault or camera != "auto" or out is not None)
    if file is None and untold and (newest := newest_run()) is not None:
        note(
            f"showing the newest run, {newest}; `handeye view water_pump` begins a new run, which you control step "
            "by step"
        )
        return _play(newest, port)
    link = Link()
    with Server(link, port) as server:
        plan = compiled(resources.plans() / "insertion.al") if demo else plan_or_own(file, world.task)
        world = world.of(plan.task)
        setup = Setup(plan=plan, world=broken(world.spec, fault, world.work, plan.program), camera=camera)
        for line in DEMO if demo else ():
            link.say(line)
        start = Checkpoint(setup=setup)
        return work(Job(start=start, out=out, overwrite=overwrite, step=True, on_stop="ask", server=server))


def _play(run: Path, port: int) -> int:
    """Show the report of a run until Ctrl-C; raises InvalidInput if there is no such run, or the port is
    unavailable.
    """
    from handeye.view.link import Link
    from handeye.view.server import Server

    with Server(Link(), port) as server:
        note("making the page")
        server.show(page_of(run))
        say(server.access.address, whole=True)
        try:
            Event().wait()
        except KeyboardInterrupt:
            note("")
    return 0


def _teach(file: Path, port: int, world: WorldOptions, fault: Faults, camera: CameraKind) -> int:
    """Serve a page for teaching positions; raises InvalidInput if a file, an option or the port cannot be used."""
    from handeye.debugger.live import Pace
    from handeye.teaching.teach_commands import TeachSession
    from handeye.view.link import Link
    from handeye.view.server import Server
    from handeye.view.teaching import Watch, teaching_page
    from handeye.view.teaching import teach as teach_there

    link = Link()
    watch = Watch(link, Pace(factor=1.0))  # a user who jogs the arm wants to see it move
    with PanicButton() as panic, Server(link, port) as server:
        cell = CellOptions(world=world, fault=fault, camera=camera)
        teacher = teacher_of(file, lambda: panic() or link.panic(), cell, watch)
        assert watch.newest is not None
        note("making the page")
        server.show(teaching_page(teacher, watch.newest), watch.newest)
        say(server.access.address, whole=True)
        try:
            teach_there(TeachSession(teacher), link, panic.aside)
        finally:
            unsaved = left_unsaved(teacher)
    return 2 if unsaved else 0
