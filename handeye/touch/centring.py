"""CENTER: close the fingers around an object without pushing it.

Plain closing would drag the object to the middle of the hand. Here, once a finger touches, the hand moves towards that
finger's side, and the fingers close so slowly meanwhile that this one comes off the object, and the other one comes on.
A finger that still touches after that is not the one that told of it, or something holds the object against it.
"""

from dataclasses import dataclass, field
from typing import Final

from handeye.core.errors import NOTHING_HELD, SWITCH_WRONG
from handeye.touch.senses import least_gap

OVERDRIVE: Final = 0.005  # m driven beyond the opening before the fingers count as stalled; placeholder
SLOWER: Final = 0.5
"""Share of their speed at which the fingers close as one touches, which falls to 0 while it does. Chosen: an object
between both is pressed on, so that the switch which takes more force fires, too. Slower from the beginning, a finger
comes off at once, and pushes a loose object a little each time it meets it again."""
EASING: Final = 0.0015
"""m that the hand goes towards a finger, at most, until that no longer touches: the arm gives as much to 18 N."""


@dataclass(frozen=True, slots=True, kw_only=True)
class CentringStep:
    """Set-point changes in one servo period: finger gap (m), and hand along its y axis (m)."""

    gap: float = 0.0
    hand: float = 0.0


@dataclass(slots=True, kw_only=True)
class Centring:
    """One centring: call `step` each period until `done`; when a finger loses the object, both close on again."""

    minimum: float = 0.0  # m; a smaller gap holds nothing, or something too thin; 0: anything
    speed: float  # m/s of the gap; the hand moves at half of it
    done: bool = field(default=False, init=False)
    error: int = field(default=0, init=False)  # when done: 0, nothing held, or a switch wrong
    eased: float = field(
        default=0.0, init=False
    )  # m that the hand has gone since the finger touched that does
    _left: float | None = field(default=None, init=False)

    def step(self, *, touch: tuple[bool, bool], gap: float, period: float) -> CentringStep:
        """Set-point changes of the next period (s), by the switches (of the +y finger first) and the gap (m)."""
        left = gap + OVERDRIVE if self._left is None else self._left
        if all(touch):
            self.done = True
        elif gap <= least_gap(self.minimum) or left <= 0:
            self.done, self.error = True, NOTHING_HELD
        elif self.eased > EASING:
            self.done, self.error = True, SWITCH_WRONG
        if self.done:
            return CentringStep()
        close = self.speed * period
        side = touch[0] - touch[1]
        gap = close * SLOWER * (1 - min(self.eased / EASING, 1.0)) if side else close
        self.eased = self.eased + close / 2 if side else 0.0
        self._left = left - gap
        return CentringStep(gap=-gap, hand=side * close / 2)
