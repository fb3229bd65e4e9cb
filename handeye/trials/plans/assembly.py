"""The sweep of planned programs that are carried out and judged."""

from collections.abc import Sequence
from typing import Final

from handeye.trials.plans.distributions import details
from handeye.trials.plans.row import OUTCOMES, Row
from handeye.trials.sweep import Sweep


def answered(rows: Sequence[Row]) -> int:
    """Trials in which calls of the operator were answered, however they ended."""
    return sum(row.result is not None and bool(row.result.interventions) for row in rows)


def _summary(rows: Sequence[Row]) -> list[str]:
    count = answered(rows)
    return [f"in {count} the operator was called and answered"] if count else []


ASSEMBLY: Final = Sweep(
    kind="assembly",
    row=Row,
    outcomes=OUTCOMES,
    success="assembled",
    narrated=True,
    summary=_summary,
    more=lambda rows: {"answered": answered(rows)},
    details=details,
)
"""Programs carried out and judged."""
