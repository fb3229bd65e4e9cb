"""The command that tries schedules of faults, interruptions and answers."""

import tempfile
from collections.abc import Iterator, Sequence
from contextlib import contextmanager
from pathlib import Path
from typing import TYPE_CHECKING, Annotated

from cyclopts import Parameter

from handeye.cli.common import Camera, Json, TaskWords, WholeNumber, note, positive, put_json, say
from handeye.cli.programs import plan_or_own
from handeye.cli.tally import Tally
from handeye.core.plain_text import counted
from handeye.core.variation import checked_seed
from handeye.tasks import task as known_task

if TYPE_CHECKING:
    from handeye.planfile.plan import Plan
    from handeye.trials.chaos.schedule import Schedule
    from handeye.trials.chaos.trials import Outcome


def chaos_trials(
    *,
    count: Annotated[WholeNumber, Parameter(name="--n", help="Schedules to draw.")] = 100,
    seed: Annotated[
        WholeNumber, Parameter(help="Number from which schedules are drawn, and the first world of theirs.")
    ] = 0,
    worlds: Annotated[WholeNumber, Parameter(help="Worlds to draw from: nominal, low and high in turn.")] = 3,
    schedule: Annotated[
        list[str] | None,
        Parameter(
            help="Try this one, as it was printed; draw none. May be repeated.", consume_multiple=False
        ),
    ] = None,
    checkpoints: Annotated[
        Path | None,
        Parameter(
            help="Folder for the sound runs that schedules begin in: made where they are not there, and kept."
        ),
    ] = None,
    task: TaskWords = None,
    workers: Annotated[WholeNumber, Parameter(help="Processes at a time.")] = 2,
    camera: Camera = "auto",
    json: Json = False,
) -> int:
    """Draw faults, times, worlds, kills, panics, retries and skips together, and check what must always hold.

    A schedule begins somewhere in a sound run and goes on for a few steps, or to the end of the stage: with up to two
    faults that set in there, up to two interruptions (the panic button, a pause, a way back, a process that is killed),
    each of which is taken up again from disk, and an operator who retries, skips, proceeds and aborts. It is carried
    out once more without its interruptions.

    Checked are: no pump is wrong that the program takes for right (`silent`); trace, events and state are the same to
    the byte as without interruptions (`resume`); the brakes are on after every stop (`brakes`); the trace can be read
    and tells what happened (`trace`); nothing is lost on disk (`disk`); and nothing is raised (`error`). A schedule
    that fails is shrunk to the fewest things with which it still does, and printed as a command.

    Each world is carried out once in whole before, which takes a minute of a processor; a schedule takes some seconds.

    Exit code 0: all held; 3: something did not; 2: bad input; 130: interrupted.
    """
    from handeye.trials.chaos.schedule import parse_schedule

    for number, what in ((count, "schedule"), (worlds, "world"), (workers, "worker")):
        positive(number, what)
    checked_seed(seed + worlds)
    given = [parse_schedule(text) for text in schedule or ()]
    plan = plan_or_own(None, task)
    with _folder(checkpoints) as folder:
        drawn = given or _drawn(plan, folder, seed, count, worlds, camera, workers)
        return _tried(drawn, plan, folder, camera=camera, workers=workers, json=json)


@contextmanager
def _folder(named: Path | None) -> Iterator[Path]:
    """The folder of the sound runs; one for now, if nobody names any."""
    if named is not None:
        yield named
        return
    with tempfile.TemporaryDirectory(prefix="handeye-") as name:
        yield Path(name)


def _drawn(
    plan: "Plan", folder: Path, seed: int, count: int, worlds: int, camera: str, workers: int
) -> "list[Schedule]":
    """Schedules, when the worlds that they begin in have been carried out."""
    from handeye.trials.chaos import trials

    specs = trials.worlds(seed, worlds)
    ended = trials.sound_runs(plan, folder, specs, camera, workers)
    tally = Tally(len(specs), "worlds carried out")
    runs = sorted(tally.counting(ended), key=lambda run: run.world.seed)
    return list(trials.schedules(seed, count, runs, known_task(plan.task)))


def _tried(
    drawn: "Sequence[Schedule]", plan: "Plan", folder: Path, *, camera: str, workers: int, json: bool
) -> int:
    """Try schedules, and tell of those that fail as they end; the exit code."""
    from handeye.trials.chaos import trials

    outcomes: list[Outcome] = []
    ended = trials.try_all(drawn, plan, folder, camera, workers)
    try:
        for outcome in Tally(len(drawn), "schedules").counting(ended, None if json else _tell):
            outcomes.append(outcome)
    finally:
        found = trials.summed(outcomes)
        if json:
            put_json(found)
        elif outcomes:
            say(f"{counted(found.n, 'schedule')}, {found.broken} with something that did not hold")
    return 3 if found.broken else 0


def _tell(outcome: "Outcome") -> None:
    """Tell of a schedule that fails: what did not hold, and the command that shows it again."""
    if outcome.shrunk is None:
        return
    for each in outcome.shrunk.broken:
        say(str(each))
    say(f'  handeye trials chaos --schedule "{outcome.shrunk.schedule}"', whole=True)
    if outcome.shrunk.schedule != outcome.drawn.schedule:
        note(f"  shrunk from: {outcome.drawn.schedule}")
