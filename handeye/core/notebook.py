"""Pieces of pages for notebooks: no style sheet and no script, so that nothing else on the page changes."""

from base64 import b64encode
from collections.abc import Iterable, Sequence
from html import escape
from typing import Final

from handeye.core.markup import Content, Markup, markup

_CELL: Final = "padding:1px 10px 1px 0;vertical-align:top"
_INK: Final = {
    "good": "#2e7d32",
    "bad": "#c62828",
    "doubtful": "#b26a00",
    "quiet": "#757575",
    "plain": "inherit",
}


def inked(content: Content, ink: str) -> Markup:
    """Content in a colour: `good`, `bad`, `doubtful`, `quiet`."""
    return Markup(f'<span style="color:{_INK[ink]}">{markup(content)}</span>')


def heading(content: Content) -> Markup:
    """A line that says what this is."""
    return Markup(f'<div style="margin:4px 0"><b>{markup(content)}</b></div>')


def line(content: Content) -> Markup:
    """A line of its own."""
    return Markup(f'<div style="margin:2px 0">{markup(content)}</div>')


def frame(text: str) -> Markup:
    """Text as it is, line by line."""
    return Markup(f'<pre style="margin:4px 0">{escape(text)}</pre>')


def bar(share: float) -> Markup:
    """A bar as long as a share, from 0 to 1."""
    width = max(1, round(160 * share)) if share > 0 else 0
    return Markup(
        f'<span style="display:inline-block;height:.7em;width:{width}px;background:#3b75af"></span>'
    )


def picture(webp: bytes, what: str) -> Markup:
    """A picture with words for those who cannot see it."""
    data = b64encode(webp).decode()
    return Markup(f'<img alt="{escape(what)}" src="data:image/webp;base64,{data}" style="max-width:480px">')


def svg(drawing: str, what: str) -> Markup:
    """A drawing with words for those who cannot see it; its style reaches nothing else on the page."""
    data = b64encode(drawing.encode()).decode()
    return Markup(f'<img alt="{escape(what)}" src="data:image/svg+xml;base64,{data}" style="max-width:100%">')


def sandbox(file: bytes, what: str, height: int) -> Markup:
    """A page of its own within the page: its scripts run, and reach neither the notebook nor its kernel.

    An address that holds the page, and not `srcdoc`: there, links to moments would lead to the notebook's own address.
    """
    return Markup(
        f'<iframe title="{escape(what)}" sandbox="allow-scripts" width="100%" height="{height}" '
        f'style="border:1px solid #ccc" src="data:text/html;base64,{b64encode(file).decode()}"></iframe>'
    )


def table(head: Sequence[str], rows: Iterable[Sequence[Content]]) -> Markup:
    """A table; numbers, and what stands over them, are on the right."""
    lines = [list(row) for row in rows]
    right = [any(isinstance(row[n], (int, float)) for row in lines) for n in range(len(head))]
    out = ['<table style="border-collapse:collapse">']
    out.append(f"<tr>{''.join(_cell('th', text, side) for text, side in zip(head, right, strict=True))}</tr>")
    for row in lines:
        out.append(
            f"<tr>{''.join(_cell('td', each, side) for each, side in zip(row, right, strict=True))}</tr>"
        )
    return Markup("\n".join([*out, "</table>"]))


def _cell(tag: str, content: Content, right: bool) -> str:
    return f'<{tag} style="{_CELL};text-align:{"right" if right else "left"}">{markup(_written(content))}</{tag}>'


def _written(content: Content) -> Content:
    """A number as people write it."""
    return f"{content:.1f}" if isinstance(content, float) else content


def page(*pieces: Markup) -> str:
    """Pieces one below the other."""
    return "<div>\n" + "\n".join(pieces) + "\n</div>\n"
