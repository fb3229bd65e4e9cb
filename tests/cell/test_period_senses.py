"""Senses and drives of the period: converters of few bits, a finger servo that knows its potentiometer only."""

import numpy as np
import pytest
from driving import Drive, tick
from released_arm import arm_alone

from handeye.cell.signal_lines import Converters, converted
from handeye.core.units import INCH
from handeye.core.variation import Overrides, WorldSpec
from handeye.tasks.stanford_cell.arm import ARM
from handeye.tasks.water_pump.world.pump_world import PumpWorld


def world(**set: float) -> PumpWorld:
    """The world of seed 2, with quantities set (SI): `arm__drive_gain__1` is `arm.drive_gain.1`."""
    named = {name.replace("__", "."): value for name, value in set.items()}
    return PumpWorld.draw(WorldSpec(seed=2, overrides=Overrides(set=named)))


def steps(values: object, step: object) -> np.ndarray:
    """By how many steps of a converter values are off a whole number of them."""
    count = np.asarray(values) / np.asarray(step)
    return np.abs(count - np.round(count))


def test_a_converter_passes_the_nearest_step_and_one_without_steps_everything() -> None:
    row = Converters(np.array([0.1, 0.1, 0.0]))
    assert row(np.array([0.26, -0.26, 0.26])) == pytest.approx([0.3, -0.3, 0.26])
    assert (converted(0.26, 0.1), converted(0.26, 0.0)) == (pytest.approx(0.3), 0.26)


def test_all_senses_of_arm_and_hand_read_in_steps_of_their_converters() -> None:
    drawn = world()
    read = tick(arm_alone(drawn).devices, Drive(torque=np.linspace(-3.0, 3.0, 6), gap=INCH), 20)
    assert steps(read.q, drawn.arm.pot_step).max() < 1e-6
    assert steps(read.qd, drawn.arm.tachometer_step).max() < 1e-6
    assert steps(read.gap, drawn.hand.gap_step) < 1e-6


def test_a_converter_of_12_bits_has_4096_steps_over_the_travel_of_a_joint() -> None:
    assert world().arm.pot_step[1] == pytest.approx(np.deg2rad(340) / 4096)


def test_a_drive_gives_the_nearest_of_256_torques_times_its_gain() -> None:
    drawn = world(arm__drive_gain__1=0.02)
    cell = arm_alone(drawn)
    tick(cell.devices, Drive(torque=np.array([10.0, 0, 0, 0, 0, 0])))
    given = cell.truth.data.actuator(f"{ARM}j1").ctrl[0]
    assert given == pytest.approx(round(10.0 / (100 / 256)) * 100 / 256 * 1.02)


def test_the_finger_servo_closes_on_its_potentiometer_and_not_on_the_true_gap() -> None:
    cell = arm_alone(world(hand__gap_offset=0.05 * INCH, hand__gap_scale=0.0))
    read = tick(cell.devices, Drive(gap=INCH), 120)
    assert read.gap == pytest.approx(INCH, abs=0.003 * INCH)
    assert cell.truth.data.tendon(f"{ARM}gap").length[0] == pytest.approx(0.95 * INCH, abs=0.003 * INCH)


@pytest.mark.parametrize(
    ("quantity", "field"),
    [
        ("arm__link_mass__2", "body_mass"),
        ("arm__mass_centre__2", "body_ipos"),
        ("arm__armature__2", "dof_armature"),
        ("arm__damping__2", "dof_damping"),
        ("arm__friction__2", "dof_frictionloss"),
        ("arm__hand_length", "site_pos"),
    ],
)
def test_the_arm_in_the_scene_is_as_the_world_has_built_it(quantity: str, field: str) -> None:
    cells = [arm_alone(world(**{quantity: value})) for value in (0.001, 0.002)]
    for cell in cells:
        tick(cell.devices, Drive(torque=np.zeros(6)))  # brakes are friction, too
    before, after = (getattr(cell.truth.model, field) for cell in cells)
    assert (before != after).any()
