"""The witness of an insertion: what the program prints, the greatest force in a wrist, the steps that motors have
lost, and how long the arms touched."""

import re
from typing import ClassVar, Final

import numpy as np
from msgspec.structs import replace

from handeye.core.errors import BadFile
from handeye.systems.sigma.gantries.machine import Gantries
from handeye.systems.sigma.gantries.witness import HeardTouches, Witness, touch_of_arms
from handeye.systems.sigma.insert.pieces import Peg
from handeye.systems.sigma.protocol import AXES

_TOLD: Final = re.compile(r"PEGS\s+(\d{1,9})\b")


class WatchedInsertion(HeardTouches, frozen=True, kw_only=True):
    """The pegs at the beginning, the lines that the program has printed, the greatest force in a wrist, and the steps
    that motors have lost.
    """

    pegs: tuple[Peg, ...]
    most_n: float = 0.0  # N, the greatest force in a wrist along any axis
    slipped: tuple[int, ...] = (0,) * len(AXES)  # poles that each rotor has slipped since the power came on
    lost: int = 0  # sum of the slipped poles that make counts wrong

    @property
    def counted(self) -> int | None:
        """The program's own count of inserted pegs: the last number that the program printed. None if the program
        printed no number.
        """
        told = [int(said[1]) for line in self.lines if (said := _TOLD.search(line)) is not None]
        return told[-1] if told else None


class InsertionWitness(Witness[WatchedInsertion]):
    """Records what the program prints, and watches wrists, motors and arms."""

    growing: ClassVar[tuple[str, ...]] = ("lines", "most_n", "slipped", "lost", "touched_ms")

    def watch(self, gantries: Gantries) -> None:
        model, data, touches = gantries.bench.model, gantries.bench.data, touch_of_arms(gantries)
        wrists = [model.joint(f"wrist_{axis}") for axis in AXES]
        bent = [int(joint.qposadr[0]) for joint in wrists]
        stiff = np.array([float(joint.stiffness[0]) for joint in wrists])

        def look() -> None:
            most = float(np.abs(data.qpos[bent] * stiff).max())
            touch = touches()
            if most > self.heard.most_n or touch:
                self.heard = replace(
                    self.heard,
                    most_n=max(most, self.heard.most_n),
                    touched_ms=self.heard.touched_ms + touch,
                )
            now = gantries.memory.slipped
            if (*now,) != self.heard.slipped:
                each = zip(now, self.heard.slipped, gantries.counting, strict=True)
                lost = sum(abs(poles - before) for poles, before, counted in each if counted)
                self.heard = replace(self.heard, slipped=(*now,), lost=self.heard.lost + lost)

        gantries.bench.after_step.append(look)

    def check(self, state: WatchedInsertion) -> None:
        super().check(state)
        if len(state.slipped) != len(AXES):
            raise BadFile("the number of motors in the saved state is wrong")
        if min(state.touched_ms, state.lost, state.most_n) < 0:
            raise BadFile("forces, lost steps and times of contact cannot be negative")
