"""Checks the tasks of the agents' bench: in the public worlds, each reference solution must pass, and each trivial one
must fail.
"""

import time
from collections import Counter
from collections.abc import Callable, Sequence
from pathlib import Path
from tempfile import TemporaryDirectory

from handeye.agents.bench_entrant import Entrant, solved, verdicts
from handeye.agents.bench_files import REFERENCE, TRIVIAL
from handeye.agents.bench_result import score_of
from handeye.agents.bench_task import PASSED, BenchTask
from handeye.agents.call import Call
from handeye.agents.judging import Verdict
from handeye.core.record import Record


class TaskCheck(Record, frozen=True, kw_only=True):
    """The verdicts on the two solutions of a task in the public worlds of the task."""

    task: str
    worlds: int
    reference_accepted: int
    trivial_accepted: int
    trivial_silent: int
    trivial_score: float
    largest_cpu_s: float  # processor time of the most expensive world; differs from run to run

    @property
    def right(self) -> bool:
        """True if the reference solution is accepted in every world, and the trivial solution does not pass."""
        return self.reference_accepted == self.worlds and self.trivial_score < PASSED


def checked(
    tasks: Sequence[BenchTask], call: Call, tell: Callable[[str, str, Verdict], None]
) -> list[TaskCheck]:
    """Judge the solutions of all tasks. `tell` is called for each verdict, with the name of the task and the kind of
    the solution.
    """
    return [_checked(task, call, tell) for task in tasks]


def _checked(task: BenchTask, call: Call, tell: Callable[[str, str, Verdict], None]) -> TaskCheck:
    found: dict[str, list[Verdict]] = {}
    largest = 0.0
    for kind in (REFERENCE, TRIVIAL):
        with TemporaryDirectory() as aside:
            place = Path(aside) / task.name
            solved(task, Entrant(command=kind), place, call)
            found[kind] = []
            for seed in task.file.public[: 1 if task.file.orders else None]:
                began = time.process_time()
                found[kind] += verdicts(task, place, [seed], call)
                largest = max(largest, time.process_time() - began)
                tell(task.name, kind, found[kind][-1])
    reference, trivial = (Counter(each.outcome for each in found[kind]) for kind in (REFERENCE, TRIVIAL))
    return TaskCheck(
        task=task.name,
        worlds=len(found[TRIVIAL]),
        reference_accepted=reference["accepted"],
        trivial_accepted=trivial["accepted"],
        trivial_silent=trivial["silent"],
        trivial_score=score_of(found[TRIVIAL]),
        largest_cpu_s=round(largest, 1),
    )
