"""Draws the flow of a plan as SVG, with searchable text."""

from html import escape
from typing import Final

from handeye.core.plain_text import counted
from handeye.inspection.flow import Flow
from handeye.inspection.layout import NOTE, ROW, WIDTH, Layout, Point, Route, StepBox, layout

COLOURS: Final = {
    "motion": ("#dbe9f6", "#3b75af"),
    "hand": ("#dff0e1", "#3f8f52"),
    "sight": ("#ece2f4", "#7d54a3"),
    "test": ("#fbeccb", "#b98113"),
    "search": ("#e3eff0", "#3d8087"),
    "other": ("#ededed", "#808080"),
}
"""Fill colour and stroke colour of each kind of step."""
RADIUS: Final = 6.0  # px, of the corners of an edge
LETTERS: Final = (30, 43)  # greatest numbers of characters in a step: in its statement, and in a note
_MARGIN: Final = 64  # px above the drawing, for title and legend

_STYLE: Final = (
    "text{font-family:ui-monospace,'DejaVu Sans Mono',Menlo,Consolas,monospace;fill:#222}"
    ".h{font-family:system-ui,'DejaVu Sans',Helvetica,Arial,sans-serif}"
    ".s{font-size:12px}.n{font-size:9.5px;fill:#555}.l{font-size:9.5px;fill:#888}"
    ".w{fill:none;stroke:#8a8f98;stroke-width:1.3}.x{fill:none;stroke:#c8382e;stroke-width:1.5}"
    ".o{fill:none;stroke:#c3c7cd;stroke-width:1.3}.e{font-size:10px;font-weight:bold;fill:#c8382e}"
)


def flow_svg(graph: Flow) -> str:
    """Draw a flow graph as SVG."""
    placed = layout(graph)
    width, height = max(placed.width, 660), placed.height + _MARGIN
    out = [
        f'<svg xmlns="http://www.w3.org/2000/svg" viewBox="0 0 {width:g} {height:g}" '
        f'width="{width:g}" height="{height:g}">',
        f"<style>{_STYLE}</style>", "<defs>", _arrow("a", "#8a8f98"), _arrow("r", "#c8382e"), "</defs>",
        f'<rect width="{width:g}" height="{height:g}" fill="#fff"/>',
        *_legend(graph), f'<g transform="translate(0 {_MARGIN})">', *_areas(graph, placed),
        *(_route(route, graph) for route in placed.routes), *(_box(box) for box in placed.boxes),
        *(_label(route) for route in placed.routes if route.edge.error is not None), "</g>", "</svg>",
    ]  # fmt: skip
    return "\n".join(line for line in out if line) + "\n"


def _legend(graph: Flow) -> list[str]:
    out = [f'<text class="h" x="16" y="30" font-size="19" font-weight="600">{escape(graph.name)}</text>']
    x = 16
    for kind, (paper, ink) in COLOURS.items():
        out.append(f'<rect x="{x}" y="43" width="12" height="12" rx="3" fill="{paper}" stroke="{ink}"/>')
        out.append(f'<text class="h" x="{x + 17}" y="53" font-size="11">{kind}</text>')
        x += 78
    out.append(f'<path class="x" d="M{x} 49h24" marker-end="url(#r)"/>')
    return [*out, f'<text class="h" x="{x + 34}" y="53" font-size="11">if this error was raised</text>']


def _areas(graph: Flow, placed: Layout) -> list[str]:
    out = []
    for area in placed.areas:
        out.append(
            f'<rect x="{area.x:g}" y="{area.y:g}" width="{area.width:g}" height="{area.height:g}" rx="10" '
            'fill="#f7f8fa" stroke="#e1e4e8"/>'
        )
        name = escape(_cut(f"{area.stage + 1}  {graph.stages[area.stage]}", int(area.width / 8.5)))
        said = f"{counted(area.nodes, 'step')}, {area.seconds:.1f} s"
        x, y = area.x + 14, area.y
        out.append(f'<text class="h" x="{x:g}" y="{y + 23:g}" font-size="14" font-weight="600">{name}</text>')
        out.append(f'<text class="h" x="{x:g}" y="{y + 40:g}" font-size="11" style="fill:#777">{said}</text>')
    return out


def _box(box: StepBox) -> str:
    node = box.node
    paper, ink = COLOURS[node.kind]
    middle = ROW / 2 + 4
    time = "" if node.seconds is None else f"{node.seconds:.1f} s"
    notes = "".join(
        f'<text class="n" x="10" y="{ROW + NOTE * at + 7:g}">{escape(_cut(note, LETTERS[1]))}</text>'
        for at, note in enumerate(node.notes)
    )
    hover = escape("\n".join((f"step {node.step}, line {node.line}: {node.text}", *node.notes)))
    return (
        f'<g transform="translate({box.x:g} {box.y:g})"><title>{hover}</title>'
        f'<rect width="{WIDTH}" height="{box.height:g}" rx="5" fill="{paper}" stroke="{ink}"/>'
        f'<text class="s" x="10" y="{middle:g}">{escape(_cut(node.text, LETTERS[0] - 5 * bool(time)))}</text>'
        f'<text class="l" x="{WIDTH - 30}" y="{middle:g}" text-anchor="end">{time}</text>'
        f'<text class="l" x="{WIDTH - 7}" y="{middle:g}" text-anchor="end">{node.line}</text>{notes}</g>'
    )


def _route(route: Route, graph: Flow) -> str:
    error = route.edge.error is not None
    look = "x" if error else "o" if route.kind == "over" else "w"
    arrow = "r" if error else "a"
    line = f'<path class="{look}" d="{_path(route.points)}" marker-end="url(#{arrow})"/>'
    if route.kind != "out":
        return line
    x, y = route.points[-1]
    end = route.edge.end
    said = escape(_cut("end" if end is None else f"to {graph.outside[end]}", 28))
    return f'{line}<text class="l h" x="{x + 8:g}" y="{y + 4:g}">{said}</text>'


def _label(route: Route) -> str:
    (x, y), (x2, _) = route.points[:2]
    x, y = (x + 6, y + 13) if route.kind == "down" else (min(x, x2) + 3, y - 4)
    return f'<text class="e" x="{x:g}" y="{y:g}">{route.edge.error}</text>'


def _path(points: tuple[Point, ...]) -> str:
    """Write the SVG path through points, with rounded corners."""
    out = [f"M{points[0][0]:g} {points[0][1]:g}"]
    for before, here, after in zip(points, points[1:], points[2:], strict=False):
        (x1, y1), (x2, y2) = _towards(here, before), _towards(here, after)
        out.append(f"L{x1:g} {y1:g}Q{here[0]:g} {here[1]:g} {x2:g} {y2:g}")
    return "".join([*out, f"L{points[-1][0]:g} {points[-1][1]:g}"])


def _towards(here: Point, there: Point) -> Point:
    """Return the point, on the line between two corners, at which the rounding of the first corner ends."""
    dx, dy = there[0] - here[0], there[1] - here[1]
    size = abs(dx) + abs(dy)
    share = min(RADIUS, size / 2) / size if size else 0.0
    return here[0] + dx * share, here[1] + dy * share


def _arrow(name: str, colour: str) -> str:
    return (
        f'<marker id="{name}" viewBox="0 0 8 8" refX="7.5" refY="4" markerWidth="7" markerHeight="7" '
        f'markerUnits="userSpaceOnUse" orient="auto"><path d="M0 .6L8 4L0 7.4z" fill="{colour}"/></marker>'
    )


def _cut(text: str, letters: int) -> str:
    return text if len(text) <= letters else text[: letters - 1] + "…"
