"""Assigns the tokens of an unfinished line to the operands of its instruction.

The parser accepts only complete, correct lines, but an editor needs results while the user is still typing a
line.
"""

from collections.abc import Iterator, Sequence
from dataclasses import dataclass

from handeye.al.definition import Instruction, Operand
from handeye.al.instructions import INSTRUCTIONS
from handeye.al.scanner import Line, Token, TokenKind
from handeye.al.syntax import Vector

SEPARATOR = ","


@dataclass(frozen=True, slots=True, kw_only=True)
class OperandToken:
    """A token and its operand. The operand is None for a surplus token. `component` is the token's index in a vector,
    counted from 0."""

    token: Token
    operand: Operand | None
    component: int = 0


def instruction(line: Line) -> tuple[Instruction | None, tuple[Token, ...]]:
    """Return the instruction of a line, or None if the line has no known instruction. Also return the tokens of the
    line from the instruction word on.
    """
    tokens = line.split()[1]
    known = bool(tokens) and tokens[0].kind is TokenKind.NAME
    return (INSTRUCTIONS.get(tokens[0].text.upper()) if known else None), tokens


def places(definition: Instruction, tokens: Sequence[Token]) -> list[OperandToken]:
    """Return the tokens after the instruction word, each with its operand."""
    return list(_Walk(definition, tokens).go())


def expected(definition: Instruction, tokens: Sequence[Token]) -> list[Operand]:
    """Return the operands that may come next: the first missing operand and, if that operand is optional, the operands
    after it.
    """
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

    def go(self) -> Iterator[OperandToken]:
        for number, operand in enumerate(self.operands):
            if self.at == len(self.tokens):
                rest = self.operands[number:]
                needed = next((i for i, o in enumerate(rest) if not o.optional), len(rest) - 1)
                self.expected = list(rest[: needed + 1])
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

    def _value(self, operand: Operand) -> Iterator[OperandToken]:
        if operand.free:
            while self.at < len(self.tokens):
                yield self._take(operand)
            return
        vector = self.tokens[self.at].text == "["
        yield self._take(operand)
        component, limit = 0, len(operand.units) if Vector in operand.takes else 0
        while vector and self.at < len(self.tokens):
            token = self.tokens[self.at]
            yield self._take(operand, min(component, max(limit - 1, 0)))
            if token.text == "]":
                return
            component += 1

    def _take(self, operand: Operand | None, component: int = 0) -> OperandToken:
        self.at += 1
        return OperandToken(token=self.tokens[self.at - 1], operand=operand, component=component)
