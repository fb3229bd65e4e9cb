"""Positions that only a `HERE` defines: each has to be defined before it is used."""

from collections.abc import Container, Iterator, Sequence
from typing import Final

from handeye.al.definition import Refers
from handeye.al.macros import Placed
from handeye.al.parameters import uses
from handeye.al.statements import pairs
from handeye.al.syntax import Name, Statement
from handeye.core.diagnostics import Diagnostic, Label, quoted

_PLACES: Final = (Refers.POSITION, Refers.TARGET)


def check_here(placed: Sequence[Placed], known: Container[str]) -> Iterator[Diagnostic]:
    """An error for each use that comes, in the order of the text, before the `HERE` it needs.

    Args:
        placed: the expanded program.
        known: positions that are taught or written.
    """
    defined: dict[str, int] = {}
    for number, item in enumerate(placed):
        word, operands = item.statement.word, item.statement.operands
        if word is not None and word.text == "HERE" and isinstance(operands[0], Name):
            defined.setdefault(operands[0].text, number)
    for number, item in enumerate(placed):
        for operand, value in pairs(item.statement):
            if isinstance(value, Name) and operand.refers in _PLACES and value.text not in known:
                here = defined.get(value.text, number)
                if here > number:
                    yield _early(value, placed[here].statement)


def _early(use: Name, here: Statement) -> Diagnostic:
    return Diagnostic(
        code="position-before-here",
        message=f"position {quoted(use.text)} is used before `HERE` defines it",
        primary=Label(span=use.span),
        secondary=(Label(span=here.span, text="defined here"), *uses(use)),
        help="planning follows the order of the text; a `TRANS` would give it a place",
    )
