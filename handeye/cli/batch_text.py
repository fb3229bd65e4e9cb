"""The figures of a batch for a terminal."""

from collections.abc import Iterator, Sequence
from typing import TYPE_CHECKING, Final

from rich.console import Console, ConsoleOptions, Group, RenderableType, RenderResult
from rich.table import Table
from rich.text import Text

from handeye.core.diagnostics import visible
from handeye.core.plain_text import printable

if TYPE_CHECKING:
    from handeye.trials.batch.comparing import Paired
    from handeye.trials.batch.dismantling import DismantlingFigures
    from handeye.trials.batch.figures import Failure, Figures
    from handeye.trials.batch.rates import Rate

NARROWEST: Final = 80
"""Columns that a table of figures takes: a narrower terminal breaks its lines, and loses nothing of them."""


class PlainTable(Table):
    """A table of words and figures, which may come from a file that nobody trusts."""

    def __init__(self, words: tuple[str, ...], *figures: str) -> None:
        super().__init__(box=None, pad_edge=False, header_style="bold")
        for title in words:
            self.add_column(printable(title), overflow="fold")
        for title in figures:
            self.add_column(title, justify="right", no_wrap=True)

    def __rich_console__(self, console: Console, options: ConsoleOptions) -> RenderResult:
        yield from super().__rich_console__(console, options.update_width(max(options.max_width, NARROWEST)))

    def row(self, *cells: str) -> None:
        """Add a row."""
        self.add_row(*map(printable, cells))


def page(found: "Figures") -> RenderableType:
    """All that is told of a batch."""
    parts = [
        table
        for table in (_operations(found), _stages(found), _searches(found), _margins(found))
        if table.rows
    ]
    spaced = [part for table in parts for part in (table, Text())]
    return Group(*spaced, *(Text(visible(line)) for line in failures(found)), Text(verdict(found)))


def failures(found: "Figures | DismantlingFigures") -> Iterator[str]:
    """The failures, each with the command that carries it out again, and their causes counted."""
    for failure in found.failures:
        yield from _failure(failure)
    for cause in found.causes:
        yield f"{cause.count} of {found.n}: {_place(cause.stage)}: {cause.cause}"


def verdict(found: "Figures") -> str:
    """How many trials were assembled, and how sure that is."""
    told = _counted(found, found.assembled, "assembled")
    return f"{told}\nin {found.answered} the operator was called and answered" if found.answered else told


def dismantling_page(found: "DismantlingFigures") -> RenderableType:
    """All that is told of trials of dismantling."""
    told = _counted(found, found.apart, "apart")
    if found.force is not None:
        told += f"\ngreatest force that the hand met: {found.force:.1f} N"
    if found.not_built:
        told += f"\nnot built, and not counted: {found.not_built}"
    tables = [table for table in (_margins(found),) if table.rows]
    return Group(*tables, *(Text(visible(line)) for line in failures(found)), Text(told))


def _counted(found: "Figures | DismantlingFigures", successes: int, right: str) -> str:
    counts = [
        f"{found.silent_failures} silent failures",
        f"{found.stopped} stopped",
        f"{found.failed} broken off",
    ]
    text = f"{successes} of {found.n} {right}, {', '.join(counts)}"
    if found.wilson95 is None or found.p_s is None:
        return text
    return f"{text}\n{right}: {percent(*found.wilson95)} (Wilson, 95 %), at least {percent(found.p_s)} (exact, 95 %)"


def comparison(first: str, found: "Sequence[Paired]") -> RenderableType:
    """Batches beside the first one: how often they are right, and how long the arm takes where both are."""
    headings = ("assembled", "first", "only\nfirst", "only\nthis", "p", "noticed", "silent", "broken\noff")
    rates = PlainTable((f"beside {first}",), *headings)
    times = PlainTable(("where both are assembled",), "pairs", "arm time", "p")
    for each in found:
        counts = each.first_assembled, each.only_first, each.only_this
        rates.row(each.name, f"{each.assembled} of {each.pairs}", *map(str, counts), f"{each.p:.2g}",
                      *map(str, (each.told, each.silent, each.failed)))  # fmt: skip
        if each.longer_s is not None and each.p_longer is not None:
            times.row(each.name, str(each.both), f"{each.longer_s:+.1f} s", f"{each.p_longer:.2g}")
    return Group(rates, Text(), times) if times.rows else rates


def percent(*parts: float) -> str:
    """Parts of one as percentages: `88.6 to 99.1 %`."""
    return f"{' to '.join(f'{100 * part:.1f}' for part in parts)} %"


def _operations(found: "Figures") -> PlainTable:
    table = PlainTable(("contact operation",), "done", "Wilson, 95 %", "at least")
    for name, rate in found.operations.items():
        table.row(name, f"{rate.successes} of {rate.trials}", *_sure(rate))
    return table


def _sure(rate: "Rate") -> tuple[str, str]:
    if rate.wilson95 is None or rate.p_s is None:
        return "", ""
    return percent(*rate.wilson95), percent(rate.p_s)


def _stages(found: "Figures") -> PlainTable:
    table = PlainTable(("stage",), "trials", "5 %", "median", "95 %")
    for stage in found.stages:
        seconds = (f"{value:.1f} s" for value in (stage.p5_s, stage.median_s, stage.p95_s))
        table.row(stage.stage, str(stage.n), *seconds)
    return table


def _searches(found: "Figures") -> PlainTable:
    table = PlainTable(("search around",), "searches", "found", "places: median", "95 %", "most")
    for each in found.searches:
        table.row(
            each.at, str(each.n), str(each.found), f"{each.median:g}", f"{each.p95:.1f}", str(each.most)
        )
    return table


def _margins(found: "Figures | DismantlingFigures") -> PlainTable:
    table = PlainTable(("margin to the limit of", "unit"), "median", "5 %", "worst", "seed", "deviations")
    for each in found.margins:
        deviations = "" if each.deviations is None else f"{each.deviations:.3g}"
        figures = (f"{value:.3g}" for value in (each.median, each.p5, each.worst))
        table.row(each.finding, each.unit, *figures, str(each.worst_seed), deviations)
    return table


def _failure(failure: "Failure") -> Iterator[str]:
    place = _place(failure.stage) + (f", line {failure.line}" if failure.line else "")
    yield f"trial {failure.trial}, seed {failure.seed}: {failure.verdict}, {place}: {failure.detail}"
    yield f"  {failure.command}"


def _place(stage: str) -> str:
    return f"“{stage}”" if stage not in ("", "referee") else stage or "no stage"
