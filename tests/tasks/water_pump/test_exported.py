"""The exported scene is what happened, as plain MuJoCo reads it: no code of handeye looks at the files here."""

import re
import subprocess
import sys
from dataclasses import dataclass
from functools import cache
from pathlib import Path

import mujoco
import numpy as np
import pytest
from finished import exhibit, finished, finished_cell, put

from handeye.core.folders import write_folder
from handeye.core.pose import Array, planar
from handeye.core.variation import WorldSpec
from handeye.results.export import exported_solids, scene_files
from handeye.runs.exported_state import initial_state
from handeye.tasks.stanford_cell.dimensions import base_top, dimensions
from handeye.tasks.water_pump.exported import RENAMED
from handeye.tasks.water_pump.referee import limits
from handeye.tasks.water_pump.referee.findings import judge
from handeye.tasks.water_pump.world.pump_world import PumpWorld

pytestmark = pytest.mark.slow

PLACE = 1e-6  # m, and of the entries of a rotation
AGREEMENT = 0.01  # mm
HEIGHT = 1.5e-3  # m: by how much a fixture may be off its drawing
FLOAT = 1e-8  # of a mass that comes from a mesh, whose vertices MuJoCo keeps in single precision
RADII = {
    "base": "base.screw_holes.radius",
    "gasket": "gasket.screw_hole_radius",
    "top": "top.screw_hole_radius",
}


@dataclass(frozen=True)
class Opened:
    """A scene as plain MuJoCo has it, at its last keyframe."""

    model: mujoco.MjModel
    data: mujoco.MjData

    def axis(self, name: str) -> tuple[Array, Array]:
        """A point of the z axis of a body or a site, and its direction."""
        thing = self.data.site(name) if "hole" in name else self.data.body(name)
        return thing.xpos, thing.xmat.reshape(3, 3)[:, 2]

    def apart(self, name: str, other: str) -> float:
        """Distance of the origin of one thing from the z axis of another, mm."""
        (p, _), (q, z) = self.axis(name), self.axis(other)
        return 1e3 * float(np.linalg.norm(np.cross(p - q, z)))


def opened(folder: Path) -> Opened:
    model = mujoco.MjModel.from_xml_path(str(folder / "scene.xml"))
    data = mujoco.MjData(model)
    mujoco.mj_resetDataKeyframe(model, data, model.nkey - 1)
    mujoco.mj_forward(model, data)
    return Opened(model, data)


@pytest.fixture(scope="module")
def pump(tmp_path_factory: pytest.TempPathFactory) -> Opened:
    """The finished pump, exported."""
    folder = tmp_path_factory.mktemp("exports") / "pump"
    write_folder(folder, scene_files(exhibit(finished_cell().truth)))
    return opened(folder)


@cache
def _world(seed: int, folder: Path) -> Opened:
    write_folder(folder, scene_files(initial_state(WorldSpec(seed=seed))))
    return opened(folder)


@pytest.fixture
def world(tmp_path_factory: pytest.TempPathFactory) -> Opened:
    """The world of seed 3 as it is drawn, exported."""
    return _world(3, tmp_path_factory.getbasetemp() / "world")


def in_the_cell(name: str) -> str:
    """Name in the simulated cell with six screws in their threads of what the export calls something else."""
    known = {new: old for old, new in RENAMED.items()}
    return name.replace("screw", "carrier") if name.startswith("screw") else known.get(name, name)


def test_every_body_is_where_the_run_left_it(pump: Opened) -> None:
    truth = finished_cell().truth.data
    for number in range(1, pump.model.nbody):
        there = truth.body(in_the_cell(pump.model.body(number).name))
        assert np.abs(pump.data.xpos[number] - there.xpos).max() < PLACE, there.name
        assert np.abs(pump.data.xmat[number] - there.xmat).max() < PLACE, there.name


def test_a_viewer_that_loads_no_keyframe_shows_the_same(pump: Opened) -> None:
    assert np.array_equal(pump.model.qpos0, pump.model.key_qpos[-1])


def test_every_body_weighs_what_it_weighs_in_the_cell(pump: Opened) -> None:
    model = finished_cell().truth.model
    known = {new: old for old, new in RENAMED.items()}
    for number in range(1, pump.model.nbody):
        body = pump.model.body(number)
        there = model.body(known.get(body.name, body.name))
        assert [*body.mass, *body.inertia, *body.ipos] == pytest.approx(
            [*there.mass, *there.inertia, *there.ipos], rel=FLOAT, abs=1e-12
        ), there.name  # fmt: skip


def test_nothing_but_what_made_the_threads_work_is_left_out(pump: Opened) -> None:
    model = finished_cell().truth.model
    there = {RENAMED.get(model.body(n).name, model.body(n).name) for n in range(model.nbody)}
    here = {pump.model.body(n).name for n in range(pump.model.nbody)}
    assert there - here == {f"carrier{k}" for k in range(6)}
    assert here <= there


@pytest.mark.parametrize("part", RADII)
def test_the_site_of_a_hole_is_as_large_as_the_hole_and_in_the_upper_face(pump: Opened, part: str) -> None:
    d = dimensions()
    face = {"base": base_top(), "gasket": d("gasket.thickness"), "top": d("top.flange")}[part]
    for k in range(6):
        site = pump.model.site(f"{part}_hole{k}")
        assert pump.model.body(site.bodyid[0]).name == part
        assert (site.size[0], site.pos[2]) == pytest.approx((d(RADII[part]), face), abs=1e-12)


def test_a_screw_in_its_thread_is_on_the_axis_of_its_hole(pump: Opened) -> None:
    for k in range(6):
        assert pump.apart(f"screw{k}", f"base_hole{k}") < 1e-3 * AGREEMENT
        assert pump.axis(f"screw{k}")[1] @ pump.axis(f"base_hole{k}")[1] == pytest.approx(1.0)


def test_screws_are_as_far_from_the_holes_of_the_top_as_the_referee_reckons(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    truth = finished()
    X = planar(*truth.data.body("base").xpos, np.pi)
    put(truth, "top", X @ planar(4e-4, -2e-4, base_top() + dimensions()("gasket.thickness"), 3e-3))
    monkeypatch.setattr(limits, "SETTLE", 0.0)
    write_folder(tmp_path / "off", scene_files(exhibit(truth)))
    off = opened(tmp_path / "off")
    most = max(off.apart(f"top_hole{k}", f"screw{k}") for k in range(6))
    assert most == pytest.approx(judge(truth)["top_place"].value, abs=AGREEMENT)
    assert most > 0.3


def test_a_screw_in_its_thread_is_held_and_does_not_touch_the_metal_that_it_cuts(pump: Opened) -> None:
    model = pump.model
    bonds = {model.equality(n).name for n in range(model.neq)} - {"stanford/fingers"}
    assert bonds == {f"screw{k}_in_thread" for k in range(6)}
    meeting = {frozenset(model.body(b).name for b in model.geom_bodyid[g]) for g in pump.data.contact.geom}
    assert {frozenset({f"screw{k}", "top"}) for k in range(6)} <= meeting
    assert {frozenset({f"screw{k}", "base"}) for k in range(6)} & meeting == set()


def test_the_export_rests_if_time_passes(pump: Opened) -> None:
    data = mujoco.MjData(pump.model)
    mujoco.mj_resetDataKeyframe(pump.model, data, pump.model.nkey - 1)
    mujoco.mj_step(pump.model, data, 480)
    assert not np.any(data.warning.number)
    assert np.linalg.norm(data.xpos - pump.data.xpos, axis=1).max() < 1e-4


def test_equal_exhibits_give_equal_bytes() -> None:
    assert scene_files(exhibit(finished_cell().truth)) == scene_files(exhibit(finished_cell().truth))


def test_the_holes_of_the_base_are_where_this_world_drilled_them(world: Opened) -> None:
    for k, hole in enumerate(PumpWorld.sample(3).drilled("base")):
        assert world.model.site(f"base_hole{k}").pos[:2] == pytest.approx(hole, abs=1e-12)


def test_a_world_as_drawn_has_its_screws_loose_in_the_dispenser(world: Opened) -> None:
    assert world.data.time == 0.0
    bonds = [world.model.equality(n).name for n in range(world.model.neq)]
    assert bonds == ["stanford/fingers"]
    point = dimensions()("dispenser.height") - dimensions()("screw.length")
    for k in range(6):
        assert world.data.body(f"screw{k}").xpos[2] == pytest.approx(point, abs=HEIGHT)
        assert world.apart(f"screw{k}", f"base_hole{k}") > 100


def test_the_arm_of_a_world_as_drawn_stands_where_it_is_parked(world: Opened) -> None:
    truth = initial_state(WorldSpec(seed=3)).truth
    for joint in range(1, 7):
        name = f"stanford/j{joint}"
        assert world.data.joint(name).qpos[0] == pytest.approx(float(truth.data.joint(name).qpos[0]))


def test_the_page_measures_a_pump_without_handeye(pump: Opened, tmp_path: Path) -> None:
    page = (Path(__file__).parents[3] / "docs" / "export.md").read_text(encoding="utf-8")
    program, other = re.findall(r"^```python\n(.*?)^```$", page, flags=re.MULTILINE | re.DOTALL)
    write_folder(tmp_path / "scene", scene_files(exhibit(finished_cell().truth)))
    (tmp_path / "pump.glb").write_bytes(exported_solids(exhibit(finished_cell().truth), "pump").file)
    said, weighed = carried_out(program, tmp_path), carried_out(other, tmp_path)
    assert [line for line in said if "base_hole" in line] == [
        f"screw{k} is 0.000 mm off base_hole{k}" for k in range(6)
    ]
    assert f"screw4 is {pump.apart('top_hole4', 'screw4'):.3f} mm off top_hole4" in said
    assert "base/casting is closed: 375.8 cm3" in weighed
    assert len(weighed) == 16


def carried_out(program: str, folder: Path) -> list[str]:
    """What a program that knows nothing of handeye says."""
    assert "handeye" not in program
    done = subprocess.run(
        [sys.executable, "-c", program], cwd=folder, capture_output=True, text=True, check=True, env={}
    )
    return done.stdout.splitlines()
