"""The servo loop over a fake arm: what it feels, where it stands after a guard, and when it gives up."""

from dataclasses import dataclass, replace

import numpy as np
import pytest
from fake_runs import AT_T
from fakes import FakeCell, Wall

from handeye.arm.kinematics import forward
from handeye.arm.line import straight
from handeye.arm.model import ArmModel
from handeye.arm.robots.stanford import STANFORD
from handeye.core.errors import JOINT_STIFF, SERVO_LAG
from handeye.core.pose import Array
from handeye.core.units import INCH
from handeye.execution.compliance import Course
from handeye.execution.drive import ArmDrive
from handeye.execution.servo import Halted
from handeye.execution.servo_loop import Outcome
from handeye.execution.state import DriveState
from handeye.program.diagnosis.causes import HandAstray, HandPushed, JointBehind
from handeye.program.diagnosis.sense_causes import JointAlone
from handeye.program.guards import Force
from handeye.touch.guards import monitor

DOWN = np.array([0.0, 0.0, -1.0])


@dataclass(frozen=True, kw_only=True)
class Weight:
    """Something that pulls the hand down all the time (N)."""

    weight: float

    def force(self, p: Array, v: Array) -> Array:
        return self.weight * DOWN


def driving(arm: ArmModel = STANFORD) -> tuple[FakeCell, ArmDrive]:
    cell = FakeCell(AT_T)
    return cell, ArmDrive(cell=cell.devices, arm=arm, state=DriveState.holding(cell.devices.sense(), arm))


def test_an_arm_that_has_weighed_its_links_computes_with_their_weights() -> None:
    _, drive = driving()
    drawn = drive.dynamics().bias
    drive.state.links = np.full(6, 1.1)
    np.testing.assert_allclose(drive.dynamics().bias[1], 1.1 * drawn[1], rtol=0.05)  # fingers are not weighed
    drive.state.links = None
    np.testing.assert_array_equal(drive.dynamics().bias, drawn)


def with_servo(**figures: object) -> ArmModel:
    return replace(STANFORD, servo=replace(STANFORD.servo, **figures))


def going(drive: ArmDrive, inches: float, force: float | None = None, *, pressing: bool = False) -> Outcome:
    """Go straight down, until the hand presses downwards with a force (N), by either way of going."""
    guard = None if force is None else monitor((Force(force=(0.0, 0.0, -force)),))
    if pressing:
        course = Course(
            compliance=drive.arm.compliance,
            direction=DOWN,
            distance=inches * INCH,
            speed=INCH,
            force=2 * force,
        )
        return drive.comply(course, guard)
    samples = straight(drive.arm, drive.state.q, inches * INCH * DOWN, INCH)
    return drive.follow(samples, guard, DOWN)


def test_what_is_felt_before_a_guarded_motion_does_not_count() -> None:
    cell, drive = driving()
    cell.arm.walls.append(
        Weight(weight=-10.0)
    )  # it pulls up: what the hand presses down with is felt as 10 N
    assert going(drive, 0.2, force=5.0).trip is None
    assert drive.state.tare[2] == pytest.approx(10.0, abs=0.5)


@pytest.mark.parametrize("pressing", [False, True])
def test_behind_a_guard_the_hand_is_held_where_it_is(pressing: bool) -> None:
    cell, drive = driving()
    wall = cell.arm.tcp[2] - 0.1 * INCH
    cell.arm.walls.append(Wall(point=(0.0, 0.0, wall)))
    outcome = going(drive, 0.5, force=10.0, pressing=pressing)
    assert outcome.trip is not None
    assert forward(STANFORD, drive.state.q)[2, 3] == pytest.approx(drive.hand()[2, 3], abs=1e-6)


def test_a_joint_that_lags_too_far_behind_stops_the_motion() -> None:
    cell, drive = driving(with_servo(lag=(1e-3,) * 6))
    cell.arm.walls.append(Wall(point=tuple(cell.arm.tcp)))
    outcome = going(drive, 0.2)
    assert outcome.error == SERVO_LAG
    assert isinstance(outcome.cause, JointBehind)
    assert not outcome.cause.swings  # what stands in its way pushes it one way
    np.testing.assert_array_equal(drive.state.q, drive.state.here)


@pytest.mark.parametrize(("tool", "cause"), [(0.0, HandAstray), (-20.0, HandPushed)])
def test_a_hand_that_is_held_up_short_of_its_goal_is_an_error(tool: float, cause: type[HandAstray]) -> None:
    """If the screwdriver turns, a screw may have pushed the hand."""
    cell, drive = driving(with_servo(short=0.001))
    drive.state.tool = tool
    cell.arm.walls.append(Wall(point=(0.0, 0.0, cell.arm.tcp[2] - 0.1 * INCH)))
    outcome = going(drive, 0.2)
    assert outcome.error == SERVO_LAG
    assert isinstance(outcome.cause, HandAstray)
    assert type(outcome.cause) is cause
    assert outcome.cause.distance > 0.001


@pytest.mark.parametrize(
    ("before", "lift_off", "error"), [(3.0, 0, JOINT_STIFF), (0.0, 0, SERVO_LAG), (3.0, 60, SERVO_LAG)]
)
def test_a_joint_that_lags_is_stiff_if_it_took_too_much_in_the_first_half_of_its_way(
    before: float, lift_off: int, error: int, monkeypatch: pytest.MonkeyPatch
) -> None:
    """What it took during the lift-off does not count: there, something may have held the hand."""
    cell, drive = driving(with_servo(lag=(5e-3, *STANFORD.servo.lag[1:])))
    drive.state.friction, drive.state.clear = np.full(6, 0.1), False
    x, y, _ = cell.arm.tcp
    samples = straight(drive.arm, drive.state.q, INCH * np.array([-y, x, 0.0]) / np.hypot(x, y), 2 * INCH)
    move, moved = cell.arm._move, [0]

    def dragged(torque: Array, seconds: float) -> None:
        moved[0] += 1
        late = moved[0] > 0.7 * len(samples)
        cell.arm.push = 60.0 * np.array([y, -x, 0.0]) / np.hypot(x, y) if late else np.zeros(3)
        move(torque - before * np.eye(6)[0] * np.tanh(cell.arm.qd[0] / 0.02), seconds)

    monkeypatch.setattr(cell.arm, "_move", dragged)
    outcome = drive.glide(samples, lift_off=lift_off)
    assert outcome.error == error
    assert isinstance(outcome.cause, JointAlone if error == JOINT_STIFF else JointBehind)


def test_a_servo_that_is_late_swings_about_its_set_points(monkeypatch: pytest.MonkeyPatch) -> None:
    cell, drive = driving()
    torques, put_out = [np.zeros(6)], cell.arm.drive

    def late(torque: Array | None) -> None:
        torques.append(np.zeros(6) if torque is None else torque)
        put_out(torques[-2])

    drive.hold(1)
    torques[0] = cell.arm.torque
    monkeypatch.setattr(cell.arm, "drive", late)
    outcome = drive.glide(straight(drive.arm, drive.state.q, 2 * INCH * DOWN, 2 * INCH))
    assert outcome.error == SERVO_LAG
    assert isinstance(outcome.cause, HandAstray | JointBehind)
    assert outcome.cause.swings


def test_no_torque_is_asked_for_beyond_what_the_drives_can_do() -> None:
    cell, drive = driving()
    drive.state.q = AT_T + 0.5
    drive.hold(1)
    effort = np.array([joint.effort for joint in STANFORD.joints])
    assert (np.abs(cell.arm.torque) <= effort).all()


def test_the_panic_button_sets_the_brakes_and_stops_the_screwdriver() -> None:
    cell, drive = driving()
    drive.state.tool = 9.0
    drive.hold(1)
    drive.halt = lambda: True
    with pytest.raises(Halted):
        drive.hold(1)
    assert (cell.arm.braked, cell.screwdriver.speed) == (True, 0.0)
