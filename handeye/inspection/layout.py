"""Layout of a flow graph: positions of steps, and routes of edges, in pixels, y downwards.

Stages stand side by side on shelves, their steps from top to bottom; a long one has several columns, broken outside
loops. Edges to the step below are short and straight. Those that go back run on the left of their column, those that
skip steps on its right, each in a lane of its own; edges to another column go round the top.
"""

from dataclasses import dataclass, field
from itertools import groupby
from typing import Final, Literal

from handeye.inspection.columns import GAP, LANE, SIDE, WIDTH, Column, columns, height
from handeye.inspection.flow import Flow, FlowEdge, Node

TOP: Final = 76  # above columns: stage names, and edges round the top
FOOT: Final = 28  # below columns
FRAME: Final = 16  # between stages
SHELF_WIDTH: Final = 3800

Point = tuple[float, float]


@dataclass(frozen=True, slots=True, kw_only=True)
class StepBox:
    """A placed step; x, y is the upper left corner."""

    node: Node
    x: float
    y: float
    height: float


@dataclass(frozen=True, slots=True, kw_only=True)
class Route:
    """An edge's polyline: to the step below, back, past steps, to another column, or out of the drawing."""

    edge: FlowEdge
    points: tuple[Point, ...]
    kind: Literal["down", "back", "skip", "over", "out"]


@dataclass(frozen=True, slots=True, kw_only=True)
class Area:
    """The area of a stage; x, y is the upper left corner."""

    stage: int
    x: float
    y: float
    width: float
    height: float
    nodes: int
    seconds: float


@dataclass(frozen=True, slots=True, kw_only=True)
class Layout:
    """A placed flow graph."""

    boxes: tuple[StepBox, ...]
    routes: tuple[Route, ...]
    areas: tuple[Area, ...]
    width: float
    height: float


@dataclass(slots=True, kw_only=True)
class _Shelves:
    """Places stages side by side, starting a new shelf when there is no room."""

    edges: tuple[FlowEdge, ...]
    boxes: dict[int, StepBox] = field(default_factory=dict)
    areas: list[Area] = field(default_factory=list)
    routes: list[Route] = field(default_factory=list)
    borders: dict[int, tuple[float, float, float]] = field(default_factory=dict)
    """Of a step's column: left, right, and top of its shelf."""
    x: float = FRAME
    y: float = 0.0
    width: float = 0.0
    tallest: float = 0.0  # on the present shelf

    def add(self, stage: int, nodes: list[Node]) -> None:
        """Place a stage."""
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


def _beside(edge: FlowEdge, lane: int, side: str, boxes: dict[int, StepBox]) -> Route:
    assert edge.end is not None
    one, other = boxes[edge.start], boxes[edge.end]
    start, end = one.y + one.height * 0.62, other.y + other.height * 0.38
    if side == "back":
        x, edge_x = one.x - SIDE - lane * LANE, one.x
    else:
        x, edge_x = one.x + WIDTH + SIDE + lane * LANE, one.x + WIDTH
    points = ((edge_x, start), (x, start), (x, end), (edge_x, end))
    return Route(edge=edge, points=points, kind="back" if side == "back" else "skip")


def _plain(
    edge: FlowEdge, boxes: dict[int, StepBox], borders: dict[int, tuple[float, float, float]]
) -> Route:
    """The route of an edge down, to another column, or out."""
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
    ):  # from the foot of a column to the next
        out, down, corner = border - 4, bottom + 12, other.x + WIDTH / 2
        points = (
            (middle, bottom),
            (middle, down),
            (out, down),
            (out, over),
            (corner, over),
            (corner, other.y),
        )
        return Route(edge=edge, points=points, kind="over")
    end = other.y + other.height * 0.38
    out, back, over = border - 8, back + 8, over - 8
    points = ((right, y), (out, y), (out, over), (back, over), (back, end), (other.x, end))
    return Route(edge=edge, points=points, kind="over")
