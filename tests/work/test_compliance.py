"""Force moves the set-point of a compliant motion."""

import numpy as np
import pytest

from handeye.work.compliance import GAIN, GREATEST, NOISE, Course

DOWN = np.array([0.0, 0.0, -1.0])


def course(force: float | None, free: tuple[float, float, float] = (0, 0, 0)) -> Course:
    return Course(direction=DOWN, distance=0.01, speed=0.02, force=force, free=np.array(free, float))


def felt(x: float, y: float, z: float) -> np.ndarray:
    return np.array([x, y, z, 0.0, 0.0, 0.0])


def test_pressing_goes_on_while_force_is_missing() -> None:
    assert course(6.0).advance(felt(0, 0, 2.0), 0) == pytest.approx(4.0 * GAIN)


def test_pressing_stands_still_at_its_force_and_backs_off_beyond() -> None:
    assert course(6.0).advance(felt(0, 0, 6.0), 0) == 0
    assert course(6.0).advance(felt(0, 0, 8.0), 0) == pytest.approx(-2.0 * GAIN)


def test_no_force_makes_it_faster_than_the_greatest_speed() -> None:
    assert course(100.0).advance(felt(0, 0, 0), 0) == GREATEST


def test_a_motion_that_does_not_press_ramps_up_to_its_speed() -> None:
    speeds = [course(None).advance(felt(0, 0, 0), tick) for tick in range(8)]
    assert speeds == sorted(speeds)
    assert speeds[-1] == 0.02


def test_the_hand_gives_way_along_free_axes_only() -> None:
    given = course(6.0, free=(1, 0, 0)).yielding(felt(2.0, 2.0, 2.0))
    assert given == pytest.approx([(2.0 - NOISE) * GAIN, 0, 0])


def test_what_friction_is_felt_as_moves_nothing() -> None:
    assert course(6.0, free=(1, 1, 1)).yielding(felt(NOISE, -NOISE, 0)) == pytest.approx([0, 0, 0])
