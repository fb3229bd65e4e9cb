"""Force moves the set-point of a compliant motion."""

import numpy as np
import pytest

from handeye.arm.model import ComplianceModel
from handeye.core.units import JIFFY
from handeye.execution.compliance import Course

DOWN = np.array([0.0, 0.0, -1.0])
K = ComplianceModel(
    gain=0.002, speed=0.02, turn_gain=0.2, turn_speed=0.3, turn_limit=0.25, ramp=4, friction=(),
)  # fmt: skip
"""An arm like none there is, so that figures of the Stanford arm would be seen."""


FRICTION = np.array([0.5, 0.6, 0.7, 0.1, 0.2, 0.3])
"""What joint friction is felt as along and about each axis, N and N m."""


def course(force: float | None, free: tuple[float, float, float] = (0, 0, 0)) -> Course:
    return Course(
        compliance=K,
        direction=DOWN,
        distance=0.01,
        speed=0.02,
        force=force,
        free=np.array(free, float),
        friction=FRICTION,
    )


def felt(x: float, y: float, z: float) -> np.ndarray:
    return np.array([x, y, z, 0.0, 0.0, 0.0])


def test_pressing_goes_on_while_force_is_missing() -> None:
    assert course(6.0).advance(felt(0, 0, 2.0), 0) == pytest.approx(4.0 * K.gain)


def test_pressing_stands_still_at_its_force_and_backs_off_beyond() -> None:
    assert course(6.0).advance(felt(0, 0, 6.0), 0) == 0
    assert course(6.0).advance(felt(0, 0, 8.0), 0) == pytest.approx(-2.0 * K.gain)


def test_no_force_makes_it_faster_than_the_greatest_speed() -> None:
    assert course(100.0).advance(felt(0, 0, 0), 0) == K.speed


def test_a_motion_that_does_not_press_ramps_up_to_its_speed() -> None:
    speeds = [course(None).advance(felt(0, 0, 0), tick) for tick in range(6)]
    assert speeds == pytest.approx([0.005, 0.01, 0.015, 0.02, 0.02, 0.02])


def test_the_hand_gives_way_along_free_axes_only() -> None:
    given = course(6.0, free=(1, 0, 0)).yielding(felt(2.0, 2.0, 2.0))
    assert given == pytest.approx([(2.0 - FRICTION[0]) * K.gain, 0, 0])


def test_what_friction_is_felt_as_moves_nothing() -> None:
    assert course(6.0, free=(1, 1, 1)).yielding(felt(*FRICTION[:3])) == pytest.approx([0, 0, 0])
    assert course(6.0, free=(1, 1, 1)).yielding(felt(*-FRICTION[:3])) == pytest.approx([0, 0, 0])


def rate(moment: tuple[float, float, float] = (0, 0, 0), spin: tuple[float, float, float] = (0, 0, 0), *,
         felt: tuple[float, float, float]) -> np.ndarray:  # fmt: skip
    """How fast the hand turns, rad/s, when it feels a moment (N m)."""
    course = Course(
        compliance=K,
        direction=DOWN,
        distance=0.01,
        speed=0.02,
        moment=np.array(moment, float),
        spin=np.array(spin, float),
        friction=FRICTION,
    )
    return course.turned(np.zeros(3), np.array([0.0, 0.0, 0.0, *felt]), JIFFY) / JIFFY


def test_the_hand_turns_about_the_axes_it_may_spin_about_only() -> None:
    assert rate(spin=(1, 0, 0), felt=(0.5, 0.5, 0.5)) == pytest.approx(
        [(0.5 - FRICTION[3]) * K.turn_gain, 0, 0]
    )
    assert rate(felt=(0.5, 0.5, 0.5)) == pytest.approx([0, 0, 0])


def test_what_friction_is_felt_as_turns_nothing() -> None:
    assert rate(spin=(1, 1, 1), felt=tuple(FRICTION[3:] * [1, -1, 1])) == pytest.approx([0, 0, 0])


def test_no_moment_makes_it_turn_faster_than_the_greatest_rate() -> None:
    assert rate(spin=(1, 1, 0), felt=(50, -50, 0)) == pytest.approx([K.turn_speed, -K.turn_speed, 0])


def test_turning_goes_on_while_moment_is_missing_and_back_beyond_it() -> None:
    assert rate(moment=(0, 0, 0.5), felt=(0, 0, 0)) == pytest.approx([0, 0, 0.5 * K.turn_gain])
    assert rate(moment=(0, 0, 0.5), felt=(0, 0, -0.5)) == pytest.approx([0, 0, 0])
    assert rate(moment=(0, 0, 0.5), felt=(0, 0, -0.8)) == pytest.approx([0, 0, -0.3 * K.turn_gain])


def test_about_the_axis_of_a_moment_to_exert_the_hand_does_not_spin_besides() -> None:
    both = rate(moment=(0, 0, 0.5), spin=(1, 0, 1), felt=(0.5, 0, -0.8))
    assert both == pytest.approx([(0.5 - FRICTION[3]) * K.turn_gain, 0, -0.3 * K.turn_gain])


def test_the_hand_turns_no_farther_than_the_most() -> None:
    course = Course(compliance=K, direction=DOWN, distance=0.01, speed=0.02, spin=np.ones(3))
    turn = np.zeros(3)
    for _ in range(1000):
        turn = course.turned(turn, np.array([0, 0, 0, 5.0, -5.0, 0.0]), JIFFY)
    assert np.linalg.norm(turn) == pytest.approx(K.turn_limit)
