"""A finished run is exported by the command, measured by programs that know nothing of handeye, and judged alike."""

import subprocess
import sys
from pathlib import Path

import msgspec
import pytest
from finished import finished, finished_cell
from short_runs import plan_of, through

from handeye.cli import app
from handeye.core.variation import WorldSpec
from handeye.judge.measured import SettledState
from handeye.runs.checkpoint_file import write_checkpoint
from handeye.runs.runner import Runner
from handeye.runs.setup import Setup
from handeye.runs.snapshot import Checkpoint
from handeye.tasks.water_pump.referee import limits, measure
from handeye.tasks.water_pump.referee.findings import judge

pytestmark = pytest.mark.slow

SEED = 910031
AGREEMENT = 0.01  # mm
LAYERS = ("gasket", "top")

WITH_MUJOCO = """
import json, mujoco, numpy as np
model = mujoco.MjModel.from_xml_path("scene/scene.xml")
data = mujoco.MjData(model)
mujoco.mj_resetDataKeyframe(model, data, model.nkey - 1)
mujoco.mj_forward(model, data)
found = {}
for part in ("base", "gasket", "top"):
    for k in range(6):
        hole = data.site(f"{part}_hole{k}").xpos
        apart = []
        for s in range(6):
            screw = data.body(f"screw{s}")
            axis = screw.xmat.reshape(3, 3)[:, 2]
            apart.append(1000 * np.linalg.norm(np.cross(hole - screw.xpos, axis)))
        found[f"{part}{k}"] = min(apart)
print(json.dumps(found))
"""
WITH_TRIMESH = """
import json, numpy as np, trimesh
pump = trimesh.load_scene("pump.glb")
place = lambda name: pump.graph.get(name)[0]
found = {}
for part in ("base", "gasket", "top"):
    for k in range(6):
        hole = place(f"{part}_hole{k}")[:3, 3]
        apart = []
        for s in range(6):
            screw = place(f"screw{s}")
            apart.append(1000 * np.linalg.norm(np.cross(hole - screw[:3, 3], screw[:3, 2])))
        found[f"{part}{k}"] = min(apart)
assert all(solid.is_watertight for solid in pump.geometry.values())
print(json.dumps(found))
"""


@pytest.fixture(scope="module")
def folder(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """Exports of a run that has ended on the finished pump of a drawn world."""
    place = tmp_path_factory.mktemp("opinions")
    setup = Setup(plan=plan_of("OPEN 1\n"), world=WorldSpec(seed=SEED), camera="ray")
    ended = through(Runner(Checkpoint(setup=setup))).checkpoint()
    assert ended.snapshot is not None
    pump = msgspec.structs.replace(ended.snapshot, cell=finished_cell(SEED).capture())
    write_checkpoint(place / "end.checkpoint", msgspec.structs.replace(ended, snapshot=pump))
    run = str(place / "end.checkpoint")
    app(["export", "mjcf", run, "-o", str(place / "scene")], result_action="return_value")
    app(["export", "glb", run, "-o", str(place / "pump.glb"), "--part", "pump"], result_action="return_value")
    return place


def measured(program: str, folder: Path) -> dict[str, float]:
    """Distances (mm) of each hole's axis from the nearest screw's, by a program that knows nothing of handeye."""
    done = subprocess.run(
        [sys.executable, "-I", "-c", program], cwd=folder, capture_output=True, text=True, check=True
    )
    return dict(msgspec.json.decode(done.stdout))


@pytest.mark.parametrize("program", [WITH_MUJOCO, WITH_TRIMESH], ids=["mujoco", "trimesh"])
def test_strangers_find_screws_as_far_off_their_holes_as_the_referee(program: str, folder: Path) -> None:
    there, here = measured(program, folder), SettledState(finished(SEED))
    for layer in LAYERS:
        for k in range(6):
            assert there[f"{layer}{k}"] == pytest.approx(1e3 * measure.misfit(here, layer, k), abs=AGREEMENT)
    for k in range(6):
        assert there[f"base{k}"] == pytest.approx(1e3 * measure.thread_offset(here, k), abs=AGREEMENT)


@pytest.mark.parametrize("program", [WITH_MUJOCO, WITH_TRIMESH], ids=["mujoco", "trimesh"])
def test_the_worst_that_strangers_find_is_what_the_referee_tells(
    program: str, folder: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(limits, "SETTLE", 0.0)
    monkeypatch.setattr(measure, "rotor_torque", lambda _: 0.0)
    there, findings = measured(program, folder), judge(finished(SEED))
    for layer in LAYERS:
        worst = max(there[f"{layer}{k}"] for k in range(6))
        assert worst == pytest.approx(findings[f"{layer}_place"].value, abs=AGREEMENT)
        assert worst > 0.02
