"""Asks the person at the terminal what to do when the program calls the operator."""

from collections.abc import Callable, Iterator, Sequence
from dataclasses import dataclass
from typing import Final, Literal

from handeye.core.diagnostics import quoted
from handeye.core.errors import BadArgument, InvalidInput, Refused
from handeye.debugger.breakpoints import stage_number
from handeye.debugger.formatting import shown_lines
from handeye.debugger.listing import excerpt, excerpt_lines, numbered_stage
from handeye.debugger.views import show
from handeye.program.diagnosis.cause_text import call_sentence
from handeye.program.events import Choice, OperatorCalled, StepStarted
from handeye.runs.operator import Back, OperatorChoice, Unwind, beginnings
from handeye.runs.runner import Runner

_CHOICES: Final[dict[str, Choice | Literal["abort"]]] = {
    "p": "proceed", "r": "retry", "s": "skip", "a": "abort"
}  # fmt: skip


@dataclass(frozen=True, slots=True)
class Ask:
    """An operator who asks the person at the terminal. The end of the input means `abort`."""

    lines: Iterator[str]
    write: Callable[[str], None]  # prints lines of text, given without the final newline

    def answer(self, runner: Runner, call: OperatorCalled, refused: str | None) -> OperatorChoice:
        self._say(_question(runner, refused or call_sentence(call.message, call.error, call.cause)))
        for line in self.lines:
            word, _, rest = line.strip().partition(" ")
            try:
                answer = self._understood(runner, word.casefold(), rest.strip())
            except InvalidInput as mistake:
                self._say([str(mistake)])
                continue
            if answer is not None:
                return answer
        self._say(["the input has ended: the run is aborted"])
        return "abort"

    def _understood(self, runner: Runner, word: str, rest: str) -> OperatorChoice | None:
        """Return the choice that a line states, or None if the line only asks for information. Raises
        InvalidInput for any other line.
        """
        if word in ("b", "back"):
            return Back(stage=_begun(runner, rest))
        if word in ("u", "unwind"):
            return Unwind(stage=_begun(runner, rest))
        if word in ("h", "help", "?"):
            self._say(_choices(runner))
            return None
        if word == "show":
            self._say(shown_lines(show(runner, rest)))
            return None
        choice, given = _CHOICES.get(word[:1]), runner.kind.choices(runner)
        if choice is None or rest or not choice.startswith(word) or choice not in (*given, "abort"):
            said = quoted(f"{word} {rest}".strip())
            letters = ", ".join(name[0] for name in given)
            raise BadArgument(f"{said} is not an answer; type {letters}, b, u, a or show")
        return choice

    def _say(self, lines: Sequence[str]) -> None:
        self.write("\n".join(lines))


def _begun(runner: Runner, text: str) -> int:
    """Return the index of the stage that the user names, or of the present stage by default. Raises
    InvalidInput if that stage has not begun."""
    present = runner.stage
    stage = present if not text and present is not None else stage_number(text, runner.listing)
    if stage not in beginnings(runner):
        raise Refused(f"{numbered_stage(runner.listing, stage)}, has not begun yet")
    return stage


def _question(runner: Runner, sentence: str) -> list[str]:
    program, stage = runner.listing, runner.stage
    assert stage is not None
    step = next(event for event in reversed(runner.events) if isinstance(event, StepStarted))
    return [
        f"The program calls the operator in {numbered_stage(program, stage)}:",
        f"    {sentence}",
        *excerpt_lines(excerpt(program, step.line, step.line, 2, step.file), "■"),
        *_choices(runner),
    ]


def _choices(runner: Runner) -> list[str]:
    return [
        *(f"{word[0]:10} {does}" for word, does in runner.kind.choices(runner).items()),
        "b [STAGE]  go back in time to the beginning of this stage, or of the earlier STAGE",
        "u [STAGE]  unwind: the arm undoes its work back to the beginning of this stage, and the program "
        "continues from there",
        "a          abort",
        "show       show the state of the run, or one topic of it",
    ]
