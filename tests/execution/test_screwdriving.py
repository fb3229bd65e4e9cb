"""The first screw: driven until the motor meets its torque, and judged by depth."""

import pytest
from pump_bench import Bench, bench, stacked, stage

from handeye.errors import WRONG_TRAVEL
from handeye.events import GuardTripped
from handeye.tasks.water_pump import threads
from handeye.tasks.water_pump.threads import holes_of
from handeye.units import INCH, OUNCE_INCH

pytestmark = pytest.mark.slow


def first_screw() -> Bench:
    """The program's own text for the first screw, on a stack held by its two pins."""
    text = stage("drive the first two screws")
    return bench(text[: text.index("MOVE    S2")], lay=stacked()).go()


@pytest.fixture(scope="module")
def driven() -> Bench:
    return first_screw()


@pytest.fixture
def crossed(monkeypatch: pytest.MonkeyPatch) -> Bench:
    """In a world in which every thread crosses, however straight its screw stands."""
    monkeypatch.setattr(threads, "SQUARE", -1.0)
    return first_screw()


def test_row_60_driving_ends_by_torque(driven: Bench) -> None:
    trip = driven.all(GuardTripped)[-1]
    assert (trip.guard, driven.finished) == ("torque", True)
    assert trip.value >= trip.limit == pytest.approx(42 * OUNCE_INCH)


def test_row_60_the_screw_is_home_and_clamps(driven: Bench) -> None:
    (thread, *others) = holes_of(driven.cell.truth)
    assert (thread.screw, thread.crossed) == (0, False)
    assert thread.clamp > 40.0
    assert all(other.screw is None for other in others)


def test_row_60_a_crossed_thread_ends_by_torque_too(crossed: Bench) -> None:
    assert crossed.all(GuardTripped)[-1].guard == "torque"


def test_row_60_a_crossed_thread_is_told_by_its_depth(crossed: Bench) -> None:
    assert crossed.called.error == WRONG_TRAVEL
    assert crossed.run.state.travel < 0.15 * INCH
