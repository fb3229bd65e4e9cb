"""The language service for ML: diagnostics, explanations, completion and the standard listing."""

from typing import Final

from handeye.core.diagnostics import Diagnostic
from handeye.core.source import Source
from handeye.program.language import OwnLanguage
from handeye.program.mistakes import explained_mistake
from handeye.systems.ml.errors import MEANINGS
from handeye.systems.ml.language.assembler import assembled
from handeye.systems.ml.language.check import checked
from handeye.systems.ml.language.codes import CODES, SYMBOLIC
from handeye.systems.ml.language.commands import COMMANDS, Kind, explained
from handeye.systems.ml.language.parser import parsed, parsed_line
from handeye.systems.ml.machine.rectilinear import RIGHT
from handeye.systems.ml.tables.layout import SENSORS, SHAPES


class MlLanguage(OwnLanguage):
    """ML as editors and commands use it."""

    system = "ml"

    def check(self, source: Source) -> list[Diagnostic]:
        return checked(source)[1]

    def explanation(self, word: str) -> str | None:
        """Return the meaning of a code or of a command, or None if ML has no such code or command. If the arm language
        also has the word, `handeye explain` explains the word of the arm language; `handeye ml words` explains the
        command of ML.
        """
        return code_explained(word) or explained(word)

    def words(self, source: Source, offset: int) -> list[tuple[str, str]]:
        """Return completions. After a sequence number, these are the commands; after a command, these are the values
        that its next parameter may have.
        """
        row, column = source.position(offset)
        written = source.line(row)[: column - 1].upper().split()
        typing = bool(written) and source.line(row)[column - 2 : column - 1].strip() != ""
        before = written[:-1] if typing else written
        before = before[1:] if before and before[0].isdigit() else before
        if not before:
            return [(code, command.help) for code, command in COMMANDS.items()]
        command = COMMANDS.get(before[0])
        if command is None or len(before) > max(command.counts):
            return []
        return self._values(command.kind(len(before) - 1), source)

    def _values(self, kind: Kind, source: Source) -> list[tuple[str, str]]:
        """Return the constants that may be written for a parameter."""
        match kind:
            case "table":
                return [(name, shape.title) for name, shape in SHAPES.items()]
            case "motor":
                return [(str(motor.number), motor.axis) for motor in RIGHT.motors]
            case "sensor":
                return [(str(number), f"sensor {number}") for number in range(1, SENSORS + 1)]
            case "statement":
                lines, _ = parsed(source)
                return [(str(line.number), str(line.statement)) for line in lines if line.number is not None]
        return []

    def formatted(self, text: str) -> str:
        """Return the lines in their standard form, as LIST prints them. Remarks, and lines that cannot be read, are
        unchanged.
        """
        out = []
        for row in text.splitlines():
            line, _ = parsed_line(row)
            number = "" if line is None or line.number is None else f"{line.number} "
            out.append(row.rstrip() if line is None else f"{number}{line.statement}")
        return "".join(f"{row}\n" for row in out)


def code_explained(code: str) -> str | None:
    """Return the meaning of a code, with an example and the cure, or None if the code is unknown."""
    code = code.upper() if code.upper() in MEANINGS else code.casefold()
    known = CODES.get(code) or SYMBOLIC.get(code)
    if known is None:
        more = "The checker does not look for this mistake. A running program stops at this mistake."
        return f"error[{code}]: {MEANINGS[code]}\n{more}" if code in MEANINGS else None
    symbolic = code in SYMBOLIC
    language = SYMBOLIC_LANGUAGE if symbolic else LANGUAGE
    return explained_mistake(code, known, ".sym" if symbolic else ".ml", language.check)


class SymbolicLanguage(OwnLanguage):
    """The language of the symbolic assembler."""

    system = "ml"

    def check(self, source: Source) -> list[Diagnostic]:
        return assembled(source)[1]


LANGUAGE: Final = MlLanguage()
SYMBOLIC_LANGUAGE: Final = SymbolicLanguage()
