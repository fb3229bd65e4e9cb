"""The witness of a hand-over: the pieces counted by the program, and how long the arms touched."""

import re
from typing import ClassVar, Final

from msgspec.structs import replace

from handeye.core.errors import BadFile
from handeye.systems.sigma.gantries.machine import Gantries
from handeye.systems.sigma.gantries.witness import Heard, Witness, touch_of_arms
from handeye.systems.sigma.handover.pieces import Piece

_TOLD: Final = re.compile(r"PIECES\s+(\d{1,9})\b")


class Watched(Heard, frozen=True, kw_only=True):
    """The pieces in their initial positions, the lines that the program has printed, and how long the arms touched."""

    pieces: tuple[Piece, ...]
    touched_ms: int = 0

    @property
    def counted(self) -> int | None:
        """The number of finished pieces that the program printed last; None if it printed none."""
        told = [int(said[1]) for line in self.lines if (said := _TOLD.search(line)) is not None]
        return told[-1] if told else None


class HandoverWitness(Witness[Watched]):
    """Records what the program prints, and watches whether the arms touch each other."""

    growing: ClassVar[tuple[str, ...]] = ("lines", "touched_ms")

    def watch(self, gantries: Gantries) -> None:
        touching = touch_of_arms(gantries)

        def look() -> None:
            if touching():
                self.heard = replace(self.heard, touched_ms=self.heard.touched_ms + 1)

        gantries.bench.after_step.append(look)

    def check(self, state: Watched) -> None:
        super().check(state)
        if state.touched_ms < 0:
            raise BadFile("the time for which the arms touched cannot be negative")
