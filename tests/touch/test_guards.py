import numpy as np
import pytest

from handeye.core.units import OUNCE_FORCE
from handeye.program.guards import Against, AnyGuard, Force, GuardKind, Moment, Torque, Touch
from handeye.touch.guards import Monitor, Reading, Trip, monitor

DOWN = np.array([0.0, 0.0, -1.0])
HELD = 4
"""Servo periods for which a torque has to last: in less the spindle is up to speed."""


def pressing(ounces: tuple[float, float, float], direction: np.ndarray = DOWN) -> Reading:
    return Reading(force=np.array(ounces) * OUNCE_FORCE, direction=direction)


def watching(*guards: AnyGuard) -> Monitor:
    found = monitor(guards)
    assert found is not None
    return found


def test_a_motion_without_guards_is_not_watched() -> None:
    assert monitor(()) is None


def test_a_force_guard_trips_beyond_the_length_of_its_vector() -> None:
    guard = watching(Force(force=(0, 0, -50 * OUNCE_FORCE)))
    assert guard.check(pressing((0, 0, -49.9))) is None
    trip = guard.check(pressing((0, 0, -51)))
    assert trip is not None
    assert trip.guard is GuardKind.FORCE
    assert trip.value == pytest.approx(51 * OUNCE_FORCE)
    assert trip.limit == pytest.approx(50 * OUNCE_FORCE)


def test_a_force_guard_does_not_mind_the_side_or_the_other_way() -> None:
    guard = watching(Force(force=(0, 0, -50 * OUNCE_FORCE)))
    assert guard.check(pressing((80, 0, 0))) is None
    assert guard.check(pressing((0, 0, 80))) is None


def turning(x: float, y: float, z: float) -> Reading:
    return Reading(force=100 * DOWN, direction=DOWN, moment=np.array([x, y, z]))


def test_a_moment_guard_trips_beyond_the_length_of_its_vector_and_minds_no_force() -> None:
    guard = watching(Moment(moment=(0, 0.2, 0)))
    assert guard.check(turning(9, 0.19, 9)) is None
    assert guard.check(turning(0, -0.3, 0)) is None
    assert guard.check(turning(0, 0.3, 0)) == Trip(
        guard=GuardKind.MOMENT, value=pytest.approx(0.3), limit=0.2
    )


@pytest.mark.parametrize(
    ("mask", "trips"),
    [(1, [False, True, False, True]), (2, [False, False, True, True]), (3, [False, True, True, True])],
)
def test_a_touch_guard_trips_on_the_fingers_of_its_mask(mask: int, trips: list[bool]) -> None:
    fingers = [(False, False), (True, False), (False, True), (True, True)]
    readings = [Reading(force=0 * DOWN, direction=DOWN, touch=touch) for touch in fingers]
    assert [watching(Touch(fingers=mask)).check(reading) is not None for reading in readings] == trips


def test_of_several_guards_the_first_that_trips_ends_the_motion() -> None:
    guard = watching(Against(force=200.0), Moment(moment=(0, 0.2, 0)))
    assert guard.check(turning(0, 0.1, 0)) is None
    trip = guard.check(turning(0, 0.3, 0))
    assert trip is not None
    assert trip.guard is GuardKind.MOMENT


@pytest.mark.parametrize("direction", np.eye(3))
def test_an_against_guard_looks_where_the_motion_goes(direction: np.ndarray) -> None:
    guard = watching(Against(force=10.0))
    assert guard.check(Reading(force=11 * direction, direction=direction)) is not None
    assert guard.check(Reading(force=-11 * direction, direction=direction)) is None
    assert guard.check(Reading(force=9 * direction, direction=direction)) is None


def answers(*torques: float) -> list[bool]:
    """Trips of a guard for .3 N m, period by period."""
    guard = watching(Torque(torque=0.3))
    readings = [Reading(force=100 * DOWN, direction=DOWN, tool_torque=torque) for torque in torques]
    return [guard.check(reading) is not None for reading in readings]


def test_a_torque_guard_trips_when_the_motor_holds_its_torque() -> None:
    assert answers(0.29, *[0.3] * HELD) == [False] * HELD + [True]


def test_a_torque_guard_does_not_mind_an_instant() -> None:
    assert not any(answers(*[0.4] * (HELD - 1), 0.1, *[0.4] * (HELD - 1)))


def test_a_torque_guard_minds_neither_force_nor_the_sense_of_turning() -> None:
    assert answers(*[0.0] * HELD) == [False] * HELD
    assert answers(*[-0.4] * HELD)[-1]
