"""Figures in recorded text. Their last digit depends on the processor: NumPy and OpenBLAS use other instructions on
another kind of processor, and contacts enlarge the rounding errors.
"""

import re
from typing import Final

FIGURE: Final = re.compile(r"(-?\d+\.\d+)( ounces\b)?")
UNITS: Final = 3
"""Tolerance of a figure, in units of its last place."""
OUNCES: Final = 15
"""The same tolerance for a force, in tenths of an ounce. In a few milliseconds of a contact a force rises by as much;
we saw .6 oz.
"""


def as_recorded(text: str, recorded: str) -> str:
    """The text with each figure as it was recorded, where the two differ by their last place only.

    Compare the result with `recorded`: all other differences remain.
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
