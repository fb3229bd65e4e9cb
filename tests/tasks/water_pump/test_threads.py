"""The thread model on a bench of its own."""

from functools import cache

import pytest
from thread_bench import Outcome, drive_screw


@cache
def outcome(offset: float = 0.0, tilt: float = 0.0) -> Outcome:
    return drive_screw(offset=offset, tilt=tilt)


@pytest.mark.parametrize(("offset", "tilt"), [(0.0, 0.0), (0.001, 0.0), (0.0, 0.03)])
def test_an_aligned_screw_seats_and_stalls_the_motor(offset: float, tilt: float) -> None:
    end = outcome(offset, tilt)
    assert end.torque > 0.28
    assert abs(end.height) < 2e-4  # m: soft contact under the clamp
    assert not end.thread.crossed


def test_a_seated_screw_clamps_what_lies_under_its_head() -> None:
    assert 100 < outcome().thread.clamp < 250  # N; the study measured 113-175 N at .3 N m


@pytest.mark.slow
def test_a_screw_two_millimetres_off_never_engages_and_meets_no_torque() -> None:
    end = outcome(offset=0.002)
    assert end.thread.screw is None
    assert end.torque < 0.06
    assert end.height > 0.005


def test_a_screw_that_is_turned_too_slowly_never_engages() -> None:
    assert drive_screw(speed=2.5, seconds=4.0).thread.screw is None


def test_a_tilted_screw_crosses_and_jams_high() -> None:
    end = outcome(tilt=0.07)
    assert end.thread.crossed
    assert end.torque > 0.28
    assert end.height > 0.004


@pytest.mark.slow
def test_a_screw_seats_the_same_to_the_last_bit_every_time() -> None:
    assert drive_screw(tilt=0.02) == drive_screw(tilt=0.02)
