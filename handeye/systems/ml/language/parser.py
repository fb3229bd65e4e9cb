"""Parses lines of ML. A mistake affects only its own line."""

import re
from typing import Final, NamedTuple

from handeye.core.diagnostics import Diagnostic, alternatives, quoted
from handeye.core.errors import BadArgument
from handeye.core.plain_text import counted
from handeye.core.source import Source, Span
from handeye.systems.ml.arithmetic import fits
from handeye.systems.ml.errors import MEANINGS, MlError
from handeye.systems.ml.language.codes import mistake
from handeye.systems.ml.language.commands import COMMANDS, Command
from handeye.systems.ml.language.syntax import (
    DEEPEST,
    LAST,
    MOTORS,
    VARIABLES,
    Line,
    Parameter,
    Point,
    Reference,
    Statement,
)
from handeye.systems.ml.tables.layout import SHAPES
from handeye.systems.ml.tables.store import word_of

LONGEST_LINE: Final = 500  # characters
_REMARK: Final = "write a remark on a separate line, after `*`"
_FIRST: Final = re.compile(r"[ \t]*(\S+)")
_PARAMETER: Final = re.compile(
    r"""[ \t]*(?:(?P<minus>-)?[ \t]*(?P<depth>(?:&[ \t]*)*)(?P<digits>[0-9]+)(?=[ \t]|$)
      | (?P<other>\S+))""",
    re.VERBOSE,
)


class _Mistaken(Exception):
    """Raised with the diagnostic of a line that cannot be parsed."""

    def __init__(self, diagnostic: Diagnostic) -> None:
        super().__init__(diagnostic.message)
        self.diagnostic = diagnostic


class _Written(NamedTuple):
    """A parameter as it is written, and its place in the text."""

    minus: bool
    depth: int  # number of ampersands
    digits: str  # empty: `text` is neither a number nor a reference
    text: str
    span: Span


def parsed(source: Source) -> tuple[list[Line], list[Diagnostic]]:
    """Return the lines of a program in the order of the text, and the mistakes."""
    lines: list[Line] = []
    found: list[Diagnostic] = []
    start = 0
    for row, text in enumerate(source.text.split("\n"), 1):
        line, wrong = parsed_line(text.removesuffix("\r"), start, row)
        lines += [] if line is None else [line]
        found += [] if wrong is None else [wrong]
        start += len(text) + 1
    return lines, found


def parsed_line(text: str, start: int = 0, row: int = 1) -> tuple[Line | None, Diagnostic | None]:
    """Parse a line that begins at the offset `start` of its text. Returns two values. For a correct line, these are
    the line and None; for a line with a mistake, None and the mistake. For a remark or an empty line, both values are
    None.
    """
    if len(text) > LONGEST_LINE:
        told = f"a line can have at most {LONGEST_LINE} characters, but this line has {len(text)}"
        return None, mistake("long-line", told, Span(start=start, end=start + 1))
    try:
        return _line(text, start, row), None
    except _Mistaken as stop:
        return None, stop.diagnostic


def statement_of(text: str) -> Line | None:
    """Parse a typed line. Returns None for a remark. Raises MlError or BadArgument if the line is wrong. The text of
    the error says how to correct the line.
    """
    line, wrong = parsed_line(text)
    if wrong is None:
        return line
    told = f"{wrong.message}; {wrong.help}"
    raise MlError(wrong.code, told) if wrong.code in MEANINGS else BadArgument(told)


def _line(text: str, start: int, row: int) -> Line | None:
    first = _FIRST.match(text)
    if first is None or first[1].startswith("*"):
        return None
    number, span, word = None, _span(first, 1, start), first
    if first[1][0] in "-+0123456789":
        number = _sequence_number(first[1], span)
        following = _FIRST.match(text, first.end())
        if following is None:
            raise _Mistaken(mistake("M01", f"there is no command after the number {number}", span))
        word = following
    command = _command(word[1], _span(word, 1, start))
    if command.code == "POINT":
        written, point = _point(text, word.end(), start)
    else:
        written, point = _written(text, word.end(), start), ()
    place = _span(word, 1, start)
    _count(command, written, place)
    parameters = tuple(_parameter(command, at, each) for at, each in enumerate(written))
    _order(command, parameters, written)
    return Line(
        number=number, statement=Statement(command.code, parameters, point), row=row, span=span,
        spans=(place, *(each.span for each in written)),
    )  # fmt: skip


def _span(match: re.Match[str], group: int | str, start: int) -> Span:
    return Span(start=start + match.start(group), end=start + match.end(group))


def _sequence_number(text: str, span: Span) -> int:
    number = int(text) if text.isascii() and text.isdigit() else 0
    if not 1 <= number <= LAST:
        raise _Mistaken(
            mistake("M02", f"a sequence number must be between 1 and {LAST}, not {quoted(text)}", span)
        )
    return number


def _command(text: str, span: Span) -> Command:
    command = COMMANDS.get(text.upper())
    if command is None:
        near = alternatives(text.upper(), COMMANDS)
        raise _Mistaken(mistake("M01", f"{quoted(text)} is not a command", span, meant=near))
    return command


def _written(text: str, at: int, start: int) -> list[_Written]:
    found = []
    while match := _PARAMETER.match(text, at):
        at = match.end()
        begin = match.end() - len(match[0].lstrip(" \t"))
        span = Span(start=start + begin, end=start + at)
        depth = (match["depth"] or "").count("&")
        found.append(
            _Written(bool(match["minus"]), depth, match["digits"] or "", match[0].strip(" \t"), span)
        )
    return found


def _point(text: str, at: int, start: int) -> tuple[list[_Written], Point]:
    """Read what follows POINT: nothing, or `*` and the positions of all motors."""
    written = _written(text, at, start)
    if not written or written[0].text != "*":
        return written, ()
    if len(written) != MOTORS + 1:
        told = f"a POINT must have the positions of {MOTORS} motors, not of {len(written) - 1}"
        raise _Mistaken(
            mistake(
                "M03",
                told,
                written[0].span,
                help=f"give {MOTORS} numbers after `*`, or neither numbers nor `*`",
            )
        )
    return [], tuple(_constant(each) for each in written[1:])


def _parameter(command: Command, at: int, written: _Written) -> Parameter:
    kind = command.kind(at)
    if kind == "text":
        return written.text
    if written.depth and written.digits:
        return _reference(written)
    if kind == "table" and not written.digits:
        return _table(written)
    return _constant(written)


def _constant(written: _Written) -> int:
    if not written.digits or written.depth:
        remark = _REMARK if written.text.startswith("*") else None
        told = f"{quoted(written.text)} is neither a number nor a reference"
        raise _Mistaken(mistake("bad-parameter", told, written.span, help=remark))
    value = int(written.digits)
    value = -value if written.minus else value
    if not fits(value):
        raise _Mistaken(mistake("M04", f"{quoted(written.text)} does not fit into 16 bits", written.span))
    return value


def _reference(written: _Written) -> Reference:
    if written.depth > DEEPEST:
        told = f"a reference can have at most {DEEPEST} `&`, but this reference has {written.depth}"
        raise _Mistaken(mistake("M06", told, written.span))
    index = int(written.digits)
    if not 1 <= index <= VARIABLES:
        told = f"there is no variable {quoted(written.digits)}; the last variable is {VARIABLES}"
        raise _Mistaken(mistake("M05", told, written.span))
    return Reference(index, written.depth, written.minus)


def _table(written: _Written) -> int:
    name = written.text.upper()
    if name in SHAPES:
        return word_of(name)
    if name in COMMANDS:
        told = f"{quoted(name)} is a command, so no table has this name"
        raise _Mistaken(mistake("M11", told, written.span))
    near = alternatives(name, SHAPES)
    raise _Mistaken(mistake("M11", f"there is no table {quoted(name)}", written.span, meant=near))


def _count(command: Command, written: list[_Written], span: Span) -> None:
    """Check the number of parameters."""
    allowed, number = sorted(command.counts), len(written)
    if number in command.counts:
        return
    if allowed == [0]:
        takes = "no parameters"
    elif len(allowed) == 1:
        takes = counted(allowed[0], "parameter")
    elif len(allowed) == allowed[-1] - allowed[0] + 1:
        takes = f"{allowed[0]} to {allowed[-1]} parameters"
    else:
        takes = f"{', '.join(map(str, allowed[:-1]))} or {allowed[-1]} parameters"
    extra = written[allowed[-1]] if number > allowed[-1] else None
    cure = _REMARK if extra and extra.text.startswith("*") else f"write it as {quoted(command.form)}"
    place = extra.span if extra else span
    raise _Mistaken(mistake("M03", f"{command.code} takes {takes}, not {number}", place, help=cure))


def _order(command: Command, parameters: tuple[Parameter, ...], written: list[_Written]) -> None:
    """Check the order of the limits of SENSOR."""
    match command.code, parameters:
        case "SENSOR", (_, int(lower), int(upper)) if lower >= upper:
            told = f"the lower limit, {lower}, must be below the upper limit, {upper}"
            raise _Mistaken(mistake("M04", told, written[1].span, help="give the lower limit first"))
