"""CENTER and what plain closing does instead; refining the place of the base by touch."""

import pytest
from pump_bench import Bench, base_off, bench, stage, written

from handeye.errors import NOTHING_HELD
from handeye.pose import planar, yaw
from handeye.units import DEGREE, INCH

pytestmark = pytest.mark.slow

VISION_ERROR = (0.33, -0.25)
"""In x and y, in: what the vision of 1973 was good for."""


def closing(word: str, across: float = 0.0) -> Bench:
    """The hand .2 in off (and `across` the finger line) over the pump's top, which lies loose on the table."""
    T = written(25.0 + across, 38.2, 0.45, 90)
    top = planar(25 * INCH, 38 * INCH, 1e-5, 0.0)
    return bench(f"OPEN 2.8\nMOVE T\n{word} 1\nSAVE D", positions={"T": T}, lay={"top": top})


def feeling() -> Bench:
    return bench(stage("feel for the grasp"), world=base_off(*VISION_ERROR))


def test_row_24_center_moves_the_hand_to_the_object() -> None:
    run = closing("CENTER").go()
    assert run.finished
    assert all(run.run.drive.sensed.touch)
    assert run.hand()[1] == pytest.approx(38.0, abs=0.015)


def test_row_24_center_leaves_the_object_where_it_is() -> None:
    assert closing("CENTER").go().moved("top") < 0.01


def test_row_25_closing_drags_the_object_to_the_hand() -> None:
    """Not all of the .2 in: the arm gives way a little under the object's friction."""
    assert closing("CLOSE").go().moved("top") == pytest.approx(0.2, abs=0.06)


def test_row_26_center_on_nothing_raises_error_2_at_the_minimum_gap() -> None:
    run = bench("OPEN 1.775\nMOVE T\nCENTER .5", positions={"T": written(25, 38, 4, 0)}).go()
    assert run.called.error == NOTHING_HELD
    assert run.run.drive.sensed.gap / INCH == pytest.approx(0.5, abs=0.02)


def test_row_27_center_measures_along_the_finger_line_only() -> None:
    run = closing("CENTER", across=0.1).go()
    assert run.saved("D") == pytest.approx([0.0, -0.2, 0.0], abs=0.015)
    assert run.saved("D")[[0, 2]] == pytest.approx([0.0, 0.0], abs=1e-9)


def test_row_28_two_grasp_points_give_the_place_of_the_base_within_a_tenth() -> None:
    run = feeling().to("OPEN    1.85")
    felt = run.saved("DA") + run.saved("DB")
    assert felt[:2] == pytest.approx(VISION_ERROR, abs=0.1)


def test_row_28_feeling_leaves_the_base_as_it_was() -> None:
    run = feeling()
    turn = yaw(run.pose("base"))
    run.go()
    assert run.finished
    assert run.moved("base") < 0.02
    assert yaw(run.pose("base")) == pytest.approx(turn, abs=0.5 * DEGREE)
