"""The witness of the plate job: the pins and screws that the program has counted, and how long the arms touched."""

import re
from typing import ClassVar, Final

from msgspec.structs import replace

from handeye.core.errors import BadFile
from handeye.systems.sigma.gantries.machine import Gantries
from handeye.systems.sigma.gantries.witness import Heard, Witness, touch_of_arms
from handeye.systems.sigma.prco.drawing import Pump

_TOLD: Final = re.compile(r"PINS\s+(\d{1,9})\s+SCREWS\s+(\d{1,9})\b")


class WatchedPump(Heard, frozen=True, kw_only=True):
    """The parts at their initial places, the lines that the program has printed, and how long the two arms touched
    each other.
    """

    pump: Pump
    touched_ms: int = 0

    @property
    def counted(self) -> tuple[int, int]:
        """The numbers of pins and of screws that the program printed last; 0 and 0 if it printed none."""
        told = [(int(said[1]), int(said[2])) for line in self.lines if (said := _TOLD.search(line))]
        return told[-1] if told else (0, 0)


class PumpWitness(Witness[WatchedPump]):
    """Records what the program prints, and watches whether the arms touch each other."""

    growing: ClassVar[tuple[str, ...]] = ("lines", "touched_ms")

    def watch(self, gantries: Gantries) -> None:
        touching = touch_of_arms(gantries)

        def look() -> None:
            if touching():
                self.heard = replace(self.heard, touched_ms=self.heard.touched_ms + 1)

        gantries.bench.after_step.append(look)

    def check(self, state: WatchedPump) -> None:
        super().check(state)
        if state.touched_ms < 0:
            raise BadFile("the time for which the arms touched cannot be negative")
