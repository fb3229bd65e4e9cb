"""Mend and read the pages that Sphinx wrote: links, anchors, and the sections that a search finds."""

import re
from dataclasses import dataclass, field
from html.parser import HTMLParser
from pathlib import Path
from typing import Final

HEADINGS: Final = frozenset({"h1", "h2", "h3", "h4", "h5", "h6"})
LOADED: Final = {"script": "src", "img": "src", "source": "src", "iframe": "src", "link": "href"}
"""Elements that make a browser load a file, with the attribute that names the file."""
MENDED: Final = (
    (re.compile(r'<aside class="sidebar-drawer"'), r'\g<0> aria-label="Pages"'),
    (re.compile(r'<aside class="toc-drawer[^"]*"'), r'\g<0> aria-label="Contents of this page"'),
    (re.compile(r'class="caption" role="heading"'), r'\g<0> aria-level="2"'),
    (re.compile(r"<th([^>]*)>(<p></p>)?</th>"), r"<td\1></td>"),
)
"""What the theme and the notebooks write, and what a screen reader needs instead."""
INLINE: Final = frozenset(
    {"a", "abbr", "b", "code", "em", "i", "kbd", "mark", "span", "strong", "sub", "sup"}
)
"""Elements that do not end a word."""


@dataclass
class Section:
    """A heading and the text below it, up to the next heading."""

    anchor: str
    heading: str = ""
    text: str = ""


@dataclass
class Page(HTMLParser):
    """A page of the site."""

    anchors: set[str] = field(default_factory=set)
    links: list[str] = field(default_factory=list)
    loaded: list[str] = field(default_factory=list)
    sections: list[Section] = field(default_factory=list)
    rows: list[Section] = field(default_factory=list)
    """Rows of tables: the heading is the first cell, and the anchor is that of the section."""
    _cell: int = 0
    """Number of the cell within its row, from 1; 0 outside a table."""
    _in_article: bool = False
    _in_heading: bool = False
    _in_mark: bool = False
    """Within the link next to a heading, which is no text of the page."""

    def __post_init__(self) -> None:
        super().__init__()

    def handle_starttag(self, tag: str, attrs: list[tuple[str, str | None]]) -> None:
        given = {name: value or "" for name, value in attrs}
        self.anchors |= {given[name] for name in ("id", "name") if name in given}
        if tag == "a" and "href" in given:
            self.links.append(given["href"])
        if tag in LOADED and LOADED[tag] in given:
            self.loaded.append(given[LOADED[tag]])
        if tag == "article":
            self._in_article = True
        elif tag == "section" and self._in_article:
            self.sections.append(Section(given.get("id", "")))
        elif tag == "tr" and self.sections:
            self.rows.append(Section(self.sections[-1].anchor))
            self._cell = 0
        elif tag == "td" and self.rows:
            self._cell += 1
        if tag not in INLINE:
            self.handle_data(" ")
        self._in_heading = self._in_heading or (tag in HEADINGS and self._in_article)
        self._in_mark = self._in_mark or "headerlink" in given.get("class", "")

    def handle_endtag(self, tag: str) -> None:
        if tag == "article":
            self._in_article = False
        elif tag in HEADINGS:
            self._in_heading = False
        elif tag == "a":
            self._in_mark = False
        elif tag == "table":
            self._cell = 0

    def handle_data(self, data: str) -> None:
        if not (self._in_article and self.sections) or self._in_mark:
            return
        if self._in_heading:
            self.sections[-1].heading += data
        else:
            self.sections[-1].text += data
        if self._cell == 1:
            self.rows[-1].heading += data
        elif self._cell > 1:
            self.rows[-1].text += data


def mend(file: Path) -> None:
    """Correct what would mislead a screen reader."""
    text = file.read_text(encoding="utf-8")
    for old, new in MENDED:
        text = old.sub(new, text)
    file.write_text(text, encoding="utf-8")


def read_page(file: Path) -> Page:
    page = Page()
    page.feed(file.read_text(encoding="utf-8"))
    page.close()
    return page
