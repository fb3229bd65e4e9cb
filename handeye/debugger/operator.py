"""What to do when the operator is called: give up, try again so many times, or ask somebody."""

import re
from collections.abc import Callable, Iterator, Sequence
from dataclasses import dataclass
from typing import Final, Literal, Protocol

from handeye.debugger.breakpoints import stage_number
from handeye.debugger.formatting import shown_lines
from handeye.debugger.listing import excerpt, excerpt_lines, numbered_stage
from handeye.debugger.views import show
from handeye.diagnostics import quoted
from handeye.errors import InvalidInput
from handeye.events import OperatorAnswered, StageStarted, StepFinished, StepStarted
from handeye.execution.drive import Halted
from handeye.execution.executor import Choice
from handeye.record import Record
from handeye.runs.advance import Pause, Stop, advance, keep
from handeye.runs.runner import Runner
from handeye.runs.snapshot import Checkpoint


class Back(Record, frozen=True, kw_only=True):
    """Go back in time to where a stage, given by its index, last began."""

    stage: int


Answer = Choice | Literal["abort"] | Back


class Operator(Protocol):
    """Somebody, or a rule, to say how to go on."""

    def answer(self, runner: Runner, sentence: str) -> Answer:
        """How to go on with a run that called the operator for this reason."""


@dataclass(frozen=True, slots=True)
class Abort:
    """Gives up."""

    def answer(self, runner: Runner, sentence: str) -> Answer:
        """How to go on."""
        return "abort"


@dataclass(frozen=True, slots=True)
class Retry:
    """Does each stage again at most so many times, then gives up.

    It counts what has happened in the run, so that a run taken up again goes on as if never broken off.
    """

    times: int

    def answer(self, runner: Runner, sentence: str) -> Answer:
        """How to go on."""
        done, stage = 0, runner.executor.state.stage
        now = None
        for event in runner.events:
            if isinstance(event, StageStarted):
                now = runner.setup.plan.program.stages.index(event.stage)
            elif isinstance(event, OperatorAnswered) and event.choice == "retry" and now == stage:
                done += 1
        return "retry" if done < self.times else "abort"


_CHOICES: Final[dict[str, Choice | Literal["abort"]]] = {
    "p": "proceed", "r": "retry", "s": "skip", "a": "abort"
}  # fmt: skip


@dataclass(frozen=True, slots=True)
class Ask:
    """Asks in words; the end of the lines is taken for `abort`."""

    lines: Iterator[str]
    write: Callable[[str], None]
    """Puts out lines of text; the end of the last one is not in them."""

    def answer(self, runner: Runner, sentence: str) -> Answer:
        """How to go on."""
        self._say(_question(runner, sentence))
        for line in self.lines:
            word, _, rest = line.strip().partition(" ")
            try:
                answer = self._understood(runner, word.casefold(), rest.strip())
            except InvalidInput as mistake:
                self._say([str(mistake)])
                continue
            if answer is not None:
                return answer
        self._say(["the answers have come to their end: abort"])
        return "abort"

    def _understood(self, runner: Runner, word: str, rest: str) -> Answer | None:
        """The answer in a line; None if it only wanted to see something.

        Raises:
            InvalidInput: it is none.
        """
        if word in ("b", "back"):
            return Back(stage=_begun(runner, rest))
        if word in ("h", "help", "?"):
            self._say(_choices(runner))
            return None
        if word == "show":
            self._say(shown_lines(show(runner, rest)))
            return None
        choice = _CHOICES.get(word[:1])
        if choice is None or rest or not choice.startswith(word):
            said = quoted(f"{word} {rest}".strip())
            raise InvalidInput(f"{said} is no answer; say p, r, s, b, a or show")
        return choice

    def _say(self, lines: Sequence[str]) -> None:
        self.write("\n".join(lines))


def parse_policy(text: str) -> Operator | None:
    """The operator that `abort` or `retry:N` stands for; None for `ask`, which takes somebody to ask.

    Raises:
        InvalidInput: it is none of these.
    """
    if text == "abort":
        return Abort()
    if text == "ask":
        return None
    times = re.fullmatch(r"retry:([1-9][0-9]{0,5})", text)
    if times is None:
        raise InvalidInput(
            f"what to do on a stop is abort, ask, or retry:N with N from 1 up; {quoted(text)} is none of these"
        )
    return Retry(int(times[1]))


def attend(
    runner: Runner,
    operator: Operator,
    stops: Sequence[Stop] = (),
    kept: Callable[[int], Checkpoint | None] = lambda _: None,
) -> Pause:
    """Go on until there is a reason to stop that the operator does not settle.

    Args:
        kept: the newest checkpoint on disk at a position or before it, for going back.
    """
    refused: str | None = None
    while True:
        pause = advance(runner, stops)
        if pause.kind != "operator":
            return pause
        answer = operator.answer(runner, refused or pause.sentence)
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
    runner: Runner, answer: Choice | Back, stops: Sequence[Stop], kept: Callable[[int], Checkpoint | None]
) -> Pause | None:
    """Do what the operator says; why to stop then, if there is a reason.

    Raises:
        InvalidInput: no state from so far back was kept.
    """
    if isinstance(answer, Back):
        try:
            runner.back_to(beginnings(runner)[answer.stage], kept)
        except Halted:
            keep(runner, runner.history[-1])
            return Pause(kind="panic", sentence="stopped by hand on the way back; the brakes are set")
        return None
    runner.answer(answer)
    reason = next((why for stop in stops if (why := stop.before(runner)) is not None), None)
    if reason is None or runner.ended:
        return None
    keep(runner, runner.history[-1])
    return Pause(kind="break", sentence=reason)


def beginnings(runner: Runner) -> dict[int, int]:
    """Where each stage last began: steps done then, by index of the stage, the last to begin last."""
    found: dict[int, int] = {}
    done = 0
    for event in runner.events:
        if isinstance(event, StepFinished):
            done += 1
        elif isinstance(event, StageStarted):
            stage = runner.setup.plan.program.stages.index(event.stage)
            found.pop(stage, None)
            found[stage] = done
    return found


def _begun(runner: Runner, text: str) -> int:
    """The stage a user names, the present one if none, that has begun."""
    present = runner.executor.state.stage
    stage = present if not text and present is not None else stage_number(text, runner.setup.plan)
    if stage not in beginnings(runner):
        raise InvalidInput(f"{numbered_stage(runner.setup.plan.program, stage)}, has not begun yet")
    return stage


def _question(runner: Runner, sentence: str) -> list[str]:
    """What happened, where, and what can be said to it."""
    program, stage = runner.setup.plan.program, runner.executor.state.stage
    assert stage is not None
    step = next(event for event in reversed(runner.events) if isinstance(event, StepStarted))
    return [
        f"The operator is called in {numbered_stage(program, stage)}:",
        f"    {sentence}",
        *excerpt_lines(excerpt(program, step.line, step.line, 2, step.file), "■"),
        *_choices(runner),
    ]


def _choices(runner: Runner) -> list[str]:
    """What can be said, and what it does here."""
    program, executor = runner.setup.plan.program, runner.executor
    first = next(step.place for step in program.steps if step.stage == executor.state.stage)
    onward = executor.state.onward
    where = "to the end of the program" if onward is None else f"on at line {program.steps[onward].place}"
    return [
        f"p          proceed behind it: {where}",
        f"r          retry: the stage again from line {first}, with the world as it is now",
        "s          skip: leave out the rest of the stage",
        "b [STAGE]  back: in time to the beginning of this stage, or of an earlier one",
        "a          abort",
        "show       see joints, hand, force, saved differences, parts and so on",
    ]
