"""Formats programs in the columns of a listing of 1973. Comments are kept."""

from collections.abc import Sequence
from typing import Final

from handeye.al.hints import with_digits
from handeye.al.instructions import FREE_TEXT
from handeye.al.operands import free_text
from handeye.al.scanner import Line, Token, TokenKind, scan

OPERATION_COLUMN: Final = 8
OPERANDS_COLUMN: Final = 16
COMMENT_COLUMN: Final = 32


def format_text(text: str) -> str:
    """Format a text in columns, with instructions in capitals. The meaning of the text, its mistakes and its line
    numbers do not change.
    """
    return "".join(_format(line) + "\n" for line in scan(text))


def _format(line: Line) -> str:
    if not line.tokens:
        return (" " * OPERATION_COLUMN if line.indented and line.comment else "") + (line.comment or "")
    labels, tokens = line.split()
    text = " ".join(f"{label.text}:" for label in labels)
    if tokens and tokens[0].text.upper() == "DEFINE":
        text = " ".join((text, "DEFINE", _operands(tokens[1:]))).strip(" ")
    elif tokens:
        word = tokens[0].text.upper() if tokens[0].kind is TokenKind.NAME else tokens[0].text
        operands = free_text(tokens[1:]) if word in FREE_TEXT and tokens[1:] else _operands(tokens[1:])
        text = _column(text, OPERATION_COLUMN) + word
        text = _column(text, OPERANDS_COLUMN) + operands if operands else text
    return text if line.comment is None else _column(text, COMMENT_COLUMN) + line.comment


def _column(text: str, column: int) -> str:
    """Pad a text to a column, with at least one blank unless the text is empty."""
    return text.ljust(column) if len(text) < column else text + " " if text else text


def _operands(tokens: Sequence[Token]) -> str:
    text = ""
    for at, token in enumerate(tokens):
        tight = at == 0 or token.text in ("]", ":", ",") or _is_tight(tokens[max(at - 2, 0) : at + 1])
        text += token.text if tight else f" {token.text}"
    return text


def _is_tight(tokens: Sequence[Token]) -> bool:
    """Return True if no blank may come between the last two tokens. This is so if the first of the two is a bracket,
    or a comma that is not followed by a blank.

    A blank after a comma is kept, because `0, 5` are two numbers, and `0,5` is one number written wrongly. No blank is
    put into `O.5`, because this is one number too, written wrongly with the letter O in place of a zero.
    """
    before, token = tokens[-2:]
    close = before.end == token.start
    if before.text == ",":
        return close and tokens[0].end in (before.start, before.end)
    return before.text == "[" or (close and with_digits(before.text + token.text) is not None)
