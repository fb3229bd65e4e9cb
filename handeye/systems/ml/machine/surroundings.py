"""What the sensors sense if the motors are simulated as perfect: stimuli that are given in advance, and outlines that
the wand touches.
"""

from collections.abc import Mapping, Sequence
from typing import Annotated, Final, Literal

import msgspec

from handeye.core.record import Record

Point = tuple[float, float]
MOST: Final = 1e6  # greatest value, in any unit
MOST_STIMULI: Final = 1000
MOST_CORNERS: Final = 1000


class Stimulus(Record, frozen=True, kw_only=True):
    """A value that a channel has during some cycles. If `motor` is given, the channel has the value only while this
    motor is beyond a position.
    """

    channel: str
    value: Annotated[float, msgspec.Meta(ge=-MOST, le=MOST)]  # SI
    since: Annotated[int, msgspec.Meta(ge=0)] = 0  # first cycle
    until: int | None = None  # first cycle in which the channel no longer has the value
    motor: int = 0  # 0: the value does not depend on a motor
    beyond: int = 0  # ML units
    side: Literal["above", "below"] = "above"

    def acts(self, cycle: int, positions: Mapping[int, int]) -> bool:
        """Return True if the stimulus acts on its channel in a cycle. `positions` are the positions of the motors in
        that cycle.
        """
        if cycle < self.since or (self.until is not None and cycle >= self.until):
            return False
        if not self.motor:
            return True
        position = positions.get(self.motor, 0)
        return position >= self.beyond if self.side == "above" else position <= self.beyond


def inside(outline: Sequence[Point], at: Point) -> bool:
    """Return True if a point is inside an outline, which is closed and does not cross itself. A point on the outline
    is not inside.
    """
    (y, x), within = at, False
    for (y1, x1), (y2, x2) in zip(outline, [*outline[1:], outline[0]], strict=True):
        side = (x - x1) * (y2 - y1) - (y - y1) * (x2 - x1)
        if side == 0 and min(x1, x2) <= x <= max(x1, x2) and min(y1, y2) <= y <= max(y1, y2):
            return False
        if (x1 > x) != (x2 > x) and (side > 0) == (x2 > x1):
            within = not within
    return within
