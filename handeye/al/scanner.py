"""Splits a text into tokens in one pass. Every character is accepted."""

import re
from enum import Enum

import msgspec

from handeye.core.source import Located


class TokenKind(Enum):
    NAME = "name"
    NUMBER = "number"  # or what starts like one
    STRING = "string"  # may lack its closing quote
    MARK = "mark"  # one of `[ ] : ,`
    JUNK = "junk"


NAME, NUMBER, STRING, MARK, JUNK = TokenKind  # members by name: looking one up in an Enum is slow


class Token(Located, frozen=True, gc=False):
    """A token. Its offsets are in the text of the script together with its required texts."""

    kind: TokenKind
    text: str


class Line(msgspec.Struct, frozen=True, gc=False):
    """A line, numbered from 1. `comment` begins at the `;` and has no trailing blanks."""

    number: int
    start: int
    end: int
    tokens: tuple[Token, ...]
    comment: str | None
    indented: bool  # starts with a blank

    def split(self) -> tuple[tuple[Token, ...], tuple[Token, ...]]:
        """Split the tokens of a line. Returns the tokens of the labels, and the tokens after the labels."""
        tokens, at = self.tokens, 0
        if len(tokens) < 2 or tokens[1].text != ":":
            return (), tokens
        while at + 1 < len(tokens) and tokens[at + 1].text == ":" and tokens[at].kind is NAME:
            at += 2
        return tokens[:at:2], tokens[at:]

    @property
    def is_blank(self) -> bool:
        """True if the line is empty, and therefore ends a macro."""
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
    """Split a text that begins at `offset` into lines. A final newline starts no line."""
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
