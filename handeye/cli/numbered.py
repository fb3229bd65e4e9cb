"""What the commands of languages with numbered lines share: printed lines, mistakes, words, and the console."""

import sys
from collections.abc import Callable, Iterable, Mapping, Sequence
from itertools import chain
from pathlib import Path
from typing import Any, Protocol

from handeye.cli.common import say, show
from handeye.core.diagnostics import Diagnostic, has_errors, quoted, suggestion
from handeye.core.errors import InvalidInput, NoSuchName
from handeye.core.source import Source
from handeye.program.events import AnyEvent
from handeye.runs.observer import Observer


class LinePrinter(Observer):
    """Prints the output of a program: the texts of events of one kind."""

    def __init__(self, kind: type[Any], put: Callable[[str], None]) -> None:
        self._kind, self._put = kind, put

    def event(self, event: AnyEvent) -> None:
        if isinstance(event, self._kind):
            self._put(event.text)


def shown_without_errors(found: list[Diagnostic], source: Source) -> bool:
    """Print the errors and warnings of a program. Returns True if there are no errors."""
    show(found, source, json=False)
    return not has_errors(found)


def show_check(file: Path, found: list[Diagnostic], source: Source, *, json: bool) -> int:
    """Print the findings of a check. Returns the exit code."""
    show(found, source, json=json)
    if not found and not json:
        say(f"{file}: no errors")
    return 2 if has_errors(found) else 0


def explain_word(
    word: str | None,
    usages: Mapping[str, Iterable[str]],
    explained: Callable[[str], str | None],
    *,
    known: Iterable[str],
    noun: str,
    command: str,
) -> int:
    """Explain a word of a language; without a word, list the usages of all words under their headings.

    Args:
        noun: what the word is expected to be, such as `a command of ML`.
        command: the command that lists all words.
    """
    if word is None:
        for heading, forms in usages.items():
            say(heading)
            for form in forms:
                say(f"  {form}", whole=True)
        return 0
    text = explained(word)
    if text is None:
        hint = suggestion(word.upper(), known) or f"`{command}` lists them"
        raise NoSuchName(f"{quoted(word)} is not {noun}; {hint}")
    say(text)
    return 0


class Session(Protocol):
    """A session at a console."""

    @property
    def over(self) -> bool:
        """True if the user has left."""

    def hear(self, line: str) -> None:
        """Execute a line. Raises InvalidInput if the line cannot be executed."""

    def words(self) -> Iterable[str]:
        """Return the words offered as completions."""


Ask = Callable[[str], str | None]


def converse(
    begin: Callable[[Ask, Callable[[], bool]], Session],
    prompt: str,
    typed: Sequence[str] = (),
    *,
    echo: bool = False,
) -> int:
    """Execute the lines in `typed`, and then the lines that the user enters at the prompt. Returns the exit code.

    Args:
        begin: function that begins the session. `begin` receives two functions: one asks the user a question, and the
            other returns whether the panic button has been pressed.
        echo: print questions even if the answers come from a pipe.
    """
    from handeye.cli.panic_button import PanicButton
    from handeye.cli.prompt import typed_lines

    terminal, code = sys.stdin.isatty(), 0
    with PanicButton() as panic:

        def ask(question: str) -> str | None:
            if echo and not terminal:
                say(question.rstrip())
            return next(typed_lines(question if terminal else "", panic.aside, lambda: ()), None)

        session = begin(ask, panic)
        lines = typed_lines(prompt if terminal else "", panic.aside, session.words)
        for line in chain(typed, lines):
            try:
                session.hear(line)
            except InvalidInput as error:
                say(str(error))
                code = 2
            if session.over:
                break
    return 0 if terminal else code
