"""A straight motion that is to stop on a force: fifty ounces downwards, six tenths of an inch."""

from functools import cache

import pytest
from pump_bench import COUNT, IN_WORLDS, Bench, at_standard, bench, world_of, written

from handeye.core.errors import NO_FORCE
from handeye.core.units import DEGREE, INCH, OUNCE_FORCE
from handeye.program.events import GuardTripped
from handeye.program.program import Position

pytestmark = pytest.mark.slow

DOWN = "MOVE T\nSTOP [0 0 -50]\nCHANGE [0 0 -1] 0.6"
GIVE = 0.01
"""How far (in) a finger sinks and a servo gives under fifty ounces."""


WALL = 1.75
"""Height (in) of the wall of the large hole."""


def over_the_wall(height: float, seed: int | None) -> Bench:
    """Closed fingers about `height` (in) over the wall, about to go down."""
    T = Position(at=(0.0, 1.5625 * INCH, (WALL + height) * INCH, 0.0, 90 * DEGREE, 0.0), of="PUMP")
    return bench(DOWN, world=world_of(seed), positions={"T": T}, lay=at_standard()).to("CHANGE")


@cache
def gone(height: float, seed: int | None) -> tuple[Bench, float, float]:
    """The run to its end, how high over the wall the hand truly was, and how far it truly went down (in)."""
    run = over_the_wall(height, seed)
    start = float(run.hand()[2])
    return run.go(), start - WALL, start - float(run.hand()[2])


@pytest.mark.row(4, **COUNT)
@IN_WORLDS
def test_row_4_the_motion_stops_at_the_obstacle_without_an_error(seed: int | None) -> None:
    run, above, way = gone(0.25, seed)
    assert way == pytest.approx(above, abs=GIVE)
    assert run.errors == []


@IN_WORLDS
def test_row_4_it_stops_when_the_force_first_passes_fifty_ounces(seed: int | None) -> None:
    """A stiff obstacle at an inch a second adds about a newton in a servo period."""
    (trip,) = gone(0.25, seed)[0].all(GuardTripped)
    assert trip.limit == pytest.approx(50 * OUNCE_FORCE)
    assert 0.0 < trip.value - trip.limit < 3.0


@pytest.mark.row(5, **COUNT)
@IN_WORLDS
def test_row_5_without_an_obstacle_it_goes_all_the_way_and_raises_error_23(seed: int | None) -> None:
    run, _, way = gone(1.0, seed)
    assert way == pytest.approx(0.6, abs=GIVE)
    assert run.errors == [NO_FORCE]


@pytest.mark.row(6, **COUNT)
@IN_WORLDS
def test_row_6_a_sideways_contact_of_eighty_ounces_does_not_stop_it(seed: int | None) -> None:
    """The experimenter leans on the hand once it is on its way."""
    run = bench(DOWN, world=world_of(seed), positions={"T": written(25, 38, 5, 0)}).to("CHANGE")
    truth, ticks = run.cell.truth, iter(range(1000))
    link = truth.model.body("stanford/link6").id

    def lean(_: object) -> None:
        truth.data.xfrc_applied[link, 0] = 80 * OUNCE_FORCE if next(ticks) > 20 else 0.0

    run.run.drive.watch = lean
    assert run.go().errors == [NO_FORCE]
    assert run.run.drive.state.wrench[0] == pytest.approx(80 * OUNCE_FORCE, rel=0.05)
