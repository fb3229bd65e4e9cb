"""The command line: parses arguments, wires concrete things together, prints."""

import os
import sys
import time
from pathlib import Path
from typing import Annotated, Literal, NoReturn

from cyclopts import App, CycloptsError, Parameter
from rich.console import Console

from handeye import __version__
from handeye.al import compile_text
from handeye.diagnostics import Diagnostic, as_json, has_errors
from handeye.diagnostics import render as render_diagnostic
from handeye.errors import HandeyeError, InvalidInput
from handeye.files import write_whole
from handeye.plan.plan import Plan
from handeye.plan.store import read_plan, write_plan
from handeye.plan.taught import Taught, load_taught
from handeye.report.result import Result
from handeye.resources import plans
from handeye.source import Source, read_source
from handeye.units import DEGREE, INCH

CameraKind = Literal["auto", "gl", "ray"]
Seed = Annotated[int, Parameter(help="Draws the world: where the base lies, what is off by how much.")]
Camera = Annotated[
    CameraKind, Parameter(help="How pictures are made: OpenGL, ray casting, or what is there.")
]

app = App(
    name="handeye",
    version=__version__,
    help="The Stanford hand-eye pump assembly of 1973: plan, work, judge.",
    suppress_keyboard_interrupt=False,
)
bench = App(name="bench", help="Measure, as ratios in one run.")
trials = App(name="trials", help="Try in many worlds and count.")
app.command(bench)
app.command(trials)

_out = Console(highlight=False)
_err = Console(stderr=True, highlight=False)


def main() -> NoReturn:
    """Run the command line; the exit code says how it went."""
    try:
        code = app(result_action="return_value", exit_on_error=False)
    except CycloptsError:
        sys.exit(2)
    except HandeyeError as error:
        _err.print(f"handeye: {error}", style="red", markup=False, soft_wrap=True)
        sys.exit(2)
    except KeyboardInterrupt:
        _err.print("\nhandeye: interrupted", markup=False)
        sys.exit(130)
    except BrokenPipeError:  # the reader of our output has gone, which is not our trouble
        os.dup2(os.open(os.devnull, os.O_WRONLY), sys.stdout.fileno())
        sys.exit(141)
    sys.exit(code if isinstance(code, int) else 0)


@app.command
def assemble(
    *,
    seed: Seed = 0,
    json: Annotated[
        bool, Parameter(help="One JSON object on standard output, all else on standard error.")
    ] = False,
    out: Annotated[Path | None, Parameter(help="Folder for plan, events, pictures and result.")] = None,
    camera: Camera = "auto",
) -> int:
    """Assemble the water pump: plan, work, judge.

    Exit code 0: assembled; 1: the program stopped and called the operator; 3: the program said done but the
    referee disagrees; 2: bad input.
    """
    started = time.process_time()
    plan = _compile(plans() / "water_pump.al")
    planning = time.process_time() - started
    return _work(plan, seed=seed, json=json, out=out, camera=camera, planning=planning, referee=True)


@app.command
def check(file: Path, *, json: Annotated[bool, Parameter(help="Diagnostics as JSON.")] = False) -> int:
    """Check a script and its taught positions, the arm's reach included; nothing moves."""
    from handeye.arm.stanford import STANFORD
    from handeye.plan.planner import make_plan

    source = read_source(file)
    program, diagnostics = compile_text(source, _taught(file))
    if program is not None:
        diagnostics = [*diagnostics, *make_plan(program, STANFORD)[1]]
    _show(diagnostics, source, json=json)
    if has_errors(diagnostics):
        return 2
    if not json:
        _out.print(f"{file}: no errors", markup=False)
    return 0


@app.command
def plan(file: Path, *, output: Annotated[Path | None, Parameter(name=["--output", "-o"])] = None) -> int:
    """Compile a script into a plan.

    Parameters
    ----------
    output
        Where the plan goes; by default beside the script, with the ending .plan.json.
    """
    target = output or file.with_suffix(".plan.json")
    made = _compile(file)
    write_plan(target, made)
    counts = {"step": made.program.steps, "motion": made.motions, "stage": made.program.stages}
    said = ", ".join(f"{len(items)} {name}{'' if len(items) == 1 else 's'}" for name, items in counts.items())
    _out.print(f"{target}: {said}", markup=False)
    return 0


@app.command
def run(
    file: Path,
    *,
    seed: Seed = 0,
    judge: Annotated[bool, Parameter(help="Have the referee look at the pump afterwards.")] = False,
    json: Annotated[
        bool, Parameter(help="One JSON object on standard output, all else on standard error.")
    ] = False,
    out: Annotated[Path | None, Parameter(help="Folder for plan, events, pictures and result.")] = None,
    camera: Camera = "auto",
) -> int:
    """Carry out a plan in the work cell.

    Exit code 0: the program came to its end; 1: it stopped and called the operator; 3: the referee, if asked,
    disagrees; 2: bad input.
    """
    return _work(read_plan(file), seed=seed, json=json, out=out, camera=camera, planning=0.0, referee=judge)


@app.command
def render(
    *,
    output: Annotated[Path, Parameter(name=["--output", "-o"], help="The picture, PNG.")],
    camera: Annotated[str, Parameter(help="One of the scene's cameras.")] = "studio",
    width: int = 1280,
    height: int = 960,
    seed: Seed = 0,
) -> int:
    """Render a picture of the work cell."""
    from handeye.cell.imperfection import World
    from handeye.cell.photograph import photograph_png
    from handeye.cell.simulated import SimulatedCell

    cell = SimulatedCell(World.sample(_world(seed)), camera="ray")
    write_whole(output, photograph_png(cell.truth, camera, width, height))
    _out.print(f"{output}: {width} x {height}, camera {camera}", markup=False)
    return 0


@bench.command
def timing(*, seed: Seed = 0, camera: Camera = "auto") -> int:
    """Assemble once and print the timing table beside that of 1973."""
    from handeye.report.page import timing as table

    started = time.process_time()
    plan = _compile(plans() / "water_pump.al")
    planning = time.process_time() - started
    result = _watched(plan, seed=seed, camera=camera, planning=planning, referee=False, out=None)
    _out.print(table(result))
    return 0 if result.completed else 1


@trials.command(name="assembly")
def assembly_trials(
    *,
    seeds: Annotated[str, Parameter(help="Worlds to try: a range such as 0-19, or one number.")] = "0-19",
    jobs: Annotated[int, Parameter(help="Processes at a time.")] = 2,
    camera: Camera = "auto",
    out: Annotated[Path | None, Parameter(help="File for the results, one JSON object a line.")] = None,
) -> int:
    """Assemble the pump in many worlds and count.

    Exit code 0: no silent failure; 3: in some world the program said done and the referee disagreed.
    """
    import msgspec

    from handeye.trials.seeds import assemble_many

    chosen = _range(seeds)
    if jobs < 1:
        raise InvalidInput(f"at least one process is needed; {jobs} is too few")
    results = []
    for result in assemble_many(_compile(plans() / "water_pump.al"), chosen, camera=camera, jobs=jobs):
        results.append(result)
        word = {0: "assembled", 1: "stopped", 3: "not right"}[result.exit_code]
        detail = "" if result.exit_code == 0 else f"{result.stopped_at or ''}: {result.message}"
        if result.exit_code == 3:
            detail = "; ".join(f"{c.sentence}: {c.value:.3g}" for c in result.referee.values() if not c.ok)
        speed = f"{result.timing.real_time_factor:4.1f}x"
        _out.print(f"seed {result.seed:4}  {word:10}  {speed}  {detail}", markup=False, soft_wrap=True)
    done = sum(result.exit_code == 0 for result in results)
    silent = sum(result.exit_code == 3 for result in results)
    _out.print(f"{done} of {len(results)} assembled, {silent} silent failures")
    if out is not None:
        write_whole(
            out, b"".join(msgspec.json.encode(r) + b"\n" for r in sorted(results, key=lambda r: r.seed))
        )
    return 3 if silent else 0


def _world(seed: int) -> int:
    if seed < 0:
        raise InvalidInput(f"a seed is a whole number from 0 up; {seed} is not")
    return seed


@trials.command(name="base")
def base_vision_trials(
    count: int = 100,
    *,
    seed: Annotated[int, Parameter(help="Of the first world.")] = 0,
    eye: Annotated[
        Literal["calibrated", "drawn", "true"], Parameter(help="What the program knows of its camera.")
    ] = "calibrated",
    camera: Camera = "auto",
) -> int:
    """Find the base on the belt in many worlds: how often, how exactly, and was it ever taken for another thing.

    The camera is calibrated with 20 simulated sightings for each lens and an arm wrong by .1 in, which is quicker than
    to have the arm show its lamp a hundred times over; `assemble` does that.

    Exit code 0: no wrong pose was accepted; 3: one was.
    """
    from handeye.trials.vision import WITHIN, base_trials

    counts = base_trials(_some(count), _world(seed), renderer=camera, camera=eye)
    x, y, turn = counts.rms
    _out.print(f"found {counts.found} of {counts.tried}, {counts.wrong} of them wrong")
    _out.print(f"{counts.within} within {WITHIN[0] / INCH:.2f} x {WITHIN[1] / INCH:.2f} in")
    _out.print(f"rms error {x / INCH:.3f} in, {y / INCH:.3f} in, {turn / DEGREE:.2f} deg")
    for failure in counts.failures:
        _out.print(failure, markup=False)
    return 3 if counts.wrong else 0


@trials.command(name="gasket")
def gasket_vision_trials(
    count: int = 50,
    *,
    seed: Annotated[int, Parameter(help="Of the first world.")] = 0,
    camera: Camera = "auto",
) -> int:
    """Check the gasket in many worlds: on properly, shifted, absent."""
    from handeye.trials.vision import gasket_trials

    counts = gasket_trials(_some(count), _world(seed), renderer=camera)
    for case, accepted in counts.accepted.items():
        _out.print(f"{case:12} accepted {accepted} of {counts.tried}")
    return 0


def _some(count: int) -> int:
    if count < 1:
        raise InvalidInput(f"at least one world is needed; {count} is too few")
    return count


def _range(text: str) -> list[int]:
    """The seeds that `3` or `0-19` names."""
    first, _, last = text.partition("-")
    if not first.isdecimal() or (last and not last.isdecimal()) or int(last or first) < int(first):
        raise InvalidInput(f"seeds are given as a number or a range such as 0-19; {text!r} is neither")
    return list(range(int(first), int(last or first) + 1))


def _compile(file: Path) -> Plan:
    """The plan of a script, or its diagnostics and the end."""
    from handeye.arm.stanford import STANFORD
    from handeye.plan.planner import make_plan

    source = read_source(file)
    program, diagnostics = compile_text(source, _taught(file))
    if program is not None:
        made, problems = make_plan(program, STANFORD)
        diagnostics = [*diagnostics, *problems]
        if made is not None:
            _show(diagnostics, source, json=False)
            return made
    _show(diagnostics, source, json=False)
    errors = sum(d.severity == "error" for d in diagnostics)
    raise InvalidInput(f"{file} has {errors} error{'s' if errors != 1 else ''}; there is no plan")


def _taught(file: Path) -> Taught:
    """Positions and parts taught for a script, from the file beside it; a script may do without."""
    beside = file.with_suffix(".toml")
    return load_taught(beside) if beside.exists() else Taught()


def _show(diagnostics: list[Diagnostic], source: Source, *, json: bool) -> None:
    if json:
        _out.print_json(data=[as_json(d, source) for d in diagnostics])
        return
    for diagnostic in diagnostics:
        _err.print(render_diagnostic(diagnostic, source), markup=False, soft_wrap=True, end="\n\n")


def _work(
    plan: Plan, *, seed: int, json: bool, out: Path | None, camera: CameraKind, planning: float, referee: bool
) -> int:
    from handeye.report.page import page
    from handeye.report.result import to_json

    result = _watched(plan, seed=seed, camera=camera, planning=planning, referee=referee, out=out)
    if json:
        sys.stdout.buffer.write(to_json(result))
        sys.stdout.flush()
    else:
        _out.print(page(result))
    return result.exit_code


def _watched(
    plan: Plan, *, seed: int, camera: CameraKind, planning: float, referee: bool, out: Path | None
) -> Result:
    """Run a plan with a progress bar on standard error, and keep what it leaves in `out`."""
    from handeye.report.keep import keep, kept_clean
    from handeye.report.progress import Progress
    from handeye.trials.assembly import run_plan
    from handeye.work.events import Event

    events: list[Event] = []
    with kept_clean(out), Progress(plan, _err) as progress:
        finished = run_plan(
            plan, seed=_world(seed), camera=camera, planning_wall_s=planning, referee=referee,
            listeners=(events.append, progress),
        )  # fmt: skip
    if out is not None:
        keep(out, plan, events, finished)
    return finished.result
