"""What holds the fingers in a hole is not taken for friction of the joints.

The hand comes out of a hole that holds it with 30 N. In free air such a resistance would be friction, and friction that
has grown is an error.
"""

import numpy as np
import pytest
from fake_runs import FakeRun, T, fake_run

from handeye.arm.kinematics import jacobian
from handeye.arm.robots.stanford import STANFORD
from handeye.core.errors import JOINT_STIFF
from handeye.core.pose import Array
from handeye.core.units import INCH
from handeye.program.program import Position

U = Position(at=(T.at[0] - 8 * INCH, *T.at[1:]))
INTO = "STOP [0 0 -30]\nCHANGE [0 0 -1] .5\nSKIPN 23"
"""A motion that may touch something: it goes on to error 23, for which the program tests."""
OVER = "CHANGE [0 0 -1] .5"
LIFTED = T.at[2] + 2 * INCH
"""Height of the hand at which the fingers are out of the hole; the lift-off goes on for half an inch."""


def held(script: str, below: float) -> FakeRun:
    """A script, and then a MOVE in which the hand cannot rise freely `below` a height (m)."""
    run = fake_run(f"{script}\nMOVE U\n", positions={"U": U})
    run.executor.run.drive.state.friction = np.array(STANFORD.compliance.friction)
    arm, move = run.cell.arm, run.cell.arm._move

    def moves(torque: Array, seconds: float) -> None:
        rising = (jacobian(STANFORD, arm.q)[:3] @ arm.qd)[2]
        holds = run.steps[-1] == "MOVE U" and rising > 0 and arm.tcp[2] < below
        arm.push = np.array([0.0, 0.0, -30.0 * np.tanh(rising / 0.01) if holds else 0.0])
        move(torque, seconds)

    arm._move = moves  # type: ignore[method-assign]
    return run.go()


def test_a_hole_may_hold_the_fingers_until_the_hand_has_lifted_off() -> None:
    assert JOINT_STIFF not in held(INTO, below=LIFTED).errors


@pytest.mark.parametrize(("script", "below"), [(OVER, LIFTED), (INTO, np.inf)])
def test_a_hand_in_free_air_meets_only_the_friction_of_its_joints(script: str, below: float) -> None:
    """It is in free air if its last motion was not to touch anything, and in any case after the lift-off."""
    assert held(script, below).errors[-1] == JOINT_STIFF
