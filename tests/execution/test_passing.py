"""VIA: the hand passes a place on its way without stopping there."""

import numpy as np
import pytest
from pump_bench import Bench, bench, written

from handeye.core.errors import NO_SOLUTION
from handeye.core.pose import Array, planar
from handeye.core.units import INCH
from handeye.program.diagnosis.causes import BeyondArm
from handeye.program.diagnosis.reach import InnerCylinder
from handeye.program.event_reading import EventReader
from handeye.program.events import Adjusted, ErrorRaised, to_line
from handeye.program.program import Part, Position

pytestmark = pytest.mark.slow

TRAY = Part(at=(20 * INCH, 32 * INCH, 0.0, 0.0))
OVER = Position(at=(0.0, 0.0, 9 * INCH, np.pi / 2, np.pi / 2, 0.0), of="TRAY")


def led(script: str = "MOVE T\nVIA OVER\nMOVE U") -> Bench:
    """A hand that goes from T by way of a place over a tray to U."""
    places = {"T": written(25, 38, 6, 90), "U": written(15, 38, 6, 90), "OVER": OVER}
    return bench(script, positions=places, parts={"TRAY": TRAY}).to("MOVE U")


def passing(run: Bench, at: tuple[float, float, float]) -> tuple[float, float]:
    """How near the hand truly comes to a place (in), and its least speed within an inch of it (in/s)."""
    hands: list[Array] = []
    run.run.drive.watch = lambda _: hands.append(run.hand())
    run.go()
    away = np.linalg.norm(np.array(hands) - at, axis=1)
    speed = np.linalg.norm(np.diff(hands, axis=0), axis=1) * 60
    return float(away.min()), float(speed[away[1:] < 1].min())


def test_the_hand_passes_the_place_and_does_not_stop_there() -> None:
    nearest, slowest = passing(led(), (20, 32, 9))
    assert nearest < 0.1
    assert slowest > 1.0


def test_a_place_on_a_part_is_passed_where_the_part_was_seen() -> None:
    run = led()
    run.run.world.state.measured["TRAY"] = planar(22 * INCH, 31 * INCH, 0.0, 0.0)
    assert passing(run, (22, 31, 9))[0] < 0.1
    (adjusted,) = run.all(Adjusted)
    assert adjusted.goal == "OVER"
    assert np.array(adjusted.shift) / INCH == pytest.approx([2, -1, 0], abs=1e-3)


def test_a_place_that_has_come_out_of_reach_is_told_by_its_name() -> None:
    run = led()
    run.run.world.state.moved["OVER"] = written(20, 15, 5, 90)
    run.go()
    assert run.called.error == NO_SOLUTION
    assert "(OVER: the wrist would have to be" in run.told
    (raised,) = run.all(ErrorRaised)
    assert isinstance(raised.cause, BeyondArm)
    assert isinstance(raised.cause.reason, InnerCylinder)
    assert raised.cause == run.called.cause
    assert EventReader().read(to_line(raised)) == raised
