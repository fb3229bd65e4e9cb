"""An exercise on concurrent tasks, judged in every order in which the tasks may run."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING, Final

from handeye.exercises.exercise import Exercise, Submission, Verdict
from handeye.systems.sigma.mal.check import checked
from handeye.systems.sigma.mal.compiler import program_of
from handeye.systems.sigma.mal.interleavings import KINDS, interleavings
from handeye.systems.sigma.mal.orders import problems

if TYPE_CHECKING:
    from handeye.core.diagnostics import Diagnostic
    from handeye.core.source import Source

_WORK: Final = ("MOVE", "ACTUATE", "FOR", "NEXT")  # statements that a student must keep
_CASE: Final = "every order"


@dataclass(frozen=True, slots=True, kw_only=True)
class OrderExercise(Exercise):
    """An exercise in MAL: make a program right in every order of its tasks."""

    @property
    def seeds(self) -> tuple[int, ...]:
        return ()

    @property
    def cases(self) -> str:
        return "every order in which the tasks may run; a motion may take any length of time"

    @property
    def rules(self) -> tuple[str, ...]:
        return (
            f"Each task must still have every {', '.join(_WORK[:-1])} and {_WORK[-1]} that it has at the start, in "
            "the same order.",
            "The program must end, and each line must be executed in at least one order of the tasks.",
        )

    def diagnostics(self, given: Submission) -> list[Diagnostic]:
        return checked(given.source)[1]

    def broken_rules(self, given: Submission) -> list[str]:
        before, now = _work(self.program), _work(given.source)
        return [
            f"the task {task} does not have the same {', '.join(_WORK[:-1])} and {_WORK[-1]} as at the start"
            for task, statements in before.items()
            if now.get(task) != statements
        ] + [f"the task {task} is new, and moves the arms" for task in now if task not in before]

    def verdicts(self, given: Submission) -> list[Verdict]:
        program = program_of(given.source.name, given.source.text)
        found = interleavings(program)
        problem = next(problems(program, found), None)
        if problem is None:
            return [Verdict(case=_CASE, standing="right", outcome="accepted")]
        again = f"handeye sigma check {given.source.name} --interleavings"
        silent, outcome, reason = problem
        return [
            Verdict(
                case=_CASE,
                standing="silent" if silent else "wrong",
                outcome=outcome,
                reason=reason,
                again=again,
            )
        ]


def _work(source: Source) -> dict[str, list[str]]:
    """Return, for each task, the statements that a student must keep (see `_WORK`)."""
    found: dict[str, list[str]] = {}
    for line in checked(source)[0]:
        if line.statement.word in _WORK:
            found.setdefault(line.task, []).append(" ".join(line.text.upper().split()))
    return found


SHARE: Final = OrderExercise(
    name="share",
    session=5,
    title="keep two hands apart in every order",
    brief="Two arms work at one place: the first arm brings pieces, and the second arm drives screws. As a rule, "
    "the arms do not meet, because the second arm is fast enough; but a motor may be slow. Add flags so that, in "
    "whatever order the tasks run, the hands cannot meet, no signal is lost, and no task waits for ever.",
    start="share.mal",
    hints=(
        (KINDS["hands"], "Use a flag that means `the place is free`: TAKE it before the hand goes there."),
        (
            KINDS["flag"],
            "Before the feeder sets its flag again, let it wait until the previous signal has been taken.",
        ),
        (
            KINDS["deadlock"],
            "Which task sets the flag that this task waits for? Which task must set the flag for the first time, "
            "before any task takes it?",
        ),
    ),
)
