"""The navigation of the site, which is the index of the documentation: one group for each heading, one entry for
each link.
"""

import re
from collections.abc import Callable, Iterable
from typing import Final

ENTRY: Final = re.compile(r"\[(?P<title>[^]]+)\]\((?!#|[a-z]+:)(?P<path>[^)\s#]+)\)")
REFERENCE: Final = "language/reference/"
"""Pages of instructions, which are below the page on the language."""


def index_page(index: str, name: Callable[[str], str]) -> str:
    """The first page of the site: the index and the navigation.

    Args:
        index: Markdown of the index.
        name: Returns the name of a page on the site, for a link of the index.
    """
    return index + "".join(
        contents(((title, name(path)) for title, path in entries), heading)
        for heading, entries in groups(index).items()
    )


def language_page(text: str, instructions: Iterable[str]) -> str:
    """The page on the language, with a page for each instruction below it."""
    return text + contents((word.upper(), f"reference/{word}") for word in instructions)


def groups(index: str) -> dict[str, list[tuple[str, str]]]:
    """Titles and paths of the pages, by heading of the index. A page is in the first group that names it."""
    found: dict[str, list[tuple[str, str]]] = {}
    named: set[str] = set()
    for section in re.split(r"^## ", index, flags=re.MULTILINE)[1:]:
        heading = section.partition("\n")[0]
        for entry in ENTRY.finditer(section):
            if entry["path"] not in named and not entry["path"].startswith(REFERENCE):
                found.setdefault(heading, []).append((entry["title"], entry["path"]))
                named.add(entry["path"])
    return found


def contents(entries: Iterable[tuple[str, str]], caption: str | None = None) -> str:
    """Sphinx's list of the pages below a page."""
    options = ":hidden:\n" + (f":caption: {caption}\n" if caption else "")
    lines = "\n".join(f"{title} <{name}>" for title, name in entries)
    return f"\n```{{toctree}}\n{options}\n{lines}\n```\n"
