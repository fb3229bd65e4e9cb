"""Figures in recorded text. Their last digit is the processor's: NumPy and OpenBLAS take other instructions on another
kind, and contacts make a rounding error of theirs larger."""

import re
from typing import Final

FIGURE: Final = re.compile(r"-?\d+\.\d+")
UNITS: Final = 3
"""By how many units of its last place a figure may be another one."""


def as_recorded(text: str, recorded: str) -> str:
    """The text with each figure as it was recorded, where the two differ by their last place only.

    Compare what this gives with `recorded`: every other difference is still there.
    """
    figures = iter(FIGURE.findall(recorded))
    return FIGURE.sub(lambda found: _nearly(found[0], next(figures, "")), text)


def _nearly(figure: str, recorded: str) -> str:
    places = len(recorded.partition(".")[2])
    alike = recorded and len(figure.partition(".")[2]) == places
    near = alike and abs(float(figure) - float(recorded)) < (UNITS + 0.5) * 10**-places
    return recorded if near else figure
