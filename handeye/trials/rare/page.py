"""Makes the HTML page of a search for rare failures, in the style of the report of a run."""

from collections.abc import Iterator, Sequence
from math import isfinite
from typing import Final

from handeye.core.files import page_kind
from handeye.core.markup import Markup, cell, element, figure_cell, figure_heads, heads, note, section, table
from handeye.report.page.document import head, resource
from handeye.report.page.plots import Scale, bar, drawing, rule
from handeye.trials.rare.campaign import Estimated
from handeye.trials.rare.nearest import NearWorld, Push
from handeye.trials.rare.text import (
    LEVEL_HEADS,
    PUSH_HEADS,
    PUSHES,
    level_cells,
    needs,
    no_worlds,
    sentence,
)

_MARK: Final = "<!DOCTYPE html>\n<!-- handeye rare failures -->\n"
PAGE: Final = page_kind("page of rare failures", _MARK)
_WIDE, _HIGH = 200.0, 16.0  # plot in a table row, drawing units
_TITLES: Final = {"stopped": "The program stops", "silent": "The program fails silently"}


def rare_page(title: str, heading: str, sections: Sequence[Markup]) -> bytes:
    """Return a page with the given sections. The page loads no external files."""
    body = element(
        "body",
        element("header", element("div", element("h1", heading), element("p", title, class_="name"))),
        element("main", *sections),
    )
    return (_MARK + element("html", head(title, resource("page.css"), ()), body, lang="en") + "\n").encode()


def estimates(found: Sequence[Estimated]) -> Iterator[Markup]:
    """Yield a section for each kind of failure: its levels and its estimate."""
    for each in found:
        yield section(each.failure, _TITLES[each.failure], element("p", sentence(each)), _levels(each))
    yield note(
        "A run usually has a margin of about 1; at a margin of 0, the program fails. Each level has a threshold "
        "for the margin. The worlds of a level are drawn so that no margin exceeds the threshold of the previous "
        "level. The share of a level is the fraction of these worlds whose margin is at most the level's own "
        "threshold. The product of all shares is the estimate of the probability. The estimate is not a bound."
    )


def worlds(failure: str, found: Sequence[NearWorld], pushing: Sequence[Push]) -> Iterator[Markup]:
    """Yield the sections for the failing worlds whose errors are smallest, and for the quantities that make the
    program fail.
    """
    title = f"{_TITLES[failure]}: nearest worlds"
    if not found:
        yield section(f"{failure}-worlds", title, element("p", no_worlds(failure)))
        return
    yield section(
        f"{failure}-worlds",
        title,
        _worlds(found),
        note(
            "Distances and deviations are in standard deviations. Quantities that are not named are all in the "
            "middle of their ranges."
        ),
    )
    heading = f"{_TITLES[failure]}: quantities that push it to fail"
    yield section(f"{failure}-pushes", heading, _pushes(pushing[:PUSHES]))


def _worlds(found: Sequence[NearWorld]) -> Markup:
    at = Scale(0.0, max(each.found_at for each in found) or 1.0, 4, _WIDE - 4)
    lines = []
    for each in found:
        plot = _plot(_from_zero(at, each.found_at, "planned"), _from_zero(at, each.distance, "here"))
        told = cell(needs(each)), cell(each.detail), cell(element("code", each.file))
        lines.append([figure_cell(f"{each.distance:.2f}"), plot, *told])
    words = heads("grey: where the search began", "needs", "why it fails", "file")
    return table([*figure_heads("distance"), *words], lines, label="Nearest failing worlds")


def _levels(found: Estimated) -> Markup:
    known = [level.threshold for level in found.levels if isfinite(level.threshold)]
    at = Scale(0.0, max(known, default=1.0) or 1.0, 4, _WIDE - 4)
    lines = [
        [*map(figure_cell, figures),
         _plot(_from_zero(at, level.threshold, "camera")) if isfinite(level.threshold) else cell(),
         cell(part)]
        for (part, *figures), level in zip(level_cells(found), found.levels, strict=True)
    ]  # fmt: skip
    return table(
        [*figure_heads(*LEVEL_HEADS), *heads("margin, from 0", "limited most often by")],
        lines,
        label="Levels",
    )


def _pushes(found: Sequence[Push]) -> Markup:
    means = [each.shift if each.mean is None else each.mean for each in found]
    wide = max(map(abs, means), default=1.0) or 1.0
    at = Scale(-wide, wide, 4, _WIDE - 4)
    lines = []
    for each, mean in zip(found, means, strict=True):
        there = "" if each.mean is None else f"{each.mean:+.2f}"
        figures = map(figure_cell, (str(each.worlds), there, f"{each.shift:+.2f}"))
        lines.append(
            [cell(each.quantity), *figures, _plot(_from_zero(at, mean, "here" if there else "planned"))]
        )
    words = heads("mean, in standard deviations")
    return table(
        [*heads("quantity"), *figure_heads(*PUSH_HEADS), *words], lines, label="Quantities that push"
    )


def _from_zero(at: Scale, value: float, kind: str) -> Markup:
    low, high = sorted((at(0.0), at(value)))
    return bar(low, _HIGH / 2 - 3, high - low, 6, class_=kind)


def _plot(*shapes: Markup) -> Markup:
    axis = rule(4, _HIGH / 2, _WIDE - 4, _HIGH / 2, class_="axis")
    return element("td", drawing(axis, *shapes, wide=_WIDE, high=_HIGH, label="bar"), class_="bars")
