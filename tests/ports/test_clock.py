"""Time passes by whole physics steps; whatever else it is asked to pass by is refused in words."""

import math
import re

import pytest
from fakes import FakeClock

from handeye.core.errors import InvalidInput
from handeye.core.units import JIFFY
from handeye.ports.clock import whole_steps

STEPS = [0.001, 1 / 960, 1 / 3000, 7e-5]


@pytest.mark.parametrize("seconds", [0.0, -JIFFY, math.nan, math.inf, -math.inf])
def test_time_passes_neither_backwards_nor_for_ever_nor_not_at_all(seconds: float) -> None:
    clock = FakeClock()
    with pytest.raises(
        InvalidInput, match=r"^the clock cannot advance by .* s; the shortest period is 0\.00104166666667 s$"
    ):
        clock.advance(seconds)
    assert clock.now == 0.0


@pytest.mark.parametrize("step", STEPS)
def test_no_more_than_a_day_passes_at_once(step: float) -> None:
    with pytest.raises(
        InvalidInput, match=r"^the clock cannot advance by 1e\+12 s at once; the longest period is 86400 s$"
    ):
        whole_steps(1e12, step)


@pytest.mark.parametrize("step", STEPS)
@pytest.mark.parametrize("share", [0.4, 1.5, 16.01, 1000.3])
def test_the_periods_that_a_refusal_names_are_taken(step: float, share: float) -> None:
    with pytest.raises(InvalidInput, match=r"is not a whole number of physics steps of .*; use ") as refused:
        whole_steps(share * step, step)
    named = re.findall(r"[\d.e-]+", str(refused.value).split("use")[1])
    assert [whole_steps(float(period), step) for period in named] == [
        max(1, int(share)),
        max(1, int(share)) + 1,
    ]


@pytest.mark.parametrize("step", STEPS)
def test_a_period_that_is_whole_but_for_rounding_is_taken(step: float) -> None:
    assert whole_steps(sum([step] * 1000), step) == 1000
