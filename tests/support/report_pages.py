"""Reports of made-up runs, and their pages as trees."""

from collections.abc import Callable, Iterator
from dataclasses import dataclass, field, replace
from html.parser import HTMLParser
from pathlib import Path

import msgspec
from recordings import record

from handeye.core.markup import SHAPES, VOID
from handeye.program.events import AnyEvent
from handeye.report.page.document import report_page
from handeye.report.photographs import Album, Photograph
from handeye.report.recorded import RecordedRun
from handeye.trace.reading import read_trace


def recorded(path: Path) -> RecordedRun:
    """A made-up run, recorded at a path."""
    record(path)
    return RecordedRun(trace=read_trace(path))


def changed(run: RecordedRun, change: Callable[[AnyEvent], AnyEvent | None]) -> RecordedRun:
    """Return the run with its events changed; an event for which `change` returns None is left out."""
    events = tuple(each for event in run.trace.events if (each := change(event)) is not None)
    head = events[0]
    return replace(run, trace=replace(run.trace, head=head, events=events))


def renamed(run: RecordedRun, **words: str) -> RecordedRun:
    """Return the run with other texts in the fields `stage`, `text`, `program` and `message` of all its events."""

    def change(event: AnyEvent) -> AnyEvent:
        own = {name: word for name, word in words.items() if hasattr(event, name)}
        return msgspec.structs.replace(event, **own)

    return changed(run, change)


def no_photographs(run: RecordedRun, why: str = "No photograph: none was wanted.") -> Album:
    """An album without photographs."""
    none = Photograph(time=0.0, shows="nothing", width=4, height=3, webp=None, missing=why)
    return Album(leading=none, stages=(none,) * len(run.trace.stages))


def page_of(run: RecordedRun) -> str:
    """The report of a run, without photographs and animation."""
    return report_page(run, no_photographs(run), None).decode()


@dataclass
class Node:
    """An element of a page."""

    name: str
    attributes: dict[str, str | None] = field(default_factory=dict)
    children: "list[Node | str]" = field(default_factory=list)

    def __iter__(self) -> "Iterator[Node]":
        """Yield the element, and all elements in it."""
        yield self
        for child in self.children:
            if isinstance(child, Node):
                yield from child

    def all(self, name: str) -> "list[Node]":
        """All elements with this name."""
        return [node for node in self if node.name == name]

    def one(self, identity: str) -> "Node":
        """The only element with this id."""
        (found,) = (node for node in self if node.attributes.get("id") == identity)
        return found

    @property
    def text(self) -> str:
        """All words in it."""
        return "".join(child if isinstance(child, str) else child.text for child in self.children)


class _Parser(HTMLParser):
    def __init__(self) -> None:
        super().__init__()
        self.open = [Node("page")]

    def handle_starttag(self, tag: str, attrs: list[tuple[str, str | None]]) -> None:
        node = Node(tag, dict(attrs))
        self.open[-1].children.append(node)
        if tag not in VOID:
            self.open.append(node)

    def handle_startendtag(self, tag: str, attrs: list[tuple[str, str | None]]) -> None:
        assert tag in SHAPES
        self.open[-1].children.append(Node(tag, dict(attrs)))

    def handle_endtag(self, tag: str) -> None:
        assert self.open.pop().name == tag

    def handle_data(self, data: str) -> None:
        self.open[-1].children.append(data)


def tree(page: str) -> Node:
    """Return a page as a tree. Fails unless every element is closed where it should be."""
    parser = _Parser()
    parser.feed(page)
    parser.close()
    assert len(parser.open) == 1
    return parser.open[0]


def barriers(page: Node) -> Iterator[str]:
    """Return what would keep users who cannot see, or cannot use a mouse, from using a page, as far as its markup
    shows it.
    """
    headings = {node.attributes.get("id"): node.text for node in page}
    regions = []
    for node in page:
        told = node.attributes
        if node.name in ("nav", "section"):
            regions.append(told.get("aria-label") or headings.get(told.get("aria-labelledby")) or "")
        if told.get("role") in ("region", "navigation", "button", "link"):
            yield f"there is an element for the role {told['role']}"
        if node.name == "th" and not node.text:
            yield "a heading of a table is empty"
        if told.get("role") == "img" and any("href" in each.attributes for each in node):
            yield f"what is in the picture {told.get('aria-label')} cannot be reached"
    names = [name.casefold() for name in regions]
    yield from (f"there are two regions called {name!r}" for name in {n for n in names if names.count(n) > 1})
