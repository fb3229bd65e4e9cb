"""What the referee says about one point."""

from dataclasses import dataclass


@dataclass(frozen=True, slots=True, kw_only=True)
class Finding:
    """A measured value against its limit."""

    ok: bool
    value: float
    limit: float
    """The value may reach it but not pass it; from above or below is said in the sentence."""
    unit: str
    sentence: str


def at_most(value: float, limit: float, unit: str, sentence: str) -> Finding:
    """A finding that is right up to `limit`; the sentence says what was measured."""
    return _finding(value <= limit, value, limit, unit, f"{sentence} (at most {limit:g} {unit})")


def at_least(value: float, limit: float, unit: str, sentence: str) -> Finding:
    """A finding that is right from `limit` on."""
    return _finding(value >= limit, value, limit, unit, f"{sentence} (at least {limit:g} {unit})")


def _finding(ok: bool, value: float, limit: float, unit: str, sentence: str) -> Finding:
    return Finding(ok=bool(ok), value=round(float(value), 4), limit=limit, unit=unit, sentence=sentence)
