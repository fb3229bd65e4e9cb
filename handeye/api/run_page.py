"""The page that a notebook shows for a run."""

from typing import Final

from handeye.api.state import State
from handeye.core.markup import Markup, text
from handeye.core.notebook import heading, inked, line, page, picture, table
from handeye.results.page import cell_times, clock, period, told_faults, verdict
from handeye.results.result import Check, Result, told_limits

_INKS: Final = {
    "done": "good",
    "under way": "doubtful",
    "skipped": "doubtful",
    "stopped": "bad",
    "not reached": "quiet",
}  # colours of the states of a stage


def run_page(result: Result, state: State, name: str | None, webp: bytes | None) -> str:
    """Write the HTML of a run: its state or verdict, stages, times, findings of the referee, and last picture."""
    pieces = [heading(f"{result.program}, {result.world}"), line(_standing(result, state)), _stages(result)]
    if not result.paused:
        then = period(result)
        years = () if then is None else (str(then.year),)
        rows = cell_times(result, {} if then is None else then.times)
        cells = (
            (_indented(name), *("" if each is None else clock(each) for each in seconds[: 1 + len(years)]))
            for name, *seconds in rows
        )
        pieces.append(table(("simulated time", "this run", *years), cells))
    if result.referee:
        pieces.append(_findings(result))
    pieces += [line(inked(f"broken: {told}", "doubtful")) for told in told_faults(result)]
    pieces += [
        line(inked(f"limit set by the calling program: {limit}", "doubtful")) for limit in told_limits(result)
    ]
    pieces += [line(inked(f"by a person: {each}", "doubtful")) for each in result.interventions]
    pieces += [
        line(inked(f"{part} replaced by the calling program: {code}", "doubtful"))
        for part, code in (result.replaced or {}).items()
    ]
    if name is not None and webp is not None:
        pieces += [line(f"last picture: {name}"), picture(webp, f"picture {name}")]
    return page(*pieces)


def _standing(result: Result, state: State) -> Markup:
    """Write the verdict on a finished run, or the state of an unfinished run."""
    if result.paused:
        return inked(str(state), "plain")
    good = result.completed and result.assembled is not False
    return inked(verdict(result).plain, "good" if good else "bad")


def _stages(result: Result) -> Markup:
    rows = [
        (
            number,
            each.name,
            inked(each.status, _INKS[each.status]),
            each.arm_s if each.status != "not reached" else None,
        )
        for number, each in enumerate(result.stages, 1)
    ]
    return table(("", "stage", "status", "arm time, s"), rows)


def _indented(name: str) -> Markup:
    """Write a name as HTML without losing its indentation."""
    words = name.lstrip()
    return Markup("&emsp;" * ((len(name) - len(words)) // 2) + text(words))


def _mark(check: Check) -> Markup:
    if check.ok:
        return inked("✓", "good")
    return inked("✗", "bad") if check.refuses else inked("!", "doubtful")


def _findings(result: Result) -> Markup:
    rows = [
        (
            _mark(each),
            name,
            each.subject,
            f"{each.value:.3g}",
            f"{each.relation} {each.limit:.3g}",
            each.unit,
        )
        for name, each in result.referee.items()
    ]
    return table(("", "", "referee", "value", "limit", "unit"), rows)
