import mujoco
import numpy as np
import pytest
from arm_in_mujoco import build

from handeye.arm.dynamics import bias, gravity, mass_matrix
from handeye.arm.kinematics import forward, jacobian, solve
from handeye.arm.servo import Servo, exerted_torque, free_joints, hand_wrench, prepare, torque
from handeye.arm.stanford import STANFORD
from handeye.arm.trajectory import move, straight
from handeye.pose import hand
from handeye.units import DEGREE, INCH, JIFFY, OUNCE_FORCE

PARK = np.array([-19.7 * DEGREE, 104 * DEGREE, 17.5 * INCH, 0, 76 * DEGREE, 70.3 * DEGREE])
GOAL = hand(24 * INCH, 38 * INCH, 3 * INCH, np.pi / 2, np.pi / 2, 0)
WORK = solve(STANFORD, GOAL, PARK).q
SUBSTEPS = 16


class Arm:
    """The arm alone in MuJoCo, with torques held over a servo period."""

    def __init__(self, q: np.ndarray) -> None:
        self.model = build(STANFORD)
        self.data = mujoco.MjData(self.model)
        self.data.qpos[:] = q
        mujoco.mj_forward(self.model, self.data)

    @property
    def state(self) -> tuple[np.ndarray, np.ndarray]:
        return self.data.qpos.copy(), self.data.qvel.copy()

    def tick(self, tau: np.ndarray, wrench: np.ndarray | None = None) -> None:
        self.data.ctrl[:] = tau
        for _ in range(SUBSTEPS):
            if wrench is not None:
                self.data.qfrc_applied[:] = jacobian(STANFORD, self.data.qpos).T @ wrench
            mujoco.mj_step(self.model, self.data)


def second() -> np.ndarray:
    return straight(STANFORD, WORK, np.array([0, 0, -0.9 * INCH]), INCH)


def test_a_second_of_motion_takes_sixty_torque_updates() -> None:
    motion = prepare(STANFORD, WORK, second())
    servo = Servo(arm=STANFORD, motion=motion)
    while not servo.done:
        command = servo.update(WORK, np.zeros(6))
        assert not command.brakes
    assert (servo.updates, len(motion) * JIFFY) == (60, pytest.approx(1.0))


def test_a_missed_period_cuts_drives_sets_brakes_and_ends_the_motion() -> None:
    servo = Servo(arm=STANFORD, motion=prepare(STANFORD, WORK, second()))
    servo.update(WORK, np.zeros(6))
    for command in (servo.miss(), servo.update(WORK, np.zeros(6))):
        assert command.brakes
        assert not command.torque.any()
    assert servo.aborted
    assert servo.done
    assert servo.updates == 1


def test_torques_stay_within_what_the_drives_can_do() -> None:
    servo = Servo(arm=STANFORD, motion=prepare(STANFORD, WORK, second()))
    command = servo.update(WORK + 1.0, np.zeros(6))
    effort = [joint.effort for joint in STANFORD.joints]
    assert (np.abs(command.torque) <= effort).all()
    assert (np.abs(command.torque) == effort).any()


def test_no_error_needs_only_the_planned_torque() -> None:
    M, h = mass_matrix(STANFORD, WORK), gravity(STANFORD, WORK)
    at_rest = torque(M, h, WORK, np.zeros(6), np.zeros(6), WORK, np.zeros(6))
    np.testing.assert_allclose(at_rest, h)
    qdd = np.arange(6.0)
    moving = torque(M, h, WORK, np.zeros(6), qdd, WORK, np.zeros(6))
    np.testing.assert_allclose(moving, M @ qdd + h)


def test_the_arm_follows_a_move_to_a_fraction_of_a_millimetre() -> None:
    motion = prepare(STANFORD, PARK, move(STANFORD, PARK, GOAL).sample(JIFFY))
    arm, servo, worst = Arm(PARK), Servo(arm=STANFORD, motion=motion), 0.0
    while not servo.done:
        planned = forward(STANFORD, motion.q[servo.updates])
        worst = max(worst, float(np.linalg.norm(planned - forward(STANFORD, arm.data.qpos))))
        arm.tick(servo.update(*arm.state).torque)
    assert worst < 0.5e-3
    np.testing.assert_allclose(forward(STANFORD, arm.data.qpos)[:3, 3], GOAL[:3, 3], atol=0.2e-3)


def test_gravity_alone_lets_the_arm_rest_where_it_is() -> None:
    arm = Arm(WORK)
    for _ in range(600):
        arm.tick(gravity(STANFORD, arm.data.qpos))
    np.testing.assert_allclose(arm.data.qpos, WORK, atol=1e-6)


def test_an_arm_with_gravity_alone_gives_way_to_a_push() -> None:
    arm = Arm(WORK)
    for _ in range(60):
        arm.tick(gravity(STANFORD, arm.data.qpos), wrench=np.array([10.0, 0, 0, 0, 0, 0]))
    assert forward(STANFORD, arm.data.qpos)[0, 3] - GOAL[0, 3] > INCH


@pytest.mark.parametrize("declared", [0.0, 8.9])
def test_a_load_sinks_unless_it_is_declared(declared: float) -> None:
    arm, weight = Arm(WORK), 8.9
    for _ in range(60):
        lift = exerted_torque(STANFORD, arm.data.qpos, np.array([0, 0, declared]))
        arm.tick(gravity(STANFORD, arm.data.qpos) + lift, wrench=np.array([0, 0, -weight, 0, 0, 0]))
    sunk = GOAL[2, 3] - forward(STANFORD, arm.data.qpos)[2, 3]
    assert sunk == pytest.approx(0, abs=1e-5) if declared else sunk > INCH


def test_the_hand_feels_the_force_on_it_and_no_other() -> None:
    force = np.array([3.0, -2.0, 50 * OUNCE_FORCE, 0.2, 0.1, -0.3])
    arm, servo = Arm(WORK), Servo(arm=STANFORD, motion=prepare(STANFORD, WORK, second()))
    while not servo.done:
        on = force if servo.updates >= 30 else np.zeros(6)
        (q, before), tau = arm.state, servo.update(*arm.state).torque
        arm.tick(tau, wrench=on)
        felt = hand_wrench(STANFORD, q, before, arm.data.qvel.copy(), tau, JIFFY)
        np.testing.assert_allclose(felt[:3], on[:3], atol=0.05)


def test_the_joint_freed_for_each_direction_is_the_one_that_moves_the_hand_there() -> None:
    J = jacobian(STANFORD, WORK)
    up = np.eye(6)[2]
    along = np.array([*(J[:3, 2] * [1, 1, 0] / np.hypot(*J[:2, 2])), 0, 0, 0])
    spin = np.eye(6)[5]
    assert np.flatnonzero(free_joints(J, up)).tolist() == [1]
    assert np.flatnonzero(free_joints(J, along)).tolist() == [2]
    assert free_joints(J, np.array([up, along, spin])).sum() == 3


def test_a_freed_joint_gets_only_bias_and_what_it_is_to_exert() -> None:
    M, h = mass_matrix(STANFORD, WORK), bias(STANFORD, WORK, np.zeros(6))
    free = np.array([False, True, False, False, False, False])
    press = exerted_torque(STANFORD, WORK, np.array([0, 0, -10.0]))
    tau = torque(M, h, WORK, np.zeros(6), np.zeros(6), WORK + 0.01, np.zeros(6), free=free, exerted=press)
    assert tau[1] == pytest.approx(h[1] + press[1])
    assert tau[0] < h[0] + press[0] - 1
