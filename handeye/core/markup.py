"""Builds HTML and SVG elements as text, and escapes all text that is put into an element."""

import re
from base64 import b64encode
from collections.abc import Iterable
from html import escape
from typing import Final, NamedTuple

from handeye.core.plain_text import printable

VOID: Final = {"img", "input", "meta"}  # elements of HTML without content
SHAPES: Final = {"circle", "line", "path", "polygon", "rect"}  # elements of drawings without content

Content = str | float | None  # markup, text, a number, or nothing


class Markup(str):
    """Markup that is already escaped; a plain `str` is text that still needs escaping."""

    __slots__ = ()


class PagePart(NamedTuple):
    """A part of a page, with its own style and script."""

    markup: Markup
    style: str = ""
    script: str = ""


def text(content: Content) -> Markup:
    """Convert content to markup. Plain text is escaped, and unprintable characters become visible symbols."""
    if isinstance(content, Markup):
        return content
    return Markup(escape("" if content is None else printable(str(content))))


def element(name: str, /, *children: Content, **attributes: str | float | bool | None) -> Markup:
    """Build an HTML or SVG element. In attribute names, `aria_label` stands for `aria-label` and `class_` for
    `class`. Attributes with the value None are left out.
    """
    inside = "".join(text(child) for child in children if child is not None)
    told = "".join(_attribute(key, value) for key, value in attributes.items())
    if name in SHAPES:
        return Markup(f"<{name}{told}/>")
    return Markup(f"<{name}{told}>" if name in VOID else f"<{name}{told}>{inside}</{name}>")


def joined(pieces: Iterable[str], between: str = "") -> Markup:
    return Markup(text(between).join(text(piece) for piece in pieces))


def lines(rows: Iterable[str]) -> Markup:
    """Build a text whose lines are not wrapped. In a narrow window, the user must scroll the text. To scroll by
    keyboard, the user selects the text with the Tab key.
    """
    return element("pre", joined(rows, Markup("\n")), tabindex="0")


def section(name: str, heading: str, *children: Content) -> Markup:
    """Build a section of a page. The heading is also the label of the section."""
    title = element("h2", heading, id=f"{name}-heading")
    return element("section", title, *children, id=name, aria_labelledby=f"{name}-heading")


_HEADING: Final = re.compile(r'<h2 id="([a-z-]+)-heading">(.*?)</h2>')


def contents(sections: Iterable[Markup]) -> Markup:
    """Build a list of links to sections, with the sections' headings as text."""
    found = (match for each in sections if (match := _HEADING.search(each)) is not None)
    links = (element("a", Markup(match[2]), href=f"#{match[1]}") for match in found)
    return element("nav", *links, aria_label="contents", class_="contents")


def region(*children: Content, label: str, **attributes: str | None) -> Markup:
    """Build a part of a section. The part scrolls while the rest of the page stays in place. The label is read by
    screen readers.
    """
    return element("section", *children, **attributes, aria_label=label, tabindex="0")


def note(*children: Content) -> Markup:
    """Build a paragraph that explains how to read a figure or table."""
    return element("p", *children, class_="note")


def to_moment(seconds: float, *children: Content, **attributes: str | None) -> Markup:
    """Build a link that moves the 3D view to a time (s since the run began)."""
    return element("a", *children, href=f"#t={seconds:.2f}", **attributes)


def table(head: Iterable[Markup], rows: Iterable[Iterable[Markup]], *, label: str) -> Markup:
    """Build a table. If the window is narrow, the table scrolls while the rest of the page stays in place."""
    titles = element("tr", *head)
    body = element("tbody", *(element("tr", *row) for row in rows))
    inside = element("table", element("thead", titles), body)
    return region(inside, label=f"table: {label}", class_="table")


def heads(*titles: str, class_: str | None = None) -> list[Markup]:
    """Build the heads of columns of words. An empty title gives an empty cell."""
    return [element("th", title, scope="col", class_=class_) if title else cell() for title in titles]


def figure_heads(*titles: str) -> list[Markup]:
    """Build the heads of columns of numbers."""
    return heads(*titles, class_="number")


def cell(*children: Content) -> Markup:
    return element("td", *children)


def figure_cell(*children: Content) -> Markup:
    """Build a table cell with a number."""
    return element("td", *children, class_="number")


def data_address(kind: str, data: bytes) -> str:
    """Build a `data:` address that contains a whole file."""
    return f"data:{kind};base64,{b64encode(data).decode()}"


def _attribute(key: str, value: str | float | bool | None) -> str:
    if value is None or value is False:
        return ""
    name = key.rstrip("_").replace("_", "-")
    return f" {name}" if value is True else f' {name}="{text(str(value))}"'
