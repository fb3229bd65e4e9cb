"""The insertion bench: what is tried, what comes of it, and what is told of that."""

import json
from pathlib import Path

import numpy as np
import pytest
from conftest import Command
from msgspec.structs import replace

from handeye.al import AL
from handeye.core.distributions import random_numbers
from handeye.core.resources import plans
from handeye.core.source import Source
from handeye.planfile.plan import Plan
from handeye.planning.planner import plan_source
from handeye.runs.runner import Runner
from handeye.runs.scripts import taught_beside
from handeye.systems.stanford import executor_run as programs
from handeye.tasks.insertion.task import INSERTION as TASK
from handeye.touch.spiral import spiral
from handeye.trace.tables import csv_bytes
from handeye.trials.figures import figures
from handeye.trials.insertion import (
    GENTLE,
    INSERTION,
    Condition,
    InsertionRow,
    InsertionTrial,
    InsertionWork,
    fetched,
    grid,
    insertion_cases,
    trials_in_world,
    tried,
)  # fmt: skip
from handeye.trials.page import sweep_page
from handeye.trials.sweep import Case
from handeye.trials.tables import trials

EXACT = Condition(sd=0.0)
FIRST = InsertionTrial(seed=1, number=0)
SCRIPT = (plans() / "insertion.al").read_text(encoding="utf-8")


@pytest.fixture(scope="module")
def start() -> Runner:
    """A pin that is held over its hole, in a drawn world."""
    return fetched(EXACT.plan, seed=1)


def planned(text: str) -> Plan:
    made = plan_source(
        Source(name="insertion.al", text=text),
        taught_beside(plans() / "insertion.al"),
        TASK.arm,
        AL,
        task=TASK.name,
    )
    assert made.plan is not None
    return made.plan


@pytest.fixture(scope="module")
def exact(start: Runner) -> InsertionTrial:
    """The trial in which the hole is where the program thinks."""
    return tried(EXACT, start, FIRST)


def test_a_pin_right_over_its_hole_is_inserted_at_once_and_gently(exact: InsertionTrial) -> None:
    assert (exact.outcome, exact.places, exact.error) == ("seated", 1, (0.0, 0.0))
    assert 5.0 < exact.peak < GENTLE
    assert 5.0 < exact.felt < 10.0  # the stop of 25 oz
    assert exact.seconds is not None
    assert 1.0 < exact.seconds < 2.4 < exact.whole


def test_the_same_trial_gives_the_same_figures(start: Runner, exact: InsertionTrial) -> None:
    assert tried(EXACT, start, FIRST) == exact


def test_a_hole_to_the_side_is_found_by_the_search(start: Runner) -> None:
    """The drawn error of this trial is 2.2 sigma; with one sigma of 1 mm the first place does not catch it."""
    found = tried(Condition(sd=1.0), start, far := farthest())
    assert np.hypot(*found.error) > 1.5
    assert (found.outcome, found.places > 1) == ("seated", True)
    assert found.peak < GENTLE
    assert far.seed == FIRST.seed


def farthest() -> InsertionTrial:
    """Of the first few trials of the world, the one whose hole is farthest away."""
    errors = [
        np.hypot(*random_numbers(FIRST.seed, f"insertion.error.{number}").standard_normal(2))
        for number in range(10)
    ]
    return replace(FIRST, number=int(np.argmax(errors)))


def test_where_there_is_no_hole_the_operator_is_told_and_it_is_no_success(
    start: Runner, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(programs, "spiral", lambda place: spiral(place) if place < 3 else None)
    trial = tried(Condition(sd=15.0), start, farthest())
    assert (trial.outcome, trial.places, trial.seconds) == ("told", 3, None)
    assert "3 places" in trial.told


def test_a_program_that_says_done_with_the_pin_on_the_face_is_a_silent_failure(start: Runner) -> None:
    """It goes down until it meets something, and does not look how far that was."""
    first, _ = SCRIPT.split("        SAVE    ABOVE")
    blind = planned(first + "        STOP    [0 0 -25]\n        CHANGE  [0 0 -1] .4 .11\n")
    trial = tried(Condition(sd=15.0), start, farthest(), blind)
    assert (trial.outcome, trial.seconds) == ("silent", None)


def test_the_gentle_search_presses_less_than_half_as_hard_as_that_of_1973(exact: InsertionTrial) -> None:
    (hard,) = trials_in_world(Condition(sd=0.0, search="1973"), FIRST)
    assert hard.outcome == "seated"
    assert hard.peak > 2 * exact.peak


def test_ten_trials_share_a_world_and_the_last_may_have_fewer() -> None:
    cases = [case for case in insertion_cases(grid("1973"), 25, 1) if case.condition == grid("1973")[3].name]
    assert [(case.seed, len(case.trials)) for case in cases] == [(1, 10), (2, 10), (3, 5)]
    assert [number for case in cases for number in case.trials] == [*range(25)]


def test_conditions_have_names_of_their_own() -> None:
    conditions = [*grid("gentle"), *grid("1973")]
    assert len({each.name for each in conditions}) == len(conditions)


# -- the rule of the step ----------------------------------------------------------------------------------


@pytest.mark.parametrize(("condition", "step"), [(Condition(), 0.07), (Condition(chamfer=0.0), 0.02)])
def test_the_step_catches_every_hole_with_a_little_to_spare(condition: Condition, step: float) -> None:
    caught = (condition.clearance / 2 + condition.chamfer + 0.35) / 25.4
    assert condition.step == pytest.approx(step)
    assert condition.step / 2**0.5 < 0.95 * caught


@pytest.mark.parametrize("condition", [*grid("gentle"), *grid("1973")])
def test_each_condition_has_a_plan_that_searches_with_its_step(condition: Condition) -> None:
    (search,) = (step for step in condition.plan.program.steps if step.text.startswith("SEARCH"))
    assert search.text == f"SEARCH  {condition.step:g}"


# -- what is told of it ------------------------------------------------------------------------------------


def many(seated: int, told: int = 0, silent: int = 0) -> list[InsertionRow]:
    """Rows of so many trials of each outcome."""
    outcomes = ("seated",) * seated + ("told",) * told + ("silent",) * silent
    made = [
        replace(FIRST, number=number, outcome=outcome, peak=10.0 + number % 20, felt=7.0,
                seconds=2.0 if outcome == "seated" else None)
        for number, outcome in enumerate(outcomes)
    ]  # fmt: skip
    return [InsertionRow(trial=each.number, seed=1, condition=Condition().name, tried=each) for each in made]


def test_the_interval_of_a_share_is_wilsons() -> None:
    """Factory's policy, 750 of 768, as its peers compute it; and the figure that this bench has to show."""
    factory, ours = (figures(INSERTION, rows).wilson95 for rows in (many(750, 18), many(995, 5)))
    assert factory == pytest.approx((0.9632, 0.9851), abs=1e-4)
    assert ours == pytest.approx((0.9883, 0.9979), abs=1e-4)


def test_figures_are_of_all_trials_but_times_of_those_seated() -> None:
    rows = many(18, 1, 1)
    found = figures(INSERTION, rows)
    assert (found.n, found.right, found.outcomes, found.exit_code) == (
        20, 18, {"seated": 18, "told": 1, "silent": 1}, 3,
    )  # fmt: skip
    peaks, times = found.measures["peak, N"], found.measures["contact to seated, s"]
    assert (peaks.n, peaks.median, peaks.most) == (20, 19.5, 29.0)
    assert (times.n, times.most) == (18, 2.0)
    (settings,) = INSERTION.details(rows)
    assert settings.cells() == [("0.114 mm, chamfer 1, sd 1", "0", "20", "11")]


def test_the_page_fetches_nothing_and_draws_each_trial() -> None:
    rows = many(18, 2)
    page = sweep_page("twenty <trials>", INSERTION, rows, figures(INSERTION, rows)).decode()
    assert "twenty &lt;trials&gt;" in page
    assert page.count("<circle") >= 1 + 20 + 18
    assert ("<script" in page, "18 of 20 seated" in page) == (False, True)


def test_a_table_has_a_line_for_each_trial() -> None:
    head, first, *others = csv_bytes(trials(INSERTION, many(2, 1))).decode().splitlines()
    assert head.startswith("trial,seed,condition,verdict,stage,cause,error_x,error_y,peak,felt,whole")
    assert first.startswith('0,1,"0.114 mm, chamfer 1, sd 1",seated,,,0.0,0.0,10.0,7.0,0.0')
    assert len(others) == 2


# -- the command -------------------------------------------------------------------------------------------


@pytest.fixture
def canned(monkeypatch: pytest.MonkeyPatch) -> None:
    """Trials that take no time; the last of seven in a world, and of more, are silent."""

    def work(self: InsertionWork, case: Case) -> list[InsertionRow]:
        rows = many(min(7, len(case.trials)), 0, len(case.trials) - min(7, len(case.trials)))
        named = zip(case.trials, rows, strict=True)
        return [replace(row, trial=k, seed=case.seed, condition=case.condition) for k, row in named]

    monkeypatch.setattr(InsertionWork, "__call__", work)


BENCH = ("bench", "insertion", "--jobs", "1")


@pytest.mark.usefixtures("canned")
def test_without_options_a_grid_is_tried_and_told(command: Command) -> None:
    code, out, _ = command(*BENCH, "--json")
    told = json.loads(out)
    assert [each["condition"] for each in told["conditions"]] == [each.name for each in grid("gentle")]
    assert {each["n"] for each in told["conditions"]} == {10}
    assert code == 3  # some were silent


@pytest.mark.usefixtures("canned")
def test_one_setting_is_tried_where_one_is_named(command: Command) -> None:
    code, out, _ = command(*BENCH, "--n", "7", "--sd", "2", "--json")
    (setting,) = json.loads(out)["settings"]
    assert (code, setting["n"], setting["condition"]) == (0, 7, "0.114 mm, chamfer 1, sd 2")


@pytest.mark.usefixtures("canned")
@pytest.mark.parametrize(("name", "begins"), [("b.html", b"<!DOCTYPE html>"), ("b.csv", b"trial,seed,")])
def test_it_is_written_as_its_name_says(command: Command, name: str, begins: bytes) -> None:
    command(*BENCH, "--n", "4", "--sd", "1", "--out", name)
    assert Path(name).read_bytes().startswith(begins)


@pytest.mark.usefixtures("canned")
def test_a_folder_is_gone_on_with_and_its_page_made_anew(command: Command) -> None:
    for n in ("4", "12"):
        _, out, err = command(*BENCH, "--n", n, "--sd", "1", "--out", "kept", "--json")
    assert (json.loads(out)["n"], len(Path("kept/trials.jsonl").read_text("utf-8").splitlines())) == (12, 17)
    assert "4 of 12 insertions already done by an earlier command" in err
    assert Path("kept/figures.html").is_file()


def test_what_has_ended_is_told_when_it_is_broken_off(
    command: Command, monkeypatch: pytest.MonkeyPatch
) -> None:
    def work(self: InsertionWork, case: Case) -> list[InsertionRow]:
        if case.seed:
            raise KeyboardInterrupt
        return [replace(row, seed=0, condition=case.condition) for row in many(10)]

    monkeypatch.setattr(InsertionWork, "__call__", work)
    code, out, _ = command(*BENCH, "--n", "20", "--sd", "1", "--out", "b.csv")
    assert (code, "10 of 10 seated" in out) == (130, True)
    assert len(Path("b.csv").read_text(encoding="utf-8").splitlines()) == 11


@pytest.mark.parametrize(
    ("words", "said"),
    [
        (("--n", "0"), "the number of trials must be at least 1"),
        (("--jobs", "0"), "the number of processes must be at least 1"),
        (("--clearance", "2"), "between 0.05 and 1 mm"),
        (("--sd", "-1"), "between 0 and 5 mm"),
        (("--sd", "nan"), "between 0 and 5 mm"),
        (("--seed", "-1"), "from 0 to"),
    ],
)
def test_bad_input_gets_one_sentence(command: Command, words: tuple[str, ...], said: str) -> None:
    code, out, err = command("bench", "insertion", *words)
    assert (code, out) == (2, "")
    assert said in err
