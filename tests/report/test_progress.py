"""The bar that shows how far a run is."""

import io
from functools import cache

import pytest
from rich.console import Console

from handeye.planfile.plan import Plan
from handeye.planfile.store import read_plan
from handeye.report.progress import Progress
from handeye.resources import plans


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
