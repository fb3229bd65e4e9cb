"""The symbolic assembler, which is used before a run: it replaces names by the numbers of statements, variables and
sensors.

    WAND EQU 1              a constant, such as the number of a sensor
    COUNT VAR               a variable, whose number the assembler chooses: `ADD COUNT 1`, `PRINT &COUNT`
    HOME: POINT             a label, which stands for the number of its statement
    AGAIN: SENSOR WAND -1 1
    BRANCH HOME AGAIN WAND

Statements are numbered 5, 10, 15 and so on. Remarks, which begin with `*`, are copied to the assembled text. A program
can consist of several texts, like decks of cards that are read one after the other.
"""

import re
from collections.abc import Sequence
from dataclasses import replace
from pathlib import Path
from typing import Final, NamedTuple

from handeye.core.diagnostics import Diagnostic, alternatives, arranged, quoted
from handeye.core.source import Source, Span, read_source
from handeye.systems.ml.language.codes import mistake
from handeye.systems.ml.language.commands import COMMANDS
from handeye.systems.ml.language.parser import parsed_line
from handeye.systems.ml.language.syntax import LAST, VARIABLES
from handeye.systems.ml.tables.layout import SHAPES

STEP: Final = 5  # difference between two sequence numbers
_NAME: Final = re.compile(r"[A-Z][A-Z0-9_]*")
_LABEL: Final = re.compile(r"[ \t]*([^\s:]+):")
_DEFINED: Final = re.compile(r"[ \t]*(\S+)[ \t]+(EQU|VAR)(?:[ \t]+(-?[0-9]+))?[ \t]*", re.IGNORECASE)
_WORD: Final = re.compile(r"(?P<marks>(?:-[ \t]*)?(?:&[ \t]*)*)(?P<name>[A-Z][A-Z0-9_]*\??)", re.IGNORECASE)


class _Row(NamedTuple):
    """A row of the text. The row becomes one statement."""

    number: int
    text: str
    start: int  # offset in the whole text


class _Mistaken(Exception):
    def __init__(self, diagnostic: Diagnostic) -> None:
        super().__init__(diagnostic.message)
        self.diagnostic = diagnostic


def decks(files: Sequence[Path]) -> Source:
    """Read the texts of a symbolic program, in the order of `files`. Raises BadFile if a text is unreadable."""
    first, *others = files
    after = (replace(read_source(file), key=f"{n} {file}") for n, file in enumerate(others))
    return replace(read_source(first), required=tuple(after))


def assembled(source: Source) -> tuple[str, list[Diagnostic]]:
    """Assemble a symbolic program from all its texts. Returns the program in ML, and the mistakes in the symbolic
    texts.
    """
    assembler = _Assembler()
    for part in source.texts:
        for text, start in _rows(part.text, source.begins[part.key]):
            try:
                assembler.take(text, start)
            except _Mistaken as stop:
                assembler.found.append(stop.diagnostic)
    return assembler.text(), arranged(assembler.found)


def _rows(text: str, start: int) -> list[tuple[str, int]]:
    """Split a text into rows. `start` is the offset of the text; each row is returned with its own offset."""
    rows = []
    for row in text.split("\n"):
        rows.append((row.removesuffix("\r"), start))
        start += len(row) + 1
    return rows


class _Assembler:
    """Reads the rows, then writes the statements when all names are known."""

    def __init__(self) -> None:
        self.found: list[Diagnostic] = []
        self._values: dict[str, int] = {}
        self._rows: list[_Row | str] = []  # statements and remarks
        self._number = 0
        self._variables = 0

    def take(self, text: str, start: int) -> None:
        """Read a row."""
        if not text.strip() or text.lstrip().startswith("*"):
            self._rows.append(text.strip())
            return
        if definition := _DEFINED.fullmatch(text):
            name, kind, value = definition.groups()
            span = Span(start=start + definition.start(1), end=start + definition.end(1))
            self._define(name, self._value(kind.upper(), value, span), span)
            return
        self._number += STEP
        if self._number > LAST:
            told = f"a program can have at most {LAST // STEP} statements"
            raise _Mistaken(mistake("too-many-statements", told, Span(start=start, end=start + 1)))
        offset = 0
        if label := _LABEL.match(text):
            offset, span = label.end(), Span(start=start + label.start(1), end=start + label.end(1))
            if not text[offset:].strip():
                raise _Mistaken(mistake("M01", f"the label {quoted(label[1])} has no statement", span))
            self._define(label[1], self._number, span)
        self._rows.append(_Row(self._number, text[offset:], start + offset))

    def _value(self, kind: str, value: str | None, span: Span) -> int:
        if (kind == "EQU") != (value is not None):
            wants = "EQU takes one number" if kind == "EQU" else "VAR takes no operand"
            raise _Mistaken(mistake("bad-definition", wants, span))
        if value is not None:
            return int(value)
        self._variables += 1
        if self._variables > VARIABLES:
            raise _Mistaken(mistake("bad-definition", f"there are at most {VARIABLES} variables", span))
        return self._variables

    def _define(self, name: str, value: int, span: Span) -> None:
        upper = name.upper()
        known = upper in self._values
        self._values[upper] = value
        if not _NAME.fullmatch(upper) or upper in COMMANDS:
            why = "is a command or a table" if upper in COMMANDS else "is not a name"
            raise _Mistaken(mistake("bad-name", f"{quoted(name)} {why}", span))
        if known:
            raise _Mistaken(mistake("name-twice", f"{quoted(name)} is already defined", span))

    def text(self) -> str:
        """Return the program as text, and collect the mistakes in its statements."""
        out = []
        for row in self._rows:
            try:
                out.append(row if isinstance(row, str) else self._statement(row))
            except _Mistaken as stop:
                self.found.append(stop.diagnostic)
        return "".join(f"{line}\n" for line in out)

    def _statement(self, row: _Row) -> str:
        code, space, rest = row.text.strip().partition(" ")
        if code.upper() in ("CMSLOAD", "CMSDUMP"):
            numbers = rest
        else:
            begin = row.text.index(code) + len(code) + len(space)
            numbers = _WORD.sub(lambda word: self._number_of(row, begin, word), row.text[begin:])
        text = f"{row.number} {code} {numbers}".rstrip()
        line, wrong = parsed_line(text)
        if wrong is not None:
            place = _span(row, 0, len(row.text))
            raise _Mistaken(mistake(wrong.code, wrong.message, place, help=wrong.help))
        assert line is not None
        return f"{row.number} {line.statement}"

    def _number_of(self, row: _Row, begin: int, word: re.Match[str]) -> str:
        """Replace a name by its value. Names of tables stay."""
        name = word["name"].upper()
        if name in SHAPES and name not in self._values and not word["marks"]:
            return word[0]
        if name not in self._values:
            span = _span(row, begin + word.start("name"), begin + word.end("name"))
            near = alternatives(name, self._values)
            raise _Mistaken(
                mistake("unknown-name", f"{quoted(word['name'])} is not defined", span, meant=near)
            )
        marks, value = word["marks"].replace(" ", "").replace("\t", ""), self._values[name]
        return str(-value) if marks == "-" else f"{marks}{value}"


def _span(row: _Row, start: int, end: int) -> Span:
    """Return the place of a part of a row. Blanks at the beginning of the part are left out."""
    begin = end - len(row.text[start:end].lstrip())
    return Span(start=row.start + begin, end=row.start + end)
