"""A run that goes by forces measures the friction of the joints first, and tells what cannot be told from it."""

import msgspec
import pytest
from short_runs import begin, plan_of, through

from handeye.core.units import OUNCE_FORCE
from handeye.core.variation import Overrides, WorldSpec
from handeye.program.events import AnyEvent, FrictionMeasured, GuardFaint, RunStarted
from handeye.results.summary import timing, warnings
from handeye.runs.host_seconds import HostSeconds
from handeye.runs.runner import Runner
from handeye.runs.setup import Setup
from handeye.runs.snapshot import Checkpoint
from handeye.trials.assembly import brakes_hold

pytestmark = pytest.mark.slow

FEELING = """
        OPEN    1
        MOVE    P1
        CHANGE  Z 3
        ASSIGN  N 3
AGAIN:  STOP    [0 0 -5]
        CHANGE  Z -.1
        SKIPE   23
        SKIPE   23
        SOJG    N AGAIN
        STOP    [0 0 -60]
        CHANGE  Z -.1
        SKIPE   23
        PARK
"""
"""Feels softly for nothing, three times at one line, and once with force."""


def stiff(script: str, times: float) -> Runner:
    """A run with so many times the friction expected in each joint."""
    joints = (0.4, 0.4, 1.6, 0.08, 0.08, 0.04)
    wanted = {f"arm.friction.{number}": times * friction for number, friction in enumerate(joints, 1)}
    world = WorldSpec(seed=0, overrides=Overrides(set=wanted))
    return Runner(Checkpoint(setup=Setup(plan=plan_of(script), world=world, camera="ray")))


@pytest.fixture(scope="module")
def felt() -> Runner:
    return through(stiff(FEELING, 1.0))


def test_friction_is_measured_before_the_first_instruction(felt: Runner) -> None:
    begun, measured, *_ = felt.events
    assert isinstance(begun, RunStarted)
    assert isinstance(measured, FrictionMeasured)
    assert [each.joint.name for each in measured.joints][::2] == ["column", "boom", "wrist bend"]
    assert [each.friction for each in measured.joints][::2] == pytest.approx([0.4, 1.6, 0.08], abs=0.1)


def test_the_record_tells_how_heavy_the_arm_has_found_its_links(felt: Runner) -> None:
    _, measured, *_ = felt.events
    assert isinstance(measured, FrictionMeasured)
    known = felt.context.state.drive.links
    assert known is not None
    assert measured.links == pytest.approx(known, abs=1e-6)
    assert measured.links != pytest.approx([1.0] * 6, abs=0.001)


def test_a_record_of_before_tells_of_no_links_and_is_still_read() -> None:
    told = b'{"event": "FrictionMeasured", "time": 0.0, "joints": [], "seconds": 3.3}'
    assert msgspec.json.decode(told, type=AnyEvent) == FrictionMeasured(time=0.0, joints=(), seconds=3.3)


def test_the_time_it_takes_stands_by_itself(felt: Runner) -> None:
    told = timing(felt.events, felt.time, HostSeconds())
    assert (told.friction_s, told.calibration_s) == (pytest.approx(3.333, abs=0.01), 0.0)


def test_a_stop_that_friction_hides_is_told_once_a_line_and_no_other(felt: Runner) -> None:
    (faint,) = (event for event in felt.events if isinstance(event, GuardFaint))
    assert faint.limit < faint.friction < 9 * OUNCE_FORCE
    (told,) = warnings(felt.events)
    assert told.startswith(
        "line 7: a stop at a force of 5.0 ounces is hard to distinguish from joint friction"
    )


def test_a_stop_that_only_friction_which_was_not_measured_would_hide_is_not_told() -> None:
    events = through(stiff(FEELING.replace("-5]", "-9]"), 1.0)).events
    assert not any(isinstance(event, GuardFaint) for event in events)


def test_what_friction_was_and_what_was_told_belong_to_the_state(felt: Runner) -> None:
    again = Runner(felt.checkpoint())
    state = again.context.state
    before = felt.context.state.drive
    assert state.drive.friction.tolist() == before.friction.tolist() != [0.0] * 6
    assert before.links is not None
    assert state.drive.links is not None
    assert state.drive.links.tolist() == before.links.tolist()
    assert state.faint == ["7"]


def test_a_program_that_feels_nothing_does_not_wait_for_it() -> None:
    runner = Runner(begin("OPEN 1"))
    assert (runner.time, len(runner.events)) == (0.0, 1)


def test_a_run_whose_joints_do_not_move_says_so_and_does_nothing() -> None:
    runner = stiff(FEELING, 100.0)
    assert runner.ended
    assert runner.trouble == ("joint friction could not be measured: the column does not move as commanded")


def test_a_run_that_its_joints_do_not_let_begin_leaves_the_brakes_on() -> None:
    assert brakes_hold(stiff(FEELING, 100.0).cell)
