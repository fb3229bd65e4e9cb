"""What the arm can press with and hold up, standing still."""

import numpy as np
import pytest
from checking import message, said

from handeye.arm.dynamics import gravity
from handeye.arm.ik import solve
from handeye.arm.kinematics import jacobian
from handeye.arm.robots.stanford import STANFORD
from handeye.core.pose import hand
from handeye.core.units import INCH, OUNCE_FORCE
from handeye.planning.motion_checks import weakness

DOWN = (np.pi / 2, np.pi / 2, 0.0)


def at(x: float, y: float, z: float) -> np.ndarray:
    q = solve(STANFORD, hand(x * INCH, y * INCH, z * INCH, *DOWN), np.zeros(6)).q
    assert q is not None
    return q


@pytest.mark.parametrize("force", [(0, 0, -400), (200, 0, 0), (0, -900, 0), (30, 40, 900)])
def test_at_the_greatest_force_the_joint_that_gives_out_is_at_its_limit(
    force: tuple[float, float, float],
) -> None:
    q, asked = at(25, 38, 4), np.array(force) * 10
    weak = weakness(STANFORD, q[None], asked)
    assert weak is not None
    torque = gravity(STANFORD, q) + jacobian(STANFORD, q)[:3].T @ (asked / np.linalg.norm(asked) * weak.most)
    effort = np.array([joint.effort for joint in STANFORD.joints])
    assert abs(torque[weak.joint]) == pytest.approx(effort[weak.joint])
    assert (np.abs(torque) <= effort + 1e-9).all()


def test_a_carried_weight_helps_to_press_down_and_hinders_to_lift() -> None:
    q = at(25, 38, 4)[None]
    down, up = np.array([0, 0, -1e4]), np.array([0, 0, 1e4])
    free, laden = (weakness(STANFORD, q, down, weight=w) for w in (0.0, 20.0))
    assert free is not None
    assert laden is not None
    assert laden.most == pytest.approx(free.most + 20.0)
    free, laden = (weakness(STANFORD, q, up, weight=w) for w in (0.0, 20.0))
    assert free is not None
    assert laden is not None
    assert laden.most == pytest.approx(free.most - 20.0)


def test_the_data_sheet_s_greatest_load_is_held_within_half_a_metre() -> None:
    q = at(20, 10 + 0.5 / INCH, 4)[None]
    assert weakness(STANFORD, q, np.array([0, 0, 4.5 * 9.81])) is None


def test_a_force_that_no_joint_can_bring_up_is_found_in_planning() -> None:
    (problem,) = said("MOVE T\nFORCE [0 0 -900]\nCHANGE [0 0 -1] 1")
    assert (problem.code, problem.message) == ("force-beyond-arm", "the arm cannot press with 900 oz here")
    assert problem.help == "joint 2 (shoulder) reaches its limit at 462 oz"


def test_a_force_the_arm_can_bring_up_gets_no_message() -> None:
    assert said("MOVE T\nFORCE [0 0 -400]\nCHANGE [0 0 -1] 1") == []


def test_a_load_beyond_the_arm_is_told_once_at_the_motion_it_is_too_heavy_for() -> None:
    (problem,) = said("MOVE PEG\nLOAD 270\nCHANGE [0 0 1] 2\nMOVE T\nMOVE OVER\nMOVE T")
    assert problem.message == "the arm cannot carry 270 oz on this motion"
    assert problem.secondary[0].text == "declared here"


def test_a_load_is_no_longer_there_after_load_nought() -> None:
    assert said("MOVE T\nLOAD 900\nLOAD 0\nMOVE OVER") == []


def test_a_stop_is_judged_at_both_ends_of_its_motion() -> None:
    far = message("MOVE T\nSTOP [0 0 -400]\nCHANGE [0 1 0] 18")
    assert far.startswith("stop-beyond-arm: the arm cannot press with 400 oz here")


def test_ounces_are_those_of_the_script() -> None:
    weak = weakness(STANFORD, at(25, 38, 4)[None], np.array([0, 0, -1e4]))
    assert weak is not None
    assert round(weak.most / OUNCE_FORCE) == 462


@pytest.mark.parametrize(
    ("modifier", "said_of_it"),
    [
        (
            "STOP NIL [0 0 3000]",
            "stop-beyond-arm: the arm cannot turn with 3000 oz-in here, so the stop would",
        ),
        ("FORCE NIL [0 0 3000]", "force-beyond-arm: the arm cannot turn with 3000 oz-in here"),
    ],
)
def test_a_moment_that_no_joint_can_bring_up_is_found_in_planning(modifier: str, said_of_it: str) -> None:
    assert message(f"MOVE T\n{modifier}\nCHANGE [0 0 -1] 1").startswith(said_of_it)


@pytest.mark.parametrize(
    ("stop", "message", "help"),
    [
        (
            "[0 0 -5]",
            "the arm can hardly distinguish a force of 5 oz from joint friction here",
            "write at least 6 oz",
        ),
        (
            "NIL [19 0 0]",
            "the arm can hardly distinguish a moment of 19 oz-in from joint friction here",
            "95 oz-in",
        ),
        (
            "NIL [0 0 10]",
            "the arm can hardly distinguish a moment of 10 oz-in from joint friction here",
            "16 oz-in",
        ),
    ],
)
def test_a_stop_on_less_than_is_felt_in_free_air_is_warned_of(stop: str, message: str, help: str) -> None:
    (problem,) = said(f"MOVE T\nSTOP {stop}\nCHANGE Z -1")
    assert (problem.message, help in (problem.help or "")) == (message, True)


def test_a_stop_clear_of_friction_is_not_warned_of() -> None:
    assert said("MOVE T\nSTOP [0 0 -20] [0 0 24]\nCHANGE Z -1\nMOVE T\nPLACE") == []
