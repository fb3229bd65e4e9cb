"""The result of the agents' bench: scores as a record, and as a table."""

from collections.abc import Sequence
from typing import Final

import msgspec

from handeye.agents.bench_task import PASSED, PROTOCOL
from handeye.agents.judging import Verdict
from handeye.core.record import Record
from handeye.core.versions import HANDEYE


class TaskScore(Record, frozen=True, kw_only=True):
    """The score of an entrant in one task."""

    task: str
    title: str
    language: str
    tier: str
    worlds: int
    accepted: int
    silent: int
    stopped: int
    score: float  # (accepted - 2 silent) / worlds: from -2 to 1
    rounds: int  # effort: how often the command was run
    wall_s: float  # effort: wall-clock time of the command
    verdicts: tuple[Verdict, ...]

    @property
    def passed(self) -> bool:
        """True if the task is passed."""
        return self.score >= PASSED


class BenchResult(Record, frozen=True, kw_only=True):
    """The result of an entrant."""

    protocol: int = PROTOCOL
    handeye: str = HANDEYE
    entrant: str
    feedback: str
    seeds: str  # `public` or `hidden`
    tasks: tuple[TaskScore, ...]

    @property
    def score(self) -> float:
        """The mean of the scores of all tasks."""
        return round(sum(each.score for each in self.tasks) / len(self.tasks), 4)


def score_of(found: Sequence[Verdict]) -> float:
    """Return (a - 2 s) / n for the verdicts in n worlds, of which a are `accepted` and s are `silent`."""
    accepted, silent = (sum(each.outcome == word for each in found) for word in ("accepted", "silent"))
    return round((accepted - 2 * silent) / len(found), 4)


def scored(
    task: str, title: str, language: str, tier: str, found: Sequence[Verdict], *, rounds: int, wall_s: float
) -> TaskScore:
    """Count the verdicts on a solution, and compute its score."""
    accepted, silent = (sum(each.outcome == word for each in found) for word in ("accepted", "silent"))
    return TaskScore(
        task=task,
        title=title,
        language=language,
        tier=tier,
        worlds=len(found),
        accepted=accepted,
        silent=silent,
        stopped=len(found) - accepted - silent,
        score=score_of(found),
        rounds=rounds,
        wall_s=wall_s,
        verdicts=tuple(msgspec.structs.replace(each, steps=(), measured=()) for each in found),
    )


def to_json(result: BenchResult) -> bytes:
    """Encode the result as one JSON object. Hidden seeds are left out: the position of a seed in the task's list of
    hidden seeds, counted from 0, replaces the seed.
    """
    told = msgspec.to_builtins(result) | {"score": result.score}
    if result.seeds == "hidden":
        for task in told["tasks"]:
            for number, verdict in enumerate(task["verdicts"]):
                verdict["seed"] = number
    return msgspec.json.format(msgspec.json.encode(told), indent=1) + b"\n"


HEADS: Final = ("task", "tier", "accepted", "stopped", "silent", "score", "rounds", "wall, s")
TEXTS: Final = 2  # of the first heads are above texts, the others above numbers


def rows(result: BenchResult) -> list[tuple[str, ...]]:
    """Return the table of the scores, a row for each task."""
    return [
        (
            each.task,
            f"{each.tier}, {each.language}",
            f"{each.accepted} of {each.worlds}",
            *map(str, (each.stopped, each.silent)),
            f"{each.score:.2f}",
            str(each.rounds),
            f"{each.wall_s:.0f}",
        )
        for each in result.tasks
    ]
