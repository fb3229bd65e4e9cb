"""Step 11: the rotor is turned, and is to resist with less than 15 ounces.

That a free one turns and meets nothing is in `test_whole_run`.
"""

import math

import pytest
from pump_bench import COUNT, IN_WORLDS, Bench, bench, stacked, stage, world_of

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
    assert run.told == "THE ROTOR IS HARD TO TURN"
    assert abs(turned(run)) < 2


@IN_WORLDS
def test_a_rotor_that_takes_nearly_three_times_its_friction_is_hard_to_turn(seed: int | None) -> None:
    run = turning(friction=0.14, seed=seed)
    assert run.all(GuardTripped)[-1].guard == "against"
    assert run.told == "THE ROTOR IS HARD TO TURN"
