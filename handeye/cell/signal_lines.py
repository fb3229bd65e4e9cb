"""Signal lines between the devices of a cell and its controller. Device faults are injected in the lines, not in
the physics.

A device passes all its readings and commands over lines with names such as `potentiometer.3`, `drive.1` and `lamp`.
A defect on a line changes the values that the line carries, from the moment the defect begins.
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
    """Return a number as a converter passes it on: the nearest multiple of `step`, or the number itself if `step`
    is 0.
    """
    return round(value / step) * step if step else value


class Converters:
    """Converters for a row of numbers, one converter for each number of the row."""

    def __init__(self, steps: Array) -> None:
        """Make converters with the steps `steps`, shape (n,). A converter with a step of 0 passes numbers on
        unchanged.
        """
        self._steps, self._none = steps, np.flatnonzero(steps <= 0)
        self._divisors = np.where(steps > 0, steps, 1.0)

    def __call__(self, values: Array) -> Array:
        """Return the numbers as the converters pass them on, shape (n,)."""
        passed = np.rint(values / self._divisors) * self._steps
        if self._none.size:
            passed[self._none] = values[self._none]
        return passed


_NUMBER: Final = 8  # bytes of a number
_BRIGHTEST: Final = 15  # intensity of a point


class DefectState(Record, frozen=True, kw_only=True):
    """State of a defect."""

    seconds: float | None = None  # since the defect began; None if it has not begun
    first: bytes | None = None
    """Value on the signal line when the defect began: a number, or the points of a picture. None if the line had no
    value yet.
    """


class SignalLinesState(Record, frozen=True, kw_only=True):
    """States of all defects, in the order of the defects."""

    defects: tuple[DefectState, ...]


class SignalLines(Mechanism[SignalLinesState]):
    """The signal lines of a cell. If a line has several defects, they act one after another: the first defect changes
    the values of the line, and each further defect changes the values that result.
    """

    name = "lines"
    kind = SignalLinesState

    def __init__(self, defects: Sequence[Defect] = ()) -> None:
        self.defects = tuple(defects)
        starts = (DefectState(seconds=0.0 if defect.stage is None else None) for defect in self.defects)
        self._states = list(starts)

    def begin_stage(self, number: int) -> None:
        """Start the defects that begin with stage `number`, or with an earlier stage that was skipped."""
        for place, defect in enumerate(self.defects):
            if self._states[place].seconds is None and defect.stage is not None and defect.stage <= number:
                self._states[place] = DefectState(seconds=0.0)

    def before(self, seconds: float) -> None:
        for place, state in enumerate(self._states):
            if state.seconds is not None:
                self._states[place] = DefectState(seconds=state.seconds + seconds, first=state.first)

    def rested(self, seconds: float) -> None:
        self.before(seconds)  # the defects drift on

    def carried(self, line: str, value: float) -> float:
        """Return the number (SI) that arrives when `value` is sent."""
        return float(self._arriving(line, np.array(value, dtype=float))) if self.defects else value

    def carried_each(self, line: str, values: Array) -> Array:
        """Return the numbers that arrive on the lines `LINE.1`, `LINE.2` and so on, where LINE is the value of `line`;
        shape (n,).
        """
        if not self.defects:
            return values
        return np.array([self.carried(f"{line}.{number}", value) for number, value in enumerate(values, 1)])

    def carried_picture(self, picture: Picture) -> Picture:
        """Return the picture that arrives when `picture` is sent."""
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
            raise ValueError("the number of saved defects differs from the number in this cell")
        for defect, own in zip(self.defects, state.defects, strict=True):
            first, pictured = own.first or b"", defect.line == PICTURE
            if len(first) not in (0, ROWS * COLUMNS if pictured else _NUMBER):
                raise ValueError(f"the saved value of the line {defect.line} has the wrong size")
            if pictured and max(first, default=0) > _BRIGHTEST:
                raise ValueError("a picture was impossibly bright")
            if not pictured:
                finite(np.frombuffer(first), f"the line {defect.line}")
            if not 0 <= (own.seconds or 0.0) < np.inf:
                raise ValueError(f"the defect of the line {defect.line} began at an impossible time")

    def restore(self, state: SignalLinesState) -> None:
        self._states = list(state.defects)


SOUND: Final = SignalLines()  # lines on which nothing is broken
