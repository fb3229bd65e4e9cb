"""A TRIG program with its cursor, and with what is remembered of what has been done."""

from collections import deque
from collections.abc import Mapping
from dataclasses import dataclass, field
from typing import Final, NamedTuple

from handeye.systems.trig.language.graph import Graph
from handeye.systems.trig.language.node import NONE, TOP, Node
from handeye.systems.trig.language.place import Place
from handeye.systems.trig.language.position import Positions

REMEMBERED: Final = 100_000
"""Steps that can be undone, loops' partners included: a night of palletising. What was done before is forgotten."""

NOWHERE: Final = Place()
"""Where nothing has to be restored."""


class Done(NamedTuple):
    """What was when a step was begun, and undoing it restores."""

    node: int
    place: Place
    """Of the arm."""
    closed: bool
    """The hand was."""
    rounds: int = 0
    """That the loop had gone back."""
    position: str = ""
    """Name of the position that the step has changed."""
    data: Place = NOWHERE
    """Of that position."""
    gaps: tuple[float, float] = (0.0, 0.0)
    """Between the fingers before and after a step of the hand, m."""
    touched: Place | None = None
    """Where the arm was when a guarded step had met something."""
    met: float = 0.0
    """The greatest force that the finger felt in a move, against its beginning, N."""


class Cut(NamedTuple):
    """A move that was halted on its way."""

    done: Done
    goal: Place


@dataclass(slots=True)
class TrigProgram:
    """Everything that a session works on but the arm."""

    graph: Graph = field(default_factory=Graph)
    positions: Positions = field(default_factory=dict)
    cursor: int = TOP
    """The active step."""
    trail: deque[Done] = field(default_factory=lambda: deque(maxlen=REMEMBERED))
    """What was done and not undone, in order: the stacks of positions of all steps in one."""
    forgotten: bool = False
    """The trail began earlier."""
    taken: int | None = None
    """The branch that the active step took when it was executed, since the cursor has been there."""
    cut: Cut | None = None
    paused: int = NONE
    """The step before which a run was halted."""
    ended_at: Place | None = None
    """Where the arm was last taken to by a step."""
    changed: bool = False
    """There is something that no file has."""
    unread: Mapping[str, object] = field(default_factory=dict)
    """What its file says that this version does not know."""

    @property
    def active(self) -> Node:
        """The active step, or the top."""
        return self.graph[self.cursor]

    @property
    def first(self) -> int:
        """The first step; NONE: there is none."""
        return self.graph.step_at(self.graph[TOP].sons[0])

    def put_cursor(self, id: int) -> None:
        """Make a step the active one."""
        if id != self.cursor:
            self.taken, self.paused = None, NONE
        self.cursor = id

    def edited(self, above: int) -> None:
        """Something has been taken away; where the cursor was on it, it goes above.

        Args:
            above: the step above, as it was before.
        """
        self.changed = True
        if self.cursor not in self.graph:
            self.put_cursor(above if above in self.graph else TOP)

    def remember(self, done: Done) -> None:
        """Put what is done on the trail."""
        self.forgotten |= len(self.trail) == self.trail.maxlen
        self.trail.append(done)

    def pstack(self, id: int) -> list[Place]:
        """The stack of positions of one step: where the arm was before each time that it was executed."""
        return [done.place for done in self.trail if done.node == id]

    def above(self, id: int) -> int:
        """The step above a node, by the most recent fathers; the top, where there is none."""
        id = self.graph[id].recent_father
        while id not in (TOP, NONE) and not self.graph[id].shown:
            id = self.graph[id].recent_father
        return TOP if id == NONE else id

    def begin(self) -> None:
        """Make everything as it was taught, as before every run from the top."""
        for position in self.positions.values():
            position.data = position.init
        for node in self.graph.nodes.values():
            node.count = 0
        self.trail.clear()
        self.forgotten, self.taken, self.cut, self.paused = False, None, None, NONE

    def relative_by_default(self) -> bool:
        """The kind of a move to what is not defined yet: that of the nearest move above, the active step included."""
        id, seen = self.cursor, {TOP}
        while id not in seen:
            seen.add(id)
            node = self.graph[id]
            if node.moves and node.position is not None:
                return self.positions[node.position].relative
            id = self.above(id)
        return False

    def users(self, position: str) -> list[Node]:
        """Steps that go to a position, or set it."""
        return [node for node in self.graph.nodes.values() if node.position == position]
