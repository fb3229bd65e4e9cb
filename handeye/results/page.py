"""Shows the result of a run as a page for the terminal."""

from collections.abc import Iterator, Mapping

import msgspec
from msgspec import UNSET
from rich.console import Group, RenderableType
from rich.table import Table
from rich.text import Text

from handeye.core.diagnostics import visible
from handeye.core.plain_text import counted
from handeye.results.result import Check, Result, told_limits
from handeye.tasks import known, known_any
from handeye.tasks.interface import HistoricalTiming, Words

TimingRow = tuple[str, float, float | None]
"""A row of the timing table: name, seconds in this run, and seconds in 1973 (None if the paper does not report them).
"""
_NEUTRAL = Words(done="The referee accepts the result.", product="the work")
"""Words for a task that handeye does not know, because only the Python program that began the run defines the task."""
_MARK = {
    "done": ("✓", "green"),
    "under way": ("▸", "yellow"),
    "skipped": ("–", "yellow"),
    "stopped": ("✗", "red"),
    "not reached": ("·", "dim"),
    "undone": ("↶", "green"),
}


def page(result: Result) -> RenderableType:
    """Return the result as a page: stages, times of an ended run, calibration of the camera, findings of the
    referee, and verdict.
    """
    result = printable(result)
    parts: list[RenderableType] = [stages(result)]
    if not result.paused:
        parts += [Text(), timing(result), camera(result)]
    elif result.camera.residual_in is not None:
        parts += [Text(), camera(result)]
    if result.checks:
        parts += [Text(), referee(result)]
    return Group(*parts, *_remarks(result), Text(), verdict(result))


def short_page(result: Result) -> RenderableType:
    """Return the result in short: the verdict, a line on the stages, a line on the time, a line on the referee, and a
    line on the computer.
    """
    result = printable(result)
    table = Table(box=None, show_header=False, pad_edge=False)
    table.add_column("", style="dim")
    table.add_column("")
    for name, told in _short_rows(result):
        table.add_row(name, told)
    return Group(verdict(result), Text(), table, *_remarks(result, short=True))


def _short_rows(result: Result) -> Iterator[tuple[str, str]]:
    done = sum(stage.status == "done" for stage in result.stages)
    undone = sum(stage.status == "undone" for stage in result.stages)
    yield "stages", f"{done or undone} of {len(result.stages)} {'undone' if undone and not done else 'done'}"
    t, then = result.timing, period(result)
    if result.paused:
        return
    worked = f"worked for {clock(t.working_s)}"
    if then is not None:
        worked += f"; in {then.year}, {clock(then.times['manipulation'] + then.times['lens'])}"
    yield "arm", worked
    if result.checks:
        right = sum(check.ok for check in result.checks)
        yield "referee", f"{right} of {counted(len(result.checks), 'finding')} within limits"
    if t.real_time_factor >= 0.05:
        yield "computer", f"simulated it in {clock(t.run_wall_s)}, {t.real_time_factor:.1f}x real time"


def _remarks(result: Result, *, short: bool = False) -> Iterator[RenderableType]:
    """Yield sentences on faults, settings, warnings, and actions of the operator."""
    for told in told_faults(result):
        yield Text(f"broken: {told}", "yellow")
    for limit in told_limits(result):
        yield Text(f"limit set by the calling program: {limit}", "yellow")
    first, *others = result.warnings or ("",)
    if short and others:
        yield Text(f"{first} (and {counted(len(others), 'more warning')}: --details)", "yellow")
    else:
        yield from (Text(sentence, "yellow") for sentence in result.warnings)
    for sentence in result.interventions:
        yield Text(f"by a person: {sentence}", "yellow")


def told_faults(result: Result) -> Iterator[str]:
    """Yield the faults injected in a run, in the form in which users type them."""
    task = known_any(result.task)
    for fault in result.world.faults:
        yield str(fault) if task is None else task.faults(result.world).written(fault)


def printable(result: Result) -> Result:
    """Return a copy of the result whose texts show each control character as a visible sign. No control character of
    the result then reaches the terminal.
    """

    def made(value: object) -> object:
        match value:
            case str():
                return visible(value)
            case dict():
                return {visible(name): made(item) for name, item in value.items()}
            case list() | tuple():
                return [made(item) for item in value]
        return value

    return msgspec.convert(made(msgspec.to_builtins(result)), Result)


def stages(result: Result) -> Table:
    """Return a table of the stages with their status and arm time."""
    table = Table(box=None, pad_edge=False, header_style="bold")
    table.add_column("")
    table.add_column("stage")
    table.add_column("status")
    table.add_column("arm time", justify="right")
    for stage in result.stages:
        mark, style = _MARK[stage.status]
        seconds = f"{stage.arm_s:.1f} s" if stage.status != "not reached" else ""
        table.add_row(Text(mark, style), Text(stage.name), Text(stage.status, style), seconds)
    return table


def timing(result: Result) -> Table:
    """Return the table of times. The table has a column for 1973 if the program was timed in 1973."""
    t, then = result.timing, period(result)
    table = Table(box=None, pad_edge=False, header_style="bold")
    for name in ("", "here", "" if then is None else str(then.year)):
        table.add_column(name, justify="left" if not name else "right")
    for name, seconds, at_that_time in _rows(result, {} if then is None else then.times):
        table.add_row(name, clock(seconds), "" if at_that_time is None else clock(at_that_time))
    if t.real_time_factor >= 0.05:
        since = f" from step {t.host_from_step} on" if t.host_from_step else ""
        simulated = (f"simulated{since} in", clock(t.run_wall_s), f"{t.real_time_factor:.1f}x real time")
        table.add_row(*(Text(text, "dim") for text in simulated))
    return table


def _rows(result: Result, then: Mapping[str, float]) -> Iterator[TimingRow]:
    """Yield the rows of the table of times. The first row and the last row may show computing times; all other rows
    show simulated times.
    """
    t = result.timing
    if t.planning_cpu_s:  # 0 if the plan existed already
        yield "planning phase (CPU)", t.planning_cpu_s, then.get("planning")
    yield from cell_times(result, then)
    if result.camera.used:
        yield "vision (CPU)", t.vision_cpu_s, then.get("vision")


def cell_times(result: Result, then: Mapping[str, float]) -> Iterator[TimingRow]:
    """Yield the rows of simulated time: name, seconds and, if known, seconds in 1973."""
    t, sees = result.timing, result.camera.used
    if t.friction_s:
        yield "joint friction", t.friction_s, None
    if t.calibration_s:
        yield "camera calibration" if sees else "before the working phase", t.calibration_s, None
    worked = then["manipulation"] + then["lens"] if then else None
    yield "working phase, without vision", t.working_s, worked
    yield "  manipulation", t.manipulation_s, then.get("manipulation")
    if sees:
        yield "  lens change, aim and focus", t.lens_s, then.get("lens")
    if t.overlapped_s:
        yield "    while the arm moved", t.overlapped_s, None


def period(result: Result) -> HistoricalTiming | None:
    """Return the times of 1973 for this program. Return None if the program was not timed in 1973, or if the run undid
    work.
    """
    if result.apart is not UNSET:
        return None
    task = known(result.task)
    then = None if task is None else task.period
    return then if then is not None and then.program == result.program else None


def camera(result: Result) -> Text:
    """Return a line about the camera: its renderer, and the accuracy of its calibration."""
    seen = result.camera
    if seen.residual_in is None:
        return Text(f"camera: {seen.renderer}; not used", "dim")
    lenses = ", ".join(f"{lens} {rms:.1f} points" for lens, rms in seen.sightings_rms_px.items())
    return Text(
        f"camera: {seen.renderer}; calibrated to {seen.residual_in:.2f} in rms on the table ({lenses})", "dim"
    )


def clock(seconds: float) -> str:
    """Return a duration in minutes and seconds, or in seconds with a sensible number of digits."""
    if seconds >= 60:
        whole = round(seconds)
        return f"{whole // 60}:{whole % 60:02d} min"
    return f"{seconds:.0f} s" if seconds >= 10 else f"{seconds:.2f} s"


def referee(result: Result) -> Table:
    """Return a table of the referee's measurements. The referee measures the finished work or, if the arm has undone
    the work, the parts.
    """
    table = Table(box=None, pad_edge=False, header_style="bold")
    table.add_column("")
    table.add_column("referee")
    table.add_column("value", justify="right")
    table.add_column("limit", justify="right")
    table.add_column("unit")
    for check in result.checks:
        mark = _mark(check)
        sign = ">=" if check.relation == "at least" else "<="
        figures = f"{check.value:.3g}", f"{sign} {check.limit:.3g}"
        table.add_row(mark, Text(check.subject), *figures, Text(check.unit))
    return table


def _mark(check: Check) -> Text:
    if check.ok:
        return Text("✓", "green")
    return Text("✗", "red") if check.refuses else Text("!", "yellow")


def verdict(result: Result) -> Text:
    """Return the verdict on the run, which is the last line of the page."""
    if result.paused:
        return Text(f"{result.message[:1].upper()}{result.message[1:]}.", "bold")
    if not result.completed:
        where = f" in stage “{result.stopped_at}”" if result.stopped_at else ""
        number = f" (error {result.error})" if result.error is not None else ""
        return Text(f"Stopped{where}{number}: {result.message}", "bold red")
    if result.apart is not UNSET:
        return _apart(result)
    if result.assembled is None:
        return Text("The program finished.", "bold")
    task = known_any(result.task)
    words = _NEUTRAL if task is None else task.words
    if result.assembled:
        doubt = "; ".join(result.cautions)
        return (
            Text(f"{words.done} Caution: {doubt}", "bold yellow") if doubt else Text(words.done, "bold green")
        )
    wrong = "; ".join(wrong_points(result))
    return Text(f"The program reported success, but {words.product} is not right: {wrong}", "bold red")


def _apart(result: Result) -> Text:
    """Return the verdict on a run in which the arm has undone its work."""
    if result.apart is None:
        return Text("Undone as far as requested.", "bold")
    task = known_any(result.task)
    words = _NEUTRAL if task is None else task.words
    wrong = "; ".join(wrong_points(result))
    if not result.apart:
        return Text(f"The arm has undone its work, but not everything is back in place: {wrong}", "bold red")
    if result.assembled is False:
        return Text(f"{words.apart} Before that, {words.product} was not right: {wrong}", "bold red")
    return Text(words.apart, "bold green")


def wrong_points(result: Result) -> list[str]:
    """Return the referee's failed findings, one sentence each."""
    return [check.sentence for check in result.checks if check.refuses]
