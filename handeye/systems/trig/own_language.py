"""The language service for TRIG. It handles scripts, which contain the lines that a user types, and programs that the
command W has written.
"""

from typing import Final

from handeye.core.diagnostics import Diagnostic, problem
from handeye.core.errors import InvalidInput
from handeye.core.source import Source, Span
from handeye.program.language import OwnLanguage
from handeye.systems.trig import ENTRY
from handeye.systems.trig.language.command_input import LineRefused, help
from handeye.systems.trig.language.command_table import COMMANDS, SYNONYMS
from handeye.systems.trig.language.storage import ENDING, decoded
from handeye.systems.trig.run.plan import typed

REFUSED: Final = "line-refused"
UNSOUND: Final = "program-unsound"
_CODES: Final = {
    REFUSED: (
        "the check executes the script on an arm without physics, and a line fails there; the following lines were "
        "not checked"
    ),
    UNSOUND: "the file does not contain a valid program in the form that the command W writes",
}


class TrigLanguage(OwnLanguage):
    """Checks scripts by executing them with an imaginary arm. Nothing moves."""

    system = ENTRY.name

    def check(self, source: Source) -> list[Diagnostic]:
        """Return a diagnostic for the first line that is refused, or for a file that is not a program."""
        first = Span(start=0, end=len(source.line(1)))
        try:
            if source.name.endswith(ENDING):
                decoded(source.text.encode(), source.name)
            else:
                typed(source.text, source.name)
        except LineRefused as refused:
            start = sum(len(line) + 1 for line in source.text.split("\n")[: refused.number - 1])
            span = Span(start=start, end=start + len(source.line(refused.number)))
            return [problem(REFUSED, refused.why, span, own="error")]
        except InvalidInput as error:
            code = UNSOUND if source.name.endswith(ENDING) else REFUSED
            return [problem(code, str(error), first, own="error")]
        return []

    def explanation(self, word: str) -> str | None:
        if word in _CODES:
            return f"error[{word}]: {_CODES[word]}"
        return help(word) if SYNONYMS.get(word.upper(), word.upper()) in COMMANDS else None

    def words(self, source: Source, offset: int) -> list[tuple[str, str]]:
        """Return the commands, for completion at the beginning of a line."""
        number, column = source.position(offset)
        before = source.line(number)[: column - 1].removeprefix(">").split()
        if len(before) > 1:
            return []
        return [(word, command.help) for word, command in COMMANDS.items()]


LANGUAGE: Final = TrigLanguage()
