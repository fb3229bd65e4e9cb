"""Formats numbers for the page."""

from handeye.core.units import MILLIMETRE, OUNCE_FORCE, OUNCE_INCH
from handeye.program.guards import GuardKind


def clock(seconds: float) -> str:
    """Return a time of the run in minutes and whole seconds, such as `7:08`."""
    whole = max(0, int(seconds + 1e-6))
    return f"{whole // 60}:{whole % 60:02d}"


def duration(seconds: float) -> str:
    """Return a duration in minutes and whole seconds."""
    return clock(round(seconds))


def exact_clock(seconds: float) -> str:
    """Return a time of the run to a tenth of a second, such as `7:08.6`."""
    tenths = max(0, int(10 * seconds + 1e-6))
    return f"{tenths // 600}:{tenths // 10 % 60:02d}.{tenths % 10}"


def millimetres(length: float) -> str:
    """Return a length (m) in millimetres, with one or two decimals."""
    size = length / MILLIMETRE
    places = 2 if abs(size) < 10 else 1
    return f"{size:z.{places}f}"


def felt(kind: GuardKind, value: float) -> str:
    """Return the value that a guard watches, in SI units and in the units of the arm language."""
    match kind:
        case GuardKind.FORCE | GuardKind.AGAINST:
            return f"{value:z.1f} N ({value / OUNCE_FORCE:.4g} oz)"
        case GuardKind.MOMENT | GuardKind.TORQUE:
            return f"{value:z.3f} N m ({value / OUNCE_INCH:.4g} oz in)"
        case GuardKind.TOUCH:
            return _FINGERS[round(value) % 4]


_FINGERS = ("no finger", "finger 1", "finger 2", "both fingers")
