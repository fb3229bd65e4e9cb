"""Which operand of its instruction each token of a line is, as far as that can be told from a line in the making.

The parser reads whole lines and refuses wrong ones; an editor looks at lines that somebody is typing.
"""

from collections.abc import Iterator, Sequence
from dataclasses import dataclass

from handeye.al.definition import Instruction, Operand
from handeye.al.instructions import INSTRUCTIONS
from handeye.al.scanner import Line, Token, TokenKind
from handeye.al.syntax import Vector

SEPARATOR = ","


@dataclass(frozen=True, slots=True, kw_only=True)
class Place:
    """A token in the operand column."""

    token: Token
    operand: Operand | None
    """None: it is more than the instruction takes."""
    component: int = 0
    """Of a number in a vector: which, from 0."""


def instruction(line: Line) -> tuple[Instruction | None, tuple[Token, ...]]:
    """The instruction of a line, if it is one, and the tokens from its word on (none: labels at most)."""
    tokens = line.split()[1]
    known = bool(tokens) and tokens[0].kind is TokenKind.NAME
    return (INSTRUCTIONS.get(tokens[0].text.upper()) if known else None), tokens


def places(definition: Instruction, tokens: Sequence[Token]) -> list[Place]:
    """Every token behind the word of an instruction, with the operand it belongs to."""
    return list(_Walk(definition, tokens).go())


def expected(definition: Instruction, tokens: Sequence[Token]) -> list[Operand]:
    """Operands that may come next: the first and, while that is optional, those after it."""
    walk = _Walk(definition, tokens)
    for _ in walk.go():
        pass
    return walk.expected


class _Walk:
    def __init__(self, definition: Instruction, tokens: Sequence[Token]) -> None:
        self.operands = definition.operands
        self.tokens = [token for token in tokens if token.text != SEPARATOR]
        self.at = 0
        self.expected: list[Operand] = []

    def go(self) -> Iterator[Place]:
        for number, operand in enumerate(self.operands):
            if self.at == len(self.tokens):
                self.expected = self._open(number)
                return
            if operand.word:
                if self.tokens[self.at].text.upper() != operand.word:
                    continue
                yield self._take(operand)
                if not operand.takes:
                    continue
                if self.at == len(self.tokens):
                    self.expected = [operand]
                    return
            yield from self._value(operand)
        while self.at < len(self.tokens):
            yield self._take(None)

    def _open(self, number: int) -> list[Operand]:
        rest = self.operands[number:]
        needed = next((i for i, operand in enumerate(rest) if not operand.optional), len(rest) - 1)
        return list(rest[: needed + 1])

    def _value(self, operand: Operand) -> Iterator[Place]:
        if operand.free:
            while self.at < len(self.tokens):
                yield self._take(operand)
        elif self.tokens[self.at].text == "[":
            yield self._take(operand)
            yield from self._components(operand)
        else:
            yield self._take(operand)

    def _components(self, operand: Operand) -> Iterator[Place]:
        component, limit = 0, len(operand.units) if Vector in operand.takes else 0
        while self.at < len(self.tokens):
            token = self.tokens[self.at]
            yield self._take(operand, min(component, max(limit - 1, 0)))
            if token.text == "]":
                return
            component += 1

    def _take(self, operand: Operand | None, component: int = 0) -> Place:
        self.at += 1
        return Place(token=self.tokens[self.at - 1], operand=operand, component=component)
