"""Characters to tokens, one line at a time; nothing is lost and nothing is refused here."""

import re
from enum import Enum
from typing import NamedTuple

from handeye.source import Span


class Kind(Enum):
    """What a token is."""

    NAME = "name"
    NUMBER = "number"  # or what starts like one
    STRING = "string"  # `"`, and perhaps no closing one
    MARK = "mark"  # one of `[ ] : ,`
    JUNK = "junk"


class Token(NamedTuple):
    """A piece of the text; `start` and `end` are offsets into the whole of it."""

    kind: Kind
    text: str
    start: int
    end: int

    @property
    def span(self) -> Span:
        return Span(start=self.start, end=self.end)


class Line(NamedTuple):
    """A line of the text, numbered from 1; `start` is the offset of its first character."""

    number: int
    start: int
    end: int
    tokens: tuple[Token, ...]
    comment: str | None
    """From the `;` to the end, without trailing blanks."""
    indented: bool
    """Starts with a blank."""

    def split(self) -> tuple[tuple[Token, ...], tuple[Token, ...]]:
        """The names of the labels, and what follows them."""
        at = 0
        while (
            at + 1 < len(self.tokens)
            and self.tokens[at].kind is Kind.NAME
            and self.tokens[at + 1].text == ":"
        ):
            at += 2
        return self.tokens[:at:2], self.tokens[at:]

    @property
    def is_blank(self) -> bool:
        """Nothing on it at all: ends a macro."""
        return not self.tokens and self.comment is None


_TOKEN = re.compile(
    r"""[ \t\r\f\v]* (?:
        (?P<NAME> [A-Za-z_]\w* )
      | (?P<NUMBER> [+-]? (?: \d | \.\d ) (?: [eE][+-] | [\w.] )* )
      | (?P<MARK> [][:,] )
      | (?P<COMMENT> ;.* )
      | (?P<STRING> "[^"]*"? )
      | (?P<JUNK> [^][:;,"\s]+ | . )
    )""",
    re.ASCII | re.VERBOSE | re.DOTALL,
)
_KINDS = {kind.name: kind for kind in Kind}


def scan(text: str, start: int = 0) -> list[Line]:
    """The lines of a text that begins at an offset; a final newline starts no line of its own."""
    lines: list[Line] = []
    pieces = text.split("\n")
    if pieces[-1] == "":
        pieces.pop()
    for number, piece in enumerate(pieces, 1):
        lines.append(_line(number, start, piece))
        start += len(piece) + 1
    return lines


def _line(number: int, start: int, text: str) -> Line:
    tokens: list[Token] = []
    comment = None
    end = len(text.rstrip(" \t\r\f\v"))
    for match in _TOKEN.finditer(text, 0, end):
        kind = match.lastgroup
        assert kind is not None
        if kind == "COMMENT":
            comment = match[kind]
        else:
            a, b = match.span(kind)
            tokens.append(Token(_KINDS[kind], match[kind], start + a, start + b))
    return Line(number, start, start + end, tuple(tokens), comment, text[:1] in (" ", "\t"))
