"""What the program believes of a part once it has looked at it with the fake camera, which shows drawn pictures."""

import numpy as np
import pytest
from fake_runs import fake_run
from looked_runs import GRASP, PART, POSE, SCRIPT, looked

from handeye.core.errors import PART_NOT_SEEN
from handeye.core.pose import yaw
from handeye.core.units import DEGREE, INCH


def test_a_part_is_believed_where_its_holes_were_seen() -> None:
    run = looked()
    assert run.errors == []
    X_WP = run.executor.run.world.part("PUMP")
    assert X_WP[:2, 3] == pytest.approx(POSE[:2], abs=0.03 * INCH)
    assert yaw(X_WP) == pytest.approx(POSE[2], abs=0.6 * DEGREE)
    assert X_WP[2, 3] == PART.at[2]


def test_the_line_of_the_first_grasp_goes_from_finger_to_finger_where_the_part_was_seen() -> None:
    run = looked(GRASP).executor.run
    found, view = run.state.found["NEAR"], run.state.shots["NEAR"].view
    assert found.grasp is not None
    ends = view.back_project(np.array(found.grasp), PART.at[2] + PART.face)[:, :2]
    x, y, turn = POSE
    along = np.array([-np.sin(turn), np.cos(turn)])
    fingers = [(x, y) + along * (1.53 + side * 0.9) * INCH for side in (-1, 1)]
    assert np.sort(ends, axis=0) == pytest.approx(np.sort(fingers, axis=0), abs=0.04 * INCH)


@pytest.mark.parametrize("then", ["WHERE", "OPEN 1.8\nMOVE T\nCLOSE .5", "OPEN 1.8\nMOVE WALL\nOPEN 2"])
def test_a_part_that_is_not_grasped_has_no_line_of_a_grasp(then: str) -> None:
    assert looked(then).executor.run.state.found["NEAR"].grasp is None


def test_a_part_that_is_not_in_the_picture_is_believed_where_it_was() -> None:
    run = fake_run(SCRIPT, parts={"PUMP": PART}).go()
    assert run.errors == [PART_NOT_SEEN]
    assert run.executor.run.world.state.measured == {}


def test_what_was_found_in_a_picture_is_forgotten_when_another_takes_its_name() -> None:
    assert "NEAR" in looked().executor.state.found
    assert "NEAR" not in looked(end="LOOK NEAR").executor.state.found
