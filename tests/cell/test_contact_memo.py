import mujoco
import numpy as np

from handeye.cell.contact_memo import ContactMemo

BALL = """
<mujoco>
  <worldbody>
    <geom type="plane" size="1 1 1"/>
    <body pos="0 0 1"><freejoint/><geom type="sphere" size=".1"/></body>
  </worldbody>
</mujoco>
"""


def test_each_set_of_contacts_is_judged_once() -> None:
    model = mujoco.MjModel.from_xml_string(BALL)
    data, judged = mujoco.MjData(model), []

    def judge(geoms: np.ndarray) -> list[list[int]]:
        judged.append(geoms.tolist())
        return judged[-1]

    memo, found = ContactMemo(data, judge), []
    for height in (1.0, 0.09, 1.0, 0.08):
        data.qpos[2] = height
        mujoco.mj_forward(model, data)
        found.append(memo.now())
    assert found == [[], [[0, 1]], [], [[0, 1]]]
    assert judged == [[], [[0, 1]]]
