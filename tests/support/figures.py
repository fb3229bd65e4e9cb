"""Figures in recorded text. Their last digit is the processor's: NumPy and OpenBLAS take other instructions on another
kind, and contacts make a rounding error of theirs larger."""

import re
from typing import Final

FIGURE: Final = re.compile(r"(-?\d+\.\d+)( ounces\b)?")
UNITS: Final = 3
"""By how many units of its last place a figure may be another one."""
OUNCES: Final = 15
"""The same of a force, tenths of an ounce: it rises by as much in a few milliseconds of a contact, .6 oz was seen."""


def as_recorded(text: str, recorded: str) -> str:
    """The text with each figure as it was recorded, where the two differ by their last place only.

    Compare what this gives with `recorded`: every other difference is still there.
    """
    figures = iter(figure for figure, _ in FIGURE.findall(recorded))

    def put(found: re.Match[str]) -> str:
        units = OUNCES if found[2] else UNITS
        return _nearly(found[1], next(figures, ""), units) + (found[2] or "")

    return FIGURE.sub(put, text)


def _nearly(figure: str, recorded: str, units: int) -> str:
    places = len(recorded.partition(".")[2])
    alike = recorded and len(figure.partition(".")[2]) == places
    near = alike and abs(float(figure) - float(recorded)) < (units + 0.5) * 10**-places
    return recorded if near else figure
