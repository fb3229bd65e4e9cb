"""A wrong part is wrong in the scene as its fault says, and nothing else is."""

from functools import cache

import mujoco
import numpy as np
import pytest
from thread_bench import SPEED, STOP, ThreadBench

from handeye.core.faults import Fault
from handeye.core.pose import Array
from handeye.core.units import DEGREE, INCH
from handeye.core.variation import WorldSpec
from handeye.tasks.stanford_cell.dimensions import screw_holes
from handeye.tasks.water_pump.faults.before import bad_threads, part_faults, slipping_screws
from handeye.tasks.water_pump.faults.scene_changes import GONE, METAL
from handeye.tasks.water_pump.scene import build
from handeye.tasks.water_pump.world.pump_world import PumpWorld

pytestmark = pytest.mark.slow

TOGETHER = (
    Fault(name="base.turned", value=35 * DEGREE),
    Fault(name="bit.smooth"),
    Fault(name="gasket.reversed"),
    Fault(name="gasket.thick", value=0.12 * INCH),
    Fault(name="hole.3.blocked", value=0.002),
    Fault(name="pin.1.missing"),
    Fault(name="pin.2.thick", value=0.0002),
    Fault(name="screw.4.burred", value=0.0005),
    Fault(name="top.off.y", value=0.006),
)
"""Faults that do not touch each other."""


@cache
def scene(*faults: Fault) -> tuple[mujoco.MjModel, mujoco.MjData]:
    """A scene as it is in the plan, with wrong parts."""
    level = PumpWorld.nominal().drawn.spec.overrides
    model = build(PumpWorld.draw(WorldSpec(seed=3, overrides=level, faults=faults)))
    data = mujoco.MjData(model)
    mujoco.mj_forward(model, data)
    return model, data


def place(part: str, *faults: Fault) -> Array:
    return np.array(scene(*faults)[1].body(part).xpos)


def direction(part: str, *faults: Fault) -> float:
    """Of a part's x axis, deg."""
    x = scene(*faults)[1].body(part).xmat.reshape(3, 3)[:, 0]
    return float(np.degrees(np.arctan2(x[1], x[0])))


def radius(part: str, *faults: Fault) -> float:
    """The farthest that a part of a screw or pin below its origin's 1 mm reaches from its axis, mm."""
    model, _ = scene(*faults)
    geoms = np.flatnonzero(
        (model.geom_bodyid == model.body(part).id) & (model.geom_contype + model.geom_conaffinity > 0)
    )
    return float(min(model.geom_aabb[geoms, 3])) * 1e3


def test_every_wrong_part_makes_a_scene() -> None:
    model, _ = scene(*(fault.usual() for fault in part_faults(6)))
    assert model.nbody == scene()[0].nbody


def test_a_torn_gasket_has_no_sheet_and_no_land_at_screw_hole_6() -> None:
    model, _ = scene(Fault(name="gasket.torn", value=0.018))
    lands = [geom for geom in range(model.ngeom) if model.geom_bodyid[geom] == model.body("gasket_lands").id]
    assert [bool(model.geom_contype[land]) for land in lands] == [True] * 5 + [False]
    mesh, geom = model.mesh("gasket"), int(np.flatnonzero(model.geom_dataid == model.mesh("gasket").id)[0])
    turn = np.zeros(9)
    mujoco.mju_quat2Mat(turn, model.geom_quat[geom])
    start = int(mesh.vertadr[0])
    sheet = (
        model.mesh_vert[start : start + int(mesh.vertnum[0])] @ turn.reshape(3, 3).T + model.geom_pos[geom]
    )
    assert np.abs(sheet[:, :2] - screw_holes()[5]).max(axis=1).min() == pytest.approx(0.009, abs=1e-5)


def test_the_seventh_screw_can_be_missing_too() -> None:
    names = {fault.name for fault in part_faults(7)} - {fault.name for fault in part_faults(6)}
    assert names == {f"{thing}.7.{what}" for thing, what in (
        ("screw", "missing"), ("screw", "burred"), ("hole", "blocked"), ("thread", "scarred"), ("thread", "crosses"),
            ("thread", "stripped"), ("thread", "full"), ("screw", "slotless"),
    )}  # fmt: skip


def test_what_is_missing_is_on_the_tray_under_the_floor() -> None:
    assert place("pin0", *TOGETHER) == pytest.approx([*GONE["pin0"], -1.9], abs=0.03)
    assert place("pin1", *TOGETHER) == pytest.approx(place("pin1"))


def test_a_part_off_its_place_is_so_far_off() -> None:
    assert place("top", *TOGETHER) - place("top") == pytest.approx([0, 0.006, 0])


def test_a_base_that_is_turned_lies_in_that_direction() -> None:
    assert direction("base", *TOGETHER) == pytest.approx(35)


def test_a_reversed_gasket_lies_the_other_way_round_with_its_web_where_it_was() -> None:
    assert abs(direction("gasket", *TOGETHER) - direction("gasket")) == pytest.approx(180, abs=1e-3)
    webs = [scene(*faults)[1].geom("gasket_web").xpos[:2] for faults in ((), TOGETHER)]
    assert webs[0] == pytest.approx(webs[1], abs=1e-6)


def test_a_thick_gasket_reaches_so_high_at_each_hole_and_lies_on_its_stand() -> None:
    model, data = scene(*TOGETHER)
    floor, web = data.body("gasket").xpos[2], data.geom("gasket_web")
    assert [data.site(f"gasket_hole{k}").xpos[2] - floor for k in range(6)] == pytest.approx(
        [0.12 * INCH] * 6
    )
    half = model.geom("gasket_web").size[2]
    assert [web.xpos[2] - half - floor, web.xpos[2] + half - floor] == pytest.approx([0, 0.12 * INCH])
    for mesh in ("gasket_hole_1", "gasket_hole_2"):
        assert ring_heights(model, data, mesh) - floor == pytest.approx([0, 0.12 * INCH])
    lands = np.flatnonzero(model.geom_bodyid == model.body("gasket_lands").id)
    assert data.geom_xpos[lands, 2] - floor == pytest.approx([0.06 * INCH] * 6)
    assert model.geom_size[lands, 0] == pytest.approx([0.06 * INCH] * 6)


def ring_heights(model: mujoco.MjModel, data: mujoco.MjData, mesh: str) -> Array:
    """The lowest and the highest corner in W of the wedges of a mesh, m."""
    known = model.mesh(mesh)
    corners = model.mesh_vert[known.vertadr[0] : known.vertadr[0] + known.vertnum[0]]
    wedges = np.flatnonzero(model.geom_dataid == known.id)
    heights = [data.geom_xpos[w, 2] + corners @ data.geom_xmat[w].reshape(3, 3)[2] for w in wedges]
    return np.array([np.min(heights), np.max(heights)])


def test_a_pin_is_thicker_than_the_other() -> None:
    assert radius("pin1", *TOGETHER) - radius("pin1") == pytest.approx(0.2, abs=0.01)


def test_a_burr_makes_the_point_of_one_screw_thicker() -> None:
    assert radius("screw3", *TOGETHER) - radius("screw3") == pytest.approx(0.5, abs=0.01)
    assert radius("screw2", *TOGETHER) == radius("screw2")


def test_a_blocked_hole_ends_below_its_mouth_for_whatever_comes_in() -> None:
    model, data = scene(*TOGETHER)
    top = data.geom("plug2").xpos[2] + model.geom("plug2").size[1]
    assert data.site("base_hole2").xpos[2] - top == pytest.approx(0.002)
    assert model.joint("thread_slide2").range[0] == -0.002
    assert model.jnt_solimp[model.joint("thread_slide2").id].tolist() == [*METAL[1]]


def test_no_torque_of_the_driver_turns_a_screw_through_the_end_of_a_blocked_hole() -> None:
    bench = ThreadBench()
    slide = bench.model.joint("thread_slide0").id
    bench.model.jnt_range[slide, 0] = -0.002
    bench.model.jnt_solref[slide], bench.model.jnt_solimp[slide] = METAL
    bench.drive_until(lambda: bench.driver.torque() > STOP, speed=SPEED, press=6.0, seconds=4.0)
    assert bench.thread.screw == 0
    assert bench.head_gap > 0.006


def test_a_smooth_bit_does_not_rub() -> None:
    model, _ = scene(*TOGETHER)
    assert model.geom("bit").friction.tolist() == [0.0, 0.0, 0.0]


def test_threads_are_scarred_by_number() -> None:
    assert bad_threads([Fault(name="thread.2.scarred"), Fault(name="hole.3.blocked")], "scarred") == {1}


@pytest.mark.parametrize("fault", ["screw.1.slotless", "bit.smooth"])
def test_no_thread_takes_a_screw_on_which_the_bit_slips(fault: str) -> None:
    """The bench's own bit rubs, so that the screw turns over the hole."""
    bench = ThreadBench(slipping=slipping_screws([Fault(name=fault)], 1))
    bench.drive_until(lambda: bench.thread.screw is not None, speed=SPEED, press=6.0, seconds=2.0)
    assert (bench.thread.screw, bench.driver.torque() < 0.05) == (None, True)
