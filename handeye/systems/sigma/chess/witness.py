"""The witness of a board, which records the initial pieces and what the program prints about them. Only the referee
sees these records.
"""

from handeye.systems.sigma.chess.heights import ToldHeight, told_height
from handeye.systems.sigma.chess.pieces import Piece
from handeye.systems.sigma.gantries.witness import Heard


class HeardHeights(Heard, frozen=True, kw_only=True):
    """The pieces at their initial positions, and the lines that the program has printed."""

    pieces: tuple[Piece, ...]

    @property
    def heights(self) -> list[ToldHeight]:
        """The pieces for which the program has printed height, position and line."""
        return [told for line in self.lines if (told := told_height(line)) is not None]
