"""The figures of a prediction for a terminal."""

from collections.abc import Iterator
from typing import TYPE_CHECKING, Final

from rich.console import Group, RenderableType
from rich.table import Table
from rich.text import Text

from handeye.cli.batch_text import PlainTable, percent
from handeye.core.plain_text import counted

if TYPE_CHECKING:
    from handeye.trials.prediction.figures import Agreement, Outcome, PredictionFigures

THIN: Final = 0.5
"""Share of its room from which, in the worst world, a thing has a line."""
WORLDS: Final = 10
"""Of the worst, that have a line."""


def page(found: "PredictionFigures") -> RenderableType:
    """All that is told of a prediction."""
    parts: list[RenderableType] = [_operations(found), *map(Text, _left_out(found)), Text()]
    parts += [_worst(found), *map(Text, _more(found)), Text()]
    if found.outcome is not None:
        parts += [_agreements(found.outcome.agreements), Text()] if found.outcome.agreements else []
        parts.append(Text(_outcome(found.outcome)))
    return Group(*parts, Text(_verdict(found)))


def _operations(found: "PredictionFigures") -> Table:
    heads = "room", "median", "95 %", "worst", "used", "seed", "beyond"
    table = PlainTable(("operation", "at", "what is off", "unit"), *heads)
    for each in found.operations:
        if each.used >= THIN:
            figures = (f"{value:.2f}" for value in (each.room, each.median, each.p95, each.worst, each.used))
            beyond = percent(each.beyond) if each.beyond else ""
            table.row(each.operation, each.at, each.what, each.unit, *figures, str(each.worst_seed), beyond)
    return table


def _left_out(found: "PredictionFigures") -> Iterator[str]:
    left = sum(each.used < THIN for each in found.operations)
    if left:
        yield f"{left} more never use half of their room"


def _worst(found: "PredictionFigures") -> Table:
    table = PlainTable(("worst worlds: seed",), "used", "operation", "at", "what is off", "by", "of")
    for each in found.worst[:WORLDS]:
        far = (f"{value:.2f} {each.unit}" for value in (each.off, each.room))
        table.row(str(each.seed), f"{each.used:.2f}", each.operation, each.at, each.what, *far)
    return table


def _more(found: "PredictionFigures") -> Iterator[str]:
    if len(found.worst) > WORLDS:
        yield f"and {len(found.worst) - WORLDS} more; --json tells them"


def _agreements(each: "tuple[Agreement, ...]") -> Table:
    table = PlainTable(
        ("predicted and measured", "unit"), "trials", "predicted", "measured", "alike", "correlation"
    )
    for one in each:
        medians = f"{one.predicted:.3g}", f"{one.measured:.3g}"
        told = "" if one.correlation is None else f"{one.correlation:.2f}"
        table.row(one.name, one.unit, str(one.n), *medians, percent(one.close), told)
    return table


def _outcome(found: "Outcome") -> str:
    return (
        f"of {counted(found.n, 'whole trial')} {found.failed} failed ({found.silent} silently): {found.both} of the "
        f"{found.predicted} that were predicted to fail, and {found.failed - found.both} of the "
        f"{found.n - found.predicted} that were not"
    )


def _verdict(found: "PredictionFigures") -> str:
    return f"something is predicted to fail in {percent(found.beyond)} of {counted(found.n, 'world')}"
