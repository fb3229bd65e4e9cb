"""Copy the pages for Sphinx, and whatever the pages link to.

Every path of a page is a path in the repository without `docs/`. README.md becomes the index of its folder.
Sources, notebooks and folders become pages too, so that no link leaves the site; other files are copied.
"""

import os
import re
from collections.abc import Callable
from pathlib import Path, PurePosixPath
from typing import Final

from docs.website.converted import ORPHAN, SOURCES, folder_page, notebook_page, source_page
from docs.website.navigation import index_page, language_page

INDEX: Final = "docs/README.md"
LANGUAGE: Final = "docs/language/README.md"
OTHERS: Final = ("CHANGELOG.md", "CONTRIBUTING.md")
"""Pages of the site that lie outside `docs/`."""
REPLAYS: Final = "replays/"
"""Folder of the site with the pages of recorded runs."""
NOT_PROSE: Final = re.compile(r"(^ *```.*?^ *```$|`[^`\n]*`)", re.MULTILINE | re.DOTALL)
LINK: Final = re.compile(r"\]\((?![a-z]+:|#)(?P<path>[^)\s#]+)(?P<anchor>#[^)\s]*)?\)")
REPLAY: Final = re.compile(r"\[(?P<text>[^]]*)\]\((?P<path>[^)\s#]+)\)")


class BrokenLinks(Exception):
    """Raised when pages link to files that do not exist. The message has one line for each link."""


def stage(root: Path, staged: Path) -> None:
    """Write the pages of the repository `root` into the folder `staged`.

    Raises:
        BrokenLinks: a page links to a file that does not exist.
    """
    first = [*sorted((root / "docs").rglob("*.md")), *(root / name for name in OTHERS)]
    waiting = [page.relative_to(root).as_posix() for page in first]
    known, broken = set(waiting), []
    while waiting:
        path = waiting.pop()
        text = page_text(root, path)
        if text is None:
            write(staged / staged_path(root, path), (root / path).read_bytes())
            continue
        linked = links(text, path)
        broken += [f"{path}: {link} does not exist" for link in linked if not (root / link).exists()]
        new = {link for link in linked if (root / link).exists() and not is_recording(root / link)} - known
        known |= new
        waiting += sorted(new)
        page = with_staged_links(text, path, root)
        write(staged / staged_path(root, path), page.encode())
    if broken:
        raise BrokenLinks("\n".join(broken))


def page_text(root: Path, path: str) -> str | None:
    """The Markdown of a file or folder of the repository; None if the file is to be copied as it is."""
    file = root / path
    if file.is_dir():
        return folder_page(file, path)
    if file.suffix == ".ipynb":
        return notebook_page(file.read_bytes())
    if file.suffix in SOURCES:
        return source_page(file.read_text(encoding="utf-8"), path)
    if file.suffix != ".md":
        return None
    text = file.read_text(encoding="utf-8")
    if path == INDEX:
        return index_page(text, lambda link: staged_path(root, target(path, link)).removesuffix(".md"))
    if path == LANGUAGE:
        return language_page(text, sorted(page.stem for page in file.parent.glob("reference/*.md")))
    return text if path.startswith("docs/") else ORPHAN + text


def staged_path(root: Path, path: str) -> str:
    """Where the page of a file or folder of the repository is in the staged folder."""
    place = PurePosixPath(path.removeprefix("docs/"))
    if (root / path).is_dir():
        return (place / "index.md").as_posix()
    if place.name == "README.md":
        return place.with_name("index.md").as_posix()
    if place.suffix == ".ipynb":
        return place.with_suffix(".md").as_posix()
    return f"{place.as_posix()}.md" if place.suffix in SOURCES else place.as_posix()


def is_recording(folder: Path) -> bool:
    """Return True for the folder of a recorded run, whose page is its replay."""
    return (folder / "result.json").is_file()


def recordings(root: Path) -> list[Path]:
    """Return the folders of all recorded runs of the repository `root`."""
    demo = root / "demo"
    found = [demo, *demo.iterdir(), *(root / "docs" / "recordings").iterdir()]
    return sorted(folder for folder in found if is_recording(folder))


def replay_path(path: str) -> str:
    """Where the replay of a recorded run is on the site."""
    return f"{REPLAYS}{PurePosixPath(path).name}.html"


def links(text: str, path: str) -> list[str]:
    """The files and folders that a page links to, as paths in the repository."""
    found = [match["path"] for prose in NOT_PROSE.split(text)[::2] for match in LINK.finditer(prose)]
    return [target(path, link) for link in found]


def target(path: str, link: str) -> str:
    return os.path.normpath(PurePosixPath(path).parent / link).replace(os.sep, "/")


def with_staged_links(text: str, path: str, root: Path) -> str:
    """The text of a page with links to the staged pages and to the replays."""
    start = PurePosixPath(staged_path(root, path)).parent

    def relative(to: str) -> str:
        return os.path.relpath(to, start).replace(os.sep, "/")

    def replay(match: re.Match[str]) -> str:
        to = target(path, match["path"])
        if not is_recording(root / to):
            return match[0]
        return f'<a href="{relative(replay_path(to))}">{match["text"]}</a>'

    def link(match: re.Match[str]) -> str:
        return f"]({relative(staged_path(root, target(path, match['path'])))}{match['anchor'] or ''})"

    return in_prose(text, lambda prose: LINK.sub(link, REPLAY.sub(replay, prose)))


def in_prose(text: str, change: Callable[[str], str]) -> str:
    """Change a page outside its blocks and pieces of code."""
    parts = NOT_PROSE.split(text)
    return "".join(part if number % 2 else change(part) for number, part in enumerate(parts))


def write(file: Path, content: bytes) -> None:
    file.parent.mkdir(parents=True, exist_ok=True)
    file.write_bytes(content)
