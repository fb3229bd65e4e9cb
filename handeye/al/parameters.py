"""Lines of a macro with the operands of a call in the place of its parameters.

An operand is read where it comes to stand, at the place of its parameter; what is said of it alone is said where it is
written.
"""

import re
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass, replace
from typing import Final

import msgspec

from handeye.al.scanner import NAME, STRING, Token
from handeye.al.syntax import Operand, Statement, Value
from handeye.al.word_groups import FREE_TEXT
from handeye.core.diagnostics import Diagnostic, Label
from handeye.core.source import Located, Span

Call = tuple[int, ...]
"""Which call of a macro a statement comes from, within which other call: () is the text itself."""
_BRACED: Final = re.compile(r"\{([A-Za-z_]\w*)\}", re.ASCII)
"""A parameter in a text for people."""


class Given(Located, frozen=True, gc=False):
    """An operand of a call, where it is written."""

    tokens: tuple[Token, ...]
    text: str
    call: Call
    """Within which its names are known."""
    by: Statement
    """The call."""


class _Piece(Located, frozen=True, gc=False):
    """A token of the line; in the place of a parameter, all that is given for it."""

    tokens: tuple[Token, ...]
    text: str


@dataclass(frozen=True, slots=True)
class FilledLine:
    """A line of a macro with what a call gives for the parameters in it."""

    statement: Statement
    pieces: Sequence[_Piece]
    given: Mapping[Span, Given]
    """By the place of the parameter."""

    @property
    def head(self) -> Token:
        """Its instruction, or the macro it calls."""
        word = self.statement.word
        assert word is not None
        return Token(word.start, word.end, NAME, word.text)

    @property
    def tokens(self) -> list[Token]:
        """Its operands; those in the place of a parameter stand where that does."""
        return [token for piece in self.pieces for token in piece.tokens]

    @property
    def text(self) -> str:
        """The line as it is carried out."""
        return " ".join([self.head.text, *filter(None, [_text(self.pieces)])])

    @property
    def calls(self) -> tuple[Statement, ...]:
        """Those that its operands are written in."""
        return tuple(dict.fromkeys(given.by for given in self.given.values()))

    def landed(self, values: Sequence[Value | None]) -> tuple[Value | None, ...]:
        """Its values, each where it is written."""
        return tuple(value if value is None else self._landed(value) for value in values)

    def _landed(self, value: Value) -> Value:
        given = self.given.get(value.span)
        if given is None:
            return value
        return msgspec.structs.replace(value, start=given.start, end=given.end, use=value.span)

    def told(self, mistake: Diagnostic, call: Statement) -> Diagnostic:
        """A mistake in it: at the operand of a call if that alone is wrong, else at the line."""
        given = self.given.get(mistake.primary.span)
        if given is None or mistake.code == "too-many-operands":
            return replace(mistake, secondary=(Label(span=call.span, text="called here"),))
        at = Label(span=given.span, text=mistake.primary.text)
        return replace(mistake, primary=at, secondary=(used(mistake.primary.span),))

    def passed(self, value: Value, call: Call) -> Given:
        """An operand of this line, which is a call, as it is given to the macro."""
        given = self.given.get(value.span)
        if given is not None:
            return given
        pieces = [piece for piece in self.pieces if value.start <= piece.start and piece.end <= value.end]
        tokens = tuple(token for piece in pieces for token in piece.tokens)
        return Given(value.start, value.end, tokens, _text(pieces), call, self.statement)


def filled(statement: Statement, given: Mapping[str, Given]) -> FilledLine:
    """A line of a macro, or a call, with what is given for parameters in their place."""
    assert statement.word is not None
    words = statement.word.text in FREE_TEXT
    uses = {t.span: given[t.text] for t in parameters_in(statement) if t.text in given}
    pieces = [_piece(token, uses.get(token.span), given, words) for token in statement.tokens]
    return FilledLine(statement, pieces, uses)


def parameters_in(statement: Statement) -> Iterator[Token]:
    """Names among the operands of a line, of which any may be a parameter; words for people are none."""
    if statement.word is not None and statement.word.text not in FREE_TEXT:
        yield from (token for token in statement.tokens if token.kind is NAME)


def braced_in(statement: Statement) -> Iterator[tuple[str, Span]]:
    """Names in braces in the words for people of a line."""
    words = statement.word is not None and statement.word.text in FREE_TEXT
    for token in statement.tokens:
        if words or token.kind is STRING:
            yield from braced(token)


def braced(token: Token) -> Iterator[tuple[str, Span]]:
    """Names in braces, and where they stand with them."""
    for found in _BRACED.finditer(token.text):
        yield found[1], Span(start=token.start + found.start(), end=token.start + found.end())


def used(parameter: Span) -> Label:
    """Where an operand of a call comes to stand."""
    return Label(span=parameter, text="it stands here in the macro")


def uses(operand: Operand) -> tuple[Label, ...]:
    """The place in a macro of an operand that is written in a call; none if it is written where it stands."""
    return () if operand.use is None else (used(operand.use),)


def across(one: Operand, other: Operand) -> Span:
    """Two operands of a line, and what stands between them; the first alone if a call gives one of them."""
    return one.span if one.use or other.use else Span(start=one.start, end=other.end)


def _piece(token: Token, put: Given | None, given: Mapping[str, Given], words: bool) -> _Piece:
    if put is not None:
        tokens = tuple(Token(token.start, token.end, each.kind, each.text) for each in put.tokens)
        return _Piece(token.start, token.end, tokens, put.text)
    text = (
        _BRACED.sub(lambda name: _words(name, given), token.text)
        if words or token.kind is STRING
        else token.text
    )
    return _Piece(token.start, token.end, (Token(token.start, token.end, token.kind, text),), text)


def _words(name: re.Match[str], given: Mapping[str, Given]) -> str:
    """An operand in a text for people: as it is written, without quotes."""
    return given[name[1]].text.strip('"') if name[1] in given else name[0]


def _text(pieces: Sequence[_Piece]) -> str:
    text, end = "", pieces[0].start if pieces else 0
    for piece in pieces:
        text += " " * (piece.start - end) + piece.text
        end = piece.end
    return text
