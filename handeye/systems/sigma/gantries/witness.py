"""The witness of a job, which records what the program prints and what happens on the board. Only the referee sees
these records.
"""

from collections.abc import Callable
from typing import ClassVar, Final, Generic, TypeVar

import numpy as np
from msgspec import field
from msgspec.structs import replace

from handeye.cell.mechanism import Mechanism
from handeye.core.errors import BadFile
from handeye.core.record import Record
from handeye.systems.sigma.gantries.machine import Gantries

HEARD: Final = "heard"
_MOST: Final = 200  # lines
_LONGEST: Final = 2000  # characters


class Heard(Record, frozen=True, kw_only=True):
    """The lines that the program has printed."""

    lines: tuple[str, ...] = field(default=())


H = TypeVar("H", bound=Heard)


def touch_of_arms(gantries: Gantries) -> Callable[[], bool]:
    """Return a function that returns True while arms touch each other. A piece in a hand is no part of the arm, so the
    function ignores contacts with the piece.
    """
    model, data = gantries.bench.model, gantries.bench.data
    roots = {model.body(f"carriage_X{arm}").id: 1 << arm for arm in gantries.rig.arms}
    arm_of = np.array([roots.get(int(root), 0) for root in model.body_rootid])[model.geom_bodyid]

    def touch() -> bool:
        if not data.ncon:
            return False
        one, other = arm_of[data.contact.geom].T
        return bool((one * other * (one != other)).any())

    return touch


class Witness(Mechanism[H], Generic[H]):
    """Records the lines that a program prints about a board."""

    name = HEARD
    growing: ClassVar[tuple[str, ...]] = ("lines",)
    """Fields of the witness's state that change during a run; the other fields describe the board at the beginning.
    """

    def __init__(self, heard: H) -> None:
        self.heard, self.kind = heard, type(heard)

    def watch(self, gantries: Gantries) -> None:
        """Begin to watch the machine. By default this does nothing."""

    def hear(self, line: str) -> None:
        """Record a printed line."""
        if len(self.heard.lines) < _MOST:
            self.heard = replace(self.heard, lines=(*self.heard.lines, line[:_LONGEST]))

    def state(self) -> H:
        return self.heard

    def check(self, state: H) -> None:
        if replace(state, **{name: getattr(self.heard, name) for name in self.growing}) != self.heard:
            raise BadFile(
                "the pieces on the board of the saved run differ from the pieces on the board of this world"
            )
        if len(state.lines) > _MOST or any(len(line) > _LONGEST for line in state.lines):
            raise BadFile("the saved run has more lines of output than the program can print")

    def restore(self, state: H) -> None:
        self.heard = state


class HeardTouches(Heard, frozen=True, kw_only=True):
    """The lines that the program has printed, and the time for which the arms touched each other."""

    touched_ms: int = 0


T = TypeVar("T", bound=HeardTouches)


class TouchWitness(Witness[T], Generic[T]):
    """Records what the program prints, and watches whether arms touch each other."""

    growing: ClassVar[tuple[str, ...]] = ("lines", "touched_ms")

    def watch(self, gantries: Gantries) -> None:
        touch = touch_of_arms(gantries)

        def look() -> None:
            if touch():
                self.heard = replace(self.heard, touched_ms=self.heard.touched_ms + 1)

        gantries.bench.after_step.append(look)

    def check(self, state: T) -> None:
        super().check(state)
        if state.touched_ms < 0:
            raise BadFile("the time for which the arms touched cannot be negative")
