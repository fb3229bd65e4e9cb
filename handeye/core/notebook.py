"""HTML elements for notebooks. These elements use no style sheets or scripts, so they do not affect the rest of the
notebook page.
"""

from collections.abc import Iterable, Sequence
from html import escape
from typing import Final

from handeye.core.markup import Content, Markup, data_address, element

_CELL: Final = "padding:1px 10px 1px 0;vertical-align:top"
_INK: Final = {
    "good": "#2e7d32",
    "bad": "#c62828",
    "doubtful": "#b26a00",
    "quiet": "#757575",
    "plain": "inherit",
}


def inked(content: Content, ink: str) -> Markup:
    """Colour content with `good`, `bad`, `doubtful` or `quiet`."""
    return element("span", content, style=f"color:{_INK[ink]}")


def heading(content: Content) -> Markup:
    """Build a heading."""
    return element("div", element("b", content), style="margin:4px 0")


def line(content: Content) -> Markup:
    """Build a line with the content."""
    return element("div", content, style="margin:2px 0")


def frame(lines: str) -> Markup:
    """Show text in a fixed-width font, with its line breaks."""
    return element("pre", Markup(escape(lines)), style="margin:4px 0")


def bar(share: float) -> Markup:
    """Draw a bar whose length shows a share from 0 to 1."""
    width = max(1, round(160 * share)) if share > 0 else 0
    return element("span", style=f"display:inline-block;height:.7em;width:{width}px;background:#3b75af")


def picture(webp: bytes, what: str) -> Markup:
    """Show a WebP picture with alternative text."""
    return element("img", alt=what, src=data_address("image/webp", webp), style="max-width:480px")


def svg(drawing: str, what: str) -> Markup:
    """Show an SVG drawing with alternative text. The drawing's styles do not affect the rest of the page."""
    address = data_address("image/svg+xml", drawing.encode())
    return element("img", alt=what, src=address, style="max-width:100%")


def sandbox(file: bytes, what: str, height: int) -> Markup:
    """Show a separate HTML page within the notebook page. The scripts of the separate page run, but cannot reach the
    notebook or its kernel.

    The page is given by a `data:` address instead of `srcdoc`. With `srcdoc`, links to moments of the run would
    lead to the address of the notebook.
    """
    address, style = data_address("text/html", file), "border:1px solid #ccc"
    limits = {"sandbox": "allow-scripts", "width": "100%"}
    return element("iframe", title=what, **limits, height=height, style=style, src=address)


def table(head: Sequence[str], rows: Iterable[Sequence[Content]]) -> Markup:
    """Build a table. Columns of numbers and their heads are aligned to the right."""
    lines = [list(row) for row in rows]
    right = [any(isinstance(row[n], (int, float)) for row in lines) for n in range(len(head))]
    drawn = [_row("th", head, right), *(_row("td", row, right) for row in lines)]
    return element("table", *(Markup(f"\n{row}") for row in drawn), style="border-collapse:collapse")


def _row(tag: str, row: Sequence[Content], right: Sequence[bool]) -> Markup:
    shown = (f"{each:.1f}" if isinstance(each, float) else each for each in row)
    sides = ("right" if side else "left" for side in right)
    cells = zip(shown, sides, strict=True)
    return element("tr", *(element(tag, each, style=f"{_CELL};text-align:{side}") for each, side in cells))


def page(*pieces: Markup) -> str:
    """Place elements one below the other."""
    return "<div>\n" + "\n".join(pieces) + "\n</div>\n"
