"""The bar that shows how far a run is."""

import io
import re
from functools import cache

import pytest
from rich.console import Console

from handeye.core.resources import plans
from handeye.core.variation import WorldSpec
from handeye.planfile.plan import Plan
from handeye.planfile.store import read_plan
from handeye.ports.camera import Renderer
from handeye.program.events import RunStarted, StageStarted, StepStarted
from handeye.results.progress import Progress

BEGUN = RunStarted(
    time=0.0, program="water_pump", steps=303, plan="", arm="Stanford", arm_digest="", world=WorldSpec(seed=0),
    camera=Renderer(method="rays"), versions={}, prepared=215.5,
)  # fmt: skip


@cache
def plan() -> Plan:
    return read_plan(plans() / "water_pump.plan.json")


@pytest.fixture
def console() -> Console:
    return Console(file=io.StringIO(), force_terminal=True, width=100)


def test_a_run_that_begins_in_the_midst_of_a_stage_shows_that_stage(console: Console) -> None:
    with Progress(plan().program.stages, console) as progress:
        progress.goes_on("put on the gasket")
    assert console.file.getvalue().rindex("put on the gasket") > console.file.getvalue().rindex("setting up")


def shown(width: int) -> str:
    """The last line of a bar on a terminal of so many columns, in the midst of a stage."""
    console = Console(
        file=io.StringIO(), force_terminal=True, force_interactive=True, width=width, color_system=None
    )
    with Progress(plan().program.stages, console) as progress:
        progress.event(BEGUN)
        progress.event(StageStarted(time=25.0, stage="put the base in its standard position"))
        progress.event(StepStarted(time=25.0, step=1, line=1, text="CHANGE  [0 0 -1] 0.6"))
    drawn = re.sub(r"\x1b\[[0-9;?]*[A-Za-z]", "\r", console.file.getvalue())
    lines = [line for line in re.split(r"[\r\n]+", drawn) if line.strip()]
    assert max(map(len, lines)) <= width
    return lines[-1].strip()


def test_the_time_that_is_shown_begins_with_the_run() -> None:
    assert "25.0 s" in shown(100)


@pytest.mark.parametrize(
    ("width", "stage"),
    [
        (40, "put the base in its standard po…"),
        (20, "put the bas…"),
        (60, "put the base in its standard position"),
    ],
)
def test_a_narrow_terminal_has_time_and_stage_on_one_line(width: int, stage: str) -> None:
    line = shown(width)
    assert ("25.0 s" in line, line.endswith(stage)) == (True, True)


def test_a_terminal_of_the_usual_width_shows_the_statement_too() -> None:
    assert shown(80).endswith("put the base in its standard position CHANGE  [0 0 -1] 0…")


def test_calibration_of_the_camera_is_seen_to_go_on() -> None:
    console = Console(file=io.StringIO(), force_terminal=True, width=100)
    with Progress(plan().program.stages, console) as progress:
        progress.viewed(5, 18)
    assert "calibrating: view 5 of 18" in console.file.getvalue()


def test_without_a_terminal_calibration_is_one_line() -> None:
    console = Console(file=io.StringIO(), width=100)
    with Progress(plan().program.stages, console) as progress:
        for number in (1, 2, 3):
            progress.viewed(number, 3)
    assert console.file.getvalue().split() == ["calibrating", "the", "camera"]


def test_to_ask_somebody_brings_no_bar_where_there_was_none(console: Console) -> None:
    progress = Progress(plan().program.stages, console)
    with progress.aside():
        pass
    assert console.file.getvalue() == ""


def test_a_bar_comes_back_when_somebody_was_asked(console: Console) -> None:
    with Progress(plan().program.stages, console) as progress:
        with progress.aside():
            before = console.file.getvalue()
        assert console.file.getvalue() != before
