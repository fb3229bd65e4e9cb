"""Builds the section with the referee's measurements and their limits."""

from collections.abc import Iterable, Iterator
from typing import Final

from handeye.core.markup import Markup, cell, element, figure_cell, figure_heads, heads, note, section, table
from handeye.core.units import UNITS
from handeye.report.page.plots import bar, drawing, rule
from handeye.report.recorded import RecordedRun
from handeye.results.result import Check, told_limits

_WIDE: Final = 160.0
_FULL: Final = 120.0  # Where a bar reaches its limit
_HIGH: Final = 5.0


def referee_section(run: RecordedRun) -> Markup:
    """Return the section with the referee's measurements."""
    return section("referee", "What the referee measured", *_content(run))


def _content(run: RecordedRun) -> Iterator[Markup]:
    if run.result is None:
        yield note(
            "The findings of the referee are in the folder of a run, not in its trace. To show the findings, "
            "make the report from the folder."
        )
    elif not run.result.referee:
        yield note(
            "The referee did not judge this run. The referee judges only finished programs, and only "
            "on request (--judge)."
        )
    else:
        yield note(
            "The referee measured the finished work in the simulator; the program does not see these values. The "
            "bar beside a value shows the value as a fraction of its limit; counts have no bar."
        )
        yield findings_table(run.result.referee.values())
        for limit in told_limits(run.result):
            yield note(f"Limit set by the calling program for this run: {limit}.")


def findings_table(checks: Iterable[Check], label: str = "findings") -> Markup:
    """Return a table of findings. A bar in each row shows what fraction of the limit the value reaches. `label` names
    the table for screen readers.
    """
    head = [
        *heads("", "finding"),
        *figure_heads("value", "limit"),
        *heads("unit"),
        *figure_heads("used"),
        *heads(""),
    ]
    return table(head, map(_row, checks), label=label)


def _row(check: Check) -> list[Markup]:
    share = used(check)
    sign = "≥" if check.relation == "at least" else "≤"
    return [
        element("td", *_mark(check)),
        element("th", check.subject, scope="row"),
        figure_cell(f"{check.value:.3g}"),
        figure_cell(f"{sign} {check.limit:.3g}"),
        cell(check.unit),
        figure_cell("" if share is None else f"{100 * share:.0f} %"),
        element("td", *([] if share is None else [_bar(share, check)]), class_="bars"),
    ]


def _mark(check: Check) -> tuple[Markup]:
    if check.ok:
        return (element("span", "✓", class_="good", role="img", aria_label="right"),)
    if check.refuses:
        return (element("span", "✗", class_="bad", role="img", aria_label="wrong"),)
    return (element("span", "!", class_="doubtful", role="img", aria_label="doubtful"),)


def used(check: Check) -> float | None:
    """Return the ratio of a measured value to its limit. Returns None for a count, or if the limit is zero."""
    if check.unit not in UNITS or check.limit == 0:
        return None
    if check.relation == "at least" and check.limit > 0:
        return None if check.value <= 0 else check.limit / check.value
    return max(0.0, check.value / check.limit)


def _bar(share: float, check: Check) -> Markup:
    wide = min(share * _FULL, _WIDE)
    shown = bar(0, 1, wide, _HIGH, class_="here" if check.ok else "over")
    label = f"{100 * share:.0f} % of the limit"
    return drawing(
        shown, rule(_FULL, 0, _FULL, _HIGH + 2, class_="limit"), wide=_WIDE, high=_HIGH + 2, label=label
    )
