"""The lines of a macro, with the operands of a call in place of the parameters.

If an operand of the call is wrong for the line, the mistake is reported at the place in the call where the operand is
written.
"""

import re
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass, replace
from typing import Final

import msgspec

from handeye.al.instructions import FREE_TEXT
from handeye.al.scanner import NAME, STRING, Token
from handeye.al.syntax import Operand, Statement, Value
from handeye.core.diagnostics import Diagnostic, Label
from handeye.core.source import Located, Span

Call = tuple[int, ...]  # path of nested macro calls that a statement comes from; () is the main text
_BRACED: Final = re.compile(r"\{([A-Za-z_]\w*)\}", re.ASCII)  # a parameter in a text


class Argument(Located, frozen=True, gc=False):
    """An operand of a macro call, at the place where it is written. `call` is the scope of the names in the operand,
    and `by` is the statement that calls the macro.
    """

    tokens: tuple[Token, ...]
    text: str
    call: Call
    by: Statement


class _Piece(Located, frozen=True, gc=False):
    """A token of the line, or the argument that takes the place of a parameter."""

    tokens: tuple[Token, ...]
    text: str


@dataclass(frozen=True, slots=True)
class FilledLine:
    """A line of a macro with arguments filled in. `given` maps the span of each parameter to the parameter's
    argument.
    """

    statement: Statement
    pieces: Sequence[_Piece]
    given: Mapping[Span, Argument]

    @property
    def head(self) -> Token:
        """The instruction, or the name of the called macro."""
        word = self.statement.word
        assert word is not None
        return Token(word.start, word.end, NAME, word.text)

    @property
    def tokens(self) -> list[Token]:
        """The tokens of the operands. An argument has the position of its parameter."""
        return [token for piece in self.pieces for token in piece.tokens]

    @property
    def text(self) -> str:
        """The line as executed."""
        return " ".join([self.head.text, *filter(None, [_text(self.pieces)])])

    @property
    def calls(self) -> tuple[Statement, ...]:
        """The macro calls from which the arguments of this line come."""
        return tuple(dict.fromkeys(given.by for given in self.given.values()))

    def at_source(self, values: Sequence[Value | None]) -> tuple[Value | None, ...]:
        """Return the values. If an argument replaced a parameter, the value's span is the span of the argument."""
        return tuple(
            msgspec.structs.replace(value, start=given.start, end=given.end, use=value.span)
            if value is not None and (given := self.given.get(value.span)) is not None
            else value
            for value in values
        )

    def located(self, mistake: Diagnostic, call: Statement) -> Diagnostic:
        """Locate a mistake. If the mistake is at a parameter, the returned diagnostic points to the argument. If not,
        or if the line has too many operands, the diagnostic points to the line.
        """
        given = self.given.get(mistake.primary.span)
        if given is None or mistake.code == "too-many-operands":
            return replace(mistake, secondary=(Label(span=call.span, text="called here"),))
        at = Label(span=given.span, text=mistake.primary.text)
        return replace(mistake, primary=at, secondary=(used(mistake.primary.span),))

    def passed(self, value: Value, call: Call) -> Argument:
        """Make an argument from an operand of a nested macro call."""
        given = self.given.get(value.span)
        if given is not None:
            return given
        pieces = [piece for piece in self.pieces if value.start <= piece.start and piece.end <= value.end]
        tokens = tuple(token for piece in pieces for token in piece.tokens)
        return Argument(value.start, value.end, tokens, _text(pieces), call, self.statement)


def filled(statement: Statement, given: Mapping[str, Argument]) -> FilledLine:
    """Replace the parameters in a line of a macro by the arguments of a call. The line may itself be the call of
    another macro.
    """
    assert statement.word is not None
    words = statement.word.text in FREE_TEXT
    uses = {t.span: given[t.text] for t in parameters_in(statement) if t.text in given}
    pieces = [_piece(token, uses.get(token.span), given, words) for token in statement.tokens]
    return FilledLine(statement, pieces, uses)


def parameters_in(statement: Statement) -> Iterator[Token]:
    """Yield the names among the operands: these may be parameters. Yields nothing if the operand is free text."""
    if statement.word is not None and statement.word.text not in FREE_TEXT:
        yield from (token for token in statement.tokens if token.kind is NAME)


def braced_in(statement: Statement) -> Iterator[tuple[str, Span]]:
    """Yield the names in braces in the texts of a line, with their spans."""
    words = statement.word is not None and statement.word.text in FREE_TEXT
    for token in statement.tokens:
        if words or token.kind is STRING:
            yield from braced(token)


def braced(token: Token) -> Iterator[tuple[str, Span]]:
    """Yield the names in braces in a token, with their spans."""
    for found in _BRACED.finditer(token.text):
        yield found[1], Span(start=token.start + found.start(), end=token.start + found.end())


def used(parameter: Span) -> Label:
    """Make a label at the parameter that an argument replaces."""
    return Label(span=parameter, text="here in the macro")


def uses(operand: Operand) -> tuple[Label, ...]:
    """Make a label for a diagnostic. The label marks the place in the macro where the operand replaces a parameter.
    Returns no label if the operand does not replace a parameter.
    """
    return () if operand.use is None else (used(operand.use),)


def across(one: Operand, other: Operand) -> Span:
    """Return the span from one operand to another, or the span of the first operand if either operand is an
    argument.
    """
    return one.span if one.use or other.use else Span(start=one.start, end=other.end)


def _piece(token: Token, put: Argument | None, given: Mapping[str, Argument], words: bool) -> _Piece:
    if put is not None:
        tokens = tuple(Token(token.start, token.end, each.kind, each.text) for each in put.tokens)
        return _Piece(token.start, token.end, tokens, put.text)
    text = token.text
    if words or token.kind is STRING:  # in a text, an argument is written without its quotes
        text = _BRACED.sub(lambda n: given[n[1]].text.strip('"') if n[1] in given else n[0], text)
    return _Piece(token.start, token.end, (Token(token.start, token.end, token.kind, text),), text)


def _text(pieces: Sequence[_Piece]) -> str:
    text, end = "", pieces[0].start if pieces else 0
    for piece in pieces:
        text += " " * (piece.start - end) + piece.text
        end = piece.end
    return text
