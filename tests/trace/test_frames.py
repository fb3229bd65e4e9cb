"""The recorder sees the simulated cell as it is, and leaves no trace in it."""

import mujoco
import numpy as np
import pytest
import zstandard
from foxglove_schemas_protobuf.SceneUpdate_pb2 import SceneUpdate

from handeye.arm.kinematics import forward
from handeye.arm.robots.stanford import STANFORD
from handeye.cell.simulated import SimulatedCell
from handeye.tasks.stanford_cell.dimensions import PARK
from handeye.tasks.water_pump.cell import build_cell
from handeye.tasks.water_pump.world.pump_world import PumpWorld
from handeye.trace.frames import Frames

SCENE_LIMIT = 300_000  # bytes: what a trace may grow by to show shapes and not only axes


@pytest.fixture(scope="module")
def cell() -> SimulatedCell:
    return build_cell(PumpWorld.nominal(), camera="ray")


@pytest.fixture(scope="module")
def frames(cell: SimulatedCell) -> Frames:
    return Frames(cell.truth, tuple(joint.name for joint in STANFORD.joints))


def test_every_body_but_the_world_has_a_frame_where_it_is(cell: SimulatedCell, frames: Frames) -> None:
    truth = cell.truth
    assert len(frames.names) == truth.model.nbody - 1
    for name, pose in zip(frames.names, frames.poses(), strict=True):
        body = truth.data.body(name)
        assert np.allclose(pose, [*body.xpos, *body.xquat], atol=1e-7)


def test_the_last_link_is_where_the_arm_model_has_it(frames: Frames) -> None:
    X_WT = forward(STANFORD, PARK)
    pose = frames.poses()[frames.names.index("stanford/link6")]
    wrist = X_WT[:3, 3] - STANFORD.hand.length * X_WT[:3, 2]
    assert np.allclose(pose[:3], wrist, atol=1e-5)


def test_screws_that_are_not_in_their_threads_yet_are_not_to_be_seen(frames: Frames) -> None:
    hidden = [name for name, there in zip(frames.names, frames.there(), strict=True) if not there]
    assert hidden == [f"carrier{hole}" for hole in range(6)]


def test_looking_changes_nothing_in_the_cell(cell: SimulatedCell, frames: Frames) -> None:
    before = cell.capture()
    frames.there()
    frames.scene(0)
    after = cell.capture()
    assert np.array_equal(after.physics, before.physics)
    assert all(np.array_equal(after.figures[name], before.figures[name]) for name in before.figures)
    assert (after.noise, after.mechanisms) == (before.noise, before.mechanisms)


def test_the_scene_shows_everything_that_pictures_show_and_is_small(
    cell: SimulatedCell, frames: Frames
) -> None:
    data = frames.scene(10**9)
    entities = SceneUpdate.FromString(data).entities
    shapes = [len(entity.cubes) + len(entity.cylinders) + len(entity.triangles) for entity in entities]
    balls = cell.truth.model.geom_type == mujoco.mjtGeom.mjGEOM_SPHERE
    assert sum(shapes) == np.isin(cell.truth.model.geom_group[~balls], (2, 4)).sum()
    assert {entity.frame_id for entity in entities} <= {"world", *frames.names}
    assert len(zstandard.compress(data)) < SCENE_LIMIT


def test_the_meshes_of_the_scene_are_those_of_the_simulator(cell: SimulatedCell, frames: Frames) -> None:
    entities = {entity.id: entity for entity in SceneUpdate.FromString(frames.scene(0)).entities}
    mesh = cell.truth.model.mesh("gasket")
    (found,) = entities["gasket"].triangles
    assert (len(found.points), len(found.indices)) == (int(mesh.vertnum[0]), 3 * int(mesh.facenum[0]))
    assert max(found.indices) == len(found.points) - 1


@pytest.mark.slow
def test_the_scene_is_told_as_it_was_drawn_whatever_has_happened_since() -> None:
    cell = build_cell(PumpWorld.nominal(), camera="ray")
    before = Frames(cell.truth, tuple(joint.name for joint in STANFORD.joints)).scene(0)
    cell.truth.model.geom_group[:] = 2  # as if every hidden shape had become a screw in its thread
    cell.truth.model.mat_rgba[:] = 0.5  # as if the lamp had been switched
    assert Frames(cell.truth, tuple(joint.name for joint in STANFORD.joints)).scene(0) == before
