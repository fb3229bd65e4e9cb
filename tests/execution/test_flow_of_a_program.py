"""Counts, searches, circles and calls to the operator, as the executor carries them out."""

import numpy as np
import pytest
from fake_runs import fake_run
from synthetic import part

from handeye.core.errors import GASKET_WRONG, PART_ASTRAY, SEARCH_EXHAUSTED, WRONG_TRAVEL
from handeye.execution import executor
from handeye.ports.camera import COLUMNS, ROWS, Picture
from handeye.program.diagnosis.causes import Looping
from handeye.program.events import PartMatched, SearchAdvanced
from handeye.program.program import Hole, Part

HOLES = (Hole(x=0.0, y=0.0, diameter=0.05), Hole(x=0.07, y=0.0, diameter=0.03))


def test_a_counted_loop_is_gone_through_as_often_as_it_says() -> None:
    run = fake_run("ASSIGN N 3\nL: OPEN 2\nSOJG N,L").go()
    assert run.steps.count("OPEN 2") == 3


def test_a_search_tries_forty_nine_places() -> None:
    run = fake_run("SEARCH .1\nL: AOJ L").go()
    assert len(run.all(SearchAdvanced)) == 48
    assert run.errors == [SEARCH_EXHAUSTED]


@pytest.mark.parametrize(
    ("limits", "errors"), [(".2 .4", []), (".4 .5", [WRONG_TRAVEL]), (".1 .2", [WRONG_TRAVEL])]
)
def test_travel_raises_an_error_on_either_side_of_its_limits(limits: str, errors: list[int]) -> None:
    assert fake_run(f"CHANGE [0 0 1] .3\nTRAVEL {limits}").go().errors == errors


def test_pictures_that_show_no_gasket_raise_an_error() -> None:
    run = fake_run(
        "AIM PUMP\nLOOK A\nLOOK B\nINSPECT PUMP A B",
        parts={"PUMP": Part(at=(1.1, 0.7, 0.0, 0.0), holes=HOLES)},
    )
    assert run.go().errors == [GASKET_WRONG]


def patches(seed: int) -> Picture:
    """A picture of squares of any levels, without noise."""
    levels = np.random.default_rng(seed).integers(0, 15, (ROWS // 8 + 1, COLUMNS // 8 + 1), np.uint8)
    return levels.repeat(8, axis=0).repeat(8, axis=1)[:ROWS, :COLUMNS].copy()


def test_pictures_in_which_a_part_does_not_stand_alike_raise_an_error() -> None:
    run = fake_run("AIM PUMP\nLOOK A\nLOOK B\nMATCH PUMP A B", parts={"PUMP": part()})
    run.cell.camera.pictures = [patches(k) for k in range(2)]
    assert run.go().errors == [PART_ASTRAY]
    (matched,) = run.all(PartMatched)
    assert (matched.part, matched.ok, matched.unlike > 0.5) == ("PUMP", False, True)


def test_pictures_in_which_a_part_stands_alike_raise_none() -> None:
    run = fake_run("AIM PUMP\nLOOK A\nLOOK B\nMATCH PUMP A B", parts={"PUMP": part()})
    picture = patches(0)
    other = picture.copy()
    other[0, 0] += 1  # what is the same to the last point is no live picture
    run.cell.camera.pictures = [picture, other]
    assert run.go().errors == []
    assert [event.ok for event in run.all(PartMatched)] == [True]


def test_a_circle_in_which_no_time_passes_is_stopped(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(executor, "IDLE_LIMIT", 3)
    run = fake_run("L: WHERE\nJUMP L").go()
    assert isinstance(run.executor.state.stopped.cause, Looping)


def test_steps_that_take_time_are_no_circle_however_many(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(executor, "IDLE_LIMIT", 3)
    assert not fake_run("OPEN 2\nOPEN 2.1\n" * 3).go().called


def test_brakes_are_set_and_the_screwdriver_stands_when_the_operator_is_called() -> None:
    run = fake_run("TOOL 90\nOPEN 2\nWAIT LOOK").go()
    assert run.called
    assert (run.cell.arm.braked, run.cell.screwdriver.speed) == (True, 0.0)
