"""Executes a schedule: interrupts the run where the schedule says so, resumes the run from disk, and answers when
the run calls the operator.
"""

import subprocess
import sys
import time
from collections.abc import Sequence
from dataclasses import dataclass, field
from pathlib import Path
from typing import Final

from handeye.core.files import write_whole
from handeye.execution.servo import ServoPeriod
from handeye.program.events import OperatorAnswered, OperatorCalled
from handeye.results.finishing import outcome
from handeye.results.result import to_json
from handeye.runs.advance import Pause, StopCondition, keep, paused_before
from handeye.runs.folder import EVENTS, RESULT, open_again, open_new
from handeye.runs.host_seconds import Meter
from handeye.runs.observer import Observer
from handeye.runs.operator import Operator, OperatorChoice, attend
from handeye.runs.runner import Runner
from handeye.runs.snapshot import Checkpoint
from handeye.trials.assembly import brakes_hold
from handeye.trials.chaos.schedule import Answer, Break, Schedule

POLL: Final = 0.01  # s between two checks of what a process has written
LIMIT: Final = 300.0  # s after which a process counts as hanging


class ReachedPosition(StopCondition, frozen=True, kw_only=True):
    """Pause when the run has done `position` steps."""

    position: int

    def met_before(self, runner: Runner) -> bool:
        return runner.position >= self.position


@dataclass(frozen=True, slots=True)
class Answers:
    """An operator who gives the answers of a list, one per call, and then aborts the run."""

    answers: Sequence[Answer]
    before: int  # Answers that were given before the schedule began

    def answer(self, runner: Runner, call: OperatorCalled, refused: str | None) -> OperatorChoice:
        """Return the next answer of the list, or `abort` if the previous answer was refused or no answer is
        left."""
        given = sum(isinstance(event, OperatorAnswered) for event in runner.events) - self.before
        return "abort" if refused or given >= len(self.answers) else self.answers[given]


class Button(Observer):
    """A panic button that is pressed after a number of servo periods, or never if the number is None."""

    def __init__(self, after: int | None) -> None:
        self._left = after

    def down(self) -> bool:
        return self._left is not None and self._left <= 0

    def tick(self, period: ServoPeriod) -> None:
        if self._left is not None:
            self._left -= 1


@dataclass(slots=True)
class ScheduleRun:
    """The run of a schedule, after it has ended."""

    folder: Path
    runner: Runner
    pause: Pause
    unbraked: list[str] = field(default_factory=list)
    lost: list[str] = field(default_factory=list)


class ScheduleRunner:
    """Executes a schedule in a separate folder."""

    def __init__(self, schedule: Schedule, start: Checkpoint, folder: Path) -> None:
        before = sum(isinstance(event, OperatorAnswered) for event in start.events)
        self._operator: Operator = Answers(schedule.answers, before)
        self._schedule, self._place = schedule, folder
        self._start, self._folder = start, open_new(folder, start)
        self._again = False
        self._unbraked: list[str] = []
        self._lost: list[str] = []

    def carry_out(self, stops: Sequence[StopCondition], *, broken: bool) -> ScheduleRun:
        """Execute the schedule until one of the conditions in `stops` is met. The interruptions of the schedule are
        made only if `broken` is True.
        """
        runner = pause = None
        for interruption in self._schedule.breaks if broken else ():
            runner, pause = self._interrupted(interruption, stops)
            if pause is not None and pause.kind != "panic" and not self._waits(pause):
                break
            runner = pause = None
            self._folder, self._start, faults = open_again(self._place)
            self._again = True
            self._lost += faults
        if runner is None or pause is None:
            runner = self._runner(Button(None))
            pause = self._attended(runner, stops)
        if pause.kind != "break":
            runner.finish()
        self._folder.close()
        write_whole(self._place / RESULT, to_json(outcome(runner, pause, Meter(), judged=False)))
        return ScheduleRun(self._place, runner, pause, self._unbraked, self._lost)

    def _waits(self, pause: Pause) -> bool:
        """Return True if the pause belongs to an interruption. Such a pause does not end the schedule."""
        return isinstance(pause.met, Interruption)

    def _interrupted(
        self, interruption: Break, stops: Sequence[StopCondition]
    ) -> tuple[Runner | None, Pause | None]:
        """Continue until an interruption, or until the run pauses earlier for another reason."""
        if interruption.kind == "kill":
            self._folder.close()
            kill_resumed(self._place, interruption.after)
            return None, None
        panic = interruption.after if interruption.kind == "panic" else None
        runner = self._runner(Button(panic))
        there = Interruption(position=runner.position + interruption.after)
        pause = self._attended(runner, stops if panic is not None else [*stops, there])
        if self._waits(pause):
            if interruption.kind == "back":
                runner.back_to(max(runner.first, runner.position - (interruption.after + 1) // 2))
            keep(runner, runner.history[-1])
            self._folder.close()
        elif pause.kind == "panic":
            self._folder.close()
        return runner, pause

    def _attended(self, runner: Runner, stops: Sequence[StopCondition]) -> Pause:
        # `attend` executes a step before it checks the stops, but a run interrupted at its end has no step left.
        pause = paused_before(runner, stops) or attend(runner, self._operator, stops)  # type: ignore[arg-type]
        stopped = pause.kind in ("operator", "panic", "trouble")
        if stopped and runner.system.arm_cell is not None and not brakes_hold(runner.arm_cell):
            self._unbraked.append(f"{pause.kind} at {runner.time:.2f} s")
        return pause

    def _runner(self, button: Button) -> Runner:
        def watch(runner: Runner) -> list[Observer]:
            return [self._folder.watch(runner, self._start, again=self._again), button]

        return Runner(self._start, halt=button.down, observers=watch)


class Interruption(ReachedPosition, frozen=True, kw_only=True):
    """Pause at the point where the schedule interrupts the run."""


def kill_resumed(folder: Path, events: int) -> None:
    """Resume a run in a separate process. Unless the run ends earlier, the process is killed when the run has written
    `events` further events.
    """
    journal = folder / EVENTS
    enough = _lines(journal) + events + 1  # and the event for the resumption
    process = subprocess.Popen(  # noqa: S603 - our own program
        [sys.executable, "-m", "handeye", "resume", str(folder), "--on-stop", "abort"],
        stdin=subprocess.DEVNULL, stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL,
    )  # fmt: skip
    end = time.monotonic() + LIMIT
    while process.poll() is None and _lines(journal) < enough and time.monotonic() < end:
        time.sleep(POLL)
    process.kill()
    process.wait()


def _lines(journal: Path) -> int:
    return journal.read_bytes().count(b"\n") if journal.exists() else 0
