"""Reads the lines of text in which a program reports the height of a chess piece."""

import re
from math import isfinite
from typing import Final

from handeye.core.record import Record

_TOLD: Final = re.compile(r"HEIGHT\s*(\S+)\s+AT\s*(\S+)\s+LINE\s*(\d)")


class ToldHeight(Record, frozen=True, kw_only=True):
    """A piece, as the program measured and reported it (mm)."""

    height: float
    x: float
    line: int

    @property
    def text(self) -> str:
        """The line that reports it."""
        return f"HEIGHT {self.height:.3f} AT {self.x:.3f} LINE {self.line}"


def told_height(text: str) -> ToldHeight | None:
    """Return the height that a printed line reports; None if the line reports no height."""
    if (said := _TOLD.search(text)) is None:
        return None
    try:
        told = ToldHeight(height=float(said[1]), x=float(said[2]), line=int(said[3]))
    except ValueError:  # not a number
        return None
    return told if isfinite(told.height) and isfinite(told.x) else None
