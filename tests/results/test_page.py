"""What a person reads at the end of a run."""

import io
import json
from typing import cast

import msgspec
import pytest
from results import result
from rich.console import Console

from handeye.api.run_page import run_page
from handeye.api.state import State
from handeye.core.faults import Fault
from handeye.core.variation import WorldSpec
from handeye.judge.finding import at_most
from handeye.results.page import clock, page, referee, short_page, timing, verdict
from handeye.results.result import CameraReport, Check, Result, to_json

CALIBRATED = CameraReport(renderer="ray casting", sightings_rms_px={"25 mm": 0.4}, residual_in=0.02)
GAP = Check(
    ok=False, subject="gap under a head", value=5.0, relation="at most", limit=0.2, unit="mm",
    sentence="gap under a head (at most 0.2 mm)",
)  # fmt: skip


def table(made: Result) -> str:
    console = Console(file=io.StringIO(), width=80)
    with console.capture() as shown:
        console.print(timing(made))
    return shown.get()


@pytest.mark.parametrize(("program", "compared"), [("water_pump", True), ("first", False)])
def test_only_the_pump_is_compared_with_1973(program: str, compared: bool) -> None:
    shown = table(result(completed=True, assembled=None, program=program))
    assert ("1973" in shown, "5:30 min" in shown) == (compared, compared)
    assert "working phase" in shown


@pytest.mark.parametrize(
    ("assembled", "said"),
    [(True, "The referee accepts the result."), (False, "but the work is not right:")],
)
def test_a_run_of_a_task_that_is_not_known_here_is_shown_in_neutral_words(assembled: bool, said: str) -> None:
    odd = msgspec.structs.replace(result(completed=True, assembled=assembled), task="another program's own")
    console = Console(file=io.StringIO(), width=80)
    with console.capture() as shown:
        console.print(page(odd))
    assert (said in shown.get(), "1973" in shown.get()) == (True, False)


@pytest.mark.parametrize(("planning", "told"), [(0.0, False), (0.4, True)])
def test_planning_is_timed_where_it_was_done(planning: float, told: bool) -> None:
    assert ("planning phase" in table(result(completed=True, assembled=None, planning=planning))) == told


@pytest.mark.parametrize(("friction", "told"), [(0.0, False), (3.3, True)])
def test_the_measurement_of_friction_has_a_row_of_its_own(friction: float, told: bool) -> None:
    shown = table(result(completed=True, assembled=None, friction=friction))
    assert ("joint friction" in shown, "3.30 s" in shown) == (told, told)


@pytest.mark.parametrize(("calibration", "told"), [(0.0, False), (215.0, True)])
def test_calibration_of_the_camera_has_a_row_of_its_own(calibration: float, told: bool) -> None:
    done = result(completed=True, assembled=None, calibration=calibration)
    shown = table(msgspec.structs.replace(done, camera=CALIBRATED))
    assert ("camera calibration" in shown, "3:35 min" in shown) == (told, told)


def test_of_a_run_without_a_camera_nothing_is_told_of_lenses() -> None:
    shown = table(result(completed=True, assembled=None, calibration=215.0))
    assert ("before the working phase" in shown, "lens" in shown, "vision (" in shown) == (True, False, False)


@pytest.mark.parametrize(("step", "told"), [(0, "simulated in"), (7, "simulated from step 7 on in")])
def test_it_is_said_from_where_on_the_seconds_of_this_computer_are_known(step: int, told: str) -> None:
    assert told in table(result(completed=True, assembled=None, from_step=step))


@pytest.mark.parametrize(("factor", "told"), [(0.0, False), (5.5, True)])
def test_nothing_is_said_of_speed_where_nothing_was_simulated(factor: float, told: bool) -> None:
    assert ("real time" in table(result(completed=True, assembled=None, factor=factor))) == told


def test_a_stop_names_the_step_the_error_and_what_went_wrong() -> None:
    said = verdict(result(completed=False, assembled=False, message="no gasket")).plain
    assert said == "Stopped in stage “check the gasket” (error 32): no gasket"


def test_the_referee_is_shown_by_what_was_measured_and_how_it_must_stand_to_its_limit() -> None:
    few = Check(
        ok=True, subject="screws in their threads", value=6, relation="at least", limit=6, unit="screws",
        sentence="a sentence that nobody takes apart (at most)",
    )  # fmt: skip
    shown = referee(result(completed=True, assembled=False, checks={"gap": GAP, "screws": few}))
    cells = [[str(cell) for cell in column.cells] for column in shown.columns]
    assert cells[1:] == [
        ["gap under a head", "screws in their threads"], ["5", "6"], ["<= 0.2", ">= 6"], ["mm", "screws"]
    ]  # fmt: skip


def test_a_run_that_pauses_says_how_well_its_camera_is_calibrated() -> None:
    seen = CameraReport(renderer="ray casting", sightings_rms_px={"25 mm": 0.2}, residual_in=0.03)
    paused = msgspec.structs.replace(result(completed=False, assembled=None), paused=True, camera=seen)
    console = Console(file=io.StringIO(), width=80)
    with console.capture() as shown:
        console.print(page(paused))
    assert "calibrated to 0.03 in rms" in shown.get()


def test_no_word_of_a_result_steers_a_terminal_or_is_taken_for_a_style() -> None:
    odd = msgspec.structs.replace(GAP, subject="[/x]gap\x1b[31m", unit="[red]mm")
    console = Console(file=io.StringIO(), width=80)
    with console.capture() as shown:
        console.print(page(result(completed=False, assembled=False, message="\x1b[2J", checks={"gap": odd})))
    assert "\x1b" not in shown.get()
    assert "[/x]gap␛[31m" in shown.get()


def test_a_silent_failure_says_what_the_referee_found() -> None:
    wrong = GAP
    said = verdict(result(completed=True, assembled=False, checks={"gap": wrong})).plain
    assert (
        said == "The program reported success, but the pump is not right: gap under a head (at most 0.2 mm)"
    )


SCAR = Check.of(at_most(1, 0, "threads", "scarred threads", caution=True))


def test_a_caution_stands_in_the_verdict_on_right_work() -> None:
    made = result(completed=True, assembled=True, checks={"scar": SCAR})
    said = verdict(made)
    assert said.plain == "The pump is assembled. Caution: scarred threads (at most 0 threads): 1"
    assert (said.style, made.exit_code) == ("bold yellow", 0)


def test_a_caution_has_a_mark_of_its_own_on_every_page() -> None:
    made = result(completed=True, assembled=True, checks={"scar": SCAR})
    assert [str(cell) for cell in referee(made).columns[0].cells] == ["!"]
    assert "Caution: scarred threads" in run_page(made, cast(State, None), None, None)


def test_a_caution_stands_in_the_record() -> None:
    made = result(completed=True, assembled=True, checks={"scar": SCAR})
    kept = json.loads(to_json(made))["referee"]["scar"]
    assert (kept["ok"], kept["caution"], kept["value"]) == (False, True, 1)


def test_a_caution_is_no_reason_why_work_is_wrong() -> None:
    said = verdict(result(completed=True, assembled=False, checks={"gap": GAP, "scar": SCAR})).plain
    assert "scarred" not in said


@pytest.mark.parametrize(
    ("completed", "assembled", "code"),
    [(True, True, 0), (False, False, 1), (True, False, 3), (True, None, 0)],
)
def test_the_exit_code_tells_the_cases_apart(completed: bool, assembled: bool | None, code: int) -> None:
    assert result(completed=completed, assembled=assembled).exit_code == code


@pytest.mark.parametrize(
    ("seconds", "said"), [(332, "5:32 min"), (0.034, "0.03 s"), (12.3, "12 s"), (59.9, "60 s")]
)
def test_times_are_said_as_people_say_them(seconds: float, said: str) -> None:
    assert clock(seconds) == said


def test_what_was_broken_is_told_as_it_would_be_typed() -> None:
    fault = Fault(name="gap_potentiometer.off", value=0.0127, stage=2)
    made = result(completed=True, assembled=True)
    broken = msgspec.structs.replace(made, world=WorldSpec(seed=0, faults=(fault,)))
    console = Console(file=io.StringIO(), width=80)
    with console.capture() as shown:
        console.print(page(broken))
    assert "broken: gap_potentiometer.off=0.5in@2\n" in shown.get()
    state = cast("State", object())
    assert "broken: gap_potentiometer.off=0.5in@2" in run_page(broken, state, None, None)


@pytest.mark.parametrize(("program", "compared"), [("water_pump", True), ("first", False)])
def test_a_notebook_shows_the_times_of_1973_beside_the_pump_alone(program: str, compared: bool) -> None:
    made = result(completed=True, assembled=None, program=program)
    shown = run_page(made, cast("State", None), None, None)
    assert ("1973" in shown, "5:30 min" in shown) == (compared, compared)
    assert "processor" not in shown


def test_the_short_page_has_one_line_of_warnings() -> None:
    made = result(completed=True, assembled=True)
    doubtful = msgspec.structs.replace(made, warnings=("line 7: faint", "line 9: faint"))
    with (console := Console(width=100)).capture() as told:
        console.print(short_page(doubtful))
        console.print(page(doubtful))
    assert "line 7: faint (and 1 more warning: --details)" in told.get()
    assert told.get().count("line 9: faint") == 1
