"""Lays out a flow graph: positions of steps and routes of edges, in pixels, with y downwards.

Stages stand side by side in rows, which are called shelves. The steps of a stage run from top to bottom. A long stage
has several columns, but no loop is split between two columns. An edge to the step below is short and straight. An edge
that goes back runs left of its column. An edge that skips steps runs right of its column. Each edge on the left or
right has a lane of its own. An edge to another column runs above the columns.
"""

from collections.abc import Sequence
from dataclasses import dataclass, field
from itertools import groupby
from typing import Final, Literal

from handeye.inspection.flow import Flow, FlowEdge, Node

WIDTH: Final = 264  # px, of a step
ROW: Final = 24  # px, height of a step without notes
NOTE: Final = 14  # px, height of a note
GAP: Final = 18  # px, between steps
COLUMN_HEIGHT: Final = 1150  # px, height at which a column is broken if possible
LANE: Final = 11
SIDE: Final = 18  # px, from step to first lane, and from last lane to the column's border
MIN_FILL: Final = 0.9  # a column may be broken when it is filled to this fraction of its height
MIN_REST: Final = 0.35  # another column is begun only if the rest fills this fraction of it


@dataclass(frozen=True, slots=True, kw_only=True)
class Column:
    """Steps one below the other. Each edge has a lane; lane 0 is next to the steps."""

    nodes: tuple[Node, ...]
    back: dict[FlowEdge, int]  # on the left
    skip: dict[FlowEdge, int]  # on the right

    @property
    def before(self) -> float:
        """Width (pixels) of the lanes left of the steps."""
        return _breadth(self.back)

    @property
    def width(self) -> float:
        """Width (pixels) of the steps and all lanes."""
        return self.before + WIDTH + _breadth(self.skip)

    @property
    def height(self) -> float:
        return sum(height(node) + GAP for node in self.nodes) - GAP


def _breadth(lanes: dict[FlowEdge, int]) -> float:
    deepest = max(lanes.values(), default=-1) + 1
    return SIDE + (SIDE + LANE * deepest if deepest else 0)


def height(node: Node) -> float:
    """Return the height (pixels) of the box of a step."""
    return ROW + NOTE * len(node.notes)


def columns(nodes: Sequence[Node], edges: Sequence[FlowEdge]) -> list[Column]:
    """Split the steps of a stage into columns of about equal height, without splitting a loop."""
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
    """Assign a lane to each edge that goes back or skips steps within a column. Short edges get the inner lanes."""
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


TOP: Final = 76  # above columns: stage names, and edges round the top
FOOT: Final = 28  # below columns
FRAME: Final = 16  # between stages
SHELF_WIDTH: Final = 3800

Point = tuple[float, float]


@dataclass(frozen=True, slots=True, kw_only=True)
class StepBox:
    """The box of a step; (x, y) is its upper left corner."""

    node: Node
    x: float
    y: float
    height: float


@dataclass(frozen=True, slots=True, kw_only=True)
class Route:
    """The polyline of an edge. `kind` says where the edge leads: to the next step (down), back, past steps (skip),
    to another column (over), or out of the drawing (out).
    """

    edge: FlowEdge
    points: tuple[Point, ...]
    kind: Literal["down", "back", "skip", "over", "out"]


@dataclass(frozen=True, slots=True, kw_only=True)
class Area:
    """The area of a stage; (x, y) is its upper left corner."""

    stage: int
    x: float
    y: float
    width: float
    height: float
    nodes: int
    seconds: float


@dataclass(frozen=True, slots=True, kw_only=True)
class Layout:
    """A flow graph with the positions of its steps and edges."""

    boxes: tuple[StepBox, ...]
    routes: tuple[Route, ...]
    areas: tuple[Area, ...]
    width: float
    height: float


@dataclass(slots=True, kw_only=True)
class _Shelves:
    """Places stages side by side on a shelf, and starts a new shelf when the shelf is full."""

    edges: tuple[FlowEdge, ...]
    boxes: dict[int, StepBox] = field(default_factory=dict)
    areas: list[Area] = field(default_factory=list)
    routes: list[Route] = field(default_factory=list)
    borders: dict[int, tuple[float, float, float]] = field(default_factory=dict)
    """For each step, the left and right borders of its column and the top of its shelf."""
    x: float = FRAME
    y: float = 0.0
    width: float = 0.0
    tallest: float = 0.0  # on the present shelf

    def add(self, stage: int, nodes: list[Node]) -> None:
        """Place one stage."""
        parts = columns(nodes, self.edges)
        width = sum(part.width for part in parts)
        if self.x > FRAME and self.x + width > SHELF_WIDTH:
            self.x, self.y, self.tallest = FRAME, self.y + self.tallest + FRAME, 0.0
        tall = TOP + max(part.height for part in parts) + FOOT
        seconds = sum(node.seconds or 0.0 for node in nodes)
        self.areas.append(
            Area(stage=stage, x=self.x, y=self.y, width=width, height=tall, nodes=len(nodes), seconds=seconds)
        )
        for part in parts:
            self._fill(part)
            self.x += part.width
        self.x += FRAME
        self.width, self.tallest = max(self.width, self.x), max(self.tallest, tall)

    def _fill(self, column: Column) -> None:
        y = self.y + TOP
        for node in column.nodes:
            self.boxes[node.step] = StepBox(node=node, x=self.x + column.before, y=y, height=height(node))
            self.borders[node.step] = (self.x, self.x + column.width, self.y)
            y += height(node) + GAP
        self.routes += [_beside(edge, lane, "back", self.boxes) for edge, lane in column.back.items()]
        self.routes += [_beside(edge, lane, "skip", self.boxes) for edge, lane in column.skip.items()]


def layout(graph: Flow) -> Layout:
    """Place all steps and edges of a graph."""
    shelves = _Shelves(edges=graph.edges)
    for stage, run in groupby(graph.nodes, key=lambda node: node.stage):
        shelves.add(stage, list(run))
    boxes, beside = shelves.boxes, {route.edge for route in shelves.routes}
    plain = [_plain(edge, boxes, shelves.borders) for edge in graph.edges if edge not in beside]
    return Layout(
        boxes=tuple(boxes.values()), routes=(*plain, *shelves.routes), areas=tuple(shelves.areas),
        width=shelves.width, height=shelves.y + shelves.tallest + FRAME,
    )  # fmt: skip


def _beside(edge: FlowEdge, lane: int, side: Literal["back", "skip"], boxes: dict[int, StepBox]) -> Route:
    assert edge.end is not None
    one, other = boxes[edge.start], boxes[edge.end]
    start, end = one.y + one.height * 0.62, other.y + other.height * 0.38
    away, edge_x = (-1, one.x) if side == "back" else (1, one.x + WIDTH)
    x = edge_x + away * (SIDE + lane * LANE)
    points = ((edge_x, start), (x, start), (x, end), (edge_x, end))
    return Route(edge=edge, points=points, kind=side)


def _plain(
    edge: FlowEdge, boxes: dict[int, StepBox], borders: dict[int, tuple[float, float, float]]
) -> Route:
    """Return the route of an edge. The edge may lead straight down, into another column, or out of the drawing."""
    one, other = boxes[edge.start], None if edge.end is None else boxes.get(edge.end)
    middle, bottom, y = one.x + WIDTH / 2, one.y + one.height, one.y + one.height * 0.62
    right = one.x + WIDTH
    if other is None and edge.error is None:
        return Route(edge=edge, points=((middle, bottom), (middle, bottom + 16)), kind="out")
    if other is None:
        return Route(edge=edge, points=((right, y), (right + SIDE, y)), kind="out")
    if other.x == one.x and other.y == bottom + GAP:
        return Route(edge=edge, points=((middle, bottom), (middle, other.y)), kind="down")
    border, (back, _, shelf) = borders[edge.start][1], borders[other.node.step]
    over = shelf + TOP - 16.0
    if (
        one.node.step + 1 == other.node.step and other.y == shelf + TOP
    ):  # an edge from the foot of a column to the next column
        out, down, corner = border - 4, bottom + 12, other.x + WIDTH / 2
        leaving = (middle, bottom), (middle, down), (out, down), (out, over)
        return Route(edge=edge, points=(*leaving, (corner, over), (corner, other.y)), kind="over")
    end = other.y + other.height * 0.38
    out, back, over = border - 8, back + 8, over - 8
    points = ((right, y), (out, y), (out, over), (back, over), (back, end), (other.x, end))
    return Route(edge=edge, points=points, kind="over")
