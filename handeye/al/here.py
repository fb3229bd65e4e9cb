"""Positions that only a `HERE` defines: each has to be defined before it is used."""

from collections.abc import Container, Iterator, Sequence

from handeye.al.syntax import Name, Statement
from handeye.diagnostics import Diagnostic, Label, quoted
from handeye.plan.program import Here, Step


def check_here(
    steps: Sequence[Step], origins: Sequence[Statement], known: Container[str]
) -> Iterator[Diagnostic]:
    """An error for each use that comes, in the order of the text, before the `HERE` it needs.

    Args:
        origins: the statements of the steps.
        known: positions that are taught or written.
    """
    defined: dict[str, int] = {}
    for number, step in enumerate(steps):
        if isinstance(step.operation, Here):
            defined.setdefault(step.operation.position, number)
    for number, statement in enumerate(origins):
        for value in statement.operands:
            if isinstance(value, Name) and value.text not in known and defined.get(value.text, -1) > number:
                yield _early(value, origins[defined[value.text]])


def _early(use: Name, here: Statement) -> Diagnostic:
    return Diagnostic(
        code="position-before-here",
        message=f"position {quoted(use.text)} is used before `HERE` defines it",
        primary=Label(span=use.span),
        secondary=(Label(span=here.span, text="defined here"),),
        help="the planning phase goes through the text in its order; a `TRANS` would tell it where to plan",
    )
