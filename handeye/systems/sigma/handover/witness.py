"""The witness of a hand-over. It records how many pieces the program has counted, and for how long the arms touched
each other.
"""

import re
from typing import Final

from handeye.systems.sigma.gantries.witness import HeardTouches, TouchWitness
from handeye.systems.sigma.handover.pieces import Piece

_TOLD: Final = re.compile(r"PIECES\s+(\d{1,9})\b")


class Watched(HeardTouches, frozen=True, kw_only=True):
    """The pieces in their initial positions, the lines that the program has printed, and how long the arms touched."""

    pieces: tuple[Piece, ...]

    @property
    def counted(self) -> int | None:
        """The number of finished pieces that the program printed last; None if the program printed no number."""
        told = [int(said[1]) for line in self.lines if (said := _TOLD.search(line)) is not None]
        return told[-1] if told else None


class HandoverWitness(TouchWitness[Watched]):
    """The witness of a hand-over."""
