"""What the program believes of a part once it has looked at it with the fake camera, which shows drawn pictures."""

import numpy as np
import pytest
from fake_runs import FakeRun, fake_run
from synthetic import Canvas, draw_base, part, view

from handeye.errors import PART_NOT_SEEN
from handeye.ports.camera import Picture
from handeye.pose import yaw
from handeye.program.program import Position
from handeye.units import DEGREE, INCH

PART = part()
POSE = (43.0 * INCH, 26.0 * INCH, 70 * DEGREE)
"""x, y and yaw of the base, an inch or two and 20 degrees from where the program expects it."""
SCRIPT = "LENS 25\nAIM PUMP\nLOOK WIDE\nGENERAL PUMP WIDE\nLENS 50\nAIM PUMP\nLOOK NEAR\nSPECIFIC PUMP NEAR"


def aimed(lens: float, x: float, y: float) -> Picture:
    """The picture of the base that the camera takes, aimed at a part believed to lie there (m)."""
    holes = np.array([PART.holes[1].x / 2, 0.0])
    turn = np.array([[np.cos(PART.at[3]), -np.sin(PART.at[3])], [np.sin(PART.at[3]), np.cos(PART.at[3])]])
    middle = turn @ holes + (x, y)
    where, canvas = view(lens, (*middle, PART.at[2] + PART.face)), Canvas()
    draw_base(canvas, where, PART, POSE)
    return canvas.picture()


WALL = Position(at=(0.0, 1.53 * INCH, 2.75 * INCH, 90 * DEGREE, 90 * DEGREE, 0.0), of="PUMP")
"""Where the hand takes the wall beside the large hole, the finger line across it."""
GRASP = "OPEN 1.8\nMOVE WALL\nCLOSE .5"


def looked(then: str = "WHERE") -> FakeRun:
    """The base was found in a wide picture, the camera aimed anew, and its holes found in a close one."""
    script = f"{SCRIPT}\nJUMP END\n{then}\nEND: WHERE"
    run = fake_run(script, parts={"PUMP": PART}, positions={"WALL": WALL})
    run.cell.camera.pictures = [aimed(0.025, *PART.at[:2])]
    while "LENS 50" not in run.steps:
        run.executor.step()
    believed = run.executor.run.world.part("PUMP")
    run.cell.camera.pictures = [aimed(0.050, *believed[:2, 3])]
    return run.go()


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
