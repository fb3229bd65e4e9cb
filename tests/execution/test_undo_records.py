"""What steps leave for undoing them, the way back that is made of it, and the rounds that are left out."""

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from handeye.arm.kinematics import forward
from handeye.arm.robots.stanford import STANFORD
from handeye.execution.state import ExecutedStep
from handeye.execution.undo.loops import loop_entry, touch_entry
from handeye.execution.undo.retracing import retracing
from handeye.execution.undo.way import GRAIN, RecordedPath, Track, packed, unpacked
from handeye.planning.motions import GUARDED_SPEED
from handeye.program.guards import GuardKind
from handeye.tasks.stanford_cell.dimensions import PARK

JOINTS = len(STANFORD.joints)


def way(rows: int, step: float = 1e-3) -> RecordedPath:
    """A way of joint 3, whose fingers close."""
    q = np.tile(PARK, (rows, 1))
    q[:, 2] += step * np.arange(rows)
    return RecordedPath(q=q, gap=np.linspace(0.05, 0.01, rows))


def executed(step: int, **fields: object) -> ExecutedStep:
    return ExecutedStep(
        **{"step": step, "gap": (0.01, 0.01), "fingers": 0.01, "load": 0.0, "tool": 0.0, **fields}
    )  # type: ignore[arg-type] # by name


@given(st.integers(1, 50), st.integers(0, 2**32 - 1))
def test_a_way_is_read_back_to_its_grain(rows: int, seed: int) -> None:
    drawn = np.random.default_rng(seed).uniform(-3, 3, (rows, JOINTS + 1))
    again = unpacked(packed(RecordedPath(q=drawn[:, :-1], gap=drawn[:, -1])), JOINTS)
    assert np.abs(np.column_stack([again.q, again.gap]) - drawn).max() <= GRAIN / 2 + 1e-12


def test_a_second_of_a_smooth_motion_takes_less_than_two_kilobytes() -> None:
    t = np.linspace(0, 1, 60)[:, None]
    q = PARK + 0.5 * t**3 * (10 - 15 * t + 6 * t**2) * np.linspace(0.2, 1, JOINTS)
    assert len(packed(RecordedPath(q=q, gap=np.zeros(60)))) < 2000


@pytest.mark.parametrize(
    "data", [b"", b"no way", packed(way(9))[:-3], packed(RecordedPath(q=np.ones((3, 4)), gap=np.ones(3)))]
)
def test_bytes_that_are_no_way_of_the_arm_are_refused(data: bytes) -> None:
    with pytest.raises(ValueError, match=r"^the record does not contain a "):
        unpacked(data, JOINTS)


def test_what_stands_still_leaves_no_way() -> None:
    track = Track()
    track.begin(PARK, 0.02)
    for _ in range(5):
        track.note(PARK, 0.02)
    assert track.way(PARK, 0.02) is None


def test_fingers_that_were_told_another_gap_at_once_have_gone_a_way() -> None:
    track = Track()
    track.begin(PARK, 0.01)
    track.note(PARK, 0.0112)
    noted = track.way(PARK, 0.0112)
    assert noted is not None
    assert noted.gap.tolist() == [0.01, 0.0112]


def test_a_way_is_noted_without_the_rest_before_and_after_it() -> None:
    track, moved = Track(), way(4)
    track.begin(moved.q[0], moved.gap[0])
    for q, gap in [(moved.q[0], moved.gap[0])] * 3 + list(zip(moved.q, moved.gap, strict=True)):
        track.note(q, gap)
    track.note(moved.q[-1], moved.gap[-1])
    noted = track.way(moved.q[-1], moved.gap[-1])
    assert noted is not None
    assert np.array_equal(noted.q, moved.q)


def test_the_way_back_begins_where_the_arm_is_and_ends_at_rest_where_the_step_began() -> None:
    there = way(40)
    back = retracing(STANFORD, there.q[-1] + 1e-3, 0.01, there, slowly=False)
    assert np.allclose(back.samples.q[-1], there.q[0])
    assert back.gap[-1] == pytest.approx(there.gap[0])
    assert not back.samples.qd[-1].any()
    assert np.abs(back.samples.q[0] - there.q[-1] - 1e-3).max() < 1e-3
    assert (back.left[0], back.left[-1]) == (39, 0)


def test_what_has_felt_force_goes_back_no_faster_than_a_guarded_motion() -> None:
    fast = way(40, step=5e-3)  # .3 m/s
    back = retracing(STANFORD, fast.q[-1], 0.01, fast, slowly=True)
    hand = forward(STANFORD, back.samples.q)[:, :3, 3]
    rate = np.linalg.norm(np.diff(hand, axis=0), axis=1) / STANFORD.servo.period
    assert rate.max() < 1.05 * GUARDED_SPEED


# -- rounds -------------------------------------------------------------------------------------------

WENT = {"way": b"way"}
PLACES = {0: (0.0, 0.0, 0.0), 1: (0.0, 0.0, 0.1), 2: (0.1, 0.0, 0.1)}


def entry(*done: ExecutedStep, hands: dict[int, int] | None = None) -> int | None:
    """The step behind which the rounds begin, the hand after each step at one of the places."""
    return loop_entry(done, lambda index: np.array(PLACES[(hands or {}).get(index, 0)]))


def test_a_jump_back_with_the_same_in_the_hand_closes_a_round() -> None:
    assert entry(executed(3), executed(4), executed(5), executed(3)) == 0


def test_of_several_rounds_the_first_counts() -> None:
    rounds = [executed(number) for number in (2, 3, 4, 3, 4, 3)]
    assert entry(*rounds) == 1


def test_without_a_jump_back_there_is_no_round() -> None:
    assert entry(executed(3), executed(4), executed(5)) is None


def test_what_went_through_free_air_since_the_jump_belongs_to_its_rounds() -> None:
    rounds = (executed(3), executed(4, force=9.0), executed(5), executed(3), executed(4, **WENT))
    assert entry(*rounds) == 0
    assert entry(*rounds[:-1], executed(4, **WENT, force=9.0)) is None
    assert entry(*rounds[:-1], executed(4, **WENT, gap=(0.01, 0.02))) is None
    assert entry(*rounds[:-1], executed(4, **WENT, tool=20.0)) is None
    assert loop_entry(rounds, lambda _: None, grasping=True) is None  # the fingers have closed


@pytest.mark.parametrize("other", [{"gap": (0.02, 0.02)}, {"load": 5.0}, {"grasping": True}, {"tool": 20.0}])
def test_a_hand_that_holds_something_else_closes_none(other: dict[str, object]) -> None:
    assert entry(executed(3), executed(4), executed(3, **other)) is None


def test_a_round_in_which_the_operator_was_called_is_none() -> None:
    assert entry(executed(3), executed(4, called=True), executed(3)) is None


def test_a_round_in_which_a_stage_began_is_none() -> None:
    assert entry(executed(3), executed(4), executed(3, enters=True)) is None
    assert entry(executed(3, enters=True), executed(4), executed(3)) == 0


def test_a_grasp_that_a_loop_begins_with_closes_no_round() -> None:
    """It closed on nothing the first time, and holds something now: a lift would carry that away."""
    first, last = executed(3, gap=(0.05, 0.0)), executed(3, gap=(0.05, 0.025))
    rounds = (first, executed(4, grasping=True), executed(5, grasping=True), executed(6), last)
    assert loop_entry(rounds, lambda _: None, grasping=True) is None
    same = (*rounds[:-1], first)
    assert loop_entry(same, lambda _: None, grasping=True) is None
    assert loop_entry((executed(3), *rounds[1:-1], executed(3)), lambda _: None, grasping=False) == 0


HOLDING = {"grasping": True}
FREE = {"grasping": False}


def put_down(place: int, taken: int) -> int | None:
    """A round in which a thing is put down at a place and one is taken up at another, or the same."""
    done = [executed(n, **h) for n, h in ((3, HOLDING), (4, HOLDING), (5, FREE), (6, FREE), (3, HOLDING))]
    return entry(*done, hands={1: place, 3: taken})


def test_what_is_put_down_and_taken_up_again_where_it_stood_is_a_round() -> None:
    assert put_down(0, 0) == 0


@pytest.mark.parametrize(("place", "taken"), [(0, 1), (0, 2), (1, 2)])
def test_rounds_that_carry_things_from_place_to_place_are_undone_one_by_one(place: int, taken: int) -> None:
    assert put_down(place, taken) is None


def test_a_screw_that_was_driven_and_not_backed_out_is_no_round() -> None:
    driven = executed(4, tool=20.0, ended=GuardKind.TORQUE, way=b"way")
    backed = executed(5, tool=-20.0, way=b"way")
    assert entry(executed(3), driven, executed(3)) is None
    assert entry(executed(3), driven, backed, executed(3)) == 0


# -- touches ------------------------------------------------------------------------------------------

FORCE = GuardKind.FORCE
TOUCH = (executed(3), executed(4, **WENT, ended=FORCE), executed(5), executed(6, **WENT))
"""A step, a motion that ends on a force, a test of that, and the motion that leaves it."""


def test_a_touch_is_undone_with_the_motion_that_left_it() -> None:
    assert touch_entry(TOUCH, grasping=False) == 0
    assert touch_entry(TOUCH[1:], grasping=False) == -1


@pytest.mark.parametrize(
    ("index", "other"),
    [
        (1, executed(4, **WENT)),  # met nothing
        (1, executed(4, **WENT, ended=FORCE, grasping=True)),  # with something in the hand
        (1, executed(4, **WENT, ended=GuardKind.TORQUE, tool=20.0)),
        (1, executed(4, **WENT, ended=FORCE, called=True)),
        (2, executed(5, fingers=0.02)),  # the fingers moved while it touched
        (3, executed(6, **WENT, gap=(0.01, 0.02))),  # they move now
        (3, executed(6, **WENT, enters=True)),
        (3, executed(6)),  # nothing has left it
    ],
)
def test_what_is_no_touch_is_undone_step_by_step(index: int, other: ExecutedStep) -> None:
    assert touch_entry((*TOUCH[:index], other, *TOUCH[index + 1 :]), grasping=False) is None


def test_fingers_that_have_closed_on_what_they_touched_have_not_left_it() -> None:
    assert touch_entry(TOUCH, grasping=True) is None
