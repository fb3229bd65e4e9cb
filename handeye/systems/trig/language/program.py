"""A TRIG program, with the cursor and the history of executed steps."""

from collections import deque
from collections.abc import Mapping
from dataclasses import dataclass, field
from typing import Final, NamedTuple

from handeye.systems.trig.language.graph import NONE, TOP, Graph, Node
from handeye.systems.trig.language.place import Place, Positions

REMEMBERED: Final = (
    100_000  # steps that can be reversed, enough for a night of palletising; older steps are forgotten
)

NOWHERE: Final = Place()


class RecordedStep(NamedTuple):
    """The state before an executed step. It contains what is needed to reverse the step."""

    node: int
    place: Place  # of the arm
    closed: bool  # of the hand
    rounds: int = 0  # rounds done by the loop
    position: str = ""  # the position it changed
    data: Place = NOWHERE  # value of that position
    gaps: tuple[float, float] = (0.0, 0.0)  # gap before and after a step of the hand, m
    touched: Place | None = None  # place at which a guarded step met an object
    met: float = 0.0  # greatest force felt in a move, N


class HaltedMove(NamedTuple):
    """A move that was halted before it reached its goal."""

    done: RecordedStep
    goal: Place


@dataclass(slots=True)
class TrigProgram:
    """Everything that a session works on, except the arm."""

    graph: Graph = field(default_factory=Graph)
    positions: Positions = field(default_factory=dict)
    cursor: int = TOP  # the active step
    trail: deque[RecordedStep] = field(default_factory=lambda: deque(maxlen=REMEMBERED))
    forgotten: bool = False  # earlier steps were dropped
    taken: int | None = None  # the branch that the active step has taken since the cursor is on it
    cut: HaltedMove | None = None
    paused: int = NONE  # the step before which a run was halted
    ended_at: Place | None = None  # end of the last step
    changed: bool = False  # unsaved changes
    unread: Mapping[str, object] = field(default_factory=dict)  # file fields unknown to this version

    @property
    def active(self) -> Node:
        """The active step, or the top."""
        return self.graph[self.cursor]

    @property
    def first(self) -> int:
        """The first step, or NONE if the program is empty."""
        return self.graph.step_at(self.graph[TOP].sons[0])

    def put_cursor(self, id: int) -> None:
        if id != self.cursor:
            self.taken, self.paused = None, NONE
        self.cursor = id

    def edited(self, above: int) -> None:
        """Record that the program was changed. If the step at the cursor was removed, move the cursor to
        `above`, the step above it."""
        self.changed = True
        if self.cursor not in self.graph:
            self.put_cursor(above if above in self.graph else TOP)

    def remember(self, done: RecordedStep) -> None:
        self.forgotten |= len(self.trail) == self.trail.maxlen
        self.trail.append(done)

    def pstack(self, id: int) -> list[Place]:
        """Return one place for each execution of a step: the arm's place before it."""
        return [done.place for done in self.trail if done.node == id]

    def above(self, id: int) -> int:
        """Return the step above a node. If a node has several fathers, the most recent one counts as the node above
        it. If there is no step above the node, return the top.
        """
        id = self.graph[id].recent_father
        while id not in (TOP, NONE) and not self.graph[id].shown:
            id = self.graph[id].recent_father
        return TOP if id == NONE else id

    def begin(self) -> None:
        """Reset positions, counts and trail before a run from the top."""
        for position in self.positions.values():
            position.data = position.init
        for node in self.graph.nodes.values():
            node.count = 0
        self.trail.clear()
        self.forgotten, self.taken, self.cut, self.paused = False, None, None, NONE

    def relative_by_default(self) -> bool:
        """Return True if a new move is relative by default. A new move is relative if the nearest move at or above the
        active step is relative.
        """
        id, seen = self.cursor, {TOP}
        while id not in seen:
            seen.add(id)
            node = self.graph[id]
            if node.moves and node.position is not None:
                return self.positions[node.position].relative
            id = self.above(id)
        return False

    def users(self, position: str) -> list[Node]:
        return [node for node in self.graph.nodes.values() if node.position == position]
