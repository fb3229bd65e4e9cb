"""Shows the statistics of a sweep as an HTML page, in the style of the report of a run."""

from collections.abc import Iterator, Sequence
from typing import Final

from handeye.core.files import page_kind
from handeye.core.markup import Markup, cell, element, figure_cell, figure_heads, heads, note, section, table
from handeye.core.plain_text import counted
from handeye.report.page.document import head, resource
from handeye.report.page.plots import Scale, bar, dot, drawing, rule
from handeye.trials.figures import ConditionFigures, Figures
from handeye.trials.sweep import Details, R, Sweep, percent
from handeye.trials.text import sure

_MARK: Final = "<!DOCTYPE html>\n<!-- handeye batch -->\n"
PAGE: Final = page_kind("page of trials", _MARK)
_WIDE, _HIGH = 240.0, 16.0  # plot in a table row, drawing units


def sweep_page(title: str, sweep: Sweep[R], rows: Sequence[R], found: Figures) -> bytes:
    """Return the page of a sweep. The page loads no external files."""
    body = element(
        "body",
        element(
            "header",
            element("div", element("h1", _heading(sweep, found)), element("p", title, class_="name")),
        ),
        element("main", *_sections(sweep, rows, found)),
    )
    return (_MARK + element("html", head(title, resource("page.css"), ()), body, lang="en") + "\n").encode()


def _heading(sweep: Sweep[R], found: Figures) -> str:
    return f"{found.right} of {found.n} {sweep.success}, {counted(found.silent_failures, 'silent failure')}"


def _sections(sweep: Sweep[R], rows: Sequence[R], found: Figures) -> Iterator[Markup]:
    yield section("rate", "Success rate", *_rates(found))
    for each in sweep.details(rows):
        if each.rows:
            yield section(each.name, each.title, _details(each))
    if found.measures:
        yield section("measures", "Measurements", _measures(rows, found))
    if found.failures:
        yield section("failures", "Failures", _failures(found))


def _rates(found: Figures) -> Iterator[Markup]:
    every: list[tuple[str, ConditionFigures | Figures]] = [("all", found)]
    every += [(each.condition, each) for each in found.conditions]
    yield table(
        [*heads("", "Wilson’s interval, 0 to 100 %"), *figure_heads("right", "interval", "at least")],
        [
            [cell(name), _bars(_interval(each)), figure_cell(f"{each.right} of {each.n}"),
             *map(figure_cell, sure(each.wilson95, each.p_s))]
            for name, each in every
        ],
        label="Success rate with confidence intervals",
    )  # fmt: skip
    yield note(
        "Wilson’s intervals, 95 %; “at least” is the exact lower bound, one-sided, 95 %. A silent failure is a "
        "failed trial that the program reported as a success."
    )


def _interval(each: ConditionFigures | Figures) -> Markup:
    low, high = each.wilson95 or (0.0, 1.0)
    return _span(
        Scale(0, 1, 4, _WIDE - 4), low, each.right / each.n if each.n else 0, high, percent(low, high)
    )


def _details(details: Details) -> Markup:
    """Return a table that the kind of sweep defines. If the kind also defines bars, each row ends with a bar."""
    numbers = [details.number(column) for column in range(len(details.heads))]
    headings = [
        (figure_heads if each else heads)(name)[0] for name, each in zip(details.heads, numbers, strict=True)
    ]
    bars = _spans(details)
    lines = [
        [(figure_cell if number else cell)(text) for text, number in zip(cells, numbers, strict=True)]
        for cells in details.cells()
    ]
    if bars:
        headings.append(heads("")[0])
        lines = [[*line, _bars(plot)] for line, plot in zip(lines, bars, strict=True)]
    return table(headings, lines, label=details.title)


def _spans(details: Details) -> list[Markup]:
    if details.span is None:
        return []
    names = details.span
    values = [
        (getattr(row, names[0]), getattr(row, names[1]), getattr(row, names[2])) for row in details.rows
    ]
    known = [value for each in values for value in each if value is not None]
    low, high = min([0.0, *known]), max([0.0, *known]) or 1.0
    at = Scale(low, high, 4, _WIDE - 4)
    return [
        drawing(wide=_WIDE, high=_HIGH, label="no trials")
        if None in (first, middle, last)
        else _span(at, first, middle, last, f"{first:.3g} to {last:.3g}")
        for first, middle, last in values
    ]


def _measures(rows: Sequence[R], found: Figures) -> Markup:
    """Return a strip chart for each measured value and condition, with one dot per trial."""
    lines = []
    for name in found.measures:
        values = [row.measures[name] for row in rows if name in row.measures]
        at = Scale(min(0.0, *values), max(0.0, *values) or 1.0, 4, _WIDE - 4)
        for each in found.conditions or (found,):
            condition = each.condition if isinstance(each, ConditionFigures) else ""
            mine = [
                row.measures[name]
                for row in rows
                if name in row.measures and condition in ("", row.condition)
            ]
            if name in each.measures:
                spread = each.measures[name]
                dots = (dot(at(value), _HIGH / 2, 2, class_="moved") for value in mine)
                strip = drawing(
                    rule(at(0), 1, at(0), _HIGH - 1, class_="limit"),
                    *dots,
                    wide=_WIDE,
                    high=_HIGH,
                    label=name,
                )
                figures = (f"{value:.3g}" for value in (spread.median, spread.p95, spread.most))
                lines.append([cell(name), cell(condition), _bars(strip), *map(figure_cell, figures)])
    return table(
        [*heads("", "", "each trial; red line: zero"), *figure_heads("median", "95 %", "maximum")],
        lines,
        label="Measures",
    )


def _failures(found: Figures) -> Markup:
    return table(
        [*figure_heads("seed"), *heads("", "how", "stage", "cause", "command that repeats it")],
        [
            [figure_cell(str(f.seed)), cell(f.condition), cell(f.verdict), cell(f.stage), cell(f.detail),
             cell(element("code", f.command))]
            for f in found.failures
        ],
        label="Failures",
    )  # fmt: skip


def _bars(plot: Markup) -> Markup:
    return element("td", plot, class_="bars")


def _span(at: Scale, low: float, middle: float, high: float, label: str) -> Markup:
    return drawing(
        rule(at(at.low), _HIGH / 2, at(at.high), _HIGH / 2, class_="axis"),
        bar(at(low), _HIGH / 2 - 3, at(high) - at(low), 6, class_="camera"),
        dot(at(middle), _HIGH / 2, 3, class_="moved"),
        wide=_WIDE, high=_HIGH, label=label,
    )  # fmt: skip
