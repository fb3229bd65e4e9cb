"""Shows the statistics of a sweep on a terminal."""

from collections.abc import Iterator, Sequence
from typing import Final

from rich.console import Console, ConsoleOptions, Group, RenderableType, RenderResult
from rich.table import Table
from rich.text import Text

from handeye.core.diagnostics import visible
from handeye.core.plain_text import counted, printable
from handeye.trials.comparing import PairedBatch
from handeye.trials.figures import ConditionFigures, Figures
from handeye.trials.sweep import R, Sweep, percent

NARROWEST: Final = 80
"""Least width of the tables, in columns. A narrower terminal wraps the lines, so no text is lost."""


class PlainTable(Table):
    """A table of words and figures. The contents of the table may come from an untrusted file, so control characters
    are made visible.
    """

    def __init__(self, words: tuple[str, ...], *figures: str) -> None:
        super().__init__(box=None, pad_edge=False, collapse_padding=True, header_style="bold")
        for title in words:
            self.add_column(printable(title), overflow="fold")
        for title in figures:
            self.add_column(title, justify="right", no_wrap=True)

    def __rich_console__(self, console: Console, options: ConsoleOptions) -> RenderResult:
        yield from super().__rich_console__(console, options.update_width(max(options.max_width, NARROWEST)))

    def row(self, *cells: str) -> None:
        """Add a row."""
        self.add_row(*map(printable, cells))


def page(sweep: Sweep[R], rows: Sequence[R], found: Figures) -> RenderableType:
    """Return the summary that is printed at the end of a sweep."""
    tables = [table for table in _tables(sweep, rows, found) if table.rows]
    spaced = [part for table in tables for part in (table, Text())]
    lines = [] if sweep.sentence else [*failures(found)]
    return Group(
        *spaced,
        *(Text(visible(line)) for line in [*lines, *sweep.summary(rows)]),
        Text(verdict(sweep, found)),
    )


def _tables(sweep: Sweep[R], rows: Sequence[R], found: Figures) -> Iterator[PlainTable]:
    for details in sweep.details(rows):
        figures = [
            head for column, head in enumerate(details.heads) if details.rows and details.number(column)
        ]
        table = PlainTable(details.heads[: len(details.heads) - len(figures)], *figures)
        for cells in details.cells():
            table.row(*cells)
        yield table
    several = [each for each in found.conditions if each.n > 1]
    if several:
        yield _rates(sweep, found.conditions)
    yield _measures(several or [found])


def _rates(sweep: Sweep[R], conditions: Sequence[ConditionFigures]) -> PlainTable:
    others = [name for name, standing in sweep.outcomes.items() if standing != "right"]
    table = PlainTable(("condition",), sweep.success, "Wilson, 95 %", "at least", *others)
    for each in conditions:
        counts = (str(each.outcomes.get(name, 0)) for name in others)
        table.row(each.condition, f"{each.right} of {each.n}", *sure(each.wilson95, each.p_s), *counts)
    return table


def _measures(figures: "Sequence[ConditionFigures | Figures]") -> PlainTable:
    """Return the table of the distributions of measured values, by condition or over all trials."""
    table = PlainTable(("measure",), "trials", "median", "95 %", "maximum")
    for each in figures:
        name = f"{each.condition}: " if isinstance(each, ConditionFigures) else ""
        for measure, found in each.measures.items():
            table.row(
                f"{name}{measure}",
                str(found.n),
                *(f"{value:.3g}" for value in (found.median, found.p95, found.most)),
            )
    return table


def sure(wilson95: tuple[float, float] | None, p_s: float | None) -> tuple[str, str]:
    """Return the confidence interval and the lower confidence bound of a rate as text. Both texts are empty if there
    were no trials.
    """
    return ("", "") if wilson95 is None or p_s is None else (percent(*wilson95), percent(p_s))


def failures(found: Figures) -> Iterator[str]:
    """Describe each failure in a line, followed by the command that repeats the trial. Then yield a line for each
    cause, with the number of its failures.
    """
    for failure in found.failures:
        place = _place(failure.stage, failure.line)
        condition = f", {failure.condition}" if failure.condition else ""
        told = ", ".join(filter(None, (failure.verdict, f"{place}{failure.detail}")))
        yield f"trial {failure.trial}, seed {failure.seed}{condition}: {told}"
        if failure.command:
            yield f"  {failure.command}"
    for cause in found.causes:
        if told := f"{_place(cause.stage)}{cause.cause}":
            yield f"{cause.count} of {found.n}: {told}"


def verdict(sweep: Sweep[R], found: Figures) -> str:
    """Say in a sentence how many trials were right, with confidence limits."""
    wrong = [name for name, standing in sweep.outcomes.items() if standing == "wrong"]
    counts = [
        counted(found.silent_failures, "silent failure"),
        *(f"{found.outcomes.get(name, 0)} {name}" for name in wrong),
        f"{found.failed} unfinished",
    ]
    text = f"{found.right} of {found.n} {sweep.success}, {', '.join(counts)}"
    if found.uncounted:
        names = [name for name, standing in sweep.outcomes.items() if standing == "uncounted"]
        text += f"\n{' or '.join(names)}, not counted: {found.uncounted}"
    interval, least = sure(found.wilson95, found.p_s)
    return (
        f"{text}\n{sweep.success}: {interval} (Wilson, 95 %), at least {least} (exact, 95 %)"
        if interval
        else text
    )


def _place(stage: str, line: str | None = None) -> str:
    """Return the place of a failure as a prefix to its cause; empty if the place is unknown."""
    named = f"“{stage}”" if stage not in ("", "referee") else stage
    return f"{named}{f', line {line}' if line else ''}: " if named else ""


def comparison(first: str, found: Sequence[PairedBatch]) -> RenderableType:
    """Compare each batch with the first one. The table shows the success rates. For trials that succeeded in both
    batches, the table also shows the differences of the measured values.
    """
    rates = PlainTable(
        (f"compared with {first}",),
        "right",
        "first",
        "only\nfirst",
        "only\nthis",
        "p",
        "noticed",
        "silent",
        "un-\nfinished",
    )
    measures = PlainTable(("trials that succeeded in both", "measure"), "pairs", "more", "p")
    for each in found:
        counts = each.first_right, each.only_first, each.only_this
        rates.row(each.name, f"{each.right} of {each.pairs}", *map(str, counts), f"{each.p:.2g}",
                  *map(str, (each.noticed, each.silent, each.failed)))  # fmt: skip
        for name, difference in each.measures.items():
            measures.row(
                each.name, name, str(difference.pairs), f"{difference.more:+.3g}", f"{difference.p:.2g}"
            )
    return Group(rates, Text(), measures) if measures.rows else rates


def told_so_far(sweep: Sweep[R], rows: Sequence[R]) -> str:
    """Return the success rate so far, such as `3 of 4 assembled (30.1 to 95.4 %)`."""
    from handeye.trials.figures import rate

    known = [row for row in rows if sweep.standing(row) != "uncounted"]
    found = rate(sum(sweep.standing(row) == "right" for row in known), len(known))
    interval = f" ({percent(*found.wilson95)})" if found.wilson95 else ""
    return f"{found.successes} of {found.trials} {sweep.success}{interval}"


def kept(rows: int, out: object) -> str:
    """Say in a sentence how many trials of an interrupted batch are saved, and how to continue."""
    return f"{counted(rows, 'trial')} kept in {out}; the same command continues the batch"
