"""CENTER: closes the fingers around an object without pushing it.

Plain closing would drag the object to the middle of the hand. In centring, the hand moves as soon as one finger
touches: it moves towards the side of that finger, while the fingers close more slowly. The touching finger therefore
leaves the object again. The motion ends when both fingers touch. One finger may keep touching although the hand has
moved far enough to free it. This has three possible causes: the finger's switch is stuck, the wrong finger reported
the touch, or the object is held against the finger.
"""

from dataclasses import dataclass, field
from typing import Final

from handeye.core.errors import NOTHING_HELD, SWITCH_WRONG
from handeye.touch.senses import least_gap

OVERDRIVE: Final = 0.005  # m; fingers driven this far beyond their opening count as stalled; placeholder
SLOWER: Final = 0.5
"""When one finger begins to touch an object, both fingers slow down to this fraction of their speed. While the finger
keeps touching the object, the speed falls to 0. With this fraction, the fingers still press hard enough on an object
between them to close both switches. With a smaller fraction, the finger would come off the object at once, and would
push a loose object a little each time it touched again.
"""
EASING: Final = 0.0015
"""If a finger touches an object, the hand moves towards this finger until the finger no longer touches, but at most by
this distance (m). A force of 18 N deflects the arm by this distance.
"""


@dataclass(frozen=True, slots=True, kw_only=True)
class CentringStep:
    """The changes of two set-points in one servo period: the change of the finger gap (m), and the motion of the hand
    along its y axis (m).
    """

    gap: float = 0.0
    hand: float = 0.0


@dataclass(slots=True, kw_only=True)
class Centring:
    """The state of one centring motion. Call `step` in each servo period until `done`. If a finger loses the
    object, both fingers close again.
    """

    minimum: float = 0.0  # m; a smaller gap holds nothing, or something too thin; 0: anything
    speed: float  # m/s of the gap; the hand moves at half of it
    done: bool = field(default=False, init=False)
    error: int = field(
        default=0, init=False
    )  # when done: 0, or the error for an empty hand or for a faulty switch
    eased: float = field(
        default=0.0, init=False
    )  # m that the hand has moved since the touching finger began to touch
    _left: float | None = field(default=None, init=False)

    def step(self, *, touch: tuple[bool, bool], gap: float, period: float) -> CentringStep:
        """Return the changes of set-points in the next period (s). `touch` holds the states of the two switches, first
        the switch of the +y finger; `gap` is in m.
        """
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
