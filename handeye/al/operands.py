"""Tokens to operands, by the definition of the instruction."""

import math
import re
from collections.abc import Sequence

from handeye.al.definition import BIGGEST, NIL, SMALLEST, Instruction, Operand
from handeye.al.instructions import AXES
from handeye.al.scanner import Kind, Token
from handeye.al.syntax import Name, Number, Text, Value, Vector
from handeye.diagnostics import Diagnostic, Label, quoted
from handeye.source import Span

_NUMBER = re.compile(r"[+-]?(\d+\.?\d*|\.\d+)([eE][+-]?\d+)?", re.ASCII)
_NOT_FINITE = re.compile(r"[+-]?(nan|inf|infinity)", re.ASCII | re.IGNORECASE)
_NO_LENGTH = 1e-6


class Mistake(Exception):
    """The first mistake of a line."""

    def __init__(self, code: str, message: str, span: Span, text: str = "", help: str | None = None) -> None:
        super().__init__(message)
        primary = Label(span=span, text=text)
        self.diagnostic = Diagnostic(code=code, message=message, primary=primary, help=help)


def read_operands(definition: Instruction, head: Token, tokens: Sequence[Token]) -> tuple[Value | None, ...]:
    """A value for each operand of the definition, None for those left out.

    Raises:
        Mistake: the operands do not fit the definition.
    """
    if not any(operand.free for operand in definition.operands):
        tokens = _separated(tokens)
    return _Reader(definition, head, tokens).read()


def free_text(tokens: Sequence[Token]) -> str:
    """Words as they stand on the line; blanks of any kind become spaces."""
    text, end = "", tokens[0].start
    for token in tokens:
        text += " " * (token.start - end) + token.text
        end = token.end
    return text


def _separated(tokens: Sequence[Token]) -> Sequence[Token]:
    """Without the commas of the dialect of 1977, each of which stands between two values."""
    for at, token in enumerate(tokens):
        if token.text == ",":
            if at == 0 or tokens[at - 1].text in (",", "["):
                raise Mistake("misplaced-comma", "nothing stands before this comma", token.span)
            if at + 1 == len(tokens) or tokens[at + 1].text == "]":
                raise Mistake("misplaced-comma", "nothing stands behind this comma", token.span)
    return [token for token in tokens if token.text != ","]


def is_unterminated(token: Token) -> bool:
    """Whether it is a string without its closing quote."""
    return token.kind is Kind.STRING and (len(token.text) == 1 or token.text[-1] != '"')


class _Reader:
    def __init__(self, definition: Instruction, head: Token, tokens: Sequence[Token]) -> None:
        self.definition = definition
        self.tokens = tokens
        self.end = Span(start=(tokens[-1] if tokens else head).end, end=(tokens[-1] if tokens else head).end)
        self.at = 0

    def read(self) -> tuple[Value | None, ...]:
        if self.definition.axes and self.tokens and self.tokens[0].kind is Kind.NUMBER:
            return (self.axes(),)
        values = tuple(self.operand(operand) for operand in self.definition.operands)
        if self.at < len(self.tokens):
            self.too_many()
        self.check_order(values)
        self.check_nils(values)
        return values

    def operand(self, operand: Operand) -> Value | None:
        token = self.next()
        if operand.word:
            if token is None or token.kind is not Kind.NAME or token.text.upper() != operand.word:
                return None
            self.at += 1
            if not operand.takes:
                return Name(operand.word, token.span)
            token = self.next()
            if token is None:
                raise self.missing(operand)
        if token is None:
            if operand.optional:
                return None
            raise self.missing(operand)
        if operand.nil and token.text.upper() == NIL:
            self.at += 1
            return None
        value = self.free(token) if operand.free else self.value(token, operand)
        self.check(value, operand, token)
        return value

    def next(self) -> Token | None:
        return self.tokens[self.at] if self.at < len(self.tokens) else None

    def free(self, token: Token) -> Text:
        rest = self.tokens[self.at :]
        if len(rest) == 1 and token.kind is Kind.STRING:
            return self.string(token)
        for word in rest:
            if is_unterminated(word):
                raise self.unterminated_string(word)
        self.at = len(self.tokens)
        return Text(free_text(rest), Span(start=token.start, end=rest[-1].end))

    def value(self, token: Token, operand: Operand) -> Value:
        if token.kind is Kind.STRING:
            return self.string(token)
        if token.text == "[":
            return self.vector(token, operand)
        self.at += 1
        if token.kind is Kind.NUMBER:
            return Number(_number(token), token.span)
        if _NOT_FINITE.fullmatch(token.text) and Name not in operand.takes:
            raise _malformed(token)
        if token.kind is Kind.NAME:
            return Name(token.text, token.span)
        raise _unexpected(token)

    def axes(self) -> Vector:
        """A number of axes and their letters, as `2 X Y`: 1 along each of them."""
        count, *letters = self.tokens
        for letter in letters:
            if letter.text not in AXES:
                message = f"{quoted(letter.text)} is no axis"
                raise Mistake("unknown-axis", message, letter.span, help="the axes are `X`, `Y` and `Z`")
        named = {letter.text for letter in letters}
        if _number(count) != len(letters) or len(named) != len(letters) or not letters:
            stand = f"{len(named)} {'stands' if len(named) == 1 else 'different ones stand'} here"
            message = f"`{self.definition.op}` is to have {quoted(count.text)} axes; {stand}"
            raise Mistake("axis-count", message, count.span, help=self.usage())
        self.at = len(self.tokens)
        span = Span(start=count.start, end=letters[-1].end)
        return Vector(tuple(float(axis in named) for axis in AXES), span)

    def string(self, token: Token) -> Text:
        if is_unterminated(token):
            raise self.unterminated_string(token)
        self.at += 1
        return Text(token.text[1:-1], token.span)

    def vector(self, opening: Token, operand: Operand) -> Vector:
        values: list[float] = []
        self.at += 1
        while (token := self.next()) is not None:
            self.at += 1
            if token.text == "]":
                break
            if token.kind is Kind.NUMBER:
                values.append(_number(token))
            elif _NOT_FINITE.fullmatch(token.text):
                raise _malformed(token)
            elif token.kind is Kind.NAME:
                raise Mistake(
                    "wrong-operand", f"a vector consists of numbers, not of {quoted(token.text)}", token.span
                )
            else:
                raise _unexpected(token)
        else:
            raise Mistake("unterminated-vector", "the vector has no `]`", opening.span, "it begins here")
        span = Span(start=opening.start, end=token.end)
        if Vector in operand.takes and len(values) != len(operand.units):
            raise Mistake(
                "vector-size",
                f"`{self.definition.op}` takes a vector of {len(operand.units)} numbers, not {len(values)}",
                span,
                help=self.usage(),
            )
        return Vector(tuple(values), span)

    def check(self, value: Value, operand: Operand, token: Token) -> None:
        if not isinstance(value, operand.takes):
            takes = " or ".join(kind.what for kind in operand.takes)
            message = f"`{self.definition.op}` takes {takes} as {operand.plain}, not {value.what}"
            raise Mistake("wrong-operand", message, value.span, help=self.usage())
        if isinstance(value, Vector):
            if max(map(abs, value.values)) > BIGGEST:
                raise Mistake(
                    "number-out-of-range", "a number in the vector is too large", value.span, operand.why
                )
            if len(value.values) == 3 and math.hypot(*value.values) < _NO_LENGTH:
                raise Mistake("zero-vector", "a vector of no length has no direction", value.span)
        if isinstance(value, Number):
            self.check_number(value, operand, token)

    def check_number(self, value: Number, operand: Operand, token: Token) -> None:
        if operand.choices and value.value not in operand.choices:
            known = " and ".join(f"{choice:g}" for choice in operand.choices)
            help = f"there are {known} {operand.units[0].name}"
            raise Mistake("unknown-lens", f"there is no {quoted(token.text)} mm lens", value.span, help=help)
        if not operand.low <= value.value <= operand.high:
            size = "small" if value.value < operand.low else "large"
            message = f"{quoted(token.text)} is too {size} as {operand.plain} of `{self.definition.op}`"
            raise Mistake("number-out-of-range", message, value.span, operand.why)
        if operand.nonzero and abs(value.value) < SMALLEST:
            message = f"{quoted(token.text)} is too small as {operand.plain} of `{self.definition.op}`"
            why = f"it has to be at least {SMALLEST:g} {operand.units[0].name}, one way or the other"
            raise Mistake("number-out-of-range", message, value.span, why)
        if operand.whole and value.value != int(value.value):
            message = f"`{self.definition.op}` takes a whole number as {operand.plain}"
            raise Mistake("wrong-operand", message, value.span)

    def check_order(self, values: tuple[Value | None, ...]) -> None:
        named = {
            o.name: v for o, v in zip(self.definition.operands, values, strict=True) if isinstance(v, Number)
        }
        low, high = named.get("minimum"), named.get("maximum")
        if low is not None and high is not None and low.value > high.value:
            message = f"the maximum {high.value:g} is less than the minimum {low.value:g}"
            raise Mistake("number-out-of-range", message, high.span)

    def check_nils(self, values: tuple[Value | None, ...]) -> None:
        """What can all be left out, one by one, cannot be left out together."""
        nils = [o.plain for o in self.definition.operands if o.nil]
        if nils and not any(v for o, v in zip(self.definition.operands, values, strict=True) if o.nil):
            message = f"`{self.definition.op}` has no {' and no '.join(nils)}"
            raise Mistake("missing-operand", message, self.tokens[-1].span, help=self.usage())

    def missing(self, operand: Operand) -> Mistake:
        message = f"`{self.definition.op}` lacks its {operand.plain}"
        return Mistake("missing-operand", message, self.end, "it is expected here", self.usage())

    def too_many(self) -> None:
        first, last = self.tokens[self.at], self.tokens[-1]
        if first.kind in (Kind.JUNK, Kind.MARK) and first.text != "[":
            raise _unexpected(first)
        if is_unterminated(last):
            raise self.unterminated_string(last)
        span = Span(start=first.start, end=last.end)
        count = len(self.definition.operands)
        message = f"`{self.definition.op}` takes no {'more ' if count else ''}operands"
        raise Mistake("too-many-operands", message, span, help=self.usage())

    def unterminated_string(self, token: Token) -> Mistake:
        start = Span(start=token.start, end=token.start + 1)
        return Mistake("unterminated-string", "the string has no closing quote", start, "it begins here")

    def usage(self) -> str:
        counted = f" or `{self.definition.op} 2 X Y`" if self.definition.axes else ""
        return f"usage: `{self.definition.usage}`{counted}"


def _number(token: Token) -> float:
    if not _NUMBER.fullmatch(token.text):
        raise _malformed(token)
    value = float(token.text)
    if math.isinf(value):
        raise Mistake("number-out-of-range", f"{quoted(token.text)} is too large for a number", token.span)
    return value


def _malformed(token: Token) -> Mistake:
    help = "numbers look like 3, .07, -0.6 or 1e-3"
    return Mistake("malformed-number", f"{quoted(token.text)} is not a number", token.span, help=help)


def _unexpected(token: Token) -> Mistake:
    return Mistake("unexpected-character", f"{quoted(token.text)} is no part of the language", token.span)
