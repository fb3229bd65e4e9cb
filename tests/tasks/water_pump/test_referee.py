"""The referee finds what is wrong with a pump, and nothing else."""

from collections.abc import Callable
from dataclasses import replace

import msgspec
import mujoco
import numpy as np
import pytest
from finished import finished, finished_cell, put

from handeye.cell.threads import Thread, ThreadsState, holes_of
from handeye.cell.truth import Truth
from handeye.core.pose import planar, pose, rotation_x, translated
from handeye.judge.finding import all_right
from handeye.judge.measured import SettledState
from handeye.tasks.stanford_cell.dimensions import dimensions
from handeye.tasks.water_pump import cell
from handeye.tasks.water_pump.referee import limits
from handeye.tasks.water_pump.referee.findings import judge
from handeye.tasks.water_pump.scene import specification
from handeye.tasks.water_pump.world.pump_world import PumpWorld


def X(truth: Truth, part: str) -> np.ndarray:
    body = truth.model.body(part).id
    return pose(truth.data.xmat[body].reshape(3, 3), truth.data.xpos[body])


def wrong(truth: Truth) -> set[str]:
    return {name for name, finding in judge(truth).items() if not finding.ok}


def moved(part: str, *by: float) -> Callable[[Truth], Truth]:
    def change(truth: Truth) -> Truth:
        put(truth, part, translated(X(truth, part), by))
        return truth

    return change


def _first_thread(truth: Truth, **changed: object) -> Truth:
    """The truth with another first thread."""
    first, *others = holes_of(truth)
    holes = (msgspec.structs.replace(first, **changed), *others)
    return replace(truth, states={**truth.states, "threads": ThreadsState(holes=holes, driven=0)})


def crossed(truth: Truth) -> Truth:
    return _first_thread(truth, crossed=True)


def missing_screw(truth: Truth) -> Truth:
    return _first_thread(truth, screw=None)


def jammed(truth: Truth) -> Truth:
    truth.model.dof_frictionloss[truth.model.joint("rotor").dofadr[0]] = 5.0
    return truth


def high_screw(truth: Truth) -> Truth:
    slide, turn = (truth.model.joint(f"thread_{way}2").qposadr[0] for way in ("slide", "turn"))
    truth.data.qpos[slide] += 0.003
    truth.data.qpos[turn] = (
        truth.data.qpos[slide] * 2 * np.pi / dimensions()("screw.pitch")
    )  # nothing strained
    truth.model.dof_frictionloss[truth.model.joint("thread_turn2").dofadr[0]] = 5.0
    return truth


def fallen_pin(truth: Truth) -> Truth:
    put(truth, "pin0", pose(rotation_x(np.pi / 2), (0.3, 0.3, 0.0037)))
    return truth


CHANGES: dict[str, tuple[Callable[[Truth], Truth], set[str]]] = {
    "a pin that lies on the table": (fallen_pin, {"pins", "pins_tilt"}),
    # it stands on its socket, which the table bears: nothing overlaps
    "a driver that falls beside its rack": (moved("driver", 0.1, 0.0, 0.0), {"rack", "rest"}),
    "a driver in a post of its rack": (
        moved("driver", 0.02, 0.0, 0.0),
        {"rack", "rack_tilt", "overlap", "still", "rest"},
    ),
    "a crossed screw": (crossed, {"screws_crossed"}),
    # its thread is stiff, so that it stays there
    "a screw that stands high": (high_screw, {"screws_depth", "screws_thread", "screws_clamp"}),
    "a jammed rotor": (jammed, {"rotor"}),
    "a missing screw": (missing_screw, {"screws", "dispenser", "floor", "as_drawn"}),
}


@pytest.mark.slow
def test_a_finished_pump_is_assembled() -> None:
    findings = judge(finished_cell().truth)
    assert {name: finding for name, finding in findings.items() if not finding.ok} == {}
    assert all_right(findings)


@pytest.mark.slow
@pytest.mark.parametrize("name", CHANGES)
def test_the_referee_finds(name: str) -> None:
    change, expected = CHANGES[name]
    assert wrong(change(finished())) == expected


def test_a_pump_without_screws_is_wrong_in_all_that_screws_do() -> None:
    truth = finished()
    empty = ThreadsState(holes=(Thread(),) * 6, driven=0)
    found = wrong(replace(truth, states={**truth.states, "threads": empty}))
    assert {"screws", "screws_depth", "screws_clamp"} <= found


def test_a_base_two_millimetres_off_its_blocks_is_found() -> None:
    truth = finished()
    for part in ("base", "gasket", "top"):
        put(truth, part, translated(X(truth, part), (0.002, -0.002, 0.0)))
    assert wrong(truth) == {"base_far", "base_left"}


def test_what_hangs_in_the_air_is_found_though_it_falls_home() -> None:
    truth = finished()
    for part in ("base", "gasket", "top"):
        put(truth, part, translated(X(truth, part), (0.0, 0.0, 0.001)))
    assert "base_height" in wrong(truth)
    assert abs(SettledState(truth, limits.SETTLE).pose("base")[2, 3]) < 1e-3 * limits.BASE_HEIGHT


def test_a_gasket_left_on_its_stand_is_found() -> None:
    truth = finished()
    put(truth, "gasket", planar(0.4, 1.1, 0.0445, 0.0))
    assert {"gasket_height", "gasket_place"} <= wrong(truth)


def test_looking_does_not_change_the_cell() -> None:
    truth = finished()
    before = truth.data.qpos.tobytes(), truth.model.geom_contype.tobytes(), truth.data.time
    judge(truth)
    assert (truth.data.qpos.tobytes(), truth.model.geom_contype.tobytes(), truth.data.time) == before


def test_judging_twice_gives_the_same() -> None:
    truth = finished()
    assert judge(truth) == judge(truth)


def test_every_finding_says_what_was_measured_and_its_limit() -> None:
    findings = judge(finished()).values()
    assert all(f.subject and f.unit and f.relation in ("at most", "at least") for f in findings)


@pytest.mark.parametrize(("place", "right"), [((0.33, -0.24, -0.9), True), ((0.0, 0.0, 0.3), False)])
def test_an_object_that_is_no_part_of_the_pump_must_be_where_the_drawing_puts_it(
    place: tuple[float, float, float], right: bool, monkeypatch: pytest.MonkeyPatch
) -> None:
    def with_nut(world: PumpWorld) -> mujoco.MjModel:
        spec = specification(world)
        nut = spec.worldbody.add_body(name="nut", pos=(0.33, -0.24, -0.9), gravcomp=1.0)
        nut.add_freejoint()
        nut.add_geom(
            type=mujoco.mjtGeom.mjGEOM_SPHERE, size=(0.008, 0, 0), mass=0.01, contype=0, conaffinity=0
        )
        return spec.compile()

    monkeypatch.setattr(cell, "build", with_nut)
    truth = cell.build_cell(PumpWorld.nominal(), camera="ray", rest=False).truth
    put(truth, "nut", pose(np.eye(3), place))
    tray = judge(truth)["tray"]
    assert tray.ok == right
    assert ("nut" in tray.subject) != right
