"""The command that lists and prints the pages of the documentation, which every installation includes."""

import re
from collections.abc import Iterator
from pathlib import Path
from textwrap import fill
from typing import Annotated, Final

from cyclopts import Parameter

from handeye.cli.common import put, say, screen
from handeye.core.diagnostics import quoted
from handeye.core.errors import NoSuchName

INDEX: Final = "README.md"
_ENTRY: Final = re.compile(r"^- \[.*?\]\((?P<page>[\w/.-]+\.md)\): (?P<sentence>.*)$", re.MULTILINE)


def docs(
    topic: Annotated[
        str | None,
        Parameter(help="Name of a page, such as `tutorial`, `faults` or `search`. Default: list the pages."),
    ] = None,
    /,
    *,
    path: Annotated[bool, Parameter(help="Print the path of the page, for an editor or a viewer.")] = False,
) -> int:
    """List the pages of the documentation, or print one.

    A terminal shows the page formatted; a pipe or a file receives its Markdown.

    ```
    handeye docs
    handeye docs tutorial
    handeye docs search | less
    ```

    Exit code 0: shown; 2: there is no such page.
    """
    from handeye.core import resources

    folder = resources.docs()
    file = folder / INDEX if topic is None else page_named(topic, folder)
    if path:
        say(str(file), whole=True)
    elif topic is None:
        _list(file.read_text(encoding="utf-8"))
    elif screen.is_terminal:
        from rich.markdown import Markdown

        screen.print(Markdown(file.read_text(encoding="utf-8")))
    else:
        put(file.read_bytes())
    return 0


def pages(folder: Path) -> dict[str, Path]:
    """The pages of the documentation by topic, without the index."""
    files = (file for file in sorted(folder.rglob("*.md")) if file != folder / INDEX)
    return {(file.parent if file.name == INDEX else file).stem: file for file in files}


def page_named(topic: str, folder: Path) -> Path:
    """The page of a topic, which may be given with its folder; raises NoSuchName if there is none."""
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


def _list(index: str) -> None:
    """Print the index: topics with one sentence each, grouped by purpose."""
    from rich.text import Text

    for heading, entries in sections(index):
        screen.print(Text(heading, "bold"))
        wide = max(len(topic) for topic, _ in entries) + 4
        for topic, sentence in entries:
            say(
                fill(
                    f"  {topic:<{wide - 2}}{sentence}",
                    max(screen.width, 2 * wide),
                    subsequent_indent=" " * wide,
                )
            )
        say("")
    say("Print a page: handeye docs TOPIC. Each instruction of the language has a page: handeye docs SEARCH.")


def sections(index: str) -> Iterator[tuple[str, list[tuple[str, str]]]]:
    """Headings of the index, each with its topics and their sentences."""
    for section in re.split(r"^## ", index, flags=re.MULTILINE)[1:]:
        entries = [(_topic(found["page"]), _plain(found["sentence"])) for found in _ENTRY.finditer(section)]
        if entries:
            yield section.partition("\n")[0], entries


def _topic(page: str) -> str:
    path = Path(page)
    return (path.parent if path.name == INDEX else path).stem


def _plain(markdown: str) -> str:
    return re.sub(r"\[(.*?)\]\(.*?\)", r"\1", markdown).replace("`", "").replace("*", "")
