"""The witness of a board. For the referee only, it records the initial pieces and what the program prints about
them."""

import re
from math import isfinite
from typing import Final

from msgspec import field
from msgspec.structs import replace

from handeye.cell.mechanism import Mechanism
from handeye.core.errors import BadFile
from handeye.core.record import Record
from handeye.systems.sigma.chess.pieces import Piece

HEARD: Final = "heard"
_MOST: Final = 200  # lines
_LONGEST: Final = 2000  # characters
_TOLD: Final = re.compile(r"HEIGHT\s*(\S+)\s+AT\s*(\S+)\s+LINE\s*(\d)")


class ToldHeight(Record, frozen=True, kw_only=True):
    """A piece, as the program measured and reported it (mm)."""

    height: float
    x: float
    line: int


class Heard(Record, frozen=True, kw_only=True):
    """The pieces at their initial positions, and the lines that the program has printed."""

    pieces: tuple[Piece, ...]
    lines: tuple[str, ...] = field(default=())

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


class Witness(Mechanism[Heard]):
    """Records the lines that the program prints about a board."""

    name = HEARD
    kind = Heard

    def __init__(self, pieces: tuple[Piece, ...]) -> None:
        self.heard = Heard(pieces=pieces)

    def hear(self, line: str) -> None:
        """Record a printed line."""
        if len(self.heard.lines) < _MOST:
            self.heard = replace(self.heard, lines=(*self.heard.lines, line[:_LONGEST]))

    def state(self) -> Heard:
        return self.heard

    def check(self, state: Heard) -> None:
        if state.pieces != self.heard.pieces:
            raise BadFile("other pieces stood on its board")
        if len(state.lines) > _MOST or any(len(line) > _LONGEST for line in state.lines):
            raise BadFile("the program cannot have printed so much")

    def restore(self, state: Heard) -> None:
        self.heard = state
