"""The steps of a stage put into columns, and a lane beside the column for each way that does not just go down."""

from collections.abc import Sequence
from dataclasses import dataclass
from typing import Final

from handeye.inspection.flow import Node, Way

WIDTH: Final = 264
"""Of a step."""
ROW: Final = 24
"""Height of a step without notes."""
NOTE: Final = 14
"""Height that each note adds to it."""
GAP: Final = 18
"""Between a step and the one below."""
TALL: Final = 1150
"""Columns are broken at this height, if they can be."""
LANE: Final = 11
SIDE: Final = 18
"""From a step to the first lane beside it, and from the last to the border of the column."""
ALMOST: Final = 0.9
"""A column may be broken when it has this share of the height it should have."""
WORTH: Final = 0.35
"""The rest of a stage must have this share of it to be worth a column of its own."""


@dataclass(frozen=True, slots=True, kw_only=True)
class Column:
    """Steps one below the other."""

    nodes: tuple[Node, ...]
    back: dict[Way, int]
    """Lanes of the ways that go back, on the left; 0 is next to the steps."""
    skip: dict[Way, int]
    """Lanes of those that skip something, on the right."""

    @property
    def before(self) -> float:
        """From the border to the steps."""
        return _breadth(self.back)

    @property
    def width(self) -> float:
        """With all its lanes."""
        return self.before + WIDTH + _breadth(self.skip)

    @property
    def height(self) -> float:
        """Of all its steps and the gaps between them."""
        return sum(height(node) + GAP for node in self.nodes) - GAP


def _breadth(lanes: dict[Way, int]) -> float:
    deepest = max(lanes.values(), default=-1) + 1
    return SIDE + (SIDE + LANE * deepest if deepest else 0)


def height(node: Node) -> float:
    """Of the box of a step."""
    return ROW + NOTE * len(node.notes)


def columns(nodes: Sequence[Node], edges: Sequence[Way]) -> list[Column]:
    """The steps of a stage in columns of equal height as nearly as loops allow."""
    total = sum(height(node) + GAP for node in nodes)
    goal = total / max(1, round(total / TALL + 0.2))
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
        if filled >= goal * ALMOST and left >= goal * WORTH and at not in spanned:
            cut.append([])
            filled = 0.0
        cut[-1].append(node)
        filled += height(node) + GAP
        left -= height(node) + GAP
    return [
        Column(nodes=tuple(of), back=_lanes(of, edges, "back"), skip=_lanes(of, edges, "skip")) for of in cut
    ]


def _lanes(column: Sequence[Node], edges: Sequence[Way], side: str) -> dict[Way, int]:
    """A lane for each way that goes back, or skips something, within a column; short ones inside."""
    place = {node.step: at for at, node in enumerate(column)}
    found = []
    for edge in edges:
        if edge.start in place and edge.end in place:
            span = place[edge.end] - place[edge.start]
            if (span <= 0 and side == "back") or (span > 1 and side == "skip"):
                found.append((abs(span), min(place[edge.start], place[edge.end]), edge))
    taken: list[list[tuple[int, int]]] = []
    lanes: dict[Way, int] = {}
    for span, low, edge in sorted(found, key=lambda item: item[:2]):
        high = low + span
        lane = next((n for n, of in enumerate(taken) if all(high < a or b < low for a, b in of)), len(taken))
        if lane == len(taken):
            taken.append([])
        taken[lane].append((low, high))
        lanes[edge] = lane
    return lanes
