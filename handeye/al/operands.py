"""Reads operands from tokens, as the definition of the instruction says."""

import math
import re
from collections.abc import Sequence
from itertools import pairwise

import msgspec

from handeye.al.definition import AXES, MAX_NUMBER, MIN_POSITIVE, NIL, Instruction, Operand
from handeye.al.hints import STOP_ALONE, letters_for_digits, no_units, strange, with_unit
from handeye.al.instructions import FREE_TEXT, INSTRUCTIONS
from handeye.al.scanner import JUNK, MARK, NAME, NUMBER, STRING, Token
from handeye.al.syntax import Name, Number, Text, Value, Vector
from handeye.core.diagnostics import problem, quoted
from handeye.core.source import Span

_NOT_FINITE = re.compile(r"[+-]?(nan|inf|infinity)", re.ASCII | re.IGNORECASE)
_NO_LENGTH = 1e-6


class Mistake(Exception):
    """Raised at the first mistake of a line, with its diagnostic."""

    def __init__(self, code: str, message: str, span: Span, text: str = "", help: str | None = None) -> None:
        super().__init__(message)
        self.diagnostic = problem(code, message, span, text=text, help=help)


def read_operands(definition: Instruction, head: Token, tokens: Sequence[Token]) -> tuple[Value | None, ...]:
    """Read the value of each operand, or None for an operand that is left out. Raises Mistake if the operands are
    wrong.
    """
    if definition.op in FREE_TEXT:
        return _Reader(definition, head, tokens).read()
    try:
        return _Reader(definition, head, separated(tokens)).read()
    except Mistake as mistake:
        raise _meant(tokens) or mistake from None


def free_text(tokens: Sequence[Token]) -> str:
    """Return the text of tokens as written on the line. A tab between the tokens becomes a space."""
    text, end = "", tokens[0].start
    for token in tokens:
        text += " " * (token.start - end) + token.text
        end = token.end
    return text


def separated(tokens: Sequence[Token]) -> Sequence[Token]:
    """Remove the commas between operands (dialect of 1977) from tokens. Raises Mistake at any other comma."""
    commas = [at for at, token in enumerate(tokens) if token.text == ","]
    for at in commas:
        token = tokens[at]
        if at == 0 or tokens[at - 1].text in (",", "["):
            raise Mistake("misplaced-comma", "there is no operand before this comma", token.span)
        if at + 1 == len(tokens) or tokens[at + 1].text == "]":
            raise Mistake("misplaced-comma", "there is no operand after this comma", token.span)
    return [token for token in tokens if token.text != ","] if commas else tokens


def _meant(tokens: Sequence[Token]) -> Mistake | None:
    """Return the mistake that brackets, units or commas in these operands reveal. Returns None if they reveal no
    mistake.
    """
    opened = False
    for token in tokens:
        if token.text == "]" and not opened:
            help = "write a vector in brackets, such as `[0 0 -1]`"
            return Mistake("unopened-vector", "the vector has no opening bracket", token.span, help=help)
        if token.text in ("[", "]"):
            opened = token.text == "["
    for before, token in pairwise(tokens):
        glued = before.text + token.text if before.end == token.start else ""
        if before.kind is NAME and token.kind is NUMBER and letters_for_digits(glued):
            return _malformed(Token(before.start, token.end, NUMBER, glued))
        unit = no_units(token.text) if token.kind is NAME else None
        if unit is not None and (before.kind is NUMBER or before.text == "]"):
            return Mistake(
                "unit-written",
                f"write a number without the unit {quoted(token.text)}",
                token.span,
                help=unit,
            )
    commas = [at for at, token in enumerate(tokens) if token.text == ","]
    if len(commas) == 1 and _is_decimal(tokens[commas[0] - 1 : commas[0] + 2]):
        whole, _, part = tokens[commas[0] - 1 : commas[0] + 2]
        help = f"write a number with a decimal point: `{whole.text}.{part.text}`"
        span = Span(start=whole.start, end=part.end)
        return Mistake("malformed-number", "a comma separates two operands", span, help=help)
    return None


def _is_decimal(tokens: Sequence[Token]) -> bool:
    """Return True if the tokens are two groups of digits, separated only by a comma."""
    if len(tokens) < 3:
        return False
    whole, comma, part = tokens
    close = whole.end == comma.start and comma.end == part.start
    return close and whole.text.lstrip("+-").isdigit() and part.text.isdigit()


def is_unterminated(token: Token) -> bool:
    """Return True if the token is a string without its closing quote."""
    return token.kind is STRING and (len(token.text) == 1 or token.text[-1] != '"')


class _Reader(msgspec.Struct, gc=False):
    definition: Instruction
    head: Token
    tokens: Sequence[Token]
    at: int = 0
    values: list[Value | None] = []

    def read(self) -> tuple[Value | None, ...]:
        if self.definition.axes and self.tokens and self.tokens[0].kind is NUMBER:
            return (self.axes(),)
        end = len(self.tokens)
        for operand in self.definition.operands:
            self.values.append(None if operand.optional and self.at == end else self.operand(operand))
        if self.at < end:
            self.too_many()
        if self.values and self.values[0] is None:
            self.check_nils()
        return tuple(self.values)

    def operand(self, operand: Operand) -> Value | None:
        if operand.word:
            if not self.takes(operand.word):
                if operand.optional:
                    return None
                raise self.missing(operand)
            if not operand.takes:
                read = self.tokens[self.at - 1]
                return Name(read.start, read.end, operand.word)
        if self.at == len(self.tokens):
            raise self.missing(operand)
        token = self.tokens[self.at]
        if operand.nil and token.text.upper() == NIL:
            self.at += 1
            return None
        value = self.free(token) if operand.free else self.value(token, operand)
        if type(value) not in operand.takes:
            raise self.wrong(value, operand)
        return value

    def takes(self, word: str) -> bool:
        """Consume a keyword if this keyword is the next token. Returns True if the next token was this keyword."""
        if self.at == len(self.tokens):
            return False
        token = self.tokens[self.at]
        found = token.kind is NAME and token.text.upper() == word
        self.at += found
        return found

    def free(self, token: Token) -> Text:
        rest = self.tokens[self.at :]
        if len(rest) == 1 and token.kind is STRING:
            return self.string(token)
        for word in rest:
            if is_unterminated(word):
                raise _unterminated_string(word)
        self.at = len(self.tokens)
        return Text(token.start, rest[-1].end, free_text(rest))

    def value(self, token: Token, operand: Operand) -> Value:
        kind = token.kind
        if kind is STRING:
            return self.string(token)
        if token.text == "[":
            return self.vector(token, operand)
        self.at += 1
        if kind is NUMBER:
            number = Number(token.start, token.end, _number(token))
            if Number in operand.takes:
                self.check_number(number, operand, token)
            return number
        if Name not in operand.takes and _NOT_FINITE.fullmatch(token.text):
            raise _malformed(token)
        if kind is NAME:
            return Name(token.start, token.end, token.text)
        raise _unexpected(token)

    def axes(self) -> Vector:
        """Read axes such as `2 X Y`. Returns a vector with 1 along each named axis."""
        count, *letters = self.tokens
        for letter in letters:
            if letter.text not in AXES:
                message = f"{quoted(letter.text)} is not an axis"
                raise Mistake("unknown-axis", message, letter.span, help="the axes are `X`, `Y` and `Z`")
        named = {letter.text for letter in letters}
        if _number(count) != len(letters) or len(named) != len(letters) or not letters:
            stand = ("no axis is", "one axis is", "two different axes are", "three different axes are")[
                len(named)
            ]
            message = f"the statement says {quoted(count.text)} axes, but {stand} named"
            raise Mistake("axis-count", message, count.span, help=self.usage())
        self.at = len(self.tokens)
        return Vector(count.start, letters[-1].end, tuple(float(axis in named) for axis in AXES))

    def string(self, token: Token) -> Text:
        if is_unterminated(token):
            raise _unterminated_string(token)
        self.at += 1
        return Text(token.start, token.end, token.text[1:-1])

    def vector(self, opening: Token, operand: Operand) -> Vector:
        values: list[float] = []
        for token in self.tokens[self.at + 1 :]:
            if token.kind is NUMBER:
                values.append(_number(token))
            elif token.text == "]":
                break
            else:
                raise _no_number(token)
        else:
            raise Mistake(
                "unterminated-vector", "the vector has no `]`", opening.span, "the vector begins here"
            )
        self.at += len(values) + 2
        vector = Vector(opening.start, token.end, tuple(values))
        if Vector in operand.takes:
            self.check_vector(vector, operand)
        return vector

    def wrong(self, value: Value, operand: Operand) -> Mistake:
        kinds = " or ".join(kind.what for kind in operand.takes)
        message = f"the {operand.plain} of `{self.definition.op}` must be {kinds}, not {value.what}"
        if operand.is_vector:
            takes = f"a vector {operand.name}{' or its name' if Name in operand.takes else ''}"
            message = f"`{self.definition.op}` takes {takes}, not {value.what}"
        return Mistake("wrong-operand", message, value.span, help=self.cure(value, operand) or self.usage())

    def cure(self, value: Value, operand: Operand) -> str | None:
        """Return a hint for a value of the wrong kind."""
        if isinstance(value, Name) and value.text.upper() in INSTRUCTIONS:
            return _begins_a_line(value.text)
        if isinstance(value, Name) and Number in operand.takes:
            return letters_for_digits(value.text)
        if isinstance(value, Number) and operand.is_vector:
            behind = [token.kind is NUMBER for token in self.tokens[self.at : self.at + 2]]
            bare = len(behind) == 2 and all(behind)
            return (
                "write a vector in brackets, such as `[0 0 -1]`"
                if bare
                else f"the vector comes first; {self.usage()}"
            )
        return None

    def check_vector(self, value: Vector, operand: Operand) -> None:
        if not operand.units:
            return  # the operand of a macro: the macro's lines check it
        if len(value.values) != len(operand.units):
            message = f"`{self.definition.op}` takes a vector of {len(operand.units)} numbers, not {len(value.values)}"
            raise Mistake("vector-size", message, value.span, help=self.usage())
        if max(map(abs, value.values)) > MAX_NUMBER:
            message = "a number in the vector is too large"
            raise Mistake("number-out-of-range", message, value.span, operand.why)
        if len(value.values) == 3 and math.hypot(*value.values) < _NO_LENGTH:
            raise Mistake("zero-vector", "a vector of length 0 has no direction", value.span)

    def check_number(self, value: Number, operand: Operand, token: Token) -> None:
        if operand.choices and value.value not in operand.choices:
            known = " and ".join(f"{choice:g}" for choice in operand.choices)
            help = f"the focal lengths are {known} {operand.units[0].name}"
            raise Mistake("unknown-lens", f"there is no {quoted(token.text)} mm lens", value.span, help=help)
        if not operand.low <= value.value <= operand.high:
            size = "small" if value.value < operand.low else "large"
            message = f"{quoted(token.text)} is too {size} for the {operand.plain} of `{self.definition.op}`"
            raise Mistake("number-out-of-range", message, value.span, operand.why)
        if operand.nonzero and abs(value.value) < MIN_POSITIVE:
            message = f"{quoted(token.text)} is too small for the {operand.plain} of `{self.definition.op}`"
            why = f"its absolute value must be at least {MIN_POSITIVE:g} {operand.units[0].name}"
            raise Mistake("number-out-of-range", message, value.span, why)
        if operand.whole and value.value != int(value.value):
            message = f"the {operand.plain} of `{self.definition.op}` must be a whole number"
            raise Mistake("wrong-operand", message, value.span)
        low = self.values[-1] if operand.name == "maximum" else None
        if isinstance(low, Number) and low.value > value.value:
            message = f"the maximum, {value.value:g}, is less than the minimum, {low.value:g}"
            raise Mistake("number-out-of-range", message, value.span)

    def check_nils(self) -> None:
        """Refuse a statement in which all operands are `NIL`."""
        nils = [o.plain for o in self.definition.operands if o.nil]
        if nils and not any(v for o, v in zip(self.definition.operands, self.values, strict=True) if o.nil):
            message = f"`{self.definition.op}` has no {' and no '.join(nils)}"
            raise Mistake("missing-operand", message, self.tokens[-1].span, help=self.usage())

    def missing(self, operand: Operand) -> Mistake:
        message, help = f"the {operand.plain} of `{self.definition.op}` is missing", self.usage()
        end = (self.tokens[self.at - 1] if self.at else self.head).end
        if self.definition.op == "STOP" and not self.tokens:
            help += f": {STOP_ALONE}"
        return Mistake("missing-operand", message, Span(start=end, end=end), "expected here", help)

    def too_many(self) -> None:
        first, last = self.tokens[self.at], self.tokens[-1]
        if first.kind in (JUNK, MARK) and first.text != "[":
            raise _unexpected(first)
        if is_unterminated(last):
            raise _unterminated_string(last)
        span = Span(start=first.start, end=last.end)
        count = len(self.definition.operands)
        message = f"`{self.definition.op}` takes no {'more ' if count else ''}operands"
        early = next((token for token in self.tokens[: self.at] if self.is_too_early(token)), None)
        if early is not None:
            message = f"another operand must come before `{early.text}`"
            raise Mistake("wrong-operand", message, early.span, help=self.usage())
        second = next((token.text for token in self.tokens if token.text.upper() in INSTRUCTIONS), None)
        help = self.usage() if second is None else _begins_a_line(second)
        raise Mistake("too-many-operands", message, span, help=help)

    def is_too_early(self, token: Token) -> bool:
        """Return True if a token was read as a name, but is the keyword of an operand that is still missing."""
        read = zip(self.definition.operands, self.values, strict=True)
        return token.kind is NAME and token.text.upper() in {o.word for o, v in read if v is None} - {"", NIL}

    def usage(self) -> str:
        counted = f" or `{self.definition.op} 2 X Y`" if self.definition.axes else ""
        return f"usage: `{self.definition.usage}`{counted}"


def _unterminated_string(token: Token) -> Mistake:
    start = Span(start=token.start, end=token.start + 1)
    return Mistake("unterminated-string", "the string has no closing quote", start, "the string begins here")


def _begins_a_line(instruction: str) -> str:
    return f"`{instruction.upper()}` is an instruction: put it on a new line"


def _number(token: Token) -> float:
    try:
        value = float(token.text)
    except ValueError:
        raise _malformed(token) from None
    if "_" in token.text:
        raise _malformed(token)
    if math.isinf(value):
        raise Mistake("number-out-of-range", f"the number {quoted(token.text)} is too large", token.span)
    return value


def _malformed(token: Token) -> Mistake:
    glued = with_unit(token.text)
    if glued is not None:
        unit, said = glued
        span = Span(start=token.end - len(unit), end=token.end)
        return Mistake("unit-written", f"write a number without the unit {quoted(unit)}", span, help=said)
    help = letters_for_digits(token.text) or "numbers look like 3, .07, -0.6 or 1e-3"
    return Mistake("malformed-number", f"{quoted(token.text)} is not a number", token.span, help=help)


def _no_number(token: Token) -> Mistake:
    if _NOT_FINITE.fullmatch(token.text):
        return _malformed(token)
    if token.kind is NAME:
        message = f"a vector must contain only numbers, not {quoted(token.text)}"
        return Mistake("wrong-operand", message, token.span, help=letters_for_digits(token.text))
    return _unexpected(token)


def _unexpected(token: Token) -> Mistake:
    message = f"{quoted(token.text)} is not part of the language"
    return Mistake("unexpected-character", message, token.span, help=strange(token.text))
