"""One look for all programs: columns as in a listing of the period, every comment kept."""

from collections.abc import Sequence
from typing import Final

from handeye.al.hints import with_digits
from handeye.al.operands import free_text
from handeye.al.scanner import Line, Token, TokenKind, scan
from handeye.al.word_groups import FREE_TEXT

OPERATION: Final = 8
OPERANDS: Final = 16
COMMENT: Final = 32


def format_text(text: str) -> str:
    """`text` in columns, instructions in capitals; it keeps its meaning, its mistakes and its lines."""
    return "".join(_format(line) + "\n" for line in scan(text))


def _format(line: Line) -> str:
    if not line.tokens:
        return (" " * OPERATION if line.indented and line.comment else "") + (line.comment or "")
    labels, tokens = line.split()
    text = " ".join(f"{label.text}:" for label in labels)
    if tokens and tokens[0].text.upper() == "DEFINE":
        text = " ".join((text, "DEFINE", _operands(tokens[1:]))).strip(" ")
    elif tokens:
        word = tokens[0].text.upper() if tokens[0].kind is TokenKind.NAME else tokens[0].text
        operands = free_text(tokens[1:]) if word in FREE_TEXT and tokens[1:] else _operands(tokens[1:])
        text = _column(text, OPERATION) + word
        text = _column(text, OPERANDS) + operands if operands else text
    return text if line.comment is None else _column(text, COMMENT) + line.comment


def _column(text: str, column: int) -> str:
    """`text` filled up to a column, at least one blank unless it is empty."""
    return text.ljust(column) if len(text) < column else text + " " if text else text


def _operands(tokens: Sequence[Token]) -> str:
    text = ""
    for at, token in enumerate(tokens):
        tight = at == 0 or token.text in ("]", ":", ",") or _is_tight(tokens[max(at - 2, 0) : at + 1])
        text += token.text if tight else f" {token.text}"
    return text


def _is_tight(tokens: Sequence[Token]) -> bool:
    """True if the last token stands against its neighbour: behind a bracket, or a comma with no blanks.

    A blank at a comma is kept, on its right: `0, 5` are two numbers, `0,5` is a wrongly written one. So is `O.5`.
    """
    before, token = tokens[-2:]
    close = before.end == token.start
    if before.text == ",":
        return close and tokens[0].end in (before.start, before.end)
    return before.text == "[" or (close and with_digits(before.text + token.text) is not None)
