"""Builds the section "Planned and found": how far each motion ended from its planned end, and why goals were
shifted."""

from collections.abc import Iterator, Sequence
from math import log10
from typing import Final

from handeye.core.markup import (
    Markup,
    cell,
    element,
    figure_cell,
    figure_heads,
    heads,
    joined,
    note,
    region,
    section,
    table,
    to_moment,
)
from handeye.core.plain_text import counted, one_line
from handeye.core.units import INCH, MILLIMETRE
from handeye.report.facts.planned import Correction, EndReason, MotionEnd, Search
from handeye.report.page.figures import clock, exact_clock, millimetres
from handeye.report.page.plots import Scale, dot, drawing, rule, words
from handeye.trace.stages import Stage

_WIDE: Final = 1160.0
_HIGH: Final = 250.0
_LEFT: Final = 56.0
_FOOT: Final = 26.0
_CLASSES: Final = {
    EndReason.PLANNED: "planned",
    EndReason.MOVED: "moved",
    EndReason.GUARD: "guarded",
    EndReason.CARRIED: "carried",
}
_MEANING: Final = {
    EndReason.PLANNED: "the motion ended as planned",
    EndReason.MOVED: "earlier measurements had moved the goal",
    EndReason.GUARD: "a guard stopped the motion",
    EndReason.CARRIED: "the motion began away from its planned start, and ended away from its planned end",
}
_DECADES: Final = (0.01, 0.1, 1.0, 10.0, 100.0, 1000.0)  # mm


def planned_section(
    ends: Sequence[MotionEnd],
    corrections: Sequence[Correction],
    searches: Sequence[Search],
    stages: Sequence[Stage],
) -> Markup:
    """Return the section on where motions ended, which goals were moved, and which places the searches tried."""
    return section(
        "planned",
        "Planned and found",
        *_ends(ends, stages),
        *_corrections(corrections),
        *searched(searches),
    )


def _ends(ends: Sequence[MotionEnd], stages: Sequence[Stage]) -> Iterator[Markup]:
    if not ends:
        yield note("No motion of this run was completed.")
        return
    yield note(
        f"The figure shows how far each of {counted(len(ends), 'motion')} ended from its planned end, in "
        "millimetres, as measured by the arm’s own sensors. The plan is made before any measurement; "
        "measurements in the working phase then move the goals of motions."
    )
    yield region(_chart(ends, stages), label="chart", class_="chart")
    counts = {why: sum(end.why is why for end in ends) for why in EndReason}
    yield element("ul", *(_key(why, counts[why]) for why in EndReason if counts[why]), class_="key")


def _key(why: EndReason, count: int) -> Markup:
    mark = element("svg", dot(6, 6, 4, class_=_CLASSES[why]), viewBox="0 0 12 12", aria_hidden="true")
    return element("li", mark, f" {_MEANING[why]}: {count}")


def _chart(ends: Sequence[MotionEnd], stages: Sequence[Stage]) -> Markup:
    sizes = [max(end.off / MILLIMETRE, _DECADES[0]) for end in ends]
    decades = [ten for ten in _DECADES if min(sizes) / 10 < ten < max(sizes) * 10]
    begin, end = ends[0].time, max(ends[-1].time, ends[0].time + 1)
    x = Scale(min(begin, *(stage.begin for stage in stages)) if stages else begin, end, _LEFT, _WIDE - 8)
    y = _Decades(min(decades), max(decades))
    strokes = [*_grid(decades, y), *_bands(stages, x), *(_dot(each, x, y) for each in ends)]
    label = f"distances between the planned and actual ends of {counted(len(ends), 'motion')}, against time"
    return drawing(*strokes, wide=_WIDE, high=_HIGH, label=label, role="group")


class _Decades:
    """A logarithmic scale of distances (mm)."""

    def __init__(self, least: float, most: float) -> None:
        self._scale = Scale(log10(least), log10(most), _HIGH - _FOOT, 12.0)

    def __call__(self, size: float) -> float:
        return self._scale(log10(size))


def _grid(decades: Sequence[float], y: _Decades) -> Iterator[Markup]:
    for ten in decades:
        yield rule(_LEFT, y(ten), _WIDE - 8, y(ten), class_="grid")
        yield words(_LEFT - 8, y(ten) + 4, f"{ten:g} mm", anchor="end")


def _bands(stages: Sequence[Stage], x: Scale) -> Iterator[Markup]:
    """Yield a numbered mark at the beginning of each stage."""
    for number, stage in enumerate(stages, 1):
        at = x(stage.begin)
        yield rule(at, 12, at, _HIGH - _FOOT + 6, class_="grid")
        yield words(at + 3, _HIGH - 8, str(number))


def _dot(end: MotionEnd, x: Scale, y: _Decades) -> Markup:
    size = max(end.off / MILLIMETRE, _DECADES[0])
    told = f"{end.step.place} {one_line(end.step.text)}: {millimetres(end.off)} mm, {end.why}"
    circle = dot(x(end.time), y(size), 3.4, class_=_CLASSES[end.why])
    return to_moment(end.time, element("title", told), circle, aria_label=told, tabindex="-1")


# -- what moved goals ------------------------------------------------------------------------------------


def _corrections(corrections: Sequence[Correction]) -> Iterator[Markup]:
    if not corrections:
        return
    yield element("h3", "Moved goals")
    figures = figure_heads("at", "x, mm", "y, mm", "z, mm")
    yield table(
        [*figure_heads("line"), *heads("motion"), *figures, *heads("moved by")],
        map(_correction, corrections),
        label="corrections",
    )


def _correction(correction: Correction) -> list[Markup]:
    shifts = [figure_cell(millimetres(component)) for component in correction.shift]
    causes = (
        joined([element("b", each.name), f" {each.by} ", to_moment(each.time, f"line {each.place}")])
        for each in correction.causes
    )
    return [
        figure_cell(correction.step.place),
        cell(element("code", one_line(correction.step.text))),
        figure_cell(to_moment(correction.time, clock(correction.time))),
        *shifts,
        element("td", joined(causes, ", ") if correction.causes else "the program", class_="wide"),
    ]


_SPIRAL: Final = 220.0


def searched(searches: Sequence[Search]) -> Iterator[Markup]:
    """Yield drawings of the searches of a run. Each drawing shows the path through the places that the search tried."""
    yield element("h3", "Searches")
    if not searches:
        yield note("No search had to try a second place.")
        return
    yield note(
        "Places that each search tried, seen from above. A ring marks the first place, and a dot marks the last."
    )
    yield element("div", *map(_search, searches), class_="figures")


def _search(search: Search) -> Markup:
    tried = counted(len(search.places), "place")
    came = "no places were left" if search.exhausted else "the search ended at the last of these places"
    told = f"{tried} tried{f' since {exact_clock(search.times[0])}' if search.times else ''}; {came}"
    caption = joined([element("b", search.step.place), element("span", told)], " ")
    if search.times:
        caption = to_moment(search.times[-1], caption, class_="moment")
    return element("figure", _spiral(search, told), element("figcaption", caption))


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
