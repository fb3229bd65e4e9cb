"""An imaginary arm, which reaches every place immediately and exactly.

With imaginary blocks, this arm lets a user try out a program without a real arm. The blocks do not fall, and exert a
force only on their upper sides. Only a guarded move whose force vector has an upward component can meet a block or the
table; all other moves pass through blocks. In this guarded move, a closed hand stops on top of a block, but a block
passes between the fingers of an open hand. A block in the hand stops on another block or on the table.
"""

import math
from dataclasses import dataclass, replace
from typing import Final, Literal

from handeye.core.record import Vector3
from handeye.systems.trig.language.desk import Tabletop
from handeye.systems.trig.language.place import Place
from handeye.systems.trig.language.trig_arm import Arrival, Halted, TrigArm

TRAVEL: Final = (*2 * ((-0.2, 0.2),), (0.0, 0.3), *3 * ((-math.radians(170), math.radians(170)),))
"""Travel of the axes (m and rad). The paper does not give the travel, so the travel is that of our Purbrick arm."""
BLOCK: Final = 0.030  # m, along and across
OPEN: Final = 0.048  # m between the fingers
HEIGHT: Final = 0.012  # m, of a block
_SAME: Final = 1e-9  # m; places closer together count as equal
_TOUCH: Final = 1.01  # force at a trip, as a multiple of the threshold


@dataclass(frozen=True, slots=True, kw_only=True)
class Block:
    """A block, given by the centre of its upper face (m)."""

    name: str
    x: float
    y: float
    z: float

    def under(self, place: Place) -> bool:
        """Return True if a place lies within the outline of the block, seen from above."""
        return max(abs(place.x - self.x), abs(place.y - self.y)) <= BLOCK / 2

    def overlaps(self, other: "Block") -> bool:
        """Return True if another block lies partly over this one, seen from above."""
        return max(abs(other.x - self.x), abs(other.y - self.y)) < BLOCK

    def moved(self, way: Place) -> "Block":
        """Return the block after a hand has carried it by a displacement."""
        return replace(self, x=self.x + way.x, y=self.y + way.y, z=self.z + way.z)

    def between(self, place: Place) -> bool:
        """Return True if a hand that closes at a place grasps the block."""
        return self.under(place) and self.z - HEIGHT < place.z < self.z


class NoArm(TrigArm, Tabletop):
    """The imaginary arm with its hand and blocks."""

    def __init__(self) -> None:
        self.blocks: list[Block] = []
        self.held: Block | None = None
        self._at = Place(z=TRAVEL[2][1])
        self._closed = False

    def here(self) -> Place:
        return self._at

    @property
    def closed(self) -> bool:
        return self._closed

    @property
    def travel(self) -> tuple[tuple[float, float], ...]:
        return TRAVEL

    @property
    def met(self) -> float:
        return 0.0

    def go(self, goal: Place, halted: Halted) -> bool:
        self.check_travel(goal)
        if halted():
            return False
        self._carry(goal)
        return True

    def feel(self, goal: Place, vector: Vector3, threshold: float, halted: Halted) -> Arrival:
        self.check_travel(goal)
        if halted():
            return Arrival(kind="halted")
        top = self._met(goal) if vector[2] > 0 else None
        self._carry(goal if top is None else goal._replace(z=top))
        force = 0.0 if top is None else max(_TOUCH * threshold, math.ulp(0.0))
        return Arrival(kind="reached" if top is None else "tripped", force=force)

    def back(self, goal: Place, halted: Halted, met: float = 0.0) -> Literal["halted"] | None:
        return None if self.go(goal, halted) else "halted"

    def set_down(self, goal: Place, halted: Halted, met: float = 0.0) -> Literal["halted"] | None:
        return self.back(goal, halted)

    @property
    def gap(self) -> float:
        return BLOCK if self.held else 0.0 if self._closed else OPEN

    def hand(self, closed: bool) -> None:
        if closed and not self._closed:
            self.held = next((block for block in self.blocks if block.between(self._at)), None)
        elif not closed:
            self.held = None
        self._closed = closed

    @property
    def count(self) -> int:
        return len(self.blocks)

    def bucket(self, x: float, y: float) -> None:
        """Do nothing, because nothing falls."""

    def stack(self, count: int, x: float, y: float) -> None:
        there = len(self.blocks)
        self.blocks += [
            Block(name=f"{there + number}", x=x, y=y, z=number * HEIGHT) for number in range(1, count + 1)
        ]

    def clear(self) -> None:
        self.blocks, self.held = [], None

    def _met(self, goal: Place) -> float | None:
        """Return the height of the hand at the first contact on the way down to a goal (m), or None if there is no
        contact.
        """
        if self.held is not None:
            there, tips = self.held.moved(goal.seen_from(self._at)), self._at.z - self.held.z + HEIGHT
            below = [block.z for block in self.blocks if block is not self.held and block.overlaps(there)]
            tops = [top + tips for top in (0.0, *below)]
        else:
            tops = [block.z for block in self.blocks if self._closed and block.under(goal)]
        return max((z for z in tops if goal.z + _SAME < z <= self._at.z + _SAME), default=None)

    def _carry(self, goal: Place) -> None:
        if self.held is not None:
            moved = self.held.moved(goal.seen_from(self._at))
            self.blocks[self.blocks.index(self.held)] = moved
            self.held = moved
        self._at = goal
