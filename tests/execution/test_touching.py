"""TOUCH: a finger that meets something ends the motion."""

import pytest
from pump_bench import Bench, bench, written

from handeye.core.errors import NO_TOUCH
from handeye.core.pose import planar
from handeye.core.units import INCH
from handeye.program.events import GuardTripped

pytestmark = pytest.mark.slow


def reaching(script: str) -> Bench:
    """The open hand about the pump's top, which lies loose on the table; angle O points to table +y."""
    top = planar(25 * INCH, 38 * INCH, 1e-5, 0.0)
    return bench(
        f"OPEN 2.8\nMOVE T\n{script}", positions={"T": written(25, 38.2, 0.45, 90)}, lay={"top": top}
    ).go()


def test_the_motion_ends_when_an_enabled_finger_touches() -> None:
    """To and fro between the fingers: one of them enabled, then both."""
    ways = [(-1, 1, 1), (1, 2, 2), (-1, 1, 3), (1, 2, 3)]
    run = reaching("\n".join(f"TOUCH {mask}\nCHANGE [0 {way} 0] 2.5" for way, _, mask in ways))
    trips = [(trip.guard, trip.value, trip.limit) for trip in run.all(GuardTripped)]
    assert trips == [("touch", finger, mask) for _, finger, mask in ways]
    assert run.errors == []
    assert run.moved("top") < 0.03


def test_the_finger_that_is_not_enabled_does_not_end_it() -> None:
    run = reaching("TOUCH 2\nCHANGE [0 -1 0] 1.5\nSKIPN 25\nWAIT NOT FELT")
    assert (run.all(GuardTripped), run.errors) == ([], [NO_TOUCH])
    assert run.told == "NOT FELT"


def test_a_move_that_touches_nothing_raises_error_25() -> None:
    run = bench("OPEN 2\nTOUCH 3\nMOVE T", positions={"T": written(25, 38, 6, 0)}).go()
    assert (run.called.error, run.told) == (
        NO_TOUCH,
        "the motion ended without a finger touching anything",
    )
