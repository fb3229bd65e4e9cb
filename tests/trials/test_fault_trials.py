"""What a run with a fault came to is judged by the error that should name it."""

import msgspec
import pytest
from results import result

from handeye.errors import InvalidInput
from handeye.events import StepStarted
from handeye.faults import Catalogue, Expected, Fault, FaultKind
from handeye.report.result import Result
from handeye.trials.faults import chosen, counted_verdicts, trial_of, verdict

STOPPED = result(completed=False, assembled=None, message="the gasket is not on properly")  # with error 32
CALLED = msgspec.structs.replace(STOPPED, error=None, message="THE ROTOR IS HARD TO TURN")
SET_UP = msgspec.structs.replace(STOPPED, error=None, stopped_at=None)
RIGHT, WRONG = (result(completed=True, assembled=assembled) for assembled in (True, False))

CATALOGUE = Catalogue(
    FaultKind(name="lamp.dead", meaning="", expected=Expected(at_setup=True)),
    FaultKind(name="picture.dark", meaning="", expected=Expected(at_setup=True, errors=(30,))),
    FaultKind(name="picture.frozen", meaning="", expected=Expected(errors=(30, 32))),
)


@pytest.mark.parametrize(
    ("expected", "ended", "found"),
    [
        (Expected(errors=(30, 32)), STOPPED, "noticed"),
        (Expected(errors=(23,)), STOPPED, "stopped"),
        (Expected(at_setup=True), SET_UP, "noticed"),
        (Expected(errors=(32,)), SET_UP, "stopped"),
        (Expected(calls=("THE ROTOR IS HARD TO TURN",)), CALLED, "noticed"),
        (Expected(at_setup=True, errors=(32,)), CALLED, "stopped"),
        (Expected(errors=(32,)), RIGHT, "unnoticed"),
        (Expected(harmless="It is."), RIGHT, "harmless"),
        (Expected(harmless="It is."), STOPPED, "stopped"),
        (Expected(harmless="It is."), WRONG, "silent"),
        (Expected(errors=(32,)), WRONG, "silent"),
    ],
)
def test_a_verdict_asks_for_the_right_name(expected: Expected, ended: Result, found: str) -> None:
    assert verdict(expected, ended) == found


def test_a_trial_tells_where_the_run_stopped() -> None:
    events = [StepStarted(time=1.0, step=n, line=line, text="") for n, line in enumerate((7, 9))]
    trial = trial_of(Fault(name="picture.frozen", stage=2), CATALOGUE, STOPPED, events)
    assert (trial.fault, trial.stage, trial.line, trial.error, trial.verdict) == (
        "picture.frozen@2", "check the gasket", "9", 32, "noticed",
    )  # fmt: skip


def test_faults_are_chosen_by_name_and_by_group() -> None:
    assert [kind.name for kind in chosen(CATALOGUE, ["picture", "picture.dark", "lamp.dead"])] == [
        "picture.dark", "picture.frozen", "lamp.dead",
    ]  # fmt: skip
    assert len(chosen(CATALOGUE, [])) == 3
    with pytest.raises(InvalidInput, match=r"^there is no fault `lamp.daed`; did you mean `lamp.dead`\?$"):
        chosen(CATALOGUE, ["lamp.daed"])


def test_verdicts_are_counted() -> None:
    trials = [trial_of(Fault(name=name), CATALOGUE, STOPPED, []) for name in CATALOGUE.kinds]
    assert counted_verdicts(trials) == "2 stopped, 1 noticed"
