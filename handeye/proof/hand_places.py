"""Finds where the hand can be at each node, as far as the program determines the place. The place is the planned goal
of the last MOVE, plus the displacements of the motions after that MOVE.

RESTORE, and the offset of a search, correct the place by values that are measured during a run. These corrections are
left out, because they only lead the hand to the true place of the named position.
"""

import math
from collections.abc import Mapping
from typing import Final, NamedTuple

from handeye.core.pose import hand, planar
from handeye.core.record import Vector3
from handeye.program.flow_operations import Here, Save, Undo
from handeye.program.graph import Graph
from handeye.program.motion_operations import ArmMotion, Center, Change, Height, Move, Turn
from handeye.program.program import Position, Program
from handeye.proof.outcomes import END, SUCCESS, OutcomeGraph

MOST: Final = 40  # places at a node; more count as unknown
ROUNDS: Final = 4  # of places that HERE defines from places that HERE has defined


class Block(NamedTuple):
    """A block in which the hand can be, given by its least and its greatest coordinates in the table frame (m)."""

    low: Vector3
    high: Vector3

    def moved(self, by: Vector3, least: float = 1.0) -> "Block":
        """Shift the block by a share of a vector. The share may be anything from `least` to 1."""
        ends = [(least * d, d) for d in by]
        return Block(
            _rounded(tuple(a + min(e) for a, e in zip(self.low, ends, strict=True))),
            _rounded(tuple(a + max(e) for a, e in zip(self.high, ends, strict=True))),
        )

    @property
    def upright(self) -> bool:
        """True if all points of the block have the same x and the same y."""
        return self.low[:2] == self.high[:2]


ANYWHERE: Final = Block(
    (-math.inf, -math.inf, 0.0), (math.inf, math.inf, math.inf)
)  # but not below the table


class Situation(NamedTuple):
    """Where the hand is, and how its last motion ended."""

    at: Block
    start: Block  # where the last motion began
    motion: int | None  # step of the last motion; None if it is not known
    outcome: int  # of this motion


UNKNOWN: Final = Situation(ANYWHERE, ANYWHERE, None, SUCCESS)
Situations = frozenset[Situation]


def _rounded(values: tuple[float, ...]) -> Vector3:
    x, y, z = (round(value, 6) for value in values)
    return x, y, z


class HandPlaces:
    """The situations before each node, and the saves that a HEIGHT may refer to."""

    def __init__(self, program: Program, graph: OutcomeGraph) -> None:
        self.program, self.graph = program, graph
        self._here = _reaching(program)
        self._saved: dict[int, list[Situations]] = {}
        self._defined: dict[int, frozenset[Block]] = {here: frozenset() for here in self._here}
        for _ in range(ROUNDS):
            self.before = self._solved()
            defined = {here: self._blocks(here) for here in self._here}
            if defined == self._defined:
                break
            self._defined = defined
        else:  # a HERE depends on itself
            self._defined = dict.fromkeys(self._here, frozenset({ANYWHERE}))
            self.before = self._solved()

    def references(self, node: int) -> list[Situations]:
        """Return the situations at the saves to which a HEIGHT may refer."""
        if node not in self._saved:
            self._saved[node] = self._references(node)
        return self._saved[node]

    def _references(self, node: int) -> list[Situations]:
        operation = self.graph.step(node).operation
        assert isinstance(operation, Height)
        found, seen, waiting = [], {node}, [node]
        while waiting:
            for before in self.graph.back[waiting.pop()]:
                if before in seen:
                    continue
                seen.add(before)
                saved = self.graph.step(before).operation
                if isinstance(saved, Save) and saved.name == operation.name:
                    found.append(self.before[before])
                else:
                    waiting.append(before)
        return found

    def after(self, node: int, outcome: int | None, situations: Situations) -> Situations:
        """Return the situations after a node, for one outcome of the node's action."""
        number = self.graph.nodes[node][0]
        operation = self.program.steps[number].operation
        if isinstance(operation, Undo):
            return frozenset({UNKNOWN})
        if outcome is None or not isinstance(operation, ArmMotion | Center):
            return situations
        found: set[Situation] = set()
        if isinstance(operation, Move):
            sound = outcome == SUCCESS and not operation.guards
            blocks = self._goals(number, operation.goal) if sound else {ANYWHERE}
            found = {Situation(block, ANYWHERE, number, outcome) for block in blocks}
        else:
            found = {
                Situation(self._shifted(number, operation, outcome, one.at), one.at, number, outcome)
                for one in situations
            }
        return frozenset(found) if len(found) <= MOST else frozenset({UNKNOWN})

    def _shifted(self, number: int, operation: ArmMotion | Center, outcome: int, at: Block) -> Block:
        if isinstance(operation, Center):
            return at
        unmet = bool(operation.guards) and outcome == operation.guards[0].error
        whole = unmet or (outcome == SUCCESS and not operation.guards)
        if isinstance(operation, Change):
            return at.moved(operation.displacement, 1.0 if whole else 0.0)
        if isinstance(operation, Turn) and whole:
            return _turned(at, self._centre(number, operation), operation.angle)
        return ANYWHERE

    def centre(self, node: int) -> Block:
        """Return the place about which a Turn turns the hand."""
        number = self.graph.nodes[node][0]
        operation = self.program.steps[number].operation
        assert isinstance(operation, Turn)
        return self._centre(number, operation)

    def _centre(self, number: int, operation: Turn) -> Block:
        places = self._goals(number, operation.centre)
        return next(iter(places)) if len(places) == 1 else ANYWHERE

    def _goals(self, number: int, name: str) -> frozenset[Block]:
        """Return the places that a position may have at a step."""
        found: set[Block] = set()
        for here, reached in self._here.items():
            if self._position(here) == name and number in reached:
                found |= self._defined[here]
        written = self.program.positions.get(name)
        if written is not None:
            found.add(planned_block(self.program, written))
        return frozenset(found or {ANYWHERE})

    def _position(self, here: int) -> str:
        operation = self.program.steps[here].operation
        assert isinstance(operation, Here)
        return operation.position

    def _blocks(self, here: int) -> frozenset[Block]:
        nodes = [node for node, (number, _) in enumerate(self.graph.nodes) if number == here]
        return frozenset(one.at for node in nodes for one in self.before[node])

    def _solved(self) -> list[Situations]:
        before: list[Situations] = [frozenset() for _ in self.graph.nodes]
        if not before:
            return before
        before[0] = frozenset({UNKNOWN})
        waiting = [0]
        while waiting:
            node = waiting.pop()
            for edge in self.graph.edges[node]:
                if edge.to == END:
                    continue
                merged = before[edge.to] | self.after(node, edge.outcome, before[node])
                if len(merged) > MOST:
                    merged = frozenset({UNKNOWN})
                if merged != before[edge.to] and before[edge.to] != {UNKNOWN}:
                    before[edge.to] = merged
                    waiting.append(edge.to)
        return before


def planned_block(program: Program, position: Position) -> Block:
    """Return the planned place of a position in the table frame."""
    X = hand(*position.at)
    if position.of is not None:
        X = planar(*program.parts[position.of].at) @ X
    x, y, z = _rounded(tuple(float(value) for value in X[:3, 3]))
    return Block((x, y, z), (x, y, z))


def _reaching(program: Program) -> Mapping[int, set[int]]:
    """Return, for each HERE, all steps that can follow it, directly or indirectly."""
    graph = Graph(program.steps)
    return {number: graph.after([number]) for number in graph.which(Here)}


def _turned(at: Block, centre: Block, angle: float) -> Block:
    """Turn a block about a vertical axis."""
    if not at.upright or not centre.upright:
        return Block((-math.inf, -math.inf, at.low[2]), (math.inf, math.inf, at.high[2]))
    (x, y, _), (cx, cy, _) = at.low, centre.low
    c, s = math.cos(angle), math.sin(angle)
    shift = (cx + c * (x - cx) - s * (y - cy) - x, cy + s * (x - cx) + c * (y - cy) - y, 0.0)
    return at.moved(shift)
