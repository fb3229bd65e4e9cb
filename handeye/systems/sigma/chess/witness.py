"""The witness of a board, which records the initial pieces and what the program prints about them. Only the referee
sees these records.
"""

import re
from math import isfinite
from typing import Final

from handeye.core.record import Record
from handeye.systems.sigma.chess.pieces import Piece
from handeye.systems.sigma.gantries.witness import Heard

_TOLD: Final = re.compile(r"HEIGHT\s*(\S+)\s+AT\s*(\S+)\s+LINE\s*(\d)")


class ToldHeight(Record, frozen=True, kw_only=True):
    """A piece, as the program measured and reported it (mm)."""

    height: float
    x: float
    line: int


class HeardHeights(Heard, frozen=True, kw_only=True):
    """The pieces at their initial positions, and the lines that the program has printed."""

    pieces: tuple[Piece, ...]

    @property
    def heights(self) -> list[ToldHeight]:
        """The pieces for which the program has printed height, position and line."""
        found = []
        for line in self.lines:
            if (said := _TOLD.search(line)) is None:
                continue
            try:
                told = ToldHeight(height=float(said[1]), x=float(said[2]), line=int(said[3]))
            except ValueError:  # not a number
                continue
            if isfinite(told.height) and isfinite(told.x):
                found.append(told)
        return found
