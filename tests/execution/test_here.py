"""HERE: a position defined by where the hand is, carried out in the cell."""

import numpy as np
import pytest
from pump_bench import TAUGHT, Bench, bench, shifted

from handeye.core.mutable_records import copied
from handeye.core.units import INCH
from handeye.program.events import PositionDefined, StepFinished
from handeye.program.program import Position

pytestmark = pytest.mark.slow

ASTRAY = {"P1": TAUGHT.positions["P1"], "OFF": shifted("P1", y=0.1)}
"""A pin, and where somebody who taught it a tenth of an inch off thinks it is."""


def hand_after(run: Bench, text: str) -> np.ndarray:
    """Where the hand was (in) when the last step of this text had been done."""
    steps = run.run.plan.program.steps
    ends = [e for e in run.all(StepFinished) if steps[e.step].text == text]
    return np.array(ends[-1].hand) / INCH


def test_move_to_a_position_defined_here_goes_to_where_the_hand_was_and_not_where_it_was_planned() -> None:
    run = bench("OPEN 1\nMOVE OFF\nCENTER .1\nHERE PIN\nOPEN 1\nPARK\nMOVE PIN", positions=ASTRAY).go()
    felt, again = hand_after(run, "CENTER .1"), hand_after(run, "MOVE PIN")
    assert np.linalg.norm(felt - hand_after(run, "MOVE OFF")) > 0.05
    assert again == pytest.approx(felt, abs=0.03)


def test_here_on_a_taught_position_of_a_part_keeps_to_the_part() -> None:
    run = bench("MOVE T1\nCHANGE Z 1\nHERE T1", positions={}).go()
    (defined,) = run.all(PositionDefined)
    assert defined.of == "PUMP"
    taught = np.array(TAUGHT.positions["T1"].at[:3])
    assert (np.array(defined.at[:3]) - taught) / INCH == pytest.approx((0, 0, 1), abs=0.05)


def test_what_is_defined_here_is_remembered_with_the_rest() -> None:
    run = bench("CHANGE Z 1\nHERE PIN\nPARK").to("PARK")
    kept = copied(run.run.state)
    there = run.run.world.state.moved["PIN"]
    run.run.world.state.moved["PIN"] = Position(at=(0.0,) * 6)
    run.run.restore(kept)
    assert run.run.world.state.moved == {"PIN": there}
