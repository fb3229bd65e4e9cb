"""Builds the section that compares the time of each stage with the time of 1973."""

from collections.abc import Iterator
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
    section,
    table,
    to_moment,
)
from handeye.program.events import FrictionMeasured
from handeye.report.page.figures import clock, duration
from handeye.report.page.plots import bar, drawing
from handeye.report.recorded import RecordedRun
from handeye.tasks.interface import HistoricalTiming
from handeye.trace.reading import stage_names
from handeye.trace.stats import Figures, StageFigures, statistics

_WIDE: Final = 300.0
_HIGH: Final = 7.0


def timing_section(run: RecordedRun) -> Markup:
    """Return the section with the times of a run."""
    figures = statistics(run.trace.events, {})
    then = run.period
    return section(
        "timing",
        "Times" if then is None else f"Times, compared with {then.year}",
        *_beside(run, figures.total, then),
        *_by_stage(run, figures.stages),
    )


def _beside(run: RecordedRun, total: Figures, then: HistoricalTiming | None) -> Iterator[Markup]:
    times = {} if then is None else then.times
    worked = times["manipulation"] + times["lens"] if times else None
    rows = [
        ("manipulation", total.seconds - total.camera_s, times.get("manipulation")),
        ("lens change, aim and focus", total.camera_s, times.get("lens")),
        ("working phase, without vision", total.seconds, worked),
    ]
    longest = max(1e-9, *(seconds for _, *pair in rows for seconds in pair if seconds is not None))
    head = [*heads(""), *figure_heads("this run", *([] if then is None else [f"{then.year}"])), *heads("")]
    yield table(head, (_row(*row, longest, then) for row in rows), label="times")
    yield note(*_remarks(run, then))


def _row(
    name: str, here: float, then: float | None, longest: float, period: HistoricalTiming | None
) -> list[Markup]:
    figures = [figure_cell(duration(here)), *([] if then is None else [figure_cell(duration(then))])]
    bars = [bar(0, 1, here / longest * _WIDE, _HIGH, class_="here")]
    told = f"{name}: {duration(here)}"
    if then is not None and period is not None:
        bars.append(bar(0, 2 + _HIGH, then / longest * _WIDE, _HIGH, class_="then"))
        told += f", in {period.year} {duration(then)}"
    high = 3 + _HIGH * len(bars)
    drawn = drawing(*bars, wide=_WIDE, high=high, label=told)
    return [element("th", name, scope="row"), *figures, element("td", drawn, class_="bars")]


def _remarks(run: RecordedRun, then: HistoricalTiming | None) -> Iterator[str]:
    """Yield remarks about the table: the unit of its times, and the times that it lacks."""
    yield "Times are in minutes and seconds of simulated time."
    friction = sum(event.seconds for event in run.trace.events if isinstance(event, FrictionMeasured))
    calibration = run.trace.head.prepared - friction
    before = [
        f"{what} {duration(seconds)}"
        for what, seconds in (
            ("calibrating the camera took", calibration),
            ("measuring joint friction", friction),
        )
        if seconds >= 1
    ]
    if before:
        yield f" Before the program began, {' and '.join(before)}."
    if then is not None:
        yield (
            f" In {then.year}, planning took {duration(then.times['planning'])} and vision "
            f"{then.times['vision']:g} s of processor time. Here, each takes well under a second; the exact "
            "times are in the result of the run."
        )
        if then.differs:
            yield f" {then.differs}"


def _by_stage(run: RecordedRun, stages: list[StageFigures]) -> Iterator[Markup]:
    if not stages:
        return
    begins = {stage.name: stage.begin for stage in reversed(run.trace.stages)}
    longest = max(1e-9, *(stage.seconds for stage in stages))
    rows = [_stage(number, stage, begins[stage.stage], longest) for number, stage in enumerate(stages, 1)]
    left = [name for name in stage_names(run.trace) if name not in {stage.stage for stage in stages}]
    rows += [
        [
            figure_cell(str(number)),
            element("th", name, scope="row", class_="unreached"),
            cell("not reached"),
            joined([cell()] * 5),
        ]
        for number, name in enumerate(left, len(stages) + 1)
    ]
    yield element("h3", "By stage")
    figures = figure_heads("begins", "took", "camera", "steps")
    yield table([*figure_heads(""), *heads("stage", "ended"), *figures, *heads("")], rows, label="stages")


def _stage(number: int, stage: StageFigures, begin: float, longest: float) -> list[Markup]:
    arm = (stage.seconds - stage.camera_s) / longest * _WIDE
    bars = [bar(0, 1, arm, _HIGH, class_="here")]
    if stage.camera_s:
        bars.append(bar(arm, 1, stage.camera_s / longest * _WIDE, _HIGH, class_="camera"))
    told = f"{stage.stage}: {duration(stage.seconds)}, {duration(stage.camera_s)} for the camera"
    return [
        figure_cell(str(number)),
        element("th", to_moment(begin, stage.stage), scope="row"),
        cell(stage.status),
        figure_cell(clock(begin)),
        figure_cell(duration(stage.seconds)),
        figure_cell(duration(stage.camera_s) if stage.camera_s else ""),
        figure_cell(str(stage.steps)),
        element("td", drawing(*bars, wide=_WIDE, high=_HIGH + 2, label=told), class_="bars"),
    ]
