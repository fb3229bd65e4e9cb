from dataclasses import dataclass

import pytest

from handeye.core.errors import NOTHING_HELD, SWITCH_WRONG
from handeye.core.units import INCH, JIFFY
from handeye.touch.centring import EASING, Centring
from handeye.touch.senses import least_gap

SPEED = 0.5 * INCH
TRAVEL = 0.00025
"""A switch closes this much before its finger pushes (m)."""


@dataclass
class Bench:
    """A hand over an object on one line: fingers at hand +- gap / 2 that push what they meet."""

    centre: float
    width: float
    hand: float = 0.0
    gap: float = 3 * INCH

    def touch(self) -> tuple[bool, bool]:
        return (
            self.centre + self.width / 2 + TRAVEL >= self.hand + self.gap / 2,
            self.centre - self.width / 2 - TRAVEL <= self.hand - self.gap / 2,
        )

    def push(self) -> None:
        """A finger that is inside the object moves it out of its way."""
        room = max(self.gap - self.width, 0.0) / 2
        self.centre = min(max(self.centre, self.hand - room), self.hand + room)

    def run(self, centring: Centring) -> int:
        for tick in range(1000):
            step = centring.step(touch=self.touch(), gap=self.gap, period=JIFFY)
            if centring.done:
                return tick
            self.gap, self.hand = max(self.gap + step.gap, 0.0), self.hand + step.hand
            self.push()
        raise AssertionError("never done")


@pytest.mark.parametrize("off", [0.2 * INCH, -0.2 * INCH, 0.9 * INCH])
def test_the_hand_moves_to_the_object_and_not_the_object_to_the_hand(off: float) -> None:
    bench = Bench(centre=off, width=1.2 * INCH)
    centring = Centring(speed=SPEED)
    bench.run(centring)
    assert centring.error == 0
    assert bench.touch() == (True, True)
    assert bench.centre == off
    assert bench.hand == pytest.approx(off, abs=0.01 * INCH)
    assert bench.gap == pytest.approx(1.2 * INCH, abs=2 * TRAVEL)


def test_the_finger_that_touched_first_comes_off_while_the_hand_moves() -> None:
    for touch, side in (((True, False), 1), ((False, True), -1)):
        step = Centring(speed=SPEED).step(touch=touch, gap=INCH, period=JIFFY)
        assert step.gap < 0
        assert step.hand * side > -step.gap / 2


@pytest.mark.parametrize("off", [0.2 * INCH, -0.1 * INCH])
def test_switches_that_are_exchanged_are_told_when_the_finger_that_touches_does_not_come_off(
    off: float,
) -> None:
    bench = Bench(centre=off, width=1.2 * INCH)
    told = bench.touch
    bench.touch = lambda: told()[::-1]  # type: ignore[method-assign]
    centring = Centring(speed=SPEED)
    bench.run(centring)
    assert centring.error == SWITCH_WRONG
    assert abs(bench.centre - off) < 2 * EASING


def test_both_fingers_close_while_none_touches() -> None:
    step = Centring(speed=SPEED).step(touch=(False, False), gap=INCH, period=JIFFY)
    assert step.gap == pytest.approx(-SPEED * JIFFY)
    assert step.hand == 0


def test_a_finger_that_loses_its_object_closes_on_it_again() -> None:
    centring = Centring(speed=SPEED)
    centring.step(touch=(True, False), gap=INCH, period=JIFFY)
    step = centring.step(touch=(False, False), gap=INCH, period=JIFFY)
    assert step.gap < 0
    assert step.hand == 0


@pytest.mark.parametrize("minimum", [0.0, 0.1 * INCH])
def test_centring_on_nothing_ends_with_an_error_at_the_minimum(minimum: float) -> None:
    bench = Bench(centre=10.0, width=0.0)
    bench.touch = lambda: (False, False)  # type: ignore[method-assign]  # switches that never fire
    centring = Centring(minimum=minimum, speed=SPEED)
    bench.run(centring)
    assert centring.error == NOTHING_HELD
    assert bench.gap == pytest.approx(least_gap(minimum), abs=0.03 * INCH)


def test_fingers_that_stall_without_touching_end_with_an_error() -> None:
    centring = Centring(speed=SPEED)
    for _ in range(1000):
        centring.step(touch=(False, False), gap=INCH, period=JIFFY)
    assert centring.done
    assert centring.error == NOTHING_HELD


def test_an_object_touched_on_both_sides_is_centred_at_once() -> None:
    centring = Centring(speed=SPEED)
    step = centring.step(touch=(True, True), gap=INCH, period=JIFFY)
    assert (step.gap, step.hand, centring.done, centring.error) == (0, 0, True, 0)


def test_plain_closing_would_drag_the_object_to_the_hand() -> None:
    bench = Bench(centre=0.2 * INCH, width=1.2 * INCH)
    while bench.touch() != (True, True):
        bench.gap -= SPEED * JIFFY
        bench.push()
    assert bench.centre == pytest.approx(0, abs=0.01 * INCH)
