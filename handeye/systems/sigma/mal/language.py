"""The language service for MAL: diagnostics, explanations, completion and formatting."""

import re
from typing import Final

from handeye.core.diagnostics import Diagnostic
from handeye.core.source import Source
from handeye.program.language import OwnLanguage
from handeye.program.mistakes import explained_mistake
from handeye.systems.sigma import ENTRY
from handeye.systems.sigma.mal.check import checked, in_order
from handeye.systems.sigma.mal.codes import CODES
from handeye.systems.sigma.mal.parser import parsed
from handeye.systems.sigma.mal.syntax import MAIN
from handeye.systems.sigma.mal.words import MAL_DEVICES, STATEMENTS, WORDS, explained
from handeye.systems.sigma.protocol import LINE_AXES

_AXIS_NEXT: Final = {"MOVE", "ORIGIN", "SPEED", "CURVE", "LIMIT", "ABORT"}
_FLAG_NEXT: Final = {"SET", "RESET", "WAIT", "TAKE"}
_LINE_NEXT: Final = {"GOTO", "GOSUB", "THEN", "ELSE"}
_TASK_NEXT: Final = {"START", "KILL"}

_AXES_OF: Final = (
    *(f"an axis of arm {arm}" for arm in range(1, 5)),
    "an axis of the feeder",
    "the axis of the belt",
)


class MalLanguage(OwnLanguage):
    """MAL as editors and commands use it."""

    system = ENTRY.name

    def check(self, source: Source) -> list[Diagnostic]:
        return checked(source)[1]

    def explanation(self, word: str) -> str | None:
        """Return the meaning of a code or word of MAL, or None if MAL has no such code or word. `handeye explain`
        gives the meaning in the arm language if both languages have the word; `handeye sigma words` always gives the
        meaning in MAL.
        """
        return code_explained(word) or explained(word)

    def words(self, source: Source, offset: int) -> list[tuple[str, str]]:
        """Return completions. After a line number, these are the statements; after a word, these are the words that
        may follow it.
        """
        row, column = source.position(offset)
        before = source.line(row)[: column - 1].upper()
        written = re.findall(r"[A-Z][A-Z0-9_]*|[0-9.]+|\S", before)
        if before and (before[-1].isalnum() or before[-1] == "_"):
            written = written[:-1]  # the word that is being typed
        last = written[-1] if written else ""
        statements = [(name, WORDS[name].help) for name in STATEMENTS]
        if len(written) <= 1:
            return statements
        lines, _ = parsed(source)
        if last in _LINE_NEXT:
            jumps = [(str(line.number), line.text) for line in in_order(lines)]
            return jumps + (statements if last in ("THEN", "ELSE") else [])
        if last in _TASK_NEXT:
            return [(name, "a task") for name in dict.fromkeys(line.task for line in lines) if name != MAIN]
        if last in _FLAG_NEXT or (last == "AND" and "WAIT" in written):
            flags = {
                name.text
                for line in lines
                if line.statement.word in _FLAG_NEXT
                for name in line.statement.names
            }
            return [(name, "a flag") for name in sorted(flags)]
        if last == "ACTUATE":
            return [(name, f"a device of arm {arm}") for name, (arm, _) in MAL_DEVICES.items()]
        axes = [(axis, _AXES_OF[int(axis[1]) - 1]) for axis in LINE_AXES]
        if last in _AXIS_NEXT:
            return axes
        names = sorted(
            {line.statement.names[0].text for line in lines if line.statement.word in ("LET", "FOR")}
        )
        rest = [(name, word.help) for name, word in WORDS.items() if word.kind != "statement"]
        return [*((name, "a variable") for name in names), *rest, *axes]

    def formatted(self, text: str) -> str:
        """Return the lines in the order of their numbers, in capitals, with one blank between words. Remarks
        are unchanged, and so are texts in quotes.
        """
        lines, _ = parsed(Source(name="text", text=text))
        return "".join(f"{line.number} {tidy(line.text)}\n" for line in in_order(lines))


def tidy(text: str) -> str:
    """Return a statement in capitals. Remarks are unchanged, and so are texts in quotes."""
    if text.upper().startswith("REM"):
        return f"REM{text[3:]}"
    return "".join(part if part.startswith('"') else part.upper() for part in re.split(r'("[^"]*")', text))


def code_explained(code: str) -> str | None:
    """Return the meaning of a code, with an example and the cure, or None if the code is unknown."""
    known = CODES.get(code.casefold())
    if known is None:
        return None
    return explained_mistake(code.casefold(), known, ".mal", LANGUAGE.check)


LANGUAGE: Final = MalLanguage()
