"""The commands of the benchmarks: `python -m benchmarks NAME`, from a checkout."""

import sys
import tempfile
import time
from collections.abc import Sequence
from pathlib import Path
from typing import Annotated, Literal, NoReturn

import msgspec
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
from handeye.core.plain_text import counted
from handeye.runs.scripts import default_script

BAD_INPUT, INTERRUPTED = 2, 130

app = App(
    name="python -m benchmarks",
    help="Measure how much time and memory handeye needs, and check that interruptions change no result.",
    suppress_keyboard_interrupt=False,
    default_parameter=Parameter(negative=""),
    console=screen,
    error_console=notes,
)


def main(words: Sequence[str] | None = None) -> NoReturn:
    """Run a benchmark, and exit with its exit code."""
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
def start(times: Annotated[WholeNumber, Parameter(help="How often to measure each command.")] = 15, /) -> int:
    """Measure how fast commands start: their CPU seconds, compared with the time to import the libraries that all
    commands need.

    Exit code 0: no command takes more than 1.6 times as long as this import; 1: some command does.
    """
    from benchmarks.start import MOST, starts

    slow = 0
    for command, cpu_s, factor in starts(times):
        say(f"{command:24} {cpu_s:.3f} s  {factor:.2f} times")
        slow += factor > MOST
    return 1 if slow else 0


@app.command
def overhead(*, world: WorldOptions = ANY_WORLD, camera: Camera = "auto") -> int:
    """Assemble once, and measure how much time checkpoints and trace add to the working phase.

    Exit code 0: checkpoints add less than 2 %, and the trace less than 10 %; 1: one of them adds more.
    """
    from benchmarks.overhead import measure
    from handeye.results.progress import Progress
    from handeye.runs.setup import Setup

    spec = world.spec
    plan = compiled(default_script())
    setup = Setup(plan=plan, world=spec, camera=camera)
    with tempfile.TemporaryDirectory(prefix="handeye-") as folder, Progress(plan.program.stages, notes):
        cost = measure(setup, Path(folder) / "run")
    say(f"working phase without them   {cost.run:6.2f} s of wall-clock time")
    rows = (
        ("checkpoints", cost.checkpoints, counted(cost.kept, "checkpoint"), 0.02),
        (
            "trace",
            cost.tracing,
            f"{counted(cost.ticks, 'servo period')}, {cost.trace_bytes / 1e6:.1f} MB",
            0.10,
        ),
    )
    for name, seconds, what, limit in rows:
        share = seconds / cost.run
        say(f"{name:28} {seconds:6.2f} s  {share:6.2%} (at most {limit:.0%})  {what}")
    return 0 if all(seconds / cost.run < limit for _, seconds, _, limit in rows) else 1


@app.command
def language(
    *,
    times: Annotated[WholeNumber, Parameter(help="How often to measure each delay.")] = 15,
    json: Json = False,
) -> int:
    """Measure how long a check, a keystroke and a plan take, each time with a new text.

    Exit code 0, even if a median is over its target, because times depend on the computer.
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
def proof(
    *,
    planted: Annotated[WholeNumber, Parameter(name="--holes", help="Number of planted holes to try.")] = 50,
    sound: Annotated[WholeNumber, Parameter(name="--variants", help="Number of sound variants to try.")] = 20,
    seed: Annotated[WholeNumber, Parameter(help="Seed of the sample.")] = 0,
) -> int:
    """Plant holes in the pump's program by rule, make sound variants of it by rule, and check that `handeye check
    --prove` finds every hole and accepts every variant. A number greater than the number of holes or variants means
    all of them.

    Exit code 0: every hole was found, and at most one variant in 20 was refused; 1: a hole was not found, or more
    variants were refused.
    """
    from benchmarks.planted import holes, sample, script, variants, verdict
    from handeye.core.variation import WorldSpec
    from handeye.tasks.water_pump.task import WATER_PUMP

    positive(planted, "hole")
    positive(sound, "variant")
    obligations, whole = WATER_PUMP.obligations(WorldSpec(seed=0)), script()
    wrong = []
    for kind, made, count in (("hole", holes(whole), planted), ("variant", variants(whole), sound)):
        drawn = sample(made, count, seed)
        missed = [each for each in drawn if verdict(each, obligations).holds == (kind == "hole")]
        for each in missed:
            say(f"{'not found' if kind == 'hole' else 'refused'}: {each.rule}")
        told = "not found" if kind == "hole" else "refused"
        say(f"{counted(len(drawn), kind)} of {len(made)}: {len(missed)} {told}")
        wrong.append(len(missed) / len(drawn))
    return 0 if wrong[0] == 0 and wrong[1] <= 1 / 20 else 1


@app.command
def vision(
    *,
    poses: Annotated[WholeNumber, Parameter(help="Number of poses in which the camera sees the part.")] = 24,
    times: Annotated[WholeNumber, Parameter(help="How often to measure each method on each picture.")] = 9,
    camera: Camera = "auto",
    json: Json = False,
) -> int:
    """Compare handeye's vision with OpenCV on the same pictures of the cell: time, success and error.

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
    poses: Annotated[WholeNumber, Parameter(help="Number of poses of the hand.")] = 200,
    times: Annotated[WholeNumber, Parameter(help="How often to measure each solver on each pose.")] = 9,
    json: Json = False,
) -> int:
    """Compare the arm's inverse kinematics with those of the Robotics Toolbox, on the same poses of the hand.

    The toolbox is large and no part of handeye. If it is not installed, only handeye is measured. Exit code 0.
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
    anywhere: Annotated[WholeNumber, Parameter(help="Number of random poses.")] = 100_000,
    singular: Annotated[
        WholeNumber, Parameter(help="Number of poses in each set of singular poses.")
    ] = 20_000,
) -> int:
    """Test the arm's inverse kinematics on poses that forward kinematics computes from joint positions within the
    limits.

    The joint positions are random, or singular: joints at their limits, two joint axes of the wrist in line, or the
    boom upright. Each pose is tried exactly, and rounded to .001 in and .01 degrees.

    Exit code 0: for each pose, a solution within the joint limits puts the hand there; 1: some pose has none.
    """
    from benchmarks.reached_poses import tried
    from handeye.tasks import task

    positive(anywhere, "pose")
    positive(singular, "pose")
    bad = 0
    for each in tried(task().arm, anywhere, singular):
        bad += each.missed + each.wrong
        off = f"hand off by at most {each.off:.1e} m and {each.turned:.1e} rad"
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
        WholeNumber,
        Parameter(help="Number of worlds in which to assemble, one after another. The first seed is --seed."),
    ] = 1,
    traced: Annotated[
        bool, Parameter(help="Also write trace and checkpoints, into a folder that is removed afterwards.")
    ] = False,
    camera: Camera = "auto",
    json: Json = False,
) -> int:
    """Assemble, and report the processor time by phase, component and stage, and the time of the physics alone.

    All times are processor times, including all threads, so other work on this computer has little effect. Each moment
    is counted for one component: the one that was called last. The cost of measuring is reported too.

    To measure the physics alone, the work is repeated and recorded on a tape. The tape contains everything that the run
    writes to the simulator: controls, forces, properties of the model such as the friction of threads, screws that
    enter their threads, and the states restored between steps. A second simulator then replays the tape, and does
    nothing else. After each step of the program, its state must be equal to that of the run, bit for bit. The time of
    the working phase is reported as a multiple of the time of this replay; 1 would mean that everything except the
    physics costs nothing. No other figure includes the time of recording and replay.

    Exit code 0: in every world, the referee accepted the work and the replay agreed; 1: in some world, the program
    stopped, the referee disagreed, or the replay ended in a different state.
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
        Parameter(
            help="The largest number of statements. The smaller programs have the powers of ten below it."
        ),
    ] = 10_000,
    json: Json = False,
) -> int:
    """Measure how costs grow with the length of a program, and with the number of cells in one process.

    Programs of several lengths, with a stage and six motions in each hundred statements, are checked, planned, executed
    and recorded. Their traces are opened, compared, and converted to text and arrays. In addition, one to three cells
    in one process execute a program of a hundred statements; they take turns after each step. All times are processor
    times.

    If a cost grows with a power near 1, ten times as many statements cost ten times as much. The power is fitted to the
    longest programs, down to a hundredth of the greatest length, because a short program mainly costs what is done
    once.

    Exit code 0: all times grow linearly or more slowly; 1: some time grows faster.
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
            help="`killed`: kill the run in each stage. `interrupted`: press Ctrl-C at random "
            "moments. `alone`: run each stage separately. `stepped`: step through the run, and go back ten times."
        ),
    ],
    /,
    *,
    world: WorldOptions = ANY_WORLD,
    count: Annotated[WholeNumber, Parameter(help="Number of runs in which Ctrl-C is pressed.")] = 20,
    dismantling: Annotated[
        bool,
        Parameter(
            negative="",
            help="Interrupt the run while the arm takes the pump apart: kill it at ten moments, or press Ctrl-C.",
        ),
    ] = False,
    jobs: Annotated[WholeNumber, Parameter(help="Number of processes that work at the same time.")] = 2,
) -> int:
    """Interrupt runs, resume them, and check that the results are the same as without an interruption.

    Exit code 0: all results are the same; 1: some result differs.
    """
    from benchmarks import breaking as broken_off
    from benchmarks import detours

    positive(jobs, "process")
    positive(count, "time")
    if dismantling and kind not in ("killed", "interrupted"):
        raise InvalidInput(f"--dismantling can be used with `killed` and `interrupted`, not with `{kind}`")
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


@app.command
def turns(
    before: Path,
    after: Path,
    checkpoint: Path,
    /,
    *,
    stages: Annotated[WholeNumber, Parameter(help="Number of stages; 0: all that are left.")] = 0,
) -> int:
    """Run the same stages in two checkouts in turn, from a kept checkpoint, and compare cost and bytes.

    For each stage: CPU seconds in both, and the ratios of CPU seconds per simulated second (work, physics, rest).

    Exit code 0: the same bytes; 1: other bytes.
    """
    from benchmarks.turns import lines, pairs

    done = []
    for pair in pairs(before, after, checkpoint, stages or None):
        done.append(pair)
        notes.print(f"{pair[0].stage}: done")
    for line in lines(done):
        say(line, whole=True)
    return 0 if all(first.digest == second.digest for first, second in done) else 1


@app.command
def simulators(
    folder: Annotated[
        Path, Parameter(help="Folder for the virtual environments of the other libraries (2 GB).")
    ],
    /,
    *,
    rounds: Annotated[WholeNumber, Parameter(help="How often to step each environment.")] = 5,
    seconds: Annotated[WholeNumber, Parameter(help="Simulated time of each measurement, s.")] = 10,
    json: Json = False,
) -> int:
    """Measure how fast the environments of handeye run, beside those of gymnasium-robotics, robosuite and metaworld.

    Each library is installed in a virtual environment of its own, with versions on which it runs. The environments are
    stepped in turn, with random actions of a fifth of their range, and without pictures. All times are processor times.
    Exit code 0.
    """
    from benchmarks.simulators import lines, measure

    positive(rounds, "round")
    positive(seconds, "second")
    costs = list(measure(folder, rounds, seconds, notes.print))
    for line in lines(costs):
        say(line, notes if json else screen, whole=True)
    if json:
        put_json({"measured": [msgspec.to_builtins(cost) for cost in costs]})
    return 0


def _tell(comparisons: Sequence[Comparison], json: bool) -> None:
    """Print what was measured."""
    for comparison in comparisons:
        for line in comparison.lines():
            say(line, notes if json else screen, whole=True)
    if json:
        put_json({"compared": [comparison.as_json() for comparison in comparisons]})


if __name__ == "__main__":
    main()
