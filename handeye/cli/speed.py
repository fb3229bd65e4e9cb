"""Commands that measure what whole runs take of a processor."""

import time
from typing import Annotated

from cyclopts import App, Parameter

from handeye.cli.common import Camera, Json, WholeNumber, compiled, notes, positive, put_json, screen
from handeye.cli.world_options import ANY_WORLD, WorldOptions
from handeye.core.errors import InvalidInput
from handeye.runs.scripts import default_script


def register(bench: App) -> None:
    """Add the commands to those that measure."""
    bench.command(speed)
    bench.command(growth)


def speed(
    *,
    world: WorldOptions = ANY_WORLD,
    worlds: Annotated[
        WholeNumber, Parameter(help="Worlds to assemble in, one after the other, from --seed on.")
    ] = 1,
    traced: Annotated[
        bool, Parameter(help="Keep trace and checkpoints too, in a folder that is removed afterwards.")
    ] = False,
    camera: Camera = "auto",
    json: Json = False,
) -> int:
    """Assemble and tell where the processor time goes, by phase, component and stage, and what the physics takes alone.

    All times are of the processor, threads included: what else this computer does at the time hardly counts. Every
    second goes to one component, the innermost under way. What measuring itself takes is told.

    The physics alone: the work is done a second time, on tape. The tape has all that the run writes into the
    simulator: controls, forces, figures of the model such as the friction of threads, screws put into their threads,
    the states put back between steps. It is played in a simulator of its own, with nothing between two calls but what
    was written; each step of the program must end in the state of the run, bit for bit. The time of the working phase
    is told as a multiple of that: 1 would be a program that costs nothing. The tape is in no other figure.

    Exit code 0: accepted in every world; 1: in some world the program stopped, the referee disagreed, or the physics
    alone ended elsewhere.
    """
    from dataclasses import replace

    from handeye.results.progress import Progress
    from handeye.runs.setup import Setup
    from handeye.trials.speed import Watching, measure
    from handeye.trials.speed_page import as_json, page

    positive(worlds, "world")
    first = world.spec
    start = time.process_time()
    plan = compiled(default_script())
    planning = time.process_time() - start
    specs = [replace(world, seed=first.seed + number).spec for number in range(worlds)]
    with Progress(plan.program.stages, notes) as progress:
        found = measure(
            [Setup(plan=plan, world=spec, camera=camera, judged=True) for spec in specs],
            plan.program.stages,
            start_cpu_s=start,
            planning_cpu_s=planning,
            traced=traced,
            watching=Watching(observers=[progress], viewed=progress.viewed),
        )
    if json:
        put_json(as_json(found))
    else:
        screen.print(page(found))
    same = all(run.bare is not None and run.bare.apart_s is None for run in found.runs)
    return 0 if same and found.accepted == worlds else 1


def growth(
    *,
    most: Annotated[
        WholeNumber,
        Parameter(help="The largest number of statements; the others are the powers of ten below it."),
    ] = 10_000,
    json: Json = False,
) -> int:
    """Measure how cost grows with the statements of a program, its trace, and the cells in one process.

    A program of so many statements, with a stage and six motions in each hundred, is checked, planned, carried out and
    recorded; its trace is opened, compared and told. And one to three cells carry out such a program of a hundred in
    one process, a step each in turn. Times are of the processor.

    What grows by a power near 1 grows as its cause does: ten times the statements take ten times as long. The power is
    fitted over the last two powers of ten, since most of what a short program takes is what is done once.

    Exit code 0: all times grow linearly, or less; 1: one grows faster.
    """
    from handeye.al.macros import LONGEST
    from handeye.trials.growth import measure
    from handeye.trials.growth_page import page

    if not 1 <= most <= LONGEST:
        raise InvalidInput(f"a program has 1 to {LONGEST} statements, not {most}")
    with notes.status("measuring") as status:
        found = list(measure(most, lambda what: status.update(f"measuring {what}")))
    if json:
        put_json({"grown": [each.as_json() for each in found]})
    else:
        screen.print(page(found))
    return 0 if all(each.is_linear for each in found if each.unit == "cpu_s") else 1
