"""The assembly as far as it has come in many worlds: what was saved, and how far each operation was off."""

from dataclasses import dataclass, field
from typing import Final, TypeVar

import numpy as np

from handeye.core.pose import Array, Pose
from handeye.program.flow_operations import Search
from handeye.program.motion_operations import Height, Travel
from handeye.program.program import Program
from handeye.program.senses import Sense
from handeye.program.world_model import WorldModel
from handeye.tasks.interface import Predicted
from handeye.tasks.water_pump.prediction.hands import Hands
from handeye.tasks.water_pump.prediction.instructions import Way, ways
from handeye.tasks.water_pump.prediction.poses import moved
from handeye.tasks.water_pump.prediction.worlds import Worlds
from handeye.tasks.water_pump.world.dimensions import dimensions
from handeye.touch.spiral import line, spiral

_UP: Final = (0.0, 0.0, 1.0)
C = TypeVar("C", Travel, Height)


@dataclass(slots=True)
class Assembly:
    """The state of a prediction. Places are in W, m, and the first axis of each array is the worlds'."""

    worlds: Worlds
    program: Program
    without: frozenset[Sense] = frozenset()
    saved: dict[str, Array] = field(default_factory=dict)
    """What the program has saved, shape (n, 3)."""
    heights: dict[str, Array] = field(default_factory=dict)
    """The height that was saved with it, shape (n,)."""
    found: list[Predicted] = field(default_factory=list)
    hands: Hands = field(init=False)
    ways: dict[str, list[Way]] = field(init=False)

    def __post_init__(self) -> None:
        self.hands, self.ways = Hands(self.worlds), ways(self.program)

    # -- the hand ---------------------------------------------------------------------------------------

    def planned(self, goal: str) -> Pose:
        """`X_WT` of a position as the program has it."""
        return WorldModel.of(self.program).position(goal)

    def hand(self, goal: str, *, way: int = 0) -> Array:
        """True poses of the hand at a position, with what is restored on the way to it."""
        return moved(self.hands.at(self.planned(goal)), self.shift(goal, way))

    def shift(self, goal: str, way: int = 0) -> Array:
        """What the program restores on a way to a position, shape (n, 3); nothing where no MOVE leads, as to G."""
        total = np.zeros((len(self.worlds), 3))
        for restore in self.ways[goal][way].restore if goal in self.ways else ():
            total += self.saved.get(restore.name, np.zeros(3)) * ((1, 1, not restore.level))
        return total

    def gives(self, goal: str, way: int = 0) -> float:
        """How far the hand stands over its set-point where it presses behind a motion to a position, m."""
        return self.hands.gives(self.planned(goal), self.ways[goal][way].pressed)

    def gives_at_last(self, goal: str) -> float:
        """The same where it presses last before it goes to another position, m."""
        return self.hands.gives(self.planned(goal), self.ways[goal][0].pressed_last)

    def line(self, goal: str) -> Array:
        """The finger line at a position, shape (3,), W."""
        return np.asarray(self.planned(goal)[:3, 1])

    def centre(self, goal: str, name: str, off: Array) -> Array:
        """CENTER on a thing that is off from the hand, shape (n, 3); what is saved under a name if SAVE follows."""
        line = self.line(goal)
        along = (off @ line)[:, None] * line
        self.saved[name] = along * (not self.without & {"touch", "centring"})
        return along

    def save(self, name: str, off: Array) -> None:
        """Keep by how far the hand had to move, shape (n, 3), beside what it was moved by under the same name."""
        self.saved[name] = off + self.saved.get(name, np.zeros(3))

    # -- what comes of it -------------------------------------------------------------------------------

    def fits(self, operation: str, goal: str, off: Array, thick: float) -> None:
        """A thing comes between the fingers if it is off by no more than their gap, and their width, leave, m."""
        room = (self.ways[goal][0].gap - thick) / 2, dimensions()("hand.finger_width") / 2
        self.has_room(operation, goal, off, room)

    def has_room(self, operation: str, goal: str, off: Array, room: tuple[float, float]) -> None:
        """The fingers meet nothing if they are off, shape (n, 3), by no more than a room along and one across, m."""
        line = self.line(goal)
        for what, axis, most in (("along", line, room[0]), ("across", np.cross(line, _UP), room[1])):
            self._add(operation, goal, what, np.abs(off @ axis), most)

    def meets(self, operation: str, goal: str, off: Array, catch: float) -> None:
        """A thing goes home from no farther off, shape (n, 2), than it is led in, m, at any place of the search."""
        search, away = self.ways[goal][0].search, np.hypot(*off[:, :2].T)
        if search is None:
            self._add(operation, goal, "off", away, catch)
            return
        count = 1 if "search" in self.without else search.limit
        grid = np.array([_place(k, search) for k in range(count)]) * search.step
        reach = float(np.abs(grid).max())
        if search.along is not None:
            reach = float(np.hypot(*grid[-1]))
            x, y = np.cos(search.along), np.sin(search.along)
            self._add(operation, goal, "across", np.abs(off[:, 1] * x - off[:, 0] * y), catch)
        self._add(operation, goal, "off", away, catch + reach, _places(off, catch, grid))

    def window(self, operation: str, goal: str, check: type[C], told: Array, *, way: int = 0) -> None:
        """A check of a height or way behind a motion is met if what is told is within its window, m."""
        first = next((each for each in self.ways[goal][way].checks if isinstance(each, check)), None)
        if first is None:
            return
        if isinstance(first, Height):  # it is told by the set-point
            told = told - self.gives(goal, way) - self.heights[first.name]
        away = np.abs(told - (first.minimum + first.maximum) / 2)
        what = "height" if isinstance(first, Height) else "way down"
        self._add(operation, goal, what, away, (first.maximum - first.minimum) / 2)

    def lies(self, layer: str, goal: str, off: Array, room: float) -> None:
        """Screws pass a layer if the axes of its holes are no farther off those of the base, m."""
        self._add(layer, goal, "lies off", off, room, finding=f"{layer}_place")

    def leans(self, operation: str, goal: str, angle: Array, room: float) -> None:
        """A screw takes its thread if it leans by no more, rad."""
        degrees = float(np.degrees(1.0))
        self.found.append(
            Predicted(operation=operation, at=goal, what="lean", unit="deg", off=angle * degrees,
                      room=float(room * degrees))
        )  # fmt: skip

    def _add(
        self, operation: str, goal: str, what: str, off: Array, room: float, places: Array | None = None,
        finding: str = "",
    ) -> None:  # fmt: skip
        self.found.append(
            Predicted(operation=operation, at=goal, what=what, unit="mm", off=off * 1e3, room=float(room * 1e3),
                      places=places, finding=finding)
        )  # fmt: skip


def _place(number: int, search: Search) -> tuple[float, float]:
    """A place of a search, in its steps."""
    return spiral(number) if search.along is None else line(number, search.along)


def _places(off: Array, catch: float, grid: Array) -> Array:
    """Number of the first place of a search, from 1, from which a hole that is off catches; count + 1 if none does."""
    near = np.hypot(*np.moveaxis(off[:, None, :2] - grid, -1, 0)) <= catch
    return np.where(near.any(axis=1), near.argmax(axis=1), len(grid)) + 1.0
