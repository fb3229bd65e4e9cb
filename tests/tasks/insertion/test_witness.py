"""A witness tells the force between pin and plate as it is, and changes nothing."""

from collections.abc import Callable

import mujoco
import numpy as np
import pytest

from handeye.cell.physics_stepper import PhysicsStepper
from handeye.core.pose import Array
from handeye.core.variation import Overrides, WorldSpec
from handeye.tasks.insertion.cell import CORNERS, FACE, HOLE, SEATED, Witness, build, shoulder, tip
from handeye.tasks.insertion.task import INSERTION
from handeye.tasks.insertion.world import InsertionWorld
from handeye.tasks.stanford_cell.dimensions import PARK, dimensions

WORLD = WorldSpec(seed=0, overrides=Overrides(set={"plate.x": 0.0, "plate.y": 0.0}))
PUSH = 12.0
"""N of a pencil on the pin."""


class Rig:
    """A pin in the hole without a hand, pushed by nobody or by a pencil; the arm is far away, under its brakes."""

    def __init__(
        self, high: float, stepper: Callable[[mujoco.MjModel, mujoco.MjData], PhysicsStepper] = Witness
    ) -> None:
        """A pin with its shoulder so far over the face, m."""
        self.model = build(InsertionWorld.draw(WORLD))
        self.data = mujoco.MjData(self.model)
        self.data.qpos[:6] = PARK
        self.model.dof_frictionloss[:6] = 600.0
        self.data.joint("pin").qpos[:3] = *HOLE, FACE + high
        self.stepper = stepper(self.model, self.data)
        mujoco.mj_forward(self.model, self.data)

    def run(self, seconds: float, push: float = 0.0) -> "Rig":
        """Let time pass, a pencil pushing the pin down with a force, N."""
        self.data.xfrc_applied[self.model.body("pin").id, 2] = -push
        for _ in range(round(seconds * 60)):
            self.stepper.step(16)
        return self

    @property
    def weight(self) -> float:
        """Of the pin, N."""
        return float(self.model.body("pin").mass[0] * -self.model.opt.gravity[2])

    @property
    def witness(self) -> Witness:
        assert isinstance(self.stepper, Witness)
        return self.stepper


def summed(rig: Rig) -> Array:
    """Force of the plate on the pin, contact by contact, N."""
    pin, plate = (rig.model.body(name).id for name in ("pin", "plate"))
    total, one = np.zeros(3), np.zeros(6)
    contacts = rig.data.contact
    for index in range(rig.data.ncon):
        first, second = rig.model.geom_bodyid[contacts.geom[index]]
        if {first, second} == {pin, plate}:
            mujoco.mj_contactForce(rig.model, rig.data, index, one)
            total += (1 if second == pin else -1) * contacts.frame[index].reshape(3, 3).T @ one[:3]
    return total


def test_a_pin_at_rest_is_borne_with_its_weight_and_a_pencils_push_besides() -> None:
    rig = Rig(1e-5).run(0.3)
    assert shoulder(rig.data) < SEATED
    assert rig.data.sensor("push").data == pytest.approx([0, 0, rig.weight], abs=0.01)
    rig.run(0.3, push=PUSH)
    assert rig.data.sensor("push").data == pytest.approx([0, 0, rig.weight + PUSH], abs=0.05)
    assert rig.data.sensor("push").data == pytest.approx(summed(rig), abs=1e-6)


def test_the_peak_is_the_greatest_force_of_any_step_and_stays() -> None:
    rig = Rig(1e-5).run(0.3, push=PUSH)
    peak = rig.witness.peak
    assert peak >= rig.weight + PUSH - 0.05
    assert rig.run(0.3).witness.peak == peak


def test_a_pin_that_falls_is_met_before_it_is_seated_and_hits_harder_than_it_weighs() -> None:
    witness = (rig := Rig(0.005)).run(0.5).witness
    assert witness.first is not None
    assert witness.seated is not None
    assert 0.0 < witness.first <= witness.seated < 0.4
    assert witness.peak > 5 * rig.weight


def test_a_witness_changes_nothing() -> None:
    seen, unseen = (Rig(0.005, stepper).run(0.3) for stepper in (Witness, PhysicsStepper))
    assert seen.data.qpos.tobytes() == unseen.data.qpos.tobytes()


def test_a_pin_beside_the_hole_has_touched_and_is_not_seated() -> None:
    """It stands on the face: as high as its nose is long."""
    rig = Rig(dimensions()("pin.nose_length"))
    rig.data.joint("pin").qpos[0] += 0.02
    rig.run(0.05)
    assert rig.witness.first is not None
    assert rig.witness.seated is None
    assert tip(rig.data)[2] == pytest.approx(FACE, abs=1e-4)


@pytest.mark.parametrize("clearance", [5e-5, 1.14e-4, 1e-3])
def test_the_hole_is_as_wide_as_its_clearance_says(clearance: float) -> None:
    """A pin pushed to the side, upright, comes to rest the play away from the axis: half the clearance, a tenth more
    where both have flats."""
    world = WorldSpec(seed=0, overrides=Overrides(set={**WORLD.overrides.set, "hole.clearance": clearance}))
    model = build(InsertionWorld.draw(world))
    radius = float(model.site("hole").size[0])
    nose = dimensions()("pin.nose_radius")
    assert 2 * (radius - nose) == pytest.approx(clearance)
    assert nose * (1 - np.cos(np.pi / CORNERS)) < 6e-6


def test_the_bench_is_a_task_with_its_own_quantities_and_the_pumps_arm() -> None:
    quantities = INSERTION.variation().quantities
    assert {"hole.clearance", "hole.chamfer", "plate.x", "plate.y", "arm.offset.1", "hand.gap_offset"} <= set(
        quantities
    )
    assert not [name for name in quantities if name.startswith(("camera", "light", "fixtures", "parts"))]


def test_a_pin_on_the_table_beside_the_plate_is_low_enough_but_not_in_the_hole() -> None:
    cell = INSERTION.cell(WORLD, "ray")
    pin = cell.truth.data.joint("pin")
    for place, right in (((*HOLE, FACE), True), ((HOLE[0] + 0.1, HOLE[1], 0.004), False)):
        pin.qpos[:3] = place
        mujoco.mj_kinematics(cell.truth.model, cell.truth.data)
        found = INSERTION.judge(cell.truth)
        assert (found["seat"].ok, found["place"].ok, INSERTION.witnessed(cell).right) == (True, right, right)
