import mujoco
import numpy as np
import pytest
from arm_in_mujoco import build

from handeye.arm.computed_torque import Motion, external_wrench, prepare, torque
from handeye.arm.dynamics import gravity, mass_matrix
from handeye.arm.ik import solve
from handeye.arm.kinematics import forward, jacobian
from handeye.arm.line import straight
from handeye.arm.robots.stanford import STANFORD
from handeye.arm.trajectory import move
from handeye.core.pose import hand
from handeye.core.units import DEGREE, INCH, OUNCE_FORCE

PARK = np.array([-19.7 * DEGREE, 104 * DEGREE, 17.5 * INCH, 0, 76 * DEGREE, 70.3 * DEGREE])
GOAL = hand(24 * INCH, 38 * INCH, 3 * INCH, np.pi / 2, np.pi / 2, 0)
WORK = solve(STANFORD, GOAL, PARK).q
PERIOD = STANFORD.servo.period
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


def second() -> Motion:
    return prepare(STANFORD, WORK, straight(STANFORD, WORK, np.array([0, 0, -0.9 * INCH]), INCH))


def at(motion: Motion, i: int, q: np.ndarray, qd: np.ndarray) -> np.ndarray:
    """Torques of a period of a motion."""
    return torque(
        STANFORD,
        motion.dynamics.M[i],
        motion.dynamics.bias[i],
        motion.q[i],
        motion.qd[i],
        motion.qdd[i],
        q,
        qd,
    )


def test_a_second_of_motion_is_prepared_as_sixty_periods_that_begin_where_the_arm_stands() -> None:
    motion = second()
    assert len(motion) * PERIOD == pytest.approx(1.0)
    np.testing.assert_array_equal(motion.q[0], WORK)
    np.testing.assert_array_equal(motion.qd[0], np.zeros(6))


def test_no_error_needs_only_the_planned_torque() -> None:
    M, h = mass_matrix(STANFORD, WORK), gravity(STANFORD, WORK)
    at_rest = torque(STANFORD, M, h, WORK, np.zeros(6), np.zeros(6), WORK, np.zeros(6))
    np.testing.assert_allclose(at_rest, h)
    qdd = np.arange(6.0)
    moving = torque(STANFORD, M, h, WORK, np.zeros(6), qdd, WORK, np.zeros(6))
    np.testing.assert_allclose(moving, M @ qdd + h)


def test_what_is_to_be_exerted_adds_to_the_torque() -> None:
    M, h, press = mass_matrix(STANFORD, WORK), gravity(STANFORD, WORK), np.arange(6.0)
    tau = torque(STANFORD, M, h, WORK, np.zeros(6), np.zeros(6), WORK, np.zeros(6), exerted=press)
    np.testing.assert_allclose(tau, h + press)


def test_the_arm_follows_a_move_to_a_fraction_of_a_millimetre() -> None:
    motion = prepare(STANFORD, PARK, move(STANFORD, PARK, GOAL).sample(PERIOD))
    arm, worst = Arm(PARK), 0.0
    for i in range(len(motion)):
        planned = forward(STANFORD, motion.q[i])
        worst = max(worst, float(np.linalg.norm(planned - forward(STANFORD, arm.data.qpos))))
        arm.tick(at(motion, i, *arm.state))
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


def test_the_hand_feels_the_force_on_it_and_no_other() -> None:
    force = np.array([3.0, -2.0, 50 * OUNCE_FORCE, 0.2, 0.1, -0.3])
    arm, motion = Arm(WORK), second()
    for i in range(len(motion)):
        on = force if i >= 30 else np.zeros(6)
        before, tau = arm.state, at(motion, i, *arm.state)
        arm.tick(tau, wrench=on)
        acceleration = (arm.data.qvel - before[1]) / PERIOD
        unexplained = motion.dynamics.M[i] @ acceleration + motion.dynamics.bias[i] - tau
        felt = external_wrench(jacobian(STANFORD, motion.q[i]), unexplained)
        np.testing.assert_allclose(felt[:3], on[:3], atol=0.2)


@pytest.mark.parametrize("joints", [3, 7])
def test_a_force_that_the_joints_carry_is_felt_by_an_arm_of_any_number_of_them(joints: int) -> None:
    J = np.random.default_rng(joints).normal(size=(6, joints))
    force = J @ np.arange(1.0, joints + 1)  # of all that few joints carry, the least
    np.testing.assert_allclose(J.T @ external_wrench(J, J.T @ force), J.T @ force, atol=1e-9)
