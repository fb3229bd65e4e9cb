"""The figures of a trace agree with its events."""

import io
from pathlib import Path

import pytest
from recordings import EVENTS, record
from rich.console import Console

from handeye.trace.reading import read_trace
from handeye.trace.stats import Figures, StageFigures, Statistics, statistics, statistics_table


def test_each_stage_is_counted_by_itself_and_all_together() -> None:
    figures = statistics(EVENTS, {})
    assert [stage.stage for stage in figures.stages] == ["open", "close", "again"]
    assert [stage.status for stage in figures.stages] == ["done"] * 3
    assert [stage.steps for stage in figures.stages] == [3, 3, 3]
    assert [stage.guards for stage in figures.stages] == [3, 3, 3]
    assert [stage.pictures for stage in figures.stages] == [0, 1, 0]
    assert (figures.total.steps, figures.total.motions, figures.total.pictures) == (9, 9, 1)


def test_the_times_of_the_stages_add_up() -> None:
    figures = statistics(EVENTS, {})
    assert sum(stage.seconds for stage in figures.stages) == pytest.approx(figures.total.seconds)
    assert figures.total.seconds == pytest.approx(3 * 3 * 8 / 60, abs=1e-5)


def test_messages_are_counted_on_each_channel(tmp_path: Path) -> None:
    record(tmp_path / "short.mcap")
    trace = read_trace(tmp_path / "short.mcap")
    messages = statistics(trace.events, trace.counts).messages
    assert messages["/events"] == len(EVENTS)
    assert messages["/joint_states"] == 72
    assert (messages["/camera/picture"], messages["/scene"]) == (1, 1)


def test_a_stage_whose_end_was_not_recorded_was_broken_off() -> None:
    last = statistics(EVENTS[:18], {}).stages[-1]
    assert (last.stage, last.status, last.steps) == ("close", "interrupted", 2)


def test_a_run_of_which_nothing_is_known_has_no_figures() -> None:
    assert statistics([], {}) == Statistics(
        stages=[], total=Figures(), operator=0, experiments=0, messages={}
    )


def test_seconds_are_rounded_as_in_the_result_of_a_run() -> None:
    console = Console(file=io.StringIO(), width=100)
    added_up = 0.1 + 0.2 + 48.65
    stages = [StageFigures(stage="insert", status="done", seconds=added_up)]
    figures = Statistics(stages=stages, total=stages[0], operator=0, experiments=0, messages={})
    console.print(statistics_table(figures, console.width))
    assert f"{added_up:.1f}" == "48.9"
    assert console.file.getvalue().count("49.0") == 2


def test_the_table_has_a_row_for_each_stage_and_one_for_all() -> None:
    console = Console(width=120, file=io.StringIO())
    console.print(statistics_table(statistics(EVENTS, {"/events": 40}), 120))
    lines = console.file.getvalue().splitlines()
    assert [line.split()[0] for line in lines[:5]] == ["stage", "open", "close", "again", "all"]
    assert lines[4].split() == ["all", "1.2", "0.0", "9", "9", "0"]
    assert lines[-1].strip() == "messages: /events 40"


@pytest.mark.parametrize("columns", [100, 40])
def test_the_name_of_a_stage_is_shown_as_it_is_and_steers_no_terminal(columns: int) -> None:
    stage = StageFigures(stage="one [/old]\x1b]0;", status="done")
    figures = Statistics(stages=[stage], total=stage, operator=0, experiments=0, messages={"/x\x1b[2J": 1})
    console = Console(file=io.StringIO(), width=columns)
    console.print(statistics_table(figures, columns))
    assert ("one [/old]" in console.file.getvalue(), "\x1b" in console.file.getvalue()) == (True, False)


def test_a_narrow_terminal_shows_every_figure() -> None:
    stage = StageFigures(
        stage="put the base in its standard position", seconds=123.4, camera_s=56.7, steps=987
    )
    figures = Statistics(stages=[stage], total=Figures(seconds=234.5), operator=0, experiments=0, messages={})
    console = Console(file=io.StringIO(), width=40)
    with console.capture() as shown:
        console.print(statistics_table(figures, console.width))
    assert [figure for figure in ("123.4", "56.7", "987", "234.5") if figure not in shown.get()] == []
