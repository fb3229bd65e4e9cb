"""What a run with a fault came to is judged by the error that should name it."""

import json
from dataclasses import replace
from pathlib import Path
from types import SimpleNamespace
from typing import cast

import msgspec
import numpy as np
import pytest
from conftest import Command
from results import result
from short_runs import plan_of

from handeye.core.errors import InvalidInput
from handeye.core.faults import Catalogue, ExpectedDetection, Fault, FaultKind
from handeye.core.variation import WorldSpec
from handeye.execution.servo import ServoPeriod
from handeye.program.events import StageStarted, StepStarted
from handeye.results.pauses import pause_sentence
from handeye.results.result import Result
from handeye.runs.advance import Pause
from handeye.runs.runner import Runner
from handeye.tasks import task
from handeye.trials.assembly import brakes_hold
from handeye.trials.faults import (
    FAULTS,
    FaultRow,
    FaultWork,
    PanicInStage,
    chosen,
    outcome,
    trial_of,
    usual,
    with_panic,
)
from handeye.trials.figures import figures
from handeye.trials.folder import read_batch
from handeye.trials.sweep import Case

STOPPED = result(completed=False, assembled=None, message="the gasket is not in place")  # with error 32
CALLED = msgspec.structs.replace(
    STOPPED, error=None, message="THE ROTOR IS HARD TO TURN, OR A JOINT OF THE ARM IS"
)
SET_UP = msgspec.structs.replace(STOPPED, error=None, stopped_at=None)
RIGHT, WRONG = (result(completed=True, assembled=assembled) for assembled in (True, False))

CATALOGUE = Catalogue(
    FaultKind(name="lamp.dead", meaning="", expected=ExpectedDetection(at_setup=True)),
    FaultKind(name="picture.dark", meaning="", expected=ExpectedDetection(at_setup=True, errors=(30,))),
    FaultKind(name="picture.frozen", meaning="", expected=ExpectedDetection(errors=(30, 32))),
)


@pytest.mark.parametrize(
    ("expected", "ended", "found"),
    [
        (ExpectedDetection(errors=(30, 32)), STOPPED, "stopped"),
        (ExpectedDetection(errors=(32,), stages=("check the gasket",)), STOPPED, "stopped"),
        (ExpectedDetection(errors=(32,), stages=("turn the rotor",)), STOPPED, "misnamed"),
        (ExpectedDetection(errors=(23,)), STOPPED, "misnamed"),
        (ExpectedDetection(at_setup=True), SET_UP, "stopped"),
        (ExpectedDetection(at_setup=True, errors=(2,), stages=("turn the rotor",)), SET_UP, "stopped"),
        (ExpectedDetection(errors=(32,)), SET_UP, "misnamed"),
        (
            ExpectedDetection(calls=("THE ROTOR IS HARD TO TURN, OR A JOINT OF THE ARM IS",)),
            CALLED,
            "stopped",
        ),
        (ExpectedDetection(at_setup=True, errors=(32,)), CALLED, "misnamed"),
        (ExpectedDetection(errors=(32,)), RIGHT, "unnoticed"),
        (ExpectedDetection(harmless="It is."), RIGHT, "recovered"),
        (ExpectedDetection(harmless="It is."), STOPPED, "misnamed"),
        (ExpectedDetection(harmless="It is."), WRONG, "silent"),
        (ExpectedDetection(errors=(32,)), WRONG, "silent"),
    ],
)
def test_an_outcome_asks_for_the_right_name_in_the_right_stage(
    expected: ExpectedDetection, ended: Result, found: str
) -> None:
    assert outcome(expected, ended, braked=True) == found


@pytest.mark.parametrize("ended", [STOPPED, CALLED, SET_UP])
def test_a_stop_without_brakes_is_undetected_whatever_its_name(ended: Result) -> None:
    expected = ExpectedDetection(
        errors=(32,), calls=("THE ROTOR IS HARD TO TURN, OR A JOINT OF THE ARM IS",), at_setup=True
    )
    assert outcome(expected, ended, braked=False) == "unbraked"


def test_a_trial_tells_where_the_run_stopped() -> None:
    events = [StepStarted(time=1.0, step=n, line=line, text="") for n, line in enumerate((7, 9))]
    trial = trial_of(Fault(name="picture.frozen", stage=2), CATALOGUE, STOPPED, events, braked=True)
    assert (trial.name, trial.stage, trial.line, trial.error, trial.outcome) == (
        "picture.frozen@2", "check the gasket", "9", 32, "stopped",
    )  # fmt: skip


def test_faults_are_chosen_by_name_and_by_group_and_by_the_matrix_if_nobody_names_any() -> None:
    assert [kind.name for kind in chosen(CATALOGUE, ["picture", "picture.dark", "lamp.dead"])] == [
        "picture.dark", "picture.frozen", "lamp.dead",
    ]  # fmt: skip
    assert len(chosen(CATALOGUE, [])) == 3
    some = Catalogue(*CATALOGUE.kinds.values(), matrix=("lamp.dead",))
    assert [kind.name for kind in chosen(some, [])] == ["lamp.dead"]
    with pytest.raises(InvalidInput, match=r"^there is no fault `lamp.daed`; did you mean `lamp.dead`\?$"):
        chosen(CATALOGUE, ["lamp.daed"])


def rows_of(*names: str, ended: Result = STOPPED, unbraked: str = "") -> list[FaultRow]:
    tried = [trial_of(Fault(name=name), CATALOGUE, ended, [], braked=name != unbraked) for name in names]
    return [FaultRow(trial=0, seed=0, condition=each.name, tried=each) for each in tried]


def test_outcomes_are_counted() -> None:
    rows = rows_of(*CATALOGUE.kinds, unbraked="lamp.dead")
    found = figures(FAULTS, rows)
    assert FAULTS.summary(rows) == ["3 faults: 1 unbraked, 1 misnamed, 1 stopped; 1 undetected"]
    assert (found.n, found.right, found.silent_failures, found.exit_code) == (3, 1, 1, 3)


def test_the_matrix_of_the_pump_has_thirty_faults_and_more() -> None:
    assert len(task().faults(WorldSpec(seed=0)).matrix) >= 30


@pytest.mark.slow
def test_brakes_hold_until_the_arm_is_driven() -> None:
    cell = task().cell(WorldSpec(seed=3), "ray")
    assert brakes_hold(cell)
    cell.devices.arm.drive(np.zeros(6))
    assert not brakes_hold(cell)
    cell.advance(1 / 60)
    cell.devices.arm.drive(None)
    assert not brakes_hold(cell)  # told, and not yet done
    cell.advance(1 / 60)
    assert brakes_hold(cell)


@pytest.fixture
def unnoticed(monkeypatch: pytest.MonkeyPatch) -> list[str]:
    """Each fault goes unnoticed, and the third trial is Ctrl-C; the conditions that were tried."""
    tried: list[str] = []

    def work(self: FaultWork, case: Case) -> list[FaultRow]:
        if len(tried) == 2:
            raise KeyboardInterrupt
        tried.append(case.condition)
        (row,) = rows_of("picture.frozen", ended=RIGHT)
        return [msgspec.structs.replace(row, trial=case.trials[0], seed=case.seed, condition=case.condition)]

    monkeypatch.setattr(FaultWork, "__call__", work)
    return tried


@pytest.mark.usefixtures("unnoticed")
def test_the_matrix_that_is_interrupted_tells_what_has_ended_and_goes_on_there(
    command: Command, unnoticed: list[str]
) -> None:
    words = ("faults", "--jobs", "1", "--only", "picture", "--only", "panic", "--out", "kept")
    code, out, err = command(*words)
    assert (code, "2 faults: 2 unnoticed; 2 undetected" in out) == (130, True)
    assert "2 trials saved in kept; the same command continues the batch" in err
    first = unnoticed.copy()
    unnoticed.clear()
    assert command(*words)[0] in (3, 130)
    assert not {*first} & {*unnoticed}


@pytest.mark.slow
@pytest.mark.usefixtures("unnoticed")
def test_the_matrix_takes_worlds_by_name_and_slices_of_it_share_a_folder(
    command: Command, unnoticed: list[str]
) -> None:
    words = ("faults", "--jobs", "1", "--out", "kept", "--only", "picture.dark", "--seeds")
    assert command(*words, "7,3")[0] == 3
    unnoticed.clear()
    assert command(*words, "7,3", "--only", "lamp.dead")[0] == 3
    kept = [(row.condition, row.trial, row.seed) for row in read_batch(Path("kept"))[1]]
    assert kept == [
        (name, k, seed) for name in ("lamp.dead", "picture.dark") for k, seed in enumerate((7, 3))
    ]


@pytest.mark.slow
def test_a_fault_that_sets_in_with_a_stage_ends_alike_in_a_whole_run_and_from_a_sound_one(
    tmp_path: Path,
) -> None:
    world = WorldSpec(seed=3)
    stuck = task().faults(world).kind("gap_potentiometer.stuck").usual(2)
    plan = plan_of('  STAGE "a"\n  OPEN 1\n  STAGE "b"\n  OPEN 2\n')
    whole = FaultWork(plan=plan, world=world, faults={"stuck": stuck}, camera="ray")
    case = Case(trials=(0,), seed=3, condition="stuck")
    (row,) = whole(case)
    assert (row.stage, row.verdict) == ("b", "stopped")
    assert replace(whole, sound=tmp_path)(case) == [row]


@pytest.mark.usefixtures("unnoticed")
def test_a_fault_that_goes_undetected_has_an_exit_code_of_its_own(command: Command) -> None:
    words = ("faults", "--jobs", "1", "--only", "picture.frozen", "--json")
    code, out, _ = command(*words)
    told = json.loads(out)
    assert (code, told["n"], told["undetected"]) == (3, 1, 1)
    assert {"name", "outcome", "stage", "message"} <= told["faults"][0].keys()


@pytest.mark.parametrize("words", [("--only", "rotr"), ("--all", "--only", "rotor"), ("--jobs", "0")])
def test_what_cannot_be_tried_is_bad_input(command: Command, words: tuple[str, ...]) -> None:
    code, out, err = command("faults", *words)
    assert (code, out, err.count("\n")) == (2, "", 1)


def test_the_panic_button_is_hit_once_in_the_middle_of_its_stage() -> None:
    button = PanicInStage(1, periods=2)
    button.watching(cast("Runner", SimpleNamespace(listing=SimpleNamespace(stages=("a", "b")))))
    hit = []
    for stage in "ab":
        button.event(StageStarted(time=0.0, stage=stage))
        for _ in range(4):
            hit.append(button.down())
            button.tick(cast("ServoPeriod", None))
    assert hit == [False] * 6 + [True, False]


def test_the_panic_button_is_in_the_matrix_and_named_by_what_the_operator_is_told() -> None:
    catalogue = with_panic(task().faults(WorldSpec(seed=0)))
    assert "panic" in catalogue.matrix
    told = pause_sentence(Pause(kind="panic"))
    assert catalogue.kind("panic").expected.calls == (told,)


def test_what_sets_in_with_a_later_stage_than_a_program_has_sets_in_with_its_last() -> None:
    catalogue = with_panic(task("insertion").faults(WorldSpec(seed=0)))
    assert [*usual(catalogue, [catalogue.kind("panic")], None, 2)] == ["panic@2"]
