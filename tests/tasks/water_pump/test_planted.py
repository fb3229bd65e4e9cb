"""The referee takes no planted wrong pump for a right one, and no right one for a wrong one."""

import pytest
from finished import finished, rested
from planted import right
from planted import wrong as planted_wrong

from handeye.cell.truth import Truth
from handeye.judge.finding import all_right
from handeye.tasks.water_pump.referee import limits, measure
from handeye.tasks.water_pump.referee.findings import judge

pytestmark = pytest.mark.slow

WRONG = {what: (finding, planting) for what, finding, planting in planted_wrong()}
RIGHT = {what: (seed, planting) for what, seed, planting in right()}


@pytest.fixture
def at_once(monkeypatch: pytest.MonkeyPatch) -> None:
    """The referee does not wait for parts to settle: it finds less then, and never more."""
    rested()
    monkeypatch.setattr(limits, "SETTLE", 0.0)


@pytest.fixture
def free_rotor(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(measure, "rotor_torque", lambda _: 0.0)


def found(truth: Truth) -> set[str]:
    return {name for name, finding in judge(truth).items() if finding.refuses}


def test_there_are_enough_of_both() -> None:
    assert (len(WRONG), len(RIGHT)) >= (90, 20)


@pytest.mark.usefixtures("at_once", "free_rotor")
@pytest.mark.parametrize("what", [what for what, (finding, _) in WRONG.items() if finding != "rotor"])
def test_a_wrong_pump_is_found(what: str) -> None:
    finding, planting = WRONG[what]
    assert finding in found(planting(rested()))


@pytest.mark.usefixtures("at_once")
@pytest.mark.parametrize("what", [what for what, (finding, _) in WRONG.items() if finding == "rotor"])
def test_a_wrong_rotor_is_found_and_nothing_else(what: str) -> None:
    _, planting = WRONG[what]
    assert "rotor" in (wrong := found(planting(rested())))
    assert wrong <= {"rotor", "as_drawn", "pins"}


@pytest.mark.usefixtures("free_rotor")
@pytest.mark.parametrize("what", [what for what in RIGHT if not what.startswith("rotor")])
def test_a_right_pump_is_right(what: str) -> None:
    seed, planting = RIGHT[what]
    assert found(planting(finished(seed))) == set()


@pytest.mark.parametrize("what", [what for what in RIGHT if what.startswith("rotor")])
def test_a_right_rotor_is_right(what: str) -> None:
    _, planting = RIGHT[what]
    assert all_right(judge(planting(finished())))
