"""A straight motion that is to stop on a force: fifty ounces downwards, six tenths of an inch."""

import pytest
from pump_bench import Bench, at_standard, bench, written

from handeye.errors import NO_FORCE
from handeye.events import GuardTripped
from handeye.program.program import Position
from handeye.units import DEGREE, INCH, OUNCE_FORCE

pytestmark = pytest.mark.slow

DOWN = "MOVE T\nSTOP [0 0 -50]\nCHANGE [0 0 -1] 0.6"
GIVE = 0.01
"""How far (in) a finger sinks and a servo gives under fifty ounces."""


def over_the_wall(height: float) -> Bench:
    """Closed fingers `height` (in) over the wall of the large hole."""
    T = Position(at=(0.0, 1.5625 * INCH, (1.75 + height) * INCH, 0.0, 90 * DEGREE, 0.0), of="PUMP")
    return bench(DOWN, positions={"T": T}, lay=at_standard())


def gone(run: Bench) -> float:
    """How far the hand truly went down (in)."""
    start = run.to("CHANGE").hand()[2]
    return float(start - run.go().hand()[2])


def test_row_4_the_motion_stops_at_the_obstacle_without_an_error() -> None:
    run = over_the_wall(0.25)
    assert gone(run) == pytest.approx(0.25, abs=GIVE)
    assert run.errors == []


def test_row_4_it_stops_when_the_force_first_passes_fifty_ounces() -> None:
    """A stiff obstacle at an inch a second adds about a newton in a servo period."""
    (trip,) = over_the_wall(0.25).go().all(GuardTripped)
    assert trip.limit == pytest.approx(50 * OUNCE_FORCE)
    assert 0.0 < trip.value - trip.limit < 3.0


def test_row_5_without_an_obstacle_it_goes_all_the_way_and_raises_error_23() -> None:
    run = over_the_wall(1.0)
    assert gone(run) == pytest.approx(0.6, abs=GIVE)
    assert run.errors == [NO_FORCE]


def test_row_6_a_sideways_contact_of_eighty_ounces_does_not_stop_it() -> None:
    """The experimenter leans on the hand once it is on its way."""
    run = bench(DOWN, positions={"T": written(25, 38, 5, 0)}).to("CHANGE")
    truth, ticks = run.cell.truth, iter(range(1000))
    link = truth.model.body("stanford/link6").id

    def lean(_: object) -> None:
        truth.data.xfrc_applied[link, 0] = 80 * OUNCE_FORCE if next(ticks) > 20 else 0.0

    run.run.drive.watch = lean
    assert run.go().errors == [NO_FORCE]
    assert run.run.drive.state.wrench[0] == pytest.approx(80 * OUNCE_FORCE, rel=0.05)
