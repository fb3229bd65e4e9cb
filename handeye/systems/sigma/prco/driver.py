"""The screwdriver of arm 2. The hand microcomputer of arm 2 switches it as one of its devices."""

from collections.abc import Sequence
from typing import Final

from handeye.cell.mechanism import Mechanism
from handeye.core.errors import BadFile
from handeye.core.record import Record
from handeye.systems.sigma.protocol import DEVICES, NUMBERS

SPEED: Final = 20.0  # rad/s, 190 turns a minute
_SPEEDS: Final = {1: SPEED, 2: -SPEED}
_HAND: Final = NUMBERS["HAND2"]


class DriverState(Record, frozen=True, kw_only=True):
    """The value to which the program has set the screwdriver."""

    value: int = 0


class HandDriver(Mechanism[DriverState]):
    """The screwdriver of arm 2. It drives screws in while its device has the value 1, and drives screws out while its
    device has the value 2. The tip of the screwdriver is a permanent magnet.
    """

    name = "screwdriver"
    kind = DriverState
    magnet = True

    def __init__(self) -> None:
        self._state = DriverState()

    @property
    def speed(self) -> float:
        """Speed of the spindle (rad/s). A positive speed drives a screw in."""
        return _SPEEDS.get(self._state.value, 0.0)

    def actuated(self, number: int, devices: Sequence[int]) -> None:
        """Set the screwdriver to the value that the hand microcomputer of arm 2 gives out."""
        if number == _HAND:
            self._state = DriverState(value=devices[DEVICES["DRIVER"]])

    def state(self) -> DriverState:
        return self._state

    def check(self, state: DriverState) -> None:
        if not 0 <= state.value <= 0xFFFF:
            raise BadFile("the setting of the screwdriver is impossible")

    def restore(self, state: DriverState) -> None:
        self._state = state
