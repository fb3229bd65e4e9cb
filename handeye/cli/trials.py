"""Commands that try things in many worlds and count."""

import re
import tempfile
from pathlib import Path
from typing import TYPE_CHECKING, Annotated, Final, Literal

from cyclopts import App, Parameter

from handeye.cli.common import Camera, Json, WholeNumber, compiled, note, put_line, say
from handeye.cli.world_options import (
    ANY_ERRORS,
    ANY_WORLD,
    ErrorOptions,
    Faults,
    WorldOptions,
    broken,
    stage_of,
)
from handeye.errors import InvalidInput
from handeye.files import Kind, check_place, write_over
from handeye.runs.scripts import default_script
from handeye.tasks import task
from handeye.variation import WorldSpec

if TYPE_CHECKING:
    from handeye.trials.faults import FaultTrial

OUTCOMES: Final = Kind("list of outcomes", rb'\{"fault":')
RESULTS: Final = Kind("list of results", rb'\{"assembled":')


def register(app: App) -> None:
    """Add the commands to the command line."""
    trials = App(name="trials", help="Try in many worlds and count.")
    trials.command(assembly_trials, name="assembly")
    trials.command(base_vision_trials, name="base")
    trials.command(gasket_vision_trials, name="gasket")
    trials.command(breaking_trials, name="breaking")
    trials.command(fault_trials, name="faults")
    app.command(trials)


def assembly_trials(
    *,
    seeds: Annotated[str, Parameter(help="Worlds to try: a range such as 0-19, or one number.")] = "0-19",
    errors: ErrorOptions = ANY_ERRORS,
    fault: Faults = None,
    jobs: Annotated[WholeNumber, Parameter(help="Processes at a time.")] = 2,
    camera: Camera = "auto",
    out: Annotated[Path | None, Parameter(help="File for the results, one JSON object a line.")] = None,
) -> int:
    """Assemble in many worlds and count.

    Exit code 0: no silent failure; 3: in some world the program said done and the referee disagreed.
    """
    import msgspec

    from handeye.trials.seeds import assemble_many

    chosen = _range(seeds)
    _some(jobs, "process")
    if out is not None:
        check_place(out, RESULTS)
    results = []
    plan = compiled(default_script())
    worlds = [broken(errors.spec(seed), fault, plan.program) for seed in chosen]
    for result in assemble_many(plan, worlds, camera=camera, jobs=jobs):
        results.append(result)
        word = {0: "assembled", 1: "stopped", 3: "not right"}[result.exit_code]
        detail = f"{result.stopped_at or ''}: {result.message}"
        if result.exit_code == 0:
            detail = "; ".join(f"caution: {sentence}" for sentence in result.cautions)
        if result.exit_code == 3:
            detail = "; ".join(check.told for check in result.referee.values() if check.refuses)
        speed = f"{result.timing.real_time_factor:4.1f}x"
        say(f"seed {result.seed:4}  {word:10}  {speed}  {detail}")
    done = sum(result.exit_code == 0 for result in results)
    silent = sum(result.exit_code == 3 for result in results)
    say(f"{done} of {len(results)} assembled, {silent} silent failures")
    if out is not None:
        lines = (msgspec.json.encode(r) + b"\n" for r in sorted(results, key=lambda r: r.seed))
        write_over(out, b"".join(lines), RESULTS)
    return 3 if silent else 0


def fault_trials(
    *,
    only: Annotated[
        list[str] | None,
        Parameter(
            help="A fault or a group of them; may be repeated. By default all.", consume_multiple=False
        ),
    ] = None,
    stage: Annotated[
        str | None, Parameter(help="Let what can set in while the cell works set in with this stage.")
    ] = None,
    world: WorldOptions = ANY_WORLD,
    jobs: Annotated[WholeNumber, Parameter(help="Processes at a time.")] = 2,
    camera: Camera = "auto",
    json: Json = False,
    out: Annotated[Path | None, Parameter(help="File for the outcomes, one JSON object a line.")] = None,
) -> int:
    """Assemble once with each fault, at its usual size, and tell where it is noticed and by which error.

    Exit code 0: every fault was noticed or did no harm; 3: with some fault the program said done, although the pump was
    wrong or the fault should have been noticed.
    """
    import msgspec

    from handeye.trials.faults import GOOD, chosen, counted_verdicts, try_faults

    spec, plan = world.spec, compiled(default_script())
    kinds = chosen(task().faults(spec.seed), only or ())
    number = None if stage is None else stage_of(plan.program)(stage)
    _some(jobs, "process")
    if out is not None:
        check_place(out, OUTCOMES)
    tried = []
    for trial in try_faults(plan, spec, kinds, stage=number, camera=camera, jobs=jobs):
        tried.append(trial)
        line = msgspec.json.encode(trial).decode()
        if json:
            put_line(line)
        else:
            say(_told(trial))
    (note if json else say)(f"{len(tried)} faults: {counted_verdicts(tried)}")
    if out is not None:
        lines = (msgspec.json.encode(trial) + b"\n" for trial in sorted(tried, key=lambda each: each.fault))
        write_over(out, b"".join(lines), OUTCOMES)
    return 0 if all(trial.verdict in GOOD for trial in tried) else 3


def _told(trial: "FaultTrial") -> str:
    """A line on a run with a fault."""
    where = "" if trial.line is None else f"“{trial.stage}”, line {trial.line}: "
    number = "" if trial.error is None else f"error {trial.error}: "
    return f"{trial.fault:32}  exit {trial.exit_code}  {trial.verdict:9}  {where}{number}{trial.message}".rstrip()


def base_vision_trials(
    count: WholeNumber = 100,
    /,
    *,
    world: WorldOptions = ANY_WORLD,
    eye: Annotated[
        Literal["calibrated", "drawn", "true"], Parameter(help="What the program knows of its camera.")
    ] = "calibrated",
    camera: Camera = "auto",
) -> int:
    """Find the base on the belt in many worlds: how often, how exactly, and how often wrongly.

    Calibrates the camera with 20 simulated sightings for each lens and an arm wrong by .1 in, which is quicker than
    showing the lamp a hundred times, as `assemble` does.

    Exit code 0: no wrong pose was accepted; 3: one was.

    Parameters
    ----------
    count
        Worlds to try, from --seed on.
    """
    return _vision_trial("base", count, world.spec, camera, eye)


def gasket_vision_trials(
    count: WholeNumber = 50,
    /,
    *,
    world: WorldOptions = ANY_WORLD,
    camera: Camera = "auto",
) -> int:
    """Check the gasket in many worlds: on properly, shifted, absent.

    Exit code 0: no shifted or absent gasket was accepted; 3: one was.

    Parameters
    ----------
    count
        Worlds to try, from --seed on.
    """
    return _vision_trial("gasket", count, world.spec, camera, "calibrated")


def _vision_trial(name: str, count: int, first: WorldSpec, camera: str, eye: str) -> int:
    tried = task().trials[name](_some(count), first, camera, eye)
    for line in tried.lines:
        say(line)
    return 3 if tried.wrong else 0


def _some(count: int, what: str = "world") -> int:
    if count < 1:
        raise InvalidInput(f"at least one {what} is needed; {count} is too few")
    return count


def _range(text: str) -> range:
    """The seeds that `3` or `0-19` names."""
    found = re.fullmatch(r"([0-9]{1,19})(?:-([0-9]{1,19}))?", text)
    first, last = (0, -1) if found is None else (int(found[1]), int(found[2] or found[1]))
    if last < first:
        raise InvalidInput(f"seeds are given as a number or a range such as 0-19; {text!r} is neither")
    return range(first, last + 1)


def breaking_trials(
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
    jobs: Annotated[WholeNumber, Parameter(help="Processes at a time.")] = 2,
) -> int:
    """Interrupt runs, resume them, and check that the result is the same.

    Exit code 0: it always is; 1: it is not.
    """
    from handeye.trials import breaking, detours

    _some(jobs, "process")
    _some(count, "time")
    spec = world.spec
    with tempfile.TemporaryDirectory(prefix="handeye-") as name:
        folder = Path(name)
        whole = breaking.whole_run(folder / "whole", spec.seed, world.words())
        ways = {
            "killed": lambda: breaking.killed(whole, folder, jobs),
            "interrupted": lambda: breaking.interrupted(whole, folder, count, jobs),
            "alone": lambda: breaking.alone(whole, folder, jobs),
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
