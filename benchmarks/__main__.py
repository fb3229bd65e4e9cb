"""The commands of the developers' stopwatches: `python -m benchmarks NAME`, from a checkout."""

import sys
import tempfile
import time
from collections.abc import Sequence
from pathlib import Path
from typing import Annotated, Literal, NoReturn

from cyclopts import App, CycloptsError, Parameter

from benchmarks.peers import Comparison
from handeye.cli.common import (
    Camera,
    Json,
    WholeNumber,
    complain,
    notes,
    positive,
    put_json,
    say,
    screen,
)
from handeye.cli.programs import compiled
from handeye.cli.usage import usage_sentence
from handeye.cli.world_options import ANY_WORLD, WorldOptions
from handeye.core.errors import HandeyeError, InvalidInput
from handeye.runs.scripts import default_script

BAD_INPUT, INTERRUPTED = 2, 130

app = App(
    name="python -m benchmarks",
    help="Measure what handeye costs, and what interrupting it changes.",
    suppress_keyboard_interrupt=False,
    default_parameter=Parameter(negative=""),
    console=screen,
    error_console=notes,
)


def main(words: Sequence[str] | None = None) -> NoReturn:
    """Run a benchmark; the exit code says how it went."""
    try:
        code = app(words, result_action="return_value", exit_on_error=False, print_error=False)
    except CycloptsError as error:
        complain(usage_sentence(error))
        sys.exit(BAD_INPUT)
    except HandeyeError as error:
        complain(error)
        sys.exit(BAD_INPUT)
    except KeyboardInterrupt:
        sys.exit(INTERRUPTED)
    sys.exit(code if isinstance(code, int) else 0)


@app.command
def start(times: Annotated[WholeNumber, Parameter(help="How often each is measured.")] = 15, /) -> int:
    """Measure how soon commands begin: CPU seconds beside those of importing what all of them rest on.

    Exit code 0: none takes more than 1.6 times as long; 1: one does.
    """
    from benchmarks.start import MOST, starts

    slow = 0
    for command, cpu_s, factor in starts(times):
        say(f"{command:24} {cpu_s:.3f} s  {factor:.2f} times")
        slow += factor > MOST
    return 1 if slow else 0


@app.command
def overhead(*, world: WorldOptions = ANY_WORLD, camera: Camera = "auto") -> int:
    """Assemble once and measure the cost of checkpoints and trace, as shares of that run.

    Exit code 0: checkpoints under 2 % and trace under 10 % of the working phase; 1: more.
    """
    from benchmarks.overhead import measure
    from handeye.results.progress import Progress
    from handeye.runs.setup import Setup

    spec = world.spec
    plan = compiled(default_script())
    setup = Setup(plan=plan, world=spec, camera=camera)
    with tempfile.TemporaryDirectory(prefix="handeye-") as folder, Progress(plan.program.stages, notes):
        cost = measure(setup, Path(folder) / "run")
    say(f"working phase without them   {cost.run:6.2f} s of this computer's clock")
    rows = (
        ("checkpoints", cost.checkpoints, f"{cost.kept} of them", 0.02),
        ("trace", cost.tracing, f"{cost.ticks} servo periods, {cost.trace_bytes / 1e6:.1f} MB", 0.10),
    )
    for name, seconds, what, limit in rows:
        share = seconds / cost.run
        say(f"{name:28} {seconds:6.2f} s  {share:6.2%} (at most {limit:.0%})  {what}")
    return 0 if all(seconds / cost.run < limit for _, seconds, _, limit in rows) else 1


@app.command
def language(
    *,
    times: Annotated[WholeNumber, Parameter(help="How often each is measured.")] = 15,
    json: Json = False,
) -> int:
    """Measure the delay of a check, a keystroke and a plan, each time on a new text.

    Exit code 0, also where a median is over its target: that depends on the computer.
    """
    from benchmarks.language import measure

    positive(times, "time")
    measured = []
    for waiting in measure(times):
        measured.append(waiting)
        say(
            f"{waiting.what:26} {waiting.median * 1e3:7.1f} ms  "
            f"({'' if waiting.is_short else 'not '}under {waiting.target * 1e3:.0f} ms)  "
            f"{times} times, {min(waiting.seconds) * 1e3:.1f} to {max(waiting.seconds) * 1e3:.1f} ms",
            notes if json else screen,
        )
    if json:
        put_json({"measured": [waiting.as_json() for waiting in measured]})
    return 0


@app.command
def vision(
    *,
    poses: Annotated[WholeNumber, Parameter(help="How often the part is laid down somewhere.")] = 24,
    times: Annotated[WholeNumber, Parameter(help="How often each is measured.")] = 9,
    camera: Camera = "auto",
    json: Json = False,
) -> int:
    """Measure the eye beside OpenCV, on the same pictures of the cell.

    Exit code 0.
    """
    from benchmarks.sights import sights
    from benchmarks.vision import measure

    positive(poses, "pose")
    positive(times, "time")
    _tell(list(measure(sights(poses, camera), times)), json)
    return 0


@app.command
def ik(
    *,
    poses: Annotated[WholeNumber, Parameter(help="How many poses of the hand there are.")] = 200,
    times: Annotated[WholeNumber, Parameter(help="How often each is measured.")] = 9,
    json: Json = False,
) -> int:
    """Measure the arm's inverse kinematics beside those of the Robotics Toolbox, on the same poses of the hand.

    Exit code 0. The toolbox is large and no part of handeye: where it is not installed, it is not measured.
    """
    from benchmarks.inverse_kinematics import measure
    from handeye.tasks import task

    positive(poses, "pose")
    positive(times, "time")
    _tell([measure(task().arm, poses, times)], json)
    return 0


@app.command
def poses(
    *,
    anywhere: Annotated[WholeNumber, Parameter(help="How many random poses there are.")] = 100_000,
    singular: Annotated[WholeNumber, Parameter(help="How many poses each other set has.")] = 20_000,
) -> int:
    """Try the arm's inverse kinematics on poses that forward kinematics gives from joints within their limits.

    At random, and with joints at limits, the wrist in line, the boom upright; each exact, and to .001 in and .01
    degrees.

    Exit code 0: each is found, within limits, with the hand there; 1: one is not.
    """
    from benchmarks.reached_poses import tried
    from handeye.tasks import task

    positive(anywhere, "pose")
    positive(singular, "pose")
    bad = 0
    for each in tried(task().arm, anywhere, singular):
        bad += each.missed + each.wrong
        off = f"hand off by {each.off:.1e} m and {each.turned:.1e} rad at most"
        say(
            f"{each.what:31} {'written' if each.written else 'exact':7} {each.poses:6} poses, {each.missed} not "
            f"found, {each.wrong} wrong, {off}"
        )
    return 1 if bad else 0


@app.command
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
    second goes to one component, the innermost under way. The cost of measuring is reported.

    The physics alone: the work is done a second time, on tape. The tape has all that the run writes into the
    simulator: controls, forces, figures of the model such as the friction of threads, screws put into their threads,
    the states put back between steps. It is played in a simulator of its own, with nothing between two calls but what
    was written; each step of the program must end in the state of the run, bit for bit. The time of the working phase
    is reported as a multiple of that: 1 would be a program that costs nothing. The tape is in no other figure.

    Exit code 0: accepted in every world; 1: in some world the program stopped, the referee disagreed, or the physics
    alone ended elsewhere.
    """
    from dataclasses import replace

    from benchmarks.speed import Watching, measure
    from benchmarks.speed_page import as_json, page
    from handeye.results.progress import Progress
    from handeye.runs.setup import Setup

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


@app.command
def growth(
    *,
    most: Annotated[
        WholeNumber,
        Parameter(help="The largest number of statements; the others are the powers of ten below it."),
    ] = 10_000,
    json: Json = False,
) -> int:
    """Measure how cost grows with the statements of a program, its trace, and the cells in one process.

    A program of the given length, with a stage and six motions in each hundred, is checked, planned, carried out and
    recorded; its trace is opened, compared and told. And one to three cells carry out such a program of a hundred in
    one process, a step each in turn. Times are of the processor.

    What grows by a power near 1 grows as its cause does: ten times the statements take ten times as long. The power is
    fitted over the last two powers of ten, since most of what a short program takes is what is done once.

    Exit code 0: all times grow linearly, or less; 1: one grows faster.
    """
    from benchmarks.growth import measure
    from benchmarks.growth_page import page
    from handeye.al.macros import MAX_STATEMENTS

    if not 1 <= most <= MAX_STATEMENTS:
        raise InvalidInput(f"a program has 1 to {MAX_STATEMENTS} statements, not {most}")
    with notes.status("measuring") as status:
        found = list(measure(most, lambda what: status.update(f"measuring {what}")))
    if json:
        put_json({"grown": [each.as_json() for each in found]})
    else:
        screen.print(page(found))
    return 0 if all(each.is_linear for each in found if each.unit == "cpu_s") else 1


@app.command
def breaking(
    kind: Annotated[
        Literal["killed", "interrupted", "alone", "stepped"],
        Parameter(
            help="Kill in each stage, press Ctrl-C at random moments, run each stage alone, or step through "
            "and go back ten times."
        ),
    ],
    /,
    *,
    world: WorldOptions = ANY_WORLD,
    count: Annotated[WholeNumber, Parameter(help="How often to press Ctrl-C.")] = 20,
    dismantling: Annotated[
        bool,
        Parameter(
            negative="",
            help="Interrupt the arm while it takes the pump apart: kill it ten times, or press Ctrl-C.",
        ),
    ] = False,
    jobs: Annotated[WholeNumber, Parameter(help="Number of processes that work at the same time.")] = 2,
) -> int:
    """Interrupt runs, resume them, and check that the result is the same.

    Exit code 0: it always is; 1: it is not.
    """
    from benchmarks import breaking as broken_off
    from benchmarks import detours

    positive(jobs, "process")
    positive(count, "time")
    if dismantling and kind not in ("killed", "interrupted"):
        raise InvalidInput(f"--dismantling goes with killed and interrupted, not with {kind}")
    spec = world.spec
    with tempfile.TemporaryDirectory(prefix="handeye-") as name:
        folder = Path(name)
        whole = broken_off.whole_run(folder / "whole", spec.seed, world.words())
        if dismantling:
            whole = broken_off.whole_undo(whole, folder / "apart")
        ways = {
            "killed": lambda: broken_off.killed(whole, folder, jobs),
            "interrupted": lambda: broken_off.interrupted(whole, folder, count, jobs),
            "alone": lambda: broken_off.alone(whole, folder, jobs),
            "stepped": lambda: detours.stepped(whole, folder),
        }
        verdicts = []
        for verdict in ways[kind]():
            verdicts.append(verdict)
            said = "; ".join(verdict.faults) or "the same"
            say(f"{kind} {verdict.name}: {said}")
    good = sum(not verdict.faults for verdict in verdicts)
    say(f"{good} of {len(verdicts)}")
    return 0 if good == len(verdicts) else 1


def _tell(comparisons: Sequence[Comparison], json: bool) -> None:
    """Say what was measured."""
    for comparison in comparisons:
        for line in comparison.lines():
            say(line, notes if json else screen, whole=True)
    if json:
        put_json({"compared": [comparison.as_json() for comparison in comparisons]})


if __name__ == "__main__":
    main()
