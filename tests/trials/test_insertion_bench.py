"""The insertion bench: what is tried, what comes of it, and what is told of that."""

import json
from collections.abc import Iterator
from pathlib import Path

import numpy as np
import pytest
from conftest import Command
from msgspec.structs import replace

from handeye.al import AL
from handeye.core.random_streams import random_numbers
from handeye.core.resources import plans
from handeye.core.source import Source
from handeye.planfile.plan import Plan
from handeye.planning.scripts import plan_source
from handeye.runs.runner import Runner
from handeye.runs.scripts import taught_beside
from handeye.systems.stanford import executor_run as programs
from handeye.tasks.insertion.task import INSERTION
from handeye.touch.spiral import spiral
from handeye.trials import insertion
from handeye.trials.insertion import Condition, InsertionTrial, fetched, grid, trials, trials_in_world, tried
from handeye.trials.insertion_figures import GENTLE, Bench
from handeye.trials.insertion_page import html, rows

EXACT = Condition(sd=0.0)
FIRST = InsertionTrial(condition=0, seed=1, number=0)
SCRIPT = (plans() / "insertion.al").read_text(encoding="utf-8")


@pytest.fixture(scope="module")
def start() -> Runner:
    """A pin that is held over its hole, in a drawn world."""
    return fetched(EXACT.plan, seed=1)


def planned(text: str) -> Plan:
    made = plan_source(
        Source(name="insertion.al", text=text),
        taught_beside(plans() / "insertion.al"),
        INSERTION.arm,
        AL,
        task=INSERTION.name,
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
    (hard,) = trials_in_world([Condition(sd=0.0, search="1973")], FIRST)
    assert hard.outcome == "seated"
    assert hard.peak > 2 * exact.peak


def test_any_number_of_workers_gives_the_same_table(monkeypatch: pytest.MonkeyPatch) -> None:
    """Their shares come in another order."""
    monkeypatch.setattr(insertion, "fetched", lambda plan, seed: None)
    monkeypatch.setattr(insertion, "tried", lambda condition, begun, trial: trial)
    monkeypatch.setattr(insertion, "in_processes", lambda work, shares, jobs: map(work, reversed(shares)))
    one, two = (Bench.of(grid("1973"), trials(grid("1973"), 25, seed=1, workers=n)) for n in (1, 2))
    assert rows(one) == rows(two)
    assert [trial.seed for trial in one.of_condition(3)] == [1] * 10 + [2] * 10 + [3] * 5


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


def many(seated: int, told: int = 0, silent: int = 0) -> Bench:
    """A bench of so many trials of each outcome."""
    outcomes = ("seated",) * seated + ("told",) * told + ("silent",) * silent
    made = [
        replace(FIRST, number=number, outcome=outcome, peak=10.0 + number % 20, felt=7.0,
                seconds=2.0 if outcome == "seated" else None)
        for number, outcome in enumerate(outcomes)
    ]  # fmt: skip
    return Bench.of([Condition()], reversed(made))


def test_the_interval_of_a_share_is_wilsons() -> None:
    """Factory's policy, 750 of 768, as its peers compute it; and the figure that this bench has to show."""
    (factory,), (ours,) = many(750, 18).figures(), many(995, 5).figures()
    assert factory.interval == pytest.approx((0.9632, 0.9851), abs=1e-4)
    assert ours.interval == pytest.approx((0.9883, 0.9979), abs=1e-4)


def test_figures_are_of_all_trials_but_times_of_those_seated() -> None:
    (figures,) = many(18, 1, 1).figures()
    assert (figures.n, figures.seated, figures.told, figures.silent) == (20, 18, 1, 1)
    assert figures.peak_n is not None
    assert (figures.peak_n.median, figures.peak_n.most, figures.gentle) == (19.5, 29.0, 11)
    assert figures.seconds is not None
    assert figures.seconds.most == 2.0


def test_trials_stand_in_order_however_they_came() -> None:
    assert [trial.number for trial in many(5).trials] == [0, 1, 2, 3, 4]


def test_the_page_fetches_nothing_and_draws_each_trial() -> None:
    page = html(many(18, 2), "twenty <trials>").decode()
    assert "twenty &lt;trials&gt;" in page
    assert page.count("<circle") == 1 + 20 + 18
    assert "<script" not in page
    assert "18 of 20" in page


def test_a_table_has_a_line_for_each_trial() -> None:
    head, first, *others = rows(many(2, 1)).decode().splitlines()
    assert head.startswith("search,clearance_mm,chamfer_mm,sd_mm,seed,number")
    assert first == "gentle,0.114,1.0,1.0,1,0,0.0,0.0,seated,0,10.0,7.0,2.0,0.0"
    assert len(others) == 2


# -- the command -------------------------------------------------------------------------------------------


@pytest.fixture
def canned(monkeypatch: pytest.MonkeyPatch) -> None:
    """Trials that take no time, one in eight of them silent."""

    def made(conditions: list[Condition], n: int, *, seed: int, workers: int) -> list[InsertionTrial]:
        return [
            replace(each, condition=index, seed=seed)
            for index in range(len(conditions))
            for each in many(n - n // 8, 0, n // 8).trials
        ]

    monkeypatch.setattr(insertion, "trials", made)


@pytest.mark.usefixtures("canned")
def test_without_options_a_grid_is_tried_and_told(command: Command) -> None:
    code, out, _ = command("bench", "insertion", "--json")
    figures = json.loads(out)["figures"]
    assert len(figures) == len(grid("gentle"))
    assert {each["n"] for each in figures} == {10}
    assert code == 3  # some were silent


@pytest.mark.usefixtures("canned")
def test_one_setting_is_tried_where_one_is_named(command: Command) -> None:
    code, out, _ = command("bench", "insertion", "--n", "7", "--sd", "2", "--json")
    (figures,) = json.loads(out)["figures"]
    assert (code, figures["n"], figures["condition"]["sd"], figures["condition"]["clearance"]) == (
        0,
        7,
        2,
        0.114,
    )


@pytest.mark.usefixtures("canned")
@pytest.mark.parametrize(("name", "begins"), [("b.html", b"<!doctype html>"), ("b.csv", b"search,")])
def test_it_is_written_as_its_name_says(command: Command, name: str, begins: bytes) -> None:
    command("bench", "insertion", "--n", "4", "--sd", "1", "--out", name)
    assert Path(name).read_bytes().startswith(begins)


def test_what_has_ended_is_told_when_it_is_broken_off(
    command: Command, monkeypatch: pytest.MonkeyPatch
) -> None:
    def broken_off(*_: object, **__: object) -> Iterator[InsertionTrial]:
        yield from many(3).trials
        raise KeyboardInterrupt

    monkeypatch.setattr(insertion, "trials", broken_off)
    code, out, _ = command("bench", "insertion", "--sd", "1", "--out", "b.csv")
    assert code == 130
    assert "3 of 3" in out
    assert len(Path("b.csv").read_text(encoding="utf-8").splitlines()) == 4


@pytest.mark.parametrize(
    ("words", "said"),
    [
        (("--n", "0"), "at least one trial"),
        (("--workers", "0"), "at least one process"),
        (("--clearance", "2"), "0.05 to 1 mm"),
        (("--sd", "-1"), "0 to 5 mm"),
        (("--sd", "nan"), "0 to 5 mm"),
        (("--out", "b.txt"), ".html"),
        (("--seed", "-1"), "from 0 up"),
    ],
)
def test_bad_input_gets_one_sentence(command: Command, words: tuple[str, ...], said: str) -> None:
    code, out, err = command("bench", "insertion", *words)
    assert (code, out) == (2, "")
    assert said in err
