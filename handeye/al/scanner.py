"""Characters to tokens, in one pass; nothing is lost and nothing is refused here."""

import re
from enum import Enum

import msgspec

from handeye.core.source import Located


class TokenKind(Enum):
    """Kinds of tokens."""

    NAME = "name"
    NUMBER = "number"  # or what starts like one
    STRING = "string"  # `"`, and perhaps no closing one
    MARK = "mark"  # one of `[ ] : ,`
    JUNK = "junk"


NAME, NUMBER, STRING, MARK, JUNK = TokenKind
"""The members by themselves, for code that asks often: looking one up in its enumeration takes time."""


class Token(Located, frozen=True, gc=False):
    """A piece of the text; its offsets are of the whole."""

    kind: TokenKind
    text: str


class Line(msgspec.Struct, frozen=True, gc=False):
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
        tokens, at = self.tokens, 0
        if len(tokens) < 2 or tokens[1].text != ":":
            return (), tokens
        while at + 1 < len(tokens) and tokens[at + 1].text == ":" and tokens[at].kind is NAME:
            at += 2
        return tokens[:at:2], tokens[at:]

    @property
    def is_blank(self) -> bool:
        """Nothing on it at all: ends a macro."""
        return not self.tokens and self.comment is None


_BLANKS = " \t\r\f\v"
_TOKEN = re.compile(
    rf"""[{_BLANKS}]* (?:
        (?P<NAME> [A-Za-z_]\w* )
      | (?P<NUMBER> [+-]? (?: \d | \.\d ) (?: [eE][+-] | [\w.] )* )
      | (?P<MARK> [][:,] )
      | (?P<COMMENT> ;[^\n]* )
      | (?P<STRING> "[^"\n]*" | "(?: [^"\n]*[^"\s] )? )
      | (?P<END> \n | \Z )
      | (?P<JUNK> [^][:;,"\s]+ )
    )""",
    re.ASCII | re.VERBOSE,
)
_KINDS = {_TOKEN.groupindex[kind.name]: kind for kind in TokenKind}
_COMMENT = _TOKEN.groupindex["COMMENT"]


def scan(text: str, offset: int = 0) -> list[Line]:
    """The lines of a text that begins at an offset; a final newline starts no line of its own."""
    lines: list[Line] = []
    tokens: list[Token] = []
    comment = None
    start = end = offset
    for match in _TOKEN.finditer(text):
        group, behind = match.lastindex, offset + match.end()
        assert group is not None
        piece = match[group]
        if group in _KINDS:
            tokens.append(Token(behind - len(piece), behind, _KINDS[group], piece))
            end = behind
        elif group == _COMMENT:
            comment = piece.rstrip(_BLANKS)
            end = behind - len(piece) + len(comment)
        else:
            if behind > start:
                indented = text[start - offset] in " \t"
                lines.append(Line(len(lines) + 1, start, end, tuple(tokens), comment, indented))
            tokens, comment, start, end = [], None, behind, behind
    return lines
