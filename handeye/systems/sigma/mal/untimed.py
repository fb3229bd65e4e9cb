"""A machine without time. Motions in progress may end in any order."""

from typing import Final

from msgspec import field

from handeye.core.errors import BadFile
from handeye.core.mutable_records import MutableRecord, put_back
from handeye.ports.microbus import PAGE, Command, MicrobusPort, Status
from handeye.systems.sigma.protocol import LINE_AXES, LINE_NUMBERS, Op

AXIS_OF: Final = {LINE_NUMBERS[axis]: axis for axis in LINE_AXES}


class UntimedMemory(MutableRecord, kw_only=True):
    """Positions of the axes, and the motions in progress."""

    places: dict[str, int] = field(default_factory=dict)  # steps
    moving: dict[str, int] = field(default_factory=dict)  # steps of the motions under way


class UntimedMachine(MicrobusPort):
    """A machine without time. The sensors answer 0, and the motors answer with their counts.

    Axes in `instant` reach their goals as soon as they are commanded.
    """

    def __init__(self, instant: frozenset[str]) -> None:
        self.state, self._instant = UntimedMemory(), instant
        self._answer = b""

    @property
    def now(self) -> int:
        return 0

    @property
    def next_event(self) -> None:
        return None

    def wait(self, until: int) -> int:
        return 0

    @property
    def free(self) -> bool:
        return True

    def begin(self, command: Command, answer: int = 0) -> None:
        self._answer = bytes(answer)
        axis = AXIS_OF.get(command.number)
        if axis is not None and command.op == Op.POSITION:
            self._answer = (self.state.places.get(axis, 0) & 0xFFFF).to_bytes(2, "big")
        if axis is None or command.op not in (Op.MOVE, Op.MOVE_SLOW, Op.ORIGIN):
            return
        place = self.state.places.get(axis, 0)
        steps = -command.value if command.detail & 1 else command.value
        self.state.moving[axis] = -place if command.op == Op.ORIGIN else steps
        if axis in self._instant:
            self.arrive(axis)

    def arrive(self, axis: str) -> None:
        """End the motion of an axis."""
        self.state.places[axis] = self.state.places.get(axis, 0) + self.state.moving.pop(axis)

    def reach(self, axis: str) -> int:
        """Return the farthest position at which an axis may be now (steps)."""
        place = self.state.places.get(axis, 0)
        return max(place, place + self.state.moving.get(axis, 0))

    def answer(self) -> bytes:
        return self._answer

    def page(self, number: int) -> int:
        busy = (AXIS_OF.get(PAGE * number + n, "") in self.state.moving for n in range(PAGE))
        return sum((Status.BUSY if each else Status.FREE) << 2 * n for n, each in enumerate(busy))

    def begun(self, number: int) -> bool:
        return True  # axes in `instant` have arrived

    @property
    def interrupt(self) -> bool:
        return False

    @property
    def memory(self) -> UntimedMemory:
        return self.state

    def remember(self, memory: MutableRecord) -> None:
        if not isinstance(memory, UntimedMemory):
            raise BadFile("the saved state comes from another kind of machine")
        put_back(self.state, memory)
