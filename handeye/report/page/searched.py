"""Searches, seen from above."""

from collections.abc import Iterator, Sequence
from typing import Final

from handeye.core.markup import Markup, element, note, to_moment
from handeye.core.plain_text import counted
from handeye.core.units import INCH
from handeye.report.facts.searches import Search
from handeye.report.page.figures import exact_clock, millimetres
from handeye.report.page.plots import Scale, dot, drawing, words

_SPIRAL: Final = 220.0
"""Side of a drawing, in its own units."""


def searched(searches: Sequence[Search]) -> Iterator[Markup]:
    """The searches of a run, each as the way through its places."""
    yield element("h3", "Searches")
    if not searches:
        yield note("No search went on from its first place.")
        return
    yield note("The places that were tried, seen from above: the ring is the first, the dot the last.")
    yield element("div", *map(_search, searches), class_="figures")


def _search(search: Search) -> Markup:
    tried = counted(len(search.places), "place")
    came = "there were no more" if search.exhausted else "the program went on from the last"
    told = f"{tried} tried, from {exact_clock(search.times[0]) if search.times else 'the first'}: {came}"
    caption = element("figcaption", element("b", search.step.place), " ", element("span", told))
    figure = element("figure", _spiral(search, told), caption)
    if not search.times:
        return figure
    return to_moment(
        search.times[-1], figure, class_="moment", aria_label=f"line {search.step.place}: {told}"
    )


def _spiral(search: Search, told: str) -> Markup:
    reach = max(max(abs(x), abs(y)) for x, y in search.places) or INCH
    scale = Scale(-reach, reach, 14.0, _SPIRAL - 14.0)
    points = [(scale(x), _SPIRAL - scale(y)) for x, y in search.places]
    way = "M" + "L".join(f"{x:.1f},{y:.1f}" for x, y in points)
    (first, *_, last) = points if len(points) > 1 else (points[0], points[0])
    tried = [dot(x, y, 1.6, class_="axis") for x, y in points[1:-1]]
    return drawing(
        element("path", d=way, class_="curve"),
        *tried,
        dot(*first, 4.2, class_="ring"),
        dot(*last, 3.6, class_="trip" if search.exhausted else "found"),
        words(6, _SPIRAL - 6, f"± {millimetres(reach)} mm"),
        wide=_SPIRAL,
        high=_SPIRAL,
        label=told,
    )
