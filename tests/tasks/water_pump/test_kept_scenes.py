"""What tests keep of the pump's worlds is what they would otherwise compile anew."""

import mujoco
import numpy as np
import pytest
from kept_scenes import MOST, keeping

from handeye.core.variation import WorldSpec
from handeye.tasks.water_pump import cell
from handeye.tasks.water_pump.faults.catalogue import catalogue
from handeye.tasks.water_pump.scene import build
from handeye.tasks.water_pump.world.pump_world import PumpWorld


def saved(model: mujoco.MjModel) -> bytes:
    """Everything that MuJoCo knows of a scene."""
    buffer = np.zeros(mujoco.mj_sizeModel(model), np.uint8)
    mujoco.mj_saveModel(model, None, buffer)
    return buffer.tobytes()


@pytest.mark.slow
def test_the_scene_of_a_cell_is_that_of_its_world_compiled_anew_whatever_other_cells_do_to_theirs() -> None:
    world = PumpWorld.sample(1)
    anew = saved(build(world))
    first, second = cell.build(world), cell.build(PumpWorld.sample(1))
    assert saved(first) == anew
    first.geom_friction[:] = 0.0
    assert saved(second) == saved(cell.build(world)) == anew


def test_a_world_that_differs_in_anything_has_a_scene_of_its_own() -> None:
    compiled: list[PumpWorld] = []

    def noted(world: PumpWorld) -> mujoco.MjModel:
        compiled.append(world)
        return mujoco.MjModel.from_xml_string("<mujoco/>")

    built = keeping(noted)
    fault = catalogue(WorldSpec(seed=1)).kind("screw.1.loosened").usual(12)
    worlds = [
        PumpWorld.nominal(),
        PumpWorld.nominal(7),
        PumpWorld.sample(1),
        PumpWorld.draw(WorldSpec(seed=1, faults=(fault,))),
    ]
    for world in (*worlds, *worlds):
        built(world)
    assert compiled == worlds
    for seed in range(2, 2 + MOST):
        built(PumpWorld.sample(seed))
    built(worlds[0])
    assert compiled[-1] is worlds[0]  # it was the last one asked for longest ago
