"""A robot value says of a robot what the model says that MuJoCo runs."""

import mujoco
import numpy as np
import pytest
from arm_in_mujoco import postures
from robots import ROBOTS, Robot

from handeye.arm.dynamics import gravity, mass_matrix
from handeye.arm.kinematics import chain, forward
from handeye.arm.model import constants

COUNT = 25
GAP = 0.03
"""m, of each finger from the middle."""


class Bench:
    """A robot's model, its fingers held a little open."""

    def __init__(self, robot: Robot) -> None:
        self.arm, self.model = robot.arm, robot.model()
        self.data = mujoco.MjData(self.model)
        self.R_WM, self.p_WM = robot.X_WM[:3, :3], robot.X_WM[:3, 3]
        names = [f"j{i + 1}" for i in range(len(self.arm.joints))]
        self.joints = [self.model.joint(name).id for name in names]
        self.motors = [self.model.actuator(name).id for name in names]
        self.dofs = self.model.jnt_dofadr[self.joints]
        self.links = self.model.jnt_bodyid[self.joints]
        self.fingers = [self.model.body(f"finger_{side}").id for side in "ab"]
        self.q = postures(self.arm, COUNT)

    def stand(self, q: np.ndarray) -> None:
        self.data.qpos[self.model.jnt_qposadr[self.joints]] = q
        for side in "ab":
            self.data.joint(f"finger_{side}").qpos = GAP
        mujoco.mj_forward(self.model, self.data)

    def at(self, p: np.ndarray) -> np.ndarray:
        """A point of the model in the world."""
        return self.R_WM @ p + self.p_WM


@pytest.fixture(scope="module", params=ROBOTS)
def bench(request: pytest.FixtureRequest) -> Bench:
    return Bench(ROBOTS[request.param])


def test_there_are_as_many_joints_and_of_the_same_kinds(bench: Bench) -> None:
    slides = bench.model.jnt_type[bench.joints] == mujoco.mjtJoint.mjJNT_SLIDE
    assert slides.tolist() == [joint.kind == "prismatic" for joint in bench.arm.joints]
    assert bench.model.njnt == len(bench.arm.joints) + 2


def test_every_axis_is_where_the_chain_has_it(bench: Bench) -> None:
    for q in bench.q:
        bench.stand(q)
        R, p = chain(bench.arm, q)
        for i, joint in enumerate(bench.joints):
            np.testing.assert_allclose(bench.R_WM @ bench.data.xaxis[joint], R[i, :, 2], atol=1e-7)
            if bench.arm.joints[i].kind == "revolute":
                lever = bench.at(bench.data.xanchor[joint]) - p[i]
                np.testing.assert_allclose(np.cross(R[i, :, 2], lever), 0, atol=1e-7)


def test_the_tool_frame_is_where_the_chain_ends(bench: Bench) -> None:
    tool = bench.data.site("tool")
    for q, X in zip(bench.q, forward(bench.arm, bench.q), strict=True):
        bench.stand(q)
        np.testing.assert_allclose(bench.at(tool.xpos), X[:3, 3], atol=1e-7)
        np.testing.assert_allclose(bench.R_WM @ tool.xmat.reshape(3, 3), X[:3, :3], atol=1e-7)


def test_limits_inertia_friction_and_efforts_of_the_drives_are_the_same(bench: Bench) -> None:
    k, model = constants(bench.arm), bench.model
    np.testing.assert_allclose(model.jnt_range[bench.joints], np.stack([k.lower, k.upper], axis=1), atol=1e-9)
    np.testing.assert_allclose(model.dof_armature[bench.dofs], k.armature)
    np.testing.assert_allclose(model.dof_damping[bench.dofs], k.damping)
    np.testing.assert_allclose(
        model.actuator_ctrlrange[bench.motors], np.stack([-k.effort, k.effort], axis=1)
    )
    np.testing.assert_array_equal(model.actuator_trnid[bench.motors, 0], bench.joints)
    np.testing.assert_array_equal(model.actuator_gear[bench.motors, 0], 1.0)


def test_every_link_weighs_the_same_at_the_same_place_with_the_same_inertia(bench: Bench) -> None:
    R, p = chain(bench.arm, bench.q[0])
    bench.stand(bench.q[0])
    for i, (joint, link) in enumerate(zip(bench.arm.joints, bench.links, strict=True)):
        axes = bench.R_WM @ bench.data.ximat[link].reshape(3, 3)
        inertia = axes @ np.diag(bench.model.body_inertia[link]) @ axes.T
        assert bench.model.body_mass[link] == pytest.approx(joint.mass)
        centre = p[i + 1] + R[i + 1] @ joint.centre
        np.testing.assert_allclose(bench.at(bench.data.xipos[link]), centre, atol=1e-7)
        np.testing.assert_allclose(inertia, R[i + 1] @ np.diag(joint.inertia) @ R[i + 1].T, atol=2e-7)


def test_the_fingers_weigh_the_same_at_the_same_height_and_open_as_wide(bench: Bench) -> None:
    hand, X = bench.arm.hand, forward(bench.arm, bench.q[0])
    bench.stand(bench.q[0])
    masses = bench.model.body_mass[bench.fingers]
    centre = bench.at(masses @ bench.data.xipos[bench.fingers] / masses.sum())
    assert masses.sum() == pytest.approx(hand.mass)
    np.testing.assert_allclose(
        X[:3, :3].T @ (centre - X[:3, 3]), [0, 0, hand.centre - hand.length], atol=1e-6
    )
    ends = [bench.model.joint(f"finger_{side}").range[1] for side in "ab"]
    assert sum(ends) == pytest.approx(hand.gap_max)
    first = bench.data.joint("finger_a").xaxis
    np.testing.assert_allclose(bench.R_WM @ first, X[:3, 1], atol=1e-7)
    assert bench.model.actuator("grip").forcerange[1] == pytest.approx(hand.grip)


def test_gravity_and_inertia_are_the_same_but_for_the_breadth_of_the_fingers(bench: Bench) -> None:
    M = np.zeros((bench.model.nv, bench.model.nv))
    for q, ours, weight in zip(
        bench.q, mass_matrix(bench.arm, bench.q), gravity(bench.arm, bench.q), strict=True
    ):
        bench.stand(q)
        mujoco.mj_fullM(bench.model, bench.data, M)
        np.testing.assert_allclose(bench.data.qfrc_bias[bench.dofs], weight, atol=1e-4)
        np.testing.assert_allclose(M[np.ix_(bench.dofs, bench.dofs)], ours, atol=6e-4)


def test_no_joint_of_the_model_has_dry_friction_and_nothing_else_hangs_on_it(bench: Bench) -> None:
    hanging = bench.model.body_subtreemass[bench.links[0]]
    masses = sum(joint.mass for joint in bench.arm.joints) + bench.arm.hand.mass
    assert hanging == pytest.approx(masses)
    assert not bench.model.dof_frictionloss.any()
