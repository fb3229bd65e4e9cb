"""The exported solids are what happened, as trimesh reads the file: closed, in their places, of the right size."""

from dataclasses import replace
from io import BytesIO

import numpy as np
import pytest
import trimesh
from finished import exhibit, finished, finished_cell, put

from handeye.cell.solids import SolidScene, WeighedBody
from handeye.core.errors import InvalidInput
from handeye.core.pose import Array, planar
from handeye.results.export import ExportedSolids, agrees, checks, exported_solids
from handeye.tasks.stanford_cell.dimensions import base_top, dimensions
from handeye.tasks.water_pump.exported import exported
from handeye.tasks.water_pump.referee import limits
from handeye.tasks.water_pump.referee.findings import judge
from handeye.tasks.water_pump.scene import solids
from handeye.tasks.water_pump.world.pump_world import PumpWorld

pytestmark = pytest.mark.slow

PLACE = 1e-6  # m, and of the entries of a rotation
AGREEMENT = 0.01  # mm
SINGLE = 1e-5  # of a volume whose corners are kept in single precision
SCREWS = [f"screw{k}" for k in range(6)]


def read(made: ExportedSolids) -> trimesh.Scene:
    return trimesh.load_scene(BytesIO(made.file), file_type="glb")


@pytest.fixture(scope="module")
def made() -> ExportedSolids:
    return exported_solids(exhibit(finished_cell().truth), "pump")


@pytest.fixture(scope="module")
def pump(made: ExportedSolids) -> trimesh.Scene:
    return read(made)


@pytest.fixture(scope="module")
def cell() -> trimesh.Scene:
    return read(exported_solids(exhibit(finished_cell().truth), "cell"))


def pose_of(scene: trimesh.Scene, node: str) -> Array:
    """Pose of a node in the frame of the table."""
    return np.asarray(scene.graph.get(node, "scene")[0])


def apart(scene: trimesh.Scene, node: str, other: str) -> float:
    """Distance of the origin of one node from the z axis of another, mm."""
    X, Y = pose_of(scene, node), pose_of(scene, other)
    return 1e3 * float(np.linalg.norm(np.cross(X[:3, 3] - Y[:3, 3], Y[:3, 2])))


def test_every_solid_of_the_cell_is_closed_as_trimesh_reads_it(cell: trimesh.Scene) -> None:
    assert [name for name, shape in cell.geometry.items() if not shape.is_watertight] == []
    assert all(shape.volume > 0 for shape in cell.geometry.values())


def test_every_body_of_the_cell_is_where_the_run_left_it(cell: trimesh.Scene) -> None:
    truth = finished_cell().truth
    there = {truth.model.body(number).name: number for number in range(1, truth.model.nbody)}
    loose = {"pin1": "pin0", "pin2": "pin1", **{f"screw{k}": f"carrier{k}" for k in range(6)}}
    here = (set(there) - set(loose.values())) | set(loose)
    assert here <= set(cell.graph.nodes)
    for name in here:
        body = truth.data.body(loose.get(name, name))
        X = pose_of(cell, name)
        assert np.abs(X[:3, 3] - body.xpos).max() < PLACE, name
        assert np.abs(X[:3, :3].ravel() - body.xmat).max() < PLACE, name


def test_what_is_up_on_the_table_is_up_in_the_file(pump: trimesh.Scene) -> None:
    X = pump.graph.get("screw0")[0]
    assert X[:3, 2] == pytest.approx([0.0, 1.0, 0.0], abs=1e-3)


def test_the_pump_is_base_gasket_top_rotor_and_screws(pump: trimesh.Scene) -> None:
    bodies = {node.partition("/")[0] for node in pump.graph.nodes_geometry}
    assert bodies == {"base", "gasket", "top", "rotor", *SCREWS}
    assert pump.metadata["moment"] == "final"


def test_solids_of_one_mesh_are_all_there(cell: trimesh.Scene) -> None:
    guides = [node for node in cell.graph.nodes_geometry if node.startswith("rack/guide")]
    assert len(guides) == 4


def test_screws_are_as_far_from_the_holes_of_the_top_as_the_referee_reckons(
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    truth = finished()
    X = planar(*truth.data.body("base").xpos, np.pi)
    put(truth, "top", X @ planar(4e-4, -2e-4, base_top() + dimensions()("gasket.thickness"), 3e-3))
    monkeypatch.setattr(limits, "SETTLE", 0.0)
    off = read(exported_solids(exhibit(truth), "pump"))
    most = max(apart(off, f"top_hole{k}", f"screw{k}") for k in range(6))
    assert most == pytest.approx(judge(truth)["top_place"].value, abs=AGREEMENT)


@pytest.mark.parametrize(
    ("name", "solid"),
    [
        ("casting", solids.casting(6)),
        ("base_plate", solids.plate()),
        ("gasket", solids.gasket(6)),
        ("flange", solids.flange(6)),
    ],
)
def test_a_solid_has_the_volume_of_what_it_was_made_of(
    pump: trimesh.Scene, name: str, solid: solids.Surface
) -> None:
    shapes = {
        node.partition("/")[2]: pump.geometry[pump.graph[node][1]] for node in pump.graph.nodes_geometry
    }
    assert shapes[name].volume == pytest.approx(trimesh.Trimesh(*solid).volume, rel=SINGLE)


def test_a_colour_is_that_of_the_scene_made_linear(cell: trimesh.Scene) -> None:
    screen = np.array([0.88, 0.85, 0.78])  # scenes/water_pump/workcell.xml, `pin`
    linear = ((screen + 0.055) / 1.055) ** 2.4
    factor = cell.geometry["pin_body"].visual.material.baseColorFactor
    assert factor[:3] / 255 == pytest.approx(linear, abs=0.5 / 255)


def test_every_part_of_the_pump_but_the_rotor_weighs_what_its_volume_says(made: ExportedSolids) -> None:
    assert {body.body for body in made.weighed} == {"base", "gasket", "top", "rotor", *SCREWS}
    assert list(checks(made)) == [
        "16 solids, all closed",
        "the mass computed from volume and density agrees with the model within 1%: base, gasket, top, "
        "screw0, screw1, screw2, screw3, screw4, screw5",
        "the mass computed from volume and density is 0.086 kg, but 0.12 kg in the model: rotor",
    ]


@pytest.mark.parametrize(("mass", "right"), [(0.991, True), (0.989, False), (1.009, True), (1.011, False)])
def test_a_mass_agrees_within_one_per_cent(made: ExportedSolids, mass: float, right: bool) -> None:
    body = WeighedBody(body="pin1", mass=mass, mass_there=1.0)
    assert agrees(body) is right
    said = list(checks(replace(made, weighed=(body,))))[1]
    assert (
        said.startswith("the mass computed from volume and density agrees with the model within 1%: pin1")
        is right
    )


def test_pins_weigh_in_the_model_what_their_volume_says() -> None:
    scene = exported(PumpWorld.nominal(), finished_cell().truth, "final")
    (pin,) = SolidScene.of(scene.spec, ["pin1"]).weighed(scene.densities)
    assert pin.mass == pytest.approx(pin.mass_there, rel=1e-6)


def test_a_surface_with_a_hole_in_it_is_named(made: ExportedSolids) -> None:
    scene = exported(PumpWorld.nominal(), finished_cell().truth, "final")
    whole = SolidScene.of(scene.spec, ["gasket", "pin1"])
    (gasket,) = whole.bodies["gasket"]
    torn = trimesh.Trimesh(gasket.shape.vertices, gasket.shape.faces[1:], process=False)
    assert whole.open == ()
    found = replace(whole, bodies={**whole.bodies, "gasket": (replace(gasket, shape=torn),)}).open
    assert found == ("gasket",)
    assert next(checks(replace(made, open=found))) == "16 solids, not closed: gasket"


def test_equal_exhibits_give_equal_bytes(made: ExportedSolids) -> None:
    assert exported_solids(exhibit(finished_cell().truth), "pump").file == made.file


def test_a_part_that_there_is_not_is_refused_with_those_there_are() -> None:
    with pytest.raises(InvalidInput, match=r"^there is no part `motor` to export; known: `cell`, `pump`$"):
        exported_solids(exhibit(finished_cell().truth), "motor")
