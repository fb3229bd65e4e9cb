"""How deep boxes overlap, against the distances that MuJoCo finds its own way."""

import mujoco
import numpy as np
import pytest

from handeye.core.obb import depths
from handeye.core.pose import Pose, hand

FINGER, BLOCK = np.array([0.012, 0.02, 0.05]), np.array([0.1, 0.03, 0.02])  # half lengths, m
MODEL = f"""
<mujoco>
  <worldbody>
    <geom name="block" type="box" size="{" ".join(map(str, BLOCK))}"/>
    <body name="finger"><freejoint/><geom name="finger" type="box" size="{" ".join(map(str, FINGER))}"/></body>
  </worldbody>
</mujoco>
"""


@pytest.fixture(scope="module")
def model() -> mujoco.MjModel:
    return mujoco.MjModel.from_xml_string(MODEL)


def distance(model: mujoco.MjModel, X: Pose) -> float:
    data = mujoco.MjData(model)
    data.qpos[:3] = X[:3, 3]
    mujoco.mju_mat2Quat(data.qpos[3:7], np.ascontiguousarray(X[:3, :3]).ravel())
    mujoco.mj_forward(model, data)
    ids = [model.geom(name).id for name in ("block", "finger")]
    return float(mujoco.mj_geomDistance(model, data, *ids, 1.0, np.zeros(6)))


@pytest.mark.parametrize("seed", range(8))
def test_boxes_overlap_by_as_much_as_mujoco_finds(model: mujoco.MjModel, seed: int) -> None:
    rng = np.random.default_rng(seed)
    poses = [hand(*rng.uniform(-0.09, 0.09, 3), *rng.uniform(-np.pi, np.pi, 3)) for _ in range(50)]
    other = np.array([distance(model, X) for X in poses])
    ours = depths(np.array(poses)[:, None], [(*-FINGER, *FINGER)], [(*-BLOCK, *BLOCK)])[:, 0, 0]
    np.testing.assert_allclose(ours, np.maximum(-other, 0.0), atol=2e-5)
