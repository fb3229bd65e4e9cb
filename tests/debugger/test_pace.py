"""Pace: how long this computer waits, by a clock that a test winds."""

from types import SimpleNamespace

import pytest

from handeye.core.errors import InvalidInput
from handeye.debugger.live import Pace, factor


class WoundClock:
    """A clock of this computer that passes only while somebody sleeps, or winds it."""

    def __init__(self) -> None:
        self.now = 100.0

    def __call__(self) -> float:
        return self.now

    def pass_(self, seconds: float) -> None:
        self.now += seconds


def paced(factor: float | None) -> tuple[Pace, WoundClock]:
    clock = WoundClock()
    return Pace(factor, clock=clock, sleep=clock.pass_), clock


def go(pace: Pace, begin: float, end: float) -> None:
    """Let servo periods of a quarter of a second pass."""
    for quarter in range(round(4 * begin), round(4 * end) + 1):
        pace.tick(SimpleNamespace(sensed=SimpleNamespace(time=quarter / 4)))


@pytest.mark.parametrize(("times", "seconds"), [(1.0, 8.0), (4.0, 2.0), (0.25, 32.0), (None, 0.0)])
def test_a_run_takes_as_long_as_its_pace_says(times: float | None, seconds: float) -> None:
    pace, clock = paced(times)
    go(pace, 50, 58)
    assert clock.now == pytest.approx(100 + seconds)


def test_time_that_the_simulation_takes_is_part_of_it() -> None:
    pace, clock = paced(1.0)
    go(pace, 0, 0)
    clock.pass_(0.2)
    go(pace, 0.25, 0.25)
    assert clock.now == pytest.approx(100.25)


def test_a_run_that_was_long_late_does_not_race_to_catch_up() -> None:
    pace, clock = paced(1.0)
    go(pace, 0, 1)
    clock.pass_(5.0)
    go(pace, 1.25, 3.5)
    assert clock.now == pytest.approx(106 + 2.25)


def test_what_passes_while_the_run_pauses_is_not_made_good() -> None:
    pace, clock = paced(1.0)
    go(pace, 0, 1)
    clock.pass_(60.0)
    go(pace, 1, 2)
    assert clock.now == pytest.approx(162)


def test_a_run_that_went_back_goes_at_its_pace_from_there() -> None:
    pace, clock = paced(1.0)
    go(pace, 7, 8)
    go(pace, 2, 3)
    assert clock.now == pytest.approx(102)


def test_a_new_pace_counts_from_when_it_was_set() -> None:
    pace, clock = paced(1.0)
    go(pace, 0, 1)
    pace.factor = 4.0
    go(pace, 1.25, 5.25)
    assert clock.now == pytest.approx(102)


@pytest.mark.parametrize(("text", "times"), [("1x", 1), ("4", 4), ("4X", 4), (".5x", 0.5), ("Free", None)])
def test_a_pace_is_a_number_of_times_or_free(text: str, times: float | None) -> None:
    assert factor(text) == times


@pytest.mark.parametrize("text", ["0x", "x", "-1x", "1e3", "101x", "0.1", "nan", "4 x", "slow", "٤x"])
def test_anything_else_is_no_pace(text: str) -> None:
    with pytest.raises(
        InvalidInput, match=r"^`pace` takes `1x`, `4x`, another number from 0\.25x to 100x, or `free`, not `"
    ):
        factor(text)


@pytest.mark.parametrize(
    ("times", "said"),
    [(None, "as fast as possible"), (1, "real time"), (2.5, "2.5 times real time")],
)
def test_a_pace_is_told_in_words(times: float | None, said: str) -> None:
    assert str(Pace(times)) == said
