"""Command that shows the live cell in a browser."""

from pathlib import Path
from typing import Annotated

from cyclopts import App, Parameter

from handeye.cli.common import Camera, Out, WholeNumber, compiled
from handeye.cli.runs import Overwrite
from handeye.cli.world_options import ANY_WORLD, Faults, WorldOptions, broken
from handeye.errors import InvalidInput
from handeye.planfile.store import read_plan
from handeye.runs.scripts import default_script

DEMO: tuple[str, ...] = ("pace 1x", "continue")
"""What is said to the run of the demo at first."""


def register(app: App) -> None:
    """Add the command to the command line."""
    app.command(view)


def view(
    file: Annotated[
        Path | None,
        Parameter(help="A plan made by `handeye plan` (.plan.json); by default that of the pump."),
    ] = None,
    /,
    *,
    demo: Annotated[
        bool, Parameter(negative="", help="A short program that takes no pictures, and goes by itself.")
    ] = False,
    port: Annotated[WholeNumber, Parameter(help="Port of this computer; 0: any that is free.")] = 0,
    world: WorldOptions = ANY_WORLD,
    fault: Faults = None,
    camera: Camera = "auto",
    out: Out = None,
    overwrite: Overwrite = False,
) -> int:
    """Show the live cell in a browser, and step a run there.

    Prints the address to open, which nobody can guess and no other computer can reach. Any number of pages may look
    on; one drives. Nobody who looks on changes anything of the run, or slows it.

    Exit codes are those of `run`.
    """
    from handeye import resources
    from handeye.cli.job import Job, work
    from handeye.runs.setup import Setup
    from handeye.runs.snapshot import Checkpoint
    from handeye.view.link import Link
    from handeye.view.server import Server

    if demo and file is not None:
        raise InvalidInput("--demo brings its own program; give a plan or --demo")
    if file is not None and file.is_dir():
        raise InvalidInput(f"{file} is a folder; `handeye report` makes a page of the run in one")
    link = Link()
    with Server(link, port) as server:
        plan = (
            read_plan(file) if file else compiled(resources.demo() / "live.al" if demo else default_script())
        )
        setup = Setup(plan=plan, world=broken(world.spec, fault, plan.program), camera=camera)
        for line in DEMO if demo else ():
            link.say(line)
        start = Checkpoint(setup=setup)
        return work(Job(start=start, out=out, overwrite=overwrite, step=True, on_stop="ask", server=server))
