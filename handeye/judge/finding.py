"""Defines findings of the referee as data."""

from collections.abc import Mapping
from dataclasses import dataclass, replace
from typing import Literal

Relation = Literal["at most", "at least"]


@dataclass(frozen=True, slots=True, kw_only=True)
class Finding:
    """A measured value and its limit. `ok` is True if the value is within the limit.

    >>> finding = handeye.at_most(0.3, 0.2, "mm", "gap under the head")
    >>> finding.ok, finding.limited(0.5).ok
    (False, True)
    """

    ok: bool
    subject: str  # the quantity that was measured
    value: float  # measured value, in `unit`
    relation: Relation  # `at most` or `at least`: the value may reach the limit
    limit: float
    unit: str
    caution: bool = False  # True if a failed finding is only a warning: the work may still be right

    @property
    def refuses(self) -> bool:
        """True if the referee rejects the work because of this finding."""
        return not self.ok and not self.caution

    def limited(self, limit: float) -> "Finding":
        """Return a copy of the finding with another limit. `limit` is in the unit of the finding. If the value is
        beyond `limit`, the copy makes the referee reject the work.
        """
        ok = self.value <= limit if self.relation == "at most" else self.value >= limit
        return replace(self, limit=limit, ok=ok, caution=False)

    @property
    def beyond(self) -> float:
        """Amount by which the value exceeds its limit, in `unit`; negative if the value is within the limit."""
        return self.value - self.limit if self.relation == "at most" else self.limit - self.value


Findings = Mapping[str, Finding]  # by the name of the point that was checked


def at_most(value: float, limit: float, unit: str, subject: str, *, caution: bool = False) -> Finding:
    """Return a finding whose `ok` is True if the value is at most `limit`. If `caution` is True, a value above the
    limit is only a warning: the referee does not reject the work for this value.

    >>> handeye.at_most(0.1, 0.2, "mm", "gap under the head").ok
    True
    """
    return replace(_finding(value <= limit, value, "at most", limit, unit, subject), caution=caution)


def at_least(value: float, limit: float, unit: str, subject: str) -> Finding:
    """Return a finding whose `ok` is True if the value is at least `limit`.

    >>> handeye.at_least(70, 40, "N", "smallest clamping force").ok
    True
    """
    return _finding(value >= limit, value, "at least", limit, unit, subject)


def worse(one: Findings, other: Findings) -> Findings:
    """Compare the findings of two inspections. Return the worse of the two findings for each name."""
    return {
        name: max(found, other[name], key=lambda finding: (not finding.ok, finding.beyond))
        for name, found in one.items()
    }


def all_right(findings: Findings) -> bool:
    """Return True if there is at least one finding, and if no finding makes the referee reject the work."""
    return bool(findings) and not any(finding.refuses for finding in findings.values())


def _finding(ok: bool, value: float, relation: Relation, limit: float, unit: str, subject: str) -> Finding:
    return Finding(
        ok=bool(ok), subject=subject, value=round(float(value), 4), relation=relation, limit=limit, unit=unit
    )
