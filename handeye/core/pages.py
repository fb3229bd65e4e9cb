"""Finds the page of a topic in the documentation, and reads the index of the pages."""

import os
import re
from collections.abc import Iterator
from pathlib import Path
from typing import Final

from handeye.core.diagnostics import quoted
from handeye.core.errors import NoSuchName

INDEX: Final = "README.md"
_ENTRY: Final = re.compile(r"^- \[.*?\]\((?P<page>[\w/.-]+\.md)\): (?P<sentence>.*)$", re.MULTILINE)

_LINK: Final = re.compile(r"\]\(([\w/.-]+\.md)(?:#[^)]*)?\)")


def pages(folder: Path) -> dict[str, Path]:
    """The pages of the documentation, without the index. The keys are the topics."""
    files = (file for file in sorted(folder.rglob("*.md")) if file != folder / INDEX)
    return {(file.parent if file.name == INDEX else file).stem: file for file in files}


def page_named(topic: str, folder: Path) -> Path:
    """The page of a topic. The name of the topic may include its folder. Raises NoSuchName if the topic has no page."""
    from difflib import get_close_matches

    found = pages(folder)
    name = topic.casefold().removesuffix(".md").removeprefix("docs/")
    place = folder / f"{name}.md"
    for page in found.values():
        if page == place:
            return page
    if name in found:
        return found[name]
    near = get_close_matches(name, found, n=1)
    hint = f"did you mean {near[0]}?" if near else "`handeye docs` lists the pages"
    raise NoSuchName(f"there is no page {quoted(topic)}; {hint}")


def sections(index: str) -> Iterator[tuple[str, list[tuple[str, str]]]]:
    """The headings of the index. Each heading comes with its topics, and each topic with the sentence that describes
    it.
    """
    for section in re.split(r"^## ", index, flags=re.MULTILINE)[1:]:
        entries = [(_topic(found["page"]), _plain(found["sentence"])) for found in _ENTRY.finditer(section)]
        if entries:
            yield section.partition("\n")[0], entries


def linked_pages(page: Path, folder: Path) -> Iterator[str]:
    """The topics of the pages to which a page links, in the order of the links."""
    topics = {file: topic for topic, file in pages(folder).items()}
    for found in _LINK.finditer(page.read_text(encoding="utf-8")):
        if (topic := topics.get(Path(os.path.normpath(page.parent / found[1])))) is not None:
            yield topic


def _topic(page: str) -> str:
    path = Path(page)
    return (path.parent if path.name == INDEX else path).stem


def _plain(markdown: str) -> str:
    return re.sub(r"\[(.*?)\]\(.*?\)", r"\1", markdown).replace("`", "").replace("*", "")
