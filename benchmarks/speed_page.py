"""Shows the cost of runs, as a page for the terminal and as JSON."""

from collections.abc import Iterable, Mapping
from typing import Final

from rich.console import Group, RenderableType
from rich.table import Table
from rich.text import Text

from benchmarks.run_components import COMPONENTS, PHYSICS, PICTURES
from benchmarks.run_cost import RunCost, Speed
from handeye.core.diagnostics import visible
from handeye.results.page import clock

_COLUMNS: Final = {
    PHYSICS: (PHYSICS,),
    "devices": ("devices",),
    "servo": ("servo",),
    "pictures": PICTURES,
    "motions": ("motions",),
}
"""Components of each column. The column `rest` contains the other components."""


def page(speed: Speed) -> RenderableType:
    """Return the page for the terminal."""
    return Group(
        _phases(speed),
        Text(),
        _components(speed),
        Text(),
        _stages(speed),
        Text(),
        *map(Text, _sentences(speed)),
    )


def _phases(speed: Speed) -> Table:
    table = _table("processor", "CPU s", "share")
    spent = speed.spent
    rows = (
        ("start of the process", speed.start_cpu_s),
        ("planning", speed.planning_cpu_s),
        (
            "preparation: building the cell, measuring the arm, calibrating the camera",
            spent.preparation_cpu_s,
        ),
        ("work", spent.work_cpu_s),
        ("referee", spent.referee_cpu_s),
        ("all", speed.cpu_s),
    )
    for name, seconds in rows:
        table.add_row(name, *_seconds_and_share(seconds, speed.cpu_s))
    return table


def _components(speed: Speed) -> Table:
    table = _table("work, by component", "CPU s", "share", "")
    for component, seconds in speed.spent.components().items():
        table.add_row(
            component,
            *_seconds_and_share(seconds, speed.spent.work_cpu_s),
            Text(COMPONENTS[component], style="dim"),
        )
    return table


def _stages(speed: Speed) -> Table:
    table = _table("by stage, CPU s", "all", *_COLUMNS, "rest")
    spent = speed.spent
    rows = [(visible(stage), spent.components(stage)) for stage in speed.stages]
    for name, components in (("preparation", spent.of_preparation()), *rows, ("work", spent.components())):
        columns = [sum(components[component] for component in column) for column in _COLUMNS.values()]
        whole = sum(components.values())
        figures = (whole, *columns, whole - sum(columns))
        table.add_row(Text(name), *(f"{seconds:.2f}" for seconds in figures))
    return table


def _table(first: str, *others: str) -> Table:
    table = Table(box=None, pad_edge=False, header_style="bold")
    table.add_column(first)
    for name in others:
        table.add_column(name, justify="right" if name else "left", no_wrap=bool(name))
    return table


def _seconds_and_share(seconds: float, whole: float) -> tuple[str, str]:
    return f"{seconds:.2f}", f"{seconds / whole:.1%}"


def _sentences(speed: Speed) -> Iterable[str]:
    for run in speed.runs:
        yield f"world {run.result.seed}: {_verdict(run)}, {clock(run.simulated_s)} simulated; {_beside_physics(run)}"
    own = sum(run.account_cpu_s for run in speed.runs)
    yield f"these times include about {own:.2f} CPU s for the measuring itself"
    hourly, simulated = speed.accepted_per_core_hour, speed.simulated_s_per_cpu_s
    yield f"{speed.accepted} of {len(speed.runs)} accepted: {hourly:.0f} per hour of processor time"
    yield f"{simulated:.1f} s simulated per CPU s of work"
    memory = speed.peak_memory_mib
    yield (
        "greatest memory: not measured on this system"
        if memory is None
        else f"greatest memory: {memory:.0f} MiB"
    )


def _verdict(run: RunCost) -> str:
    return {0: "accepted", 1: "stopped", 3: "not right"}[run.result.exit_code]


def _beside_physics(run: RunCost) -> str:
    if run.bare is None:
        return "its physics was not replayed alone"
    alone = f"work took {run.ratio:.2f} times its physics alone ({run.bare.seconds:.2f} CPU s)"
    without = f"{run.ratio_without_pictures:.2f} without pictures"
    if run.bare.apart_s is None:
        return f"{alone}, {without}; the replay had the same states as the run, bit for bit"
    others = f"{run.bare.stretches - run.bare.same} of {run.bare.stretches}"
    return (
        f"{alone}, {without}; but {others} stretches of the replay ended in different states, "
        f"the first at {run.bare.apart_s:.1f} s on the cell's clock"
    )


def as_json(speed: Speed) -> dict[str, object]:
    """Return all figures for JSON."""
    spent = speed.spent
    return {
        "start_cpu_s": speed.start_cpu_s,
        "planning_cpu_s": speed.planning_cpu_s,
        "preparation_cpu_s": spent.preparation_cpu_s,
        "work_cpu_s": spent.work_cpu_s,
        "referee_cpu_s": spent.referee_cpu_s,
        "cpu_s": speed.cpu_s,
        "accepted": speed.accepted,
        "accepted_per_core_hour": speed.accepted_per_core_hour,
        "simulated_s_per_cpu_s": speed.simulated_s_per_cpu_s,
        "peak_memory_mib": speed.peak_memory_mib,
        "worlds": [_run_as_json(run, speed.stages) for run in speed.runs],
    }


def _run_as_json(run: RunCost, stages: Iterable[str]) -> dict[str, object]:
    spent = run.spent
    return {
        "world": run.result.world,
        "verdict": _verdict(run),
        "simulated_s": run.simulated_s,
        "preparation_cpu_s": spent.preparation_cpu_s,
        "work_cpu_s": spent.work_cpu_s,
        "referee_cpu_s": spent.referee_cpu_s,
        "account_cpu_s": run.account_cpu_s,
        "preparation": _cpu_s(spent.of_preparation()),
        "components": _cpu_s(spent.components()),
        "stages": [{"stage": stage, **_cpu_s(spent.components(stage))} for stage in stages],
        "physics_alone": None if run.bare is None else {
            "cpu_s": run.bare.seconds,
            "steps": run.bare.physics_steps,
            "stretches": run.bare.stretches,
            "same": run.bare.same,
            "apart_simulated_s": run.bare.apart_s,
            "ratio": run.ratio,
            "ratio_without_pictures": run.ratio_without_pictures,
        },
    }  # fmt: skip


def _cpu_s(components: Mapping[str, float]) -> dict[str, float]:
    return {
        "cpu_s": sum(components.values()),
        **{f"{component}_cpu_s": seconds for component, seconds in components.items()},
    }
