"""Rules that answer calls to the operator without a person: give up, retry, or undo a stage. The debugger asks a
person instead.
"""

import re
from collections.abc import Callable, Sequence
from dataclasses import dataclass
from typing import Final, Literal, Protocol

from handeye.core.diagnostics import quoted
from handeye.core.errors import BadArgument, InvalidInput
from handeye.core.record import Record
from handeye.execution.servo import Halted
from handeye.program.events import (
    AnyEvent,
    Choice,
    OperatorAnswered,
    OperatorCalled,
    StageStarted,
    StepFinished,
    StepStarted,
    UndoOrdered,
    UndoStarted,
)
from handeye.program.stage_names import stage_index
from handeye.runs.advance import AnyStop, Pause, advance, keep, paused_before
from handeye.runs.runner import Runner
from handeye.runs.snapshot import Checkpoint
from handeye.runs.undo_orders import stage_began


class Back(Record, frozen=True, kw_only=True):
    """The decision to put the simulation back to the latest beginning of the stage with the index `stage`."""

    stage: int


class Unwind(Record, frozen=True, kw_only=True):
    """The decision to let the arm undo its steps, back to the latest beginning of the stage with the index `stage`,
    and then to continue the program.
    """

    stage: int


OperatorChoice = Choice | Literal["abort"] | Back | Unwind


class Operator(Protocol):
    """A person or a rule that decides how to continue after a call."""

    def answer(self, runner: Runner, call: OperatorCalled, refused: str | None) -> OperatorChoice:
        """Return the operator's answer to a call. `refused` is the reason why the operator's previous answer
        was impossible, or None."""


@dataclass(frozen=True, slots=True)
class Abort:
    """Answers every call by giving up."""

    def answer(self, runner: Runner, call: OperatorCalled, refused: str | None) -> OperatorChoice:
        return "abort"


NOBODY: Final = Abort()


@dataclass(frozen=True, slots=True)
class Retry:
    """Retries a failed stage up to `times` times, then gives up. If a call comes while the arm undoes its work, this
    operator gives up at once.

    Earlier attempts are counted from the events of the run, so that a resumed run continues as if it had not
    been interrupted.
    """

    times: int

    def answer(self, runner: Runner, call: OperatorCalled, refused: str | None) -> OperatorChoice:
        if undoing(runner):
            return "abort"
        done, now = 0, None
        for event in _of_this_part(runner):
            if isinstance(event, StageStarted):
                now = runner.listing.stages.index(event.stage)
            elif isinstance(event, OperatorAnswered) and event.choice == "retry" and now == runner.stage:
                done += 1
        return "retry" if done < self.times else "abort"


@dataclass(frozen=True, slots=True)
class UnwindOnce:
    """Lets the arm undo its steps when a stage fails for the first time. The arm goes back to the beginning of the
    failed stage or, if `stage` is given, to the beginning of the stage with this index.

    Like `Retry`, this operator counts earlier attempts from the events of the run.
    """

    stage: int | None = None  # None: the stage that failed

    def answer(self, runner: Runner, call: OperatorCalled, refused: str | None) -> OperatorChoice:
        back = runner.stage if self.stage is None else self.stage
        given_up = refused is not None or undoing(runner) or runner.stage in _unwound(runner)
        return "abort" if given_up or back is None else Unwind(stage=back)


def undoing(runner: Runner) -> bool:
    """Return True if the arm is undoing steps."""
    last = next((event for event in reversed(runner.events) if isinstance(event, StepStarted)), None)
    return isinstance(last, UndoStarted)


def _unwound(runner: Runner) -> set[int]:
    """Return the indices of the stages after whose failure the arm undid steps."""
    found, now = set(), -1
    for event in _of_this_part(runner):
        if isinstance(event, StageStarted):
            now = runner.listing.stages.index(event.stage)
        elif isinstance(event, UndoOrdered) and event.asked_by == "person":
            found.add(now)
    return found


def _of_this_part(runner: Runner) -> Sequence[AnyEvent]:
    """Return the events since the run began. If the arm was ordered to undo all its work, return only the events since
    this order.
    """
    ordered = (n for n, event in enumerate(runner.events) if isinstance(event, UndoOrdered) and event.halts)
    return runner.events[max(ordered, default=-1) + 1 :]


def parse_policy(text: str, stages: Sequence[str]) -> Operator | None:
    """Return the operator for one of the words `abort`, `retry:N`, `unwind` and `unwind:STAGE`. Returns None for
    `ask`, because this word asks for a person.
    """
    if text == "abort":
        return Abort()
    if text == "ask":
        return None
    if text == "unwind":
        return UnwindOnce()
    word, _, stage = text.partition(":")
    if word == "unwind" and stage:
        return UnwindOnce(stage_index(stage, stages))
    times = re.fullmatch(r"retry:([1-9][0-9]{0,5})", text)
    if times is None:
        raise BadArgument(
            f"--on-stop takes abort, ask, retry:N (N is at least 1), unwind or unwind:STAGE, not {quoted(text)}"
        )
    return Retry(int(times[1]))


def attend(
    runner: Runner,
    operator: Operator,
    stops: Sequence[AnyStop] = (),
    kept: Callable[[int], Checkpoint | None] = lambda _: None,
) -> Pause:
    """Continue the run. At each call, follow the operator's answer. Return when the run pauses without a call, or when
    the operator aborts the run.

    The function `kept` is needed when the run goes back. Its argument is a number of steps. It returns the newest
    checkpoint on disk that was made after at most this number of steps.
    """
    refused: str | None = None
    while True:
        pause, call = advance(runner, stops), runner.call
        if call is None:
            return pause
        answer = operator.answer(runner, call, refused)
        if answer == "abort":
            return pause
        refused = None
        try:
            stopped = _carry_out(runner, answer, stops, kept)
        except InvalidInput as mistake:
            refused = str(mistake)
            continue
        if stopped is not None:
            return stopped


def _carry_out(
    runner: Runner,
    answer: Choice | Back | Unwind,
    stops: Sequence[AnyStop],
    kept: Callable[[int], Checkpoint | None],
) -> Pause | None:
    """Follow the operator's answer. Returns the pause that follows, or None. Raises InvalidInput if the answer
    is impossible.
    """
    if isinstance(answer, Back):
        try:
            runner.back_to(beginnings(runner)[answer.stage], kept)
        except Halted:
            keep(runner, runner.history[-1])
            return Pause(kind="panic", next=runner.at, back=True)
        return None
    if isinstance(answer, Unwind):
        runner.order_reversal(stage_began(runner.system.executed, runner.listing, answer.stage))
        return None
    runner.answer(answer)
    return None if runner.ended else paused_before(runner, stops)


def beginnings(runner: Runner) -> dict[int, int]:
    """Return a dictionary from the index of each stage to the number of steps that were done when the stage last
    began. The stage that began last comes last.
    """
    found: dict[int, int] = {}
    done = 0
    for event in runner.events:
        if isinstance(event, StepFinished):
            done += 1
        elif isinstance(event, StageStarted):
            stage = runner.listing.stages.index(event.stage)
            found.pop(stage, None)
            found[stage] = done
    return found
