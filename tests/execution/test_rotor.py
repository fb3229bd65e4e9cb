"""The rotor is turned, is to resist with less than 15 ounces, and is to sit in its bearing.

That a free one turns and meets nothing is in `test_whole_run`.
"""

import math

import numpy as np
import pytest
from pump_bench import COUNT, IN_WORLDS, MACROS, Bench, bench, stacked, stage, world_of

from handeye.core.units import INCH
from handeye.program.events import GuardTripped

pytestmark = pytest.mark.slow


def turning(friction: float, seed: int | None) -> Bench:
    """The program's last stage, the experimenter having jammed the rotor (N m)."""
    run = bench(stage("turn the rotor"), world=world_of(seed), lay=stacked())
    model = run.cell.truth.model
    model.dof_frictionloss[model.joint("rotor").dofadr[0]] = friction
    return run.go()


def turned(run: Bench) -> float:
    """Angle of the rotor, degrees."""
    return math.degrees(run.cell.truth.data.joint("rotor").qpos[0])


@pytest.mark.row(56, **COUNT)
@IN_WORLDS
def test_row_56_a_jammed_rotor_stops_the_motion_and_the_operator_is_told(seed: int | None) -> None:
    run = turning(friction=5.0, seed=seed)
    assert run.all(GuardTripped)[-1].guard == "against"
    assert run.told == "THE ROTOR IS HARD TO TURN, OR A JOINT OF THE ARM IS"
    assert abs(turned(run)) < 2


@IN_WORLDS
def test_a_rotor_that_takes_nearly_three_times_its_friction_is_hard_to_turn(seed: int | None) -> None:
    run = turning(friction=0.14, seed=seed)
    assert run.all(GuardTripped)[-1].guard == "against"
    assert run.told == "THE ROTOR IS HARD TO TURN, OR A JOINT OF THE ARM IS"


def felt(raised: float) -> Bench:
    """BEARING feels a rotor that stands `raised` (mm) over its bearing, turned as the last turn leaves it."""
    face = 1.75 - 0.08  # the hand yields by .08 in to 40 oz
    run = bench(f"{MACROS}        BEARING\n", lay=stacked(), felt={"BARE": face})
    run.run.state.saved["BARE"] = np.array([0.0, 0.0, -0.3 * INCH])
    truth = run.cell.truth
    truth.data.joint("rotor").qpos[0] = math.radians(-11.6)
    truth.model.body_pos[truth.model.body("rotor").id][2] += raised / 1000
    return run.go()


def test_a_rotor_in_its_bearing_is_felt_at_its_height() -> None:
    assert felt(0.0).finished


@pytest.mark.parametrize("raised", [4.0, -4.0])
def test_a_rotor_that_has_left_its_bearing_is_felt(raised: float) -> None:
    assert felt(raised).told.startswith("THE ROTOR DOES NOT SIT IN ITS BEARING")
