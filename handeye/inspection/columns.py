"""Arranges the steps of a stage in columns, with lanes beside them for edges that jump."""

from collections.abc import Sequence
from dataclasses import dataclass
from typing import Final

from handeye.inspection.flow import FlowEdge, Node

WIDTH: Final = 264  # px, of a step
ROW: Final = 24  # px, height of a step without notes
NOTE: Final = 14  # px, height of a note
GAP: Final = 18  # px, between steps
COLUMN_HEIGHT: Final = 1150  # px, at which columns are broken if possible
LANE: Final = 11
SIDE: Final = 18  # px, from step to first lane, and from last lane to the column's border
MIN_FILL: Final = 0.9  # fraction of its height at which a column may be broken
MIN_REST: Final = 0.35  # fraction of a column that justifies another one


@dataclass(frozen=True, slots=True, kw_only=True)
class Column:
    """Steps one below the other, with lanes by edge, from 0 next to the steps."""

    nodes: tuple[Node, ...]
    back: dict[FlowEdge, int]  # on the left
    skip: dict[FlowEdge, int]  # on the right

    @property
    def before(self) -> float:
        """Width left of the steps."""
        return _breadth(self.back)

    @property
    def width(self) -> float:
        """Width including lanes."""
        return self.before + WIDTH + _breadth(self.skip)

    @property
    def height(self) -> float:
        return sum(height(node) + GAP for node in self.nodes) - GAP


def _breadth(lanes: dict[FlowEdge, int]) -> float:
    deepest = max(lanes.values(), default=-1) + 1
    return SIDE + (SIDE + LANE * deepest if deepest else 0)


def height(node: Node) -> float:
    """Height of a step's box."""
    return ROW + NOTE * len(node.notes)


def columns(nodes: Sequence[Node], edges: Sequence[FlowEdge]) -> list[Column]:
    """The steps of a stage in columns of about equal height, broken outside loops."""
    total = sum(height(node) + GAP for node in nodes)
    goal = total / max(1, round(total / COLUMN_HEIGHT + 0.2))
    left = total
    place = {node.step: at for at, node in enumerate(nodes)}
    spanned: set[int] = set()
    for edge in edges:
        if edge.start in place and edge.end in place:
            low, high = sorted((place[edge.start], place[edge.end]))
            spanned.update(range(low + 1, high + 1) if high - low > 1 else ())
    cut: list[list[Node]] = [[]]
    filled = 0.0
    for at, node in enumerate(nodes):
        if filled >= goal * MIN_FILL and left >= goal * MIN_REST and at not in spanned:
            cut.append([])
            filled = 0.0
        cut[-1].append(node)
        filled += height(node) + GAP
        left -= height(node) + GAP
    return [
        Column(nodes=tuple(of), back=_lanes(of, edges, "back"), skip=_lanes(of, edges, "skip")) for of in cut
    ]


def _lanes(column: Sequence[Node], edges: Sequence[FlowEdge], side: str) -> dict[FlowEdge, int]:
    """Lanes of edges within a column that go back, or skip steps; short ones inside."""
    place = {node.step: at for at, node in enumerate(column)}
    found = []
    for edge in edges:
        if edge.start in place and edge.end in place:
            span = place[edge.end] - place[edge.start]
            if (span <= 0 and side == "back") or (span > 1 and side == "skip"):
                found.append((abs(span), min(place[edge.start], place[edge.end]), edge))
    taken: list[list[tuple[int, int]]] = []
    lanes: dict[FlowEdge, int] = {}
    for span, low, edge in sorted(found, key=lambda item: item[:2]):
        high = low + span
        lane = next((n for n, of in enumerate(taken) if all(high < a or b < low for a, b in of)), len(taken))
        if lane == len(taken):
            taken.append([])
        taken[lane].append((low, high))
        lanes[edge] = lane
    return lanes
