"""A hand that is let turn, that turns something, and that stops on a moment; the experimenter twists it."""

import numpy as np
import pytest
from pump_bench import Bench, at_standard, bench, written

from handeye.arm.robots.stanford import STANFORD
from handeye.core.errors import NO_FORCE, SERVO_LAG
from handeye.core.pose import Array
from handeye.core.units import DEGREE, INCH, OUNCE_FORCE, OUNCE_INCH
from handeye.program.events import GuardTripped
from handeye.program.program import Position
from handeye.tasks.water_pump.world.pump_world import PumpWorld

pytestmark = pytest.mark.slow

DOWN = "CHANGE [0 0 -1] 1 .5"
ABOUT_X = (100 * OUNCE_INCH, 0.0, 0.0)


def twisted(script: str, moment: tuple[float, float, float] = ABOUT_X) -> Bench:
    """The hand carries out a script in free air; once it is on its way, the experimenter twists it (N m)."""
    run = bench(f"MOVE T\n{script}", positions={"T": written(25, 38, 6, 0)}).to("CHANGE")
    truth, ticks = run.cell.truth, iter(range(1000))
    link = truth.model.body("stanford/link6").id

    def twist(_: object) -> None:
        truth.data.xfrc_applied[link, 3:] = moment if next(ticks) > 20 else (0.0, 0.0, 0.0)

    run.run.drive.watch = twist
    return run


def turned(run: Bench) -> Array:
    """How the hand really turns while the run goes on: a rotation vector in W, degrees."""

    def hand() -> Array:
        return np.array(run.cell.truth.data.site("stanford/tool").xmat).reshape(3, 3)

    before = hand()
    run.go()
    R = hand() @ before.T
    return np.array([R[2, 1] - R[1, 2], R[0, 2] - R[2, 0], R[1, 0] - R[0, 1]]) / 2 / DEGREE


def test_a_hand_that_may_spin_yields_to_a_moment_about_that_axis() -> None:
    about = turned(twisted(f"SPIN 1 X\n{DOWN}"))
    assert about[0] == pytest.approx(7.0, abs=1.5)
    assert about[1:] == pytest.approx([0, 0], abs=0.5)


@pytest.mark.parametrize("spin", ["", "SPIN 2 Y Z\n", "FREE 2 X Y\n"])
def test_a_hand_that_may_not_spin_about_an_axis_keeps_its_angles(spin: str) -> None:
    assert turned(twisted(spin + DOWN)) == pytest.approx([0, 0, 0], abs=0.5)


def test_nothing_turns_a_hand_that_meets_nothing() -> None:
    assert turned(twisted(f"SPIN 3 X Y Z\n{DOWN}", (0.0, 0.0, 0.0))) == pytest.approx([0, 0, 0], abs=0.1)
    assert turned(twisted(f"FREE 3 X Y Z\nSPIN 3 X Y Z\n{DOWN}", (0.0, 0.0, 0.0))) == pytest.approx(
        [0, 0, 0], abs=0.1
    )


@pytest.mark.parametrize("seed", [4, 8])
def test_joint_friction_turns_no_hand_that_may_spin(seed: int) -> None:
    """The two of eight worlds in which most is felt where nothing is met: .2 degrees."""
    script = "MOVE T\nFREE 3 X Y Z\nSPIN 3 X Y Z\nCHANGE Y 2"
    run = bench(script, positions={"T": written(25, 38, 6, 0)}, world=PumpWorld.sample(seed)).to("CHANGE")
    assert turned(run) == pytest.approx([0, 0, 0], abs=0.4)


def test_the_tool_centre_point_stays_on_its_way_while_the_hand_spins() -> None:
    run = twisted(f"SPIN 1 X\n{DOWN}").go()
    assert run.hand() == pytest.approx([25, 38, 5], abs=0.06)


def test_a_hand_that_is_twisted_on_and_on_turns_no_farther_than_the_most() -> None:
    about = turned(twisted("SPIN 1 X\nCHANGE [0 0 -1] 3 .5"))
    assert about[0] * DEGREE == pytest.approx(np.sin(STANFORD.compliance.turn_limit), abs=0.02)


def test_a_moment_that_nothing_takes_turns_the_hand() -> None:
    about = turned(twisted(f"FORCE NIL [0 0 40]\n{DOWN}", (0.0, 0.0, 0.0)))
    assert about[2] > 2


def test_a_moment_that_something_takes_turns_the_hand_no_more() -> None:
    run = twisted(f"FORCE NIL [100 0 0]\n{DOWN}", (-100 * OUNCE_INCH, 0.0, 0.0))
    assert abs(turned(run)[0]) < 2
    assert run.run.drive.state.wrench[3] / OUNCE_INCH == pytest.approx(-100, abs=10)


def test_a_moment_beyond_the_limit_stops_the_motion() -> None:
    """The experimenter turns the hand one way, so that it turns the other."""
    run = twisted(f"STOP NIL [-60 0 0]\n{DOWN}").go()
    (trip,) = run.all(GuardTripped)
    assert (trip.guard, run.errors) == ("moment", [])
    assert trip.limit == pytest.approx(60 * OUNCE_INCH, abs=1e-6)


@pytest.mark.parametrize("stop", ["STOP NIL [60 0 0]", "STOP NIL [0 -60 0]", "STOP NIL [-150 0 0]"])
def test_a_moment_the_other_way_about_another_axis_or_too_small_does_not(stop: str) -> None:
    run = twisted(f"{stop}\n{DOWN}").go()
    assert (run.all(GuardTripped), run.errors) == ([], [NO_FORCE])


def test_a_hand_that_presses_and_may_spin_comes_to_rest() -> None:
    """On the wall of the large hole, until it gets on no farther."""
    wall = Position(at=(0.0, 1.5625 * INCH, 1.85 * INCH, 0.0, 90 * DEGREE, 0.0), of="PUMP")
    script = "MOVE T\nFREE 2 X Y\nSPIN 3 X Y Z\nFORCE [0 0 -30]\nCHANGE Z -.6"
    run, felt = bench(script, positions={"T": wall}, lay=at_standard()).to("CHANGE"), []
    run.run.drive.watch = lambda _: felt.append(run.run.drive.state.wrench[2] / OUNCE_FORCE)
    assert run.go().errors == [SERVO_LAG]
    assert felt[-60:] == pytest.approx([30] * 60, abs=0.5)


def test_neither_force_nor_moment_raises_error_23_and_says_so() -> None:
    run = twisted(f"STOP [0 0 -50] [60 0 0]\n{DOWN}").go()
    assert run.called.error == NO_FORCE
    assert run.told.endswith("without meeting the force of its STOP (or the moment)")


def test_force_or_moment_whichever_comes_first_stops_the_motion() -> None:
    run = twisted(f"STOP [0 0 -50] [-60 0 0]\n{DOWN}").go()
    assert [trip.guard for trip in run.all(GuardTripped)] == ["moment"]
