"""The options of MuJoCo that docs/physics.md gives are those of the compiled cell."""

import re
from pathlib import Path

import mujoco
import numpy as np
import pytest

from handeye.tasks.water_pump.scene import build
from handeye.tasks.water_pump.world.pump_world import PumpWorld

pytestmark = pytest.mark.slow

PAGE = (Path(__file__).parents[3] / "docs" / "physics.md").read_text(encoding="utf-8")
OPTIONS = dict(re.findall(r"^\| `(\w+)` \| (\S+) \|", PAGE, re.MULTILINE))
GEOMS = dict(re.findall(r"^\| (`pad_a`|`table`|`bit`|`head0`)(.*)$", PAGE, re.MULTILINE))
NAMES = {"`pad_a`": "stanford/pad_a", "`table`": "table"}
ENUMS = {
    "integrator": {"implicitfast": mujoco.mjtIntegrator.mjINT_IMPLICITFAST},
    "cone": {"elliptic": mujoco.mjtCone.mjCONE_ELLIPTIC},
    "solver": {"Newton": mujoco.mjtSolver.mjSOL_NEWTON},
}


@pytest.fixture(scope="module")
def model() -> mujoco.MjModel:
    return build(PumpWorld.nominal())


def test_the_options_of_the_page_are_those_of_the_cell(model: mujoco.MjModel) -> None:
    assert {"timestep", "integrator", "cone", "impratio", "solver", "ccd_tolerance"} <= set(OPTIONS)
    for name, told in OPTIONS.items():
        held = model.opt.gravity[2] if name == "gravity" else getattr(model.opt, name)
        value = int(ENUMS[name][told]) if name in ENUMS else float(told)
        assert held == pytest.approx(value, rel=1e-5), name
    on = mujoco.mjtEnableBit.mjENBL_SLEEP | mujoco.mjtEnableBit.mjENBL_DIAGEXACT
    assert model.opt.enableflags == on


def test_the_contacts_of_the_page_are_those_of_the_cell(model: mujoco.MjModel) -> None:
    colliding = (model.geom_contype | model.geom_conaffinity) != 0
    assert np.allclose(model.geom_solref[colliding], [0.00208333, 1], rtol=1e-5)
    for name, row in GEOMS.items():
        condim, friction, solimp = [cell.strip() for cell in row.split("|")[1:4]]
        geom = model.geom(NAMES.get(name, name.strip("`"))).id
        assert model.geom_condim[geom] == int(condim), name
        assert model.geom_friction[geom] == pytest.approx([*map(float, friction.split())]), name
        assert model.geom_solimp[geom, :3] == pytest.approx([*map(float, solimp.split())]), name
    assert set(GEOMS) == {"`pad_a`", "`table`", "`bit`", "`head0`"}
