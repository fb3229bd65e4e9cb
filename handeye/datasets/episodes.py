"""Episodes of a data set: recorded runs, each with its outcome. Failures are episodes, too."""

from collections.abc import Iterable, Iterator
from pathlib import Path
from typing import Final, Literal

from handeye.core.errors import BadFile
from handeye.core.record import Record
from handeye.core.variation import WorldSpec
from handeye.results.kept_run import kept_run
from handeye.results.result import Result
from handeye.runs.folder import RESULT, TRACE
from handeye.trace.reading import read_trace
from handeye.trace.trace import Trace

EpisodeOutcome = Literal["right", "false done", "stopped", "not judged"]
"""`right`: the program ended, and the referee accepts the work. `false done`: the program ended, but the referee does
not accept the work. `stopped`: the program did not end. `not judged`: the program ended, and no referee judged the
work.
"""

OUTCOMES: Final[dict[EpisodeOutcome, str]] = {
    "right": "the program ended, and the referee accepted the work",
    "false done": "the program ended as if the work were right, but the referee did not accept it",
    "stopped": "the program noticed a fault and called the operator, or was interrupted",
    "not judged": "the program ended, and no referee judged the work",
}


class Episode(Record, frozen=True, kw_only=True):
    """A recorded run without its frames. A line of `meta/handeye.jsonl` holds one episode."""

    episode: int  # its index in the data set
    task: str
    program: str
    world: WorldSpec
    outcome: EpisodeOutcome
    stopped_at: str | None  # the stage in which the program stopped
    message: str  # the result in a sentence
    wrong: tuple[str, ...]  # findings that the referee did not accept
    interventions: tuple[str, ...]  # of a person or of the caller's code
    renderer: str  # of the television pictures
    versions: dict[str, str]


def runs_in(places: Iterable[Path]) -> tuple[Path, ...]:
    """Find the runs that have a complete trace. `places` are folders of runs, or folders above them. Returns the
    folders of the runs, sorted by name.

    Raises:
        BadFile: a place does not exist, or holds no run.
    """
    found: list[Path] = []
    for place in places:
        if not place.is_dir():
            raise BadFile(f"{place}: there is no such folder")
        inside = sorted(trace.parent for trace in place.rglob(TRACE))
        if not inside:
            raise BadFile(f"{place} holds no run with a {TRACE}")
        found += [run for run in inside if run not in found]
    return tuple(found)


def read_episode(run: Path, number: int) -> tuple[Trace, Episode]:
    """Read a recorded run as the episode with the index `number`. Raises InvalidInput if the run cannot be read or has
    not ended.
    """
    if not (run / RESULT).is_file():
        raise BadFile(f"the run in {run} has not ended; `handeye resume {run}` continues it")
    trace, result = read_trace(run / TRACE), kept_run(run).result
    head = trace.head
    return trace, Episode(
        episode=number,
        task=head.task,
        program=head.program,
        world=head.world,
        outcome=outcome_of(result),
        stopped_at=result.stopped_at,
        message=result.message,
        wrong=tuple(_wrong(result)),
        interventions=result.interventions,
        renderer=head.camera.method,
        versions=head.versions,
    )


def outcome_of(result: Result) -> EpisodeOutcome:
    """Return the word with which a data set describes the outcome of a run."""
    if not result.completed:
        return "stopped"
    if result.assembled is None:
        return "not judged"
    return "right" if result.assembled else "false done"


def _wrong(result: Result) -> Iterator[str]:
    yield from (name for name, check in result.referee.items() if check.refuses)
