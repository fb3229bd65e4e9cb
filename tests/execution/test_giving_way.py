"""FREE in free air: what nobody pushes goes straight."""

import pytest
from pump_bench import bench, written

pytestmark = pytest.mark.slow


def test_a_hand_that_may_give_way_goes_straight_where_it_meets_nothing() -> None:
    """The arm's weight shifts on the way; counted as at the beginning it would be felt as ten ounces."""
    run = bench("MOVE T\nFREE 2,X,Y\nCHANGE Z,-2", positions={"T": written(25, 38, 6, 0)}).go()
    assert run.hand()[:2] == pytest.approx([25, 38], abs=0.01)
