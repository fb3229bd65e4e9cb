"""The magnet of the bit: it holds a screw by the whole face of its head, and draws it straight."""

from math import acos, degrees, radians

import mujoco
import numpy as np
import pytest
from finished import put, stacked

from handeye.core.pose import pose, translated
from handeye.tasks.stanford_cell.dimensions import dimensions

AIR = translated(np.eye(4), (0.5, 0.2, 0.5))  # m, where the driver is held, with nothing near


def hung(*, lean: float = 0.0, below: float = 0.0, on: bool = True) -> tuple[float, float]:
    """A screw put under the bit, its head's edge `below` it (m), leaning (deg); what it hangs like .4 s later.

    Returns:
        Its lean (deg), and how far its head is below the bit (m).
    """
    truth, size = stacked().truth, dimensions()
    model, data = truth.model, truth.data
    length = size("screw.length") + size("screw.head_height")
    put(truth, "driver", AIR)
    face, edge = data.site("bit").xpos.copy(), size("screw.head_radius") * np.sin(radians(lean))
    turned = np.zeros(9)
    mujoco.mju_quat2Mat(turned, np.array([np.cos(radians(lean) / 2), np.sin(radians(lean) / 2), 0.0, 0.0]))
    R = turned.reshape(3, 3)
    put(truth, "screw0", pose(R, face - (0.0, 0.0, edge + below) - length * R[:, 2]))
    for _ in range(round(0.4 / model.opt.timestep)):
        put(truth, "driver", AIR)
        data.actuator("magnet").ctrl = float(on)
        mujoco.mj_step(model, data)
    screw = data.body("screw0")
    head = screw.xpos + length * screw.xmat.reshape(3, 3)[:, 2]
    return degrees(acos(min(1.0, screw.xmat[8]))), float(face[2] - head[2])


@pytest.mark.parametrize("lean", [2.0, 8.0, 20.0])
def test_a_screw_that_hangs_by_the_edge_of_its_head_is_drawn_straight(lean: float) -> None:
    straight, low = hung(lean=lean, below=1e-5)
    assert straight < 0.5
    assert low == pytest.approx(0.0, abs=1e-4)


def test_a_head_within_its_reach_is_drawn_up_and_one_beyond_it_falls() -> None:
    reach = dimensions()("driver.magnet_reach")
    assert hung(below=0.8 * reach)[1] == pytest.approx(0.0, abs=1e-4)
    assert hung(below=1.2 * reach)[1] > 0.1


def test_a_magnet_that_is_off_holds_nothing() -> None:
    assert hung(on=False)[1] > 0.1
