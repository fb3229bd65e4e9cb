"""CENTER: close the fingers around an object without pushing it.

Plain closing would drag the object to the middle of the hand. Here, once a finger touches, the hand moves
towards that finger's side as fast as its fingers close: this finger stands still and the other one comes on.
"""

from dataclasses import dataclass, field
from typing import Final

from handeye.core.errors import NOTHING_HELD
from handeye.touch.hold import least_gap

SPARE: Final = 0.005
"""How much farther than the opening the fingers are told to close before they count as stalled, m.
Placeholder."""


@dataclass(frozen=True, slots=True, kw_only=True)
class CentringStep:
    """Shifts of fingers and hand in one servo period."""

    gap: float = 0.0
    """Change of the finger gap set-point, m."""
    hand: float = 0.0
    """Motion of the hand along its y axis, m."""


@dataclass(slots=True, kw_only=True)
class Centring:
    """One centring: ask for a step each servo period until it is `done`.

    The switches are the state: when a finger loses its object both close on until one touches again.
    """

    minimum: float = 0.0
    """Gap (m) beyond which there is nothing, or too thin a thing, to centre on; 0: anything will do."""
    speed: float
    """Rate at which the gap closes, m/s. The hand moves with half of it."""
    done: bool = field(default=False, init=False)
    error: int = field(default=0, init=False)
    """When done: 0, or the error that nothing is held."""
    _left: float | None = field(default=None, init=False)

    def step(self, *, touch: tuple[bool, bool], gap: float, period: float) -> CentringStep:
        """Shifts of the next period.

        Args:
            touch: switches of the finger on the +y side of the hand and of the one on the -y side.
            gap: opening between the finger tips now, m.
            period: s.
        """
        left = gap + SPARE if self._left is None else self._left
        if all(touch):
            self.done = True
        elif gap <= least_gap(self.minimum) or left <= 0:
            self.done, self.error = True, NOTHING_HELD
        if self.done:
            return CentringStep()
        close = self.speed * period
        self._left = left - close
        return CentringStep(gap=-close, hand=(touch[0] - touch[1]) * close / 2)
