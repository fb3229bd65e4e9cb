"""What a comparison has found, as sections of its page; whatever happened at a step is a link to it."""

from collections.abc import Callable, Iterator
from typing import Final, Protocol, TypeVar

from handeye.comparison.comparison import Comparison
from handeye.comparison.course import Course
from handeye.comparison.place import Place
from handeye.comparison.wording import (
    correction_words,
    first_words,
    moment_words,
    place_words,
    search_words,
    stop_words,
    turning_words,
)
from handeye.core.markup import Markup
from handeye.core.units import INCH
from handeye.report.page.elements import (
    cell,
    element,
    figure_cell,
    figure_heads,
    heads,
    section,
    table,
    to_moment,
)
from handeye.trace.stats import StageFigures

_BOTH: Final = ("A", "B")


class _Placed(Protocol):
    """Something that was found at a step."""

    @property
    def place(self) -> Place: ...


Found = TypeVar("Found", bound=_Placed)


def sections(found: Comparison, way: Course) -> Iterator[Markup]:
    """All of them."""
    yield section("otherwise", "What went otherwise", *_otherwise(found, way))
    searches = [_row(way, each.a, each.b, search_words, alike=each.alike) for each in found.searches]
    stops = [_row(way, each.a, each.b, stop_words, alike=each.alike) for each in found.stops]
    corrections = [
        [*_row(way, each.a, each.b, correction_words, alike=each.alike), _apart(each.apart)]
        for each in found.corrections
    ]
    for name, heading, rows, more in (
        ("searches", "Searches", searches, []),
        ("felt", "Guarded motions", stops, []),
        ("corrections", "Corrections", corrections, figure_heads("apart, in")),
    ):
        if rows:
            yield section(name, heading, table([*heads("step", *_BOTH), *more], rows, label=heading))
    yield section("seconds", "Seconds by stage", _seconds(found))


def _otherwise(found: Comparison, way: Course) -> Iterator[Markup]:
    """In what the runs depended on something else, what was recorded otherwise first, and where the ways part."""
    rows = [[element("th", each.what, scope="row"), cell(each.a), cell(each.b)] for each in found.conditions]
    if rows:
        yield table(heads("depends on", *_BOTH), rows, label="what the runs depended on")
    if found.first is None:
        yield element("p", "Nothing was recorded otherwise.")
        return
    yield element("h3", "Recorded otherwise first")
    yield element("p", _link(way, found.first.a, found.first.b, moment_words(found.first)))
    yield from (element("p", line) for line in first_words(found.first))
    if found.parted is None:
        yield element("p", "Both went the same way: the same steps, stops, errors and answers.")
        return
    turnings = found.parted.a, found.parted.b
    here, there = (None if turning is None else turning.place for turning in turnings)
    yield element("h3", "Their ways part")
    yield element("p", _link(way, here, there, place_words(found.parted.place)))
    for letter, turning in zip(_BOTH, turnings, strict=True):
        yield element("p", element("b", letter), " ", turning_words(turning))


def _row(
    way: Course, a: Found | None, b: Found | None, words: Callable[[Found], str], *, alike: bool
) -> list[Markup]:
    """A step, and what was found at it in both runs; one that is not alike stands out."""
    here, there = (None if side is None else side.place for side in (a, b))
    link = _link(way, here, there, place_words(here or there))
    place = link if alike else element("b", link)
    return [
        element("th", place, scope="row"),
        *(cell("" if side is None else words(side)) for side in (a, b)),
    ]


def _link(way: Course, a: Place | None, b: Place | None, words: str) -> Markup:
    """A link to a step of the first run, or else of the second."""
    if a is not None:
        return to_moment(way.at(a, 0), words)
    return element("span", words) if b is None else to_moment(way.at(b, 1), words)


def _apart(apart: float | None) -> Markup:
    return figure_cell("" if apart is None else f"{apart / INCH:.2f}")


def _seconds(found: Comparison) -> Markup:
    rows = [
        [element("th", stage.name, scope="row"), *_figures(_took(stage.a), _took(stage.b))]
        for stage in found.stages
    ]
    rows.append([element("th", "all", scope="row"), *_figures(found.a.seconds, found.b.seconds)])
    return table([*heads("stage"), *figure_heads(*_BOTH, "B - A")], rows, label="seconds by stage")


def _took(figures: StageFigures | None) -> float | None:
    return None if figures is None else figures.seconds


def _figures(a: float | None, b: float | None) -> Iterator[Markup]:
    for seconds in (a, b):
        yield figure_cell("" if seconds is None else f"{seconds:.1f}")
    yield figure_cell("" if a is None or b is None else f"{b - a:+z.1f}")
