"""The insertion bench for people: a table for the terminal, a page with drawings, and a table of all trials."""

import math
from collections.abc import Callable, Iterator, Sequence
from typing import Final

from rich.console import Group, RenderableType
from rich.table import Table
from rich.text import Text

from handeye.core.files import Kind
from handeye.core.markup import Markup
from handeye.report.page.document import head, resource
from handeye.report.page.elements import element, figure_cell, figure_heads, note, table
from handeye.report.page.plots import Scale, dot, drawing, rule, words
from handeye.trials.insertion import Condition, InsertionTrial
from handeye.trials.insertion_figures import GENTLE, Bench, Figures, Spread

_MARK: Final = "<!doctype html>\n<!-- handeye insertion bench -->\n"
PAGE: Final = Kind("page of the insertion bench", _MARK.encode(), ending=".html")
_COLUMNS: Final = (
    "search", "clearance_mm", "chamfer_mm", "sd_mm", "seed", "number", "error_x_mm", "error_y_mm", "outcome", "places",
    "peak_n", "felt_n", "seconds", "whole_s",
)  # fmt: skip
ROWS: Final = Kind("table of insertions", ",".join(_COLUMNS).encode(), ending=".csv")
_TITLES: Final = (
    "clearance, mm", "chamfer, mm", "error sd, mm", "step, in", "seated", "Wilson 95 %", "told", "silent", "peak, N",
    "≤ 20 N", "felt, N", "contact to seated, s",
)  # fmt: skip
_HOLE: Final = "Clearance in diameter, chamfer, sigma of the hole's place along each axis: mm."
_MEANING: Final = (
    "Peak: force between pin and plate, true at each physics step; felt: by the hand. "
    "Spreads: median / 95 % / most. Times are simulated, of the trials that were seated."
)


# -- the terminal ----------------------------------------------------------------------------------------


def page(bench: Bench) -> RenderableType:
    """Two tables with a line for each condition: how often it is seated; how hard, and how long. 80 columns suffice."""
    figures = list(bench.figures())
    often = _table(("step, in", "seated", "Wilson 95 %", "told", "silent"))
    hard = _table(("peak, N", "≤ 20 N", "felt, N", "contact to seated, s"))
    for each in figures:
        clearance, chamfer, sd, step, seated, interval, told, silent, peak, gentle, _, seconds = _cells(each)
        felt = "-" if each.felt_n is None else f"{each.felt_n.most:.1f}"
        often.add_row(clearance, chamfer, sd, step, seated, interval, told, silent)
        hard.add_row(clearance, chamfer, sd, peak, gentle, felt, seconds)
    return Group(often, Text(), hard, Text(), Text(f"{_HOLE} {_MEANING} Felt: the most.", style="dim"))


def _table(titles: tuple[str, ...]) -> Table:
    table = Table(box=None, pad_edge=False, collapse_padding=True, header_style="bold")
    for title in ("clearance", "chamfer", "sd", *titles):
        table.add_column(title, justify="right", no_wrap=True)
    return table


def _cells(figures: Figures) -> tuple[str, ...]:
    condition, (low, high) = figures.condition, figures.interval
    return (
        f"{condition.clearance:g}", f"{condition.chamfer:g}", f"{condition.sd:g}", f"{figures.step_in:g}",
        f"{figures.seated} of {figures.n}", f"{low:.1%} to {high:.1%}", f"{figures.told}", f"{figures.silent}",
        _spread(figures.peak_n, 1), f"{figures.gentle}", _spread(figures.felt_n, 1), _spread(figures.seconds, 2),
    )  # fmt: skip


def _spread(spread: Spread | None, places: int) -> str:
    if spread is None:
        return "-"
    return " / ".join(f"{value:.{places}f}" for value in (spread.median, spread.p95, spread.most))


# -- a page ----------------------------------------------------------------------------------------------

_WIDE, _LEFT, _ROW = 960.0, 190.0, 26.0
_PANELS: Final = ((200.0, 400.0), (450.0, 680.0), (730.0, 940.0))
"""Where the drawing's panels begin and end: success, peak force, time."""


def html(bench: Bench, title: str) -> bytes:
    """A page with the table and a drawing."""
    figures = list(bench.figures())
    rows = [[figure_cell(cell) for cell in _cells(each)] for each in figures]
    body = element(
        "body",
        element("h1", "Insertion bench"),
        element("p", title, class_="note"),
        element("figure", _drawn(bench, figures), class_="chart"),
        table(figure_heads(*_TITLES), rows, label="Figures of each condition"),
        note(_MEANING),
    )
    return (
        _MARK + element("html", head("Insertion bench", resource("page.css"), []), body, lang="en") + "\n"
    ).encode()


def _drawn(bench: Bench, figures: Sequence[Figures]) -> Markup:
    """One row a condition: the share that was seated with its interval, and each trial's peak force and time."""
    high = 40 + _ROW * len(figures) + 24
    peaks = Scale(0.0, _round(max(GENTLE, *(trial.peak for trial in bench.trials))), *_PANELS[1])
    times = Scale(0.0, _round(max(1.0, *(trial.seconds or 0.0 for trial in bench.trials))), *_PANELS[2])
    shares = Scale(0.0, 1.0, *_PANELS[0])
    return drawing(
        *_axis(shares, "seated, with Wilson 95 %", high, _percent),
        *_axis(peaks, "peak force, N", high, _number),
        *_axis(times, "first contact to seated, s", high, _number),
        rule(peaks(GENTLE), 24, peaks(GENTLE), high - 24, class_="limit"),
        *(
            shape
            for row, each in enumerate(figures)
            for shape in _row(bench, each, row, shares, peaks, times)
        ),
        wide=_WIDE,
        high=high,
        label="Share seated, peak force and time of each condition",
    )


def _axis(scale: Scale, title: str, high: float, told: Callable[[float], str]) -> Iterator[Markup]:
    bottom = high - 24
    yield words(scale.begin, 14, title)
    yield rule(scale.begin, bottom, scale.end, bottom, class_="axis")
    for value in (scale.low, (scale.low + scale.high) / 2, scale.high):
        yield words(scale(value), bottom + 14, told(value), anchor="middle")


def _round(most: float) -> float:
    """The end of a scale: the next of 1, 2, 4 and 6 times a power of ten above the most that is drawn."""
    power = 10.0 ** math.floor(math.log10(most))
    return next(times * power for times in (1, 2, 4, 6, 10, 20) if times * power > most)


def _percent(value: float) -> str:
    return f"{value:.0%}"


def _number(value: float) -> str:
    return f"{value:.3g}"


def _row(
    bench: Bench, figures: Figures, row: int, shares: Scale, peaks: Scale, times: Scale
) -> Iterator[Markup]:
    y = 40 + _ROW * row
    tried = bench.of_condition(bench.conditions.index(figures.condition))
    low, high = figures.interval
    yield words(0, y + 4, _named(figures.condition))
    yield rule(shares(low), y, shares(high), y, class_="curve")
    yield dot(shares(figures.seated / figures.n), y, 3.5, class_="trip" if figures.silent else "found")
    for number, trial in enumerate(tried):
        aside = ((number * 7) % 11 - 5) * 0.9
        yield dot(peaks(trial.peak), y + aside, 1.3, class_="moved")
        if trial.outcome == "seated" and trial.seconds is not None:
            yield dot(times(trial.seconds), y + aside, 1.3, class_="moved")
    for spread, scale in ((figures.peak_n, peaks), (figures.seconds, times)):
        if spread is not None:
            yield rule(scale(spread.median), y - 8, scale(spread.median), y + 8, class_="curve")


def _named(condition: Condition) -> str:
    return f"{condition.clearance:g} mm, chamfer {condition.chamfer:g}, sd {condition.sd:g}"


# -- a file of all trials ----------------------------------------------------------------------------------


def rows(bench: Bench) -> bytes:
    """All trials as a table of values separated by commas."""
    lines = [",".join(_COLUMNS)]
    lines += [",".join(map(str, _values(bench.conditions[each.condition], each))) for each in bench.trials]
    return ("\n".join(lines) + "\n").encode()


def _values(condition: Condition, trial: InsertionTrial) -> tuple[object, ...]:
    return (
        condition.search, condition.clearance, condition.chamfer, condition.sd, trial.seed, trial.number, *trial.error,
        trial.outcome, trial.places, trial.peak, trial.felt, "" if trial.seconds is None else trial.seconds,
        trial.whole,
    )  # fmt: skip
