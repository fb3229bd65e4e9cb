"""The witness of the assembly line. It records the pieces that the program counts, and how long the arms touched each
other.
"""

import re
from typing import Final

from handeye.systems.sigma.gantries.witness import HeardTouches, TouchWitness
from handeye.systems.sigma.line.pieces import LinePiece

_TOLD: Final = re.compile(r"PIECES\s+(\d{1,9})\s+WITHDRAWN\s+(\d{1,9})\b")


class WatchedLine(HeardTouches, frozen=True, kw_only=True):
    """The pieces on the feeder, the lines that the program has printed, and the time for which the arms touched each
    other.
    """

    pieces: tuple[LinePiece, ...]

    @property
    def counted(self) -> tuple[int, int]:
        """The numbers of finished and of withdrawn pieces that the program printed last; both are 0 if the program
        printed no numbers.
        """
        told = [said for line in self.lines if (said := _TOLD.search(line)) is not None]
        return (int(told[-1][1]), int(told[-1][2])) if told else (0, 0)


class LineWitness(TouchWitness[WatchedLine]):
    """The witness of the assembly line."""
