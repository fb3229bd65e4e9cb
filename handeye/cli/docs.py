"""The command that lists and prints the pages of the documentation. Every installation includes these pages."""

from pathlib import Path
from textwrap import fill
from typing import Annotated

from cyclopts import Parameter

from handeye.cli.common import note, put, say, screen
from handeye.core.pages import INDEX, linked_pages, page_named, sections


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
    if topic is not None and not path:
        _say_where_links_lead(file, folder)
    return 0


def _say_where_links_lead(page: Path, folder: Path) -> None:
    """If the page links to another page, say how to open that page."""
    linked = next(linked_pages(page, folder), None)
    if linked is not None:
        note(f"to open a linked page: `handeye docs {linked}`; the links are relative to {page.parent}")


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
    say("Print a page: handeye docs TOPIC. Each instruction has a page, for example handeye docs SEARCH.")
