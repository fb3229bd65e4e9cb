"""The figures of a batch as a page, in the style of the report of a run."""

from collections.abc import Callable, Iterator, Sequence
from typing import Final

from handeye.core.files import Kind
from handeye.core.markup import Markup
from handeye.report.page.document import head, resource
from handeye.report.page.elements import (
    cell,
    element,
    figure_cell,
    figure_heads,
    heads,
    note,
    section,
    table,
)
from handeye.report.page.plots import Scale, bar, dot, drawing, rule
from handeye.trials.batch.distributions import margin_of
from handeye.trials.batch.figures import Figures
from handeye.trials.batch.row import Row

_MARK: Final = "<!doctype html>\n<!-- handeye batch -->\n"
PAGE: Final = Kind("page of trials", _MARK.encode(), ending=".html")
_WIDE, _HIGH = 240.0, 16.0
"""Of a plot in a line of a table, in its own units."""


def batch_page(name: str, rows: Sequence[Row], found: Figures) -> bytes:
    """The page of a batch; it fetches nothing.

    Args:
        name: title of the page.
    """
    style = resource("page.css")
    body = element(
        "body",
        element("header", element("div", element("h1", _title(found)), element("p", name, class_="name"))),
        element("main", *_sections(rows, found)),
    )
    return (_MARK + element("html", head(name, style, ()), body, lang="en") + "\n").encode()


def percent(part: float | None) -> str:
    """A part of one as a percentage."""
    return "" if part is None else f"{100 * part:.1f} %"


def _title(found: Figures) -> str:
    return f"{found.assembled} of {found.n} assembled, {found.silent_failures} silent failures"


def _sections(rows: Sequence[Row], found: Figures) -> Iterator[Markup]:
    yield section("rate", "How often, and how sure", *_rates(found))
    if found.margins:
        yield section("margins", "Margins to the referee's limits", *_margins(rows, found))
    if found.stages:
        yield section("stages", "Arm time by stage", *_stages(found))
    if found.searches:
        yield section("searches", "Searches", *_searches(found))
    if found.failures:
        yield section("failures", "Failures", *_failures(found))


def _rates(found: Figures) -> Iterator[Markup]:
    low, high = found.wilson95 or (0.0, 1.0)
    every = [("whole run", found.assembled, found.n, (low, high), found.p_s)]
    every += [
        (name, rate.successes, rate.trials, rate.wilson95 or (0.0, 1.0), rate.p_s)
        for name, rate in found.operations.items()
    ]
    yield table(
        [*heads("", "Wilson’s interval, 0 to 100 %"), *figure_heads("successes", "from", "to", "at least")],
        [
            [cell(name), _bars(_interval(done, count, both)), figure_cell(f"{done} of {count}"),
             figure_cell(percent(both[0])), figure_cell(percent(both[1])), figure_cell(percent(p_s))]
            for name, done, count, both, p_s in every
        ],
        label="Success with its intervals",
    )  # fmt: skip
    yield note(
        "Intervals hold the probability of success with 95 %; “at least” is the exact one-sided bound. A contact "
        "operation succeeds when the program goes on behind it: a silent failure is in the whole run alone."
    )


def _bars(plot: Markup) -> Markup:
    return element("td", plot, class_="bars")


def _interval(done: int, count: int, both: tuple[float, float]) -> Markup:
    at = Scale(0, 1, 4, _WIDE - 4)
    middle = _HIGH / 2
    return drawing(
        rule(at(0), middle, at(1), middle, class_="axis"),
        bar(at(both[0]), middle - 3, at(both[1]) - at(both[0]), 6, class_="camera"),
        dot(at(done / count if count else 0), middle, 3, class_="moved"),
        wide=_WIDE, high=_HIGH, label=f"{percent(both[0])} to {percent(both[1])}",
    )  # fmt: skip


def _margins(rows: Sequence[Row], found: Figures) -> Iterator[Markup]:
    yield table(
        [*heads("finding", "each trial; red: the limit"),
         *figure_heads("median", "5 %", "worst", "seed", "deviations")],
        [
            [cell(m.finding), _bars(_strip(rows, m.finding)), figure_cell(f"{m.median:.3g} {m.unit}"),
             figure_cell(f"{m.p5:.3g}"), figure_cell(f"{m.worst:.3g}"), figure_cell(str(m.worst_seed)),
             figure_cell("" if m.deviations is None else f"{m.deviations:.3g}")]
            for m in found.margins
        ],
        label="Margins to the referee’s limits",
    )  # fmt: skip
    yield note(
        "How far each finding stays within its limit. “Deviations” is the mean margin in standard deviations: the "
        "finding with the fewest, the first here, is the next to fail."
    )


def _strip(rows: Sequence[Row], finding: str) -> Markup:
    values = [
        margin_of(row.result.referee[finding]) for row in rows if row.result and finding in row.result.referee
    ]
    at = Scale(min(0.0, *values), max(0.0, *values) or 1.0, 4, _WIDE - 4)
    return drawing(
        rule(at(0), 1, at(0), _HIGH - 1, class_="limit"),
        *(dot(at(value), _HIGH / 2, 2, class_="moved") for value in values),
        wide=_WIDE, high=_HIGH, label=f"margins of {finding}",
    )  # fmt: skip


def _stages(found: Figures) -> Iterator[Markup]:
    at = Scale(0, max(stage.p95_s for stage in found.stages), 4, _WIDE - 4)
    yield table(
        [*heads("stage", "5 to 95 %"), *figure_heads("5 %", "median", "95 %", "trials")],
        [
            [cell(s.stage), _bars(_span(at, s.p5_s, s.median_s, s.p95_s)), figure_cell(f"{s.p5_s:.1f} s"),
             figure_cell(f"{s.median_s:.1f} s"), figure_cell(f"{s.p95_s:.1f} s"), figure_cell(str(s.n))]
            for s in found.stages
        ],
        label="Arm time by stage",
    )  # fmt: skip


def _span(at: Callable[[float], float], low: float, middle: float, high: float) -> Markup:
    return drawing(
        bar(at(low), _HIGH / 2 - 3, at(high) - at(low), 6, class_="camera"),
        dot(at(middle), _HIGH / 2, 3, class_="moved"),
        wide=_WIDE, high=_HIGH, label=f"{low:.1f} to {high:.1f} s",
    )  # fmt: skip


def _searches(found: Figures) -> Iterator[Markup]:
    yield table(
        [*heads("around"), *figure_heads("searches", "found", "places: median", "95 %", "most")],
        [
            [cell(s.at), figure_cell(str(s.n)), figure_cell(str(s.found)), figure_cell(f"{s.median:g}"),
             figure_cell(f"{s.p95:.1f}"), figure_cell(str(s.most))]
            for s in found.searches
        ],
        label="Searches",
    )  # fmt: skip


def _failures(found: Figures) -> Iterator[Markup]:
    yield table(
        [*figure_heads("seed"), *heads("how", "stage", "what", "again")],
        [
            [figure_cell(str(f.seed)), cell(f.verdict), cell(f.stage), cell(f.detail), cell(element("code", f.command))]
            for f in found.failures
        ],
        label="Failures",
    )  # fmt: skip
