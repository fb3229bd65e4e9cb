"""Splits a line of MAL into tokens. The scanner returns mistakes, and never raises an exception."""

import re
from typing import Final, Literal, NamedTuple

from handeye.core.diagnostics import Diagnostic, quoted
from handeye.core.source import Span
from handeye.systems.sigma.mal.codes import mistake

LONGEST_LINE: Final = 500  # characters
LARGEST_NUMBER: Final = 1e30
TokenKind = Literal["name", "number", "text", "mark"]


class Token(NamedTuple):
    """A token. `start` and `end` are offsets in the whole text."""

    kind: TokenKind
    text: str  # names in capitals; texts without their quotes
    start: int
    end: int

    @property
    def span(self) -> Span:
        return Span(start=self.start, end=self.end)


_TOKEN: Final = re.compile(
    r"""(?P<number>(?:[0-9]+\.?[0-9]*|\.[0-9]+)(?:[Ee][+-]?[0-9]+)?)
      | (?P<name>[A-Za-z][A-Za-z0-9_]*)
      | "(?P<text>[^"]*)"
      | (?P<mark><>|<=|>=|[-+*/=<>(),;])
      | (?P<blank>[ \t]+)""",
    re.VERBOSE,
)


def tokens(line: str, start: int) -> tuple[list[Token], Diagnostic | None]:
    """Return the tokens of a line that begins at the offset `start`, and the first mistake in the line. If the line
    has no mistake, the second value is None. A remark has only the token REM.
    """
    found: list[Token] = []
    if len(line) > LONGEST_LINE:
        told = f"a line can have at most {LONGEST_LINE} characters, but this line has {len(line)}"
        return [], mistake("long-line", told, Span(start=start, end=start + 1))
    at = 0
    while at < len(line):
        match = _TOKEN.match(line, at)
        if match is None:
            span = Span(start=start + at, end=start + at + 1)
            if line[at] == '"':
                told = 'a text must end with `"` on the line on which it begins'
                return found, mistake("text-unclosed", told, Span(start=span.start, end=start + len(line)))
            return found, mistake("stray-character", f"{quoted(line[at])} is not a character of MAL", span)
        kind, text, at = match.lastgroup, match[match.lastgroup or 0], match.end()
        if kind == "number" and not float(text) <= LARGEST_NUMBER:
            span = Span(start=start + match.start(), end=start + at)
            return found, mistake("number-too-large", f"the largest number is {LARGEST_NUMBER:g}", span)
        if kind != "blank":
            upper = text.upper() if kind == "name" else text
            found.append(Token(kind, upper, start + match.start(), start + at))  # type: ignore[arg-type]  # a group's name
            if upper == "REM" and len(found) <= 2:  # at the beginning, or after a line number
                break
    return found, None
