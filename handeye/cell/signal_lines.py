"""Lines between the devices of a cell and its controller: whatever is broken is broken there, and not in physics.

A device passes all that it senses, and all that it puts out, over lines with names: `potentiometer.3`, `drive.1`,
`lamp`. A defect on a line changes what it carries, from the moment it sets in.
"""

from collections.abc import Sequence
from typing import Final

import msgspec
import numpy as np

from handeye.cell.defects import PICTURE, Defect, Values
from handeye.cell.mechanism import Mechanism
from handeye.cell.state import finite
from handeye.core.pose import Array
from handeye.core.record import Record
from handeye.ports.camera import COLUMNS, ROWS, Picture


def converted(value: float, step: float) -> float:
    """A number as a converter passes it on: the nearest multiple of its step, or as it is where that is 0."""
    return round(value / step) * step if step else value


class Converters:
    """A row of converters, one to a number."""

    def __init__(self, steps: Array) -> None:
        """Converters with these steps, shape (n,); 0 passes a number on as it is."""
        self._steps, self._there = steps, steps > 0
        self._divisors = np.where(self._there, steps, 1.0)

    def __call__(self, values: Array) -> Array:
        """Numbers as they pass them on, shape (n,)."""
        return np.where(self._there, np.rint(values / self._divisors) * self._steps, values)


_NUMBER: Final = 8  # bytes of a number
_BRIGHTEST: Final = 15  # intensity of a point


class DefectState(Record, frozen=True, kw_only=True):
    """State of a defect."""

    seconds: float | None = None  # since it set in; None: it has not
    first: bytes | None = None  # value on its line then, a number or the points of a picture; None: none yet


class SignalLinesState(Record, frozen=True, kw_only=True):
    """States of all defects, in their order."""

    defects: tuple[DefectState, ...]


class SignalLines(Mechanism[SignalLinesState]):
    """The lines of a cell; defects on one act one after the other."""

    name = "lines"
    kind = SignalLinesState

    def __init__(self, defects: Sequence[Defect] = ()) -> None:
        self.defects = tuple(defects)
        starts = (DefectState(seconds=0.0 if defect.stage is None else None) for defect in self.defects)
        self._states = list(starts)

    def begin_stage(self, number: int) -> None:
        """Let those defects set in that do with this stage, or that would have with one that was passed over."""
        for place, defect in enumerate(self.defects):
            if self._states[place].seconds is None and defect.stage is not None and defect.stage <= number:
                self._states[place] = DefectState(seconds=0.0)

    def before(self, seconds: float) -> None:
        for place, state in enumerate(self._states):
            if state.seconds is not None:
                self._states[place] = DefectState(seconds=state.seconds + seconds, first=state.first)

    def rested(self, seconds: float) -> None:
        self.before(seconds)  # what is broken drifts on

    def carried(self, line: str, value: float) -> float:
        """The number that arrives when one is sent, SI."""
        return float(self._arriving(line, np.array(value, dtype=float))) if self.defects else value

    def carried_each(self, line: str, values: Array) -> Array:
        """Numbers that arrive on `line.1`, `line.2` and so on, shape (n,)."""
        if not self.defects:
            return values
        return np.array([self.carried(f"{line}.{number}", value) for number, value in enumerate(values, 1)])

    def carried_picture(self, picture: Picture) -> Picture:
        """The picture that arrives when one is sent."""
        return np.asarray(self._arriving(PICTURE, picture), dtype=picture.dtype)

    def _arriving(self, line: str, values: Values) -> Values:
        for place, defect in enumerate(self.defects):
            state = self._states[place]
            if defect.line == line and state.seconds is not None:
                first = values
                if state.first is None:
                    self._states[place] = msgspec.structs.replace(state, first=values.tobytes())
                else:
                    first = np.frombuffer(state.first, values.dtype).reshape(values.shape)
                values = defect.effect.on(values, first, state.seconds)
        return values

    # -- state ----------------------------------------------------------------------------------------

    def state(self) -> SignalLinesState:
        return SignalLinesState(defects=tuple(self._states))

    def check(self, state: SignalLinesState) -> None:
        if len(state.defects) != len(self.defects):
            raise ValueError("it has other defects")
        for defect, own in zip(self.defects, state.defects, strict=True):
            first, pictured = own.first or b"", defect.line == PICTURE
            if len(first) not in (0, ROWS * COLUMNS if pictured else _NUMBER):
                raise ValueError(f"the value on the line {defect.line} has another size")
            if pictured and max(first, default=0) > _BRIGHTEST:
                raise ValueError("a picture was impossibly bright")
            if not pictured:
                finite(np.frombuffer(first), f"the line {defect.line}")
            if not 0 <= (own.seconds or 0.0) < np.inf:
                raise ValueError(f"the defect of the line {defect.line} began at an impossible time")

    def restore(self, state: SignalLinesState) -> None:
        self._states = list(state.defects)


SOUND: Final = SignalLines()  # lines on which nothing is broken
