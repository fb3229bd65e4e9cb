"""The arm undoes what it did: a pin goes back into its holder, and what was changed in between stops the arm."""

from collections.abc import Callable
from functools import cache

import mujoco
import numpy as np
import pytest
from msgspec.structs import replace
from short_runs import begin

from handeye.core.errors import InvalidInput
from handeye.core.packed import encoded
from handeye.execution.undo.retracing import ALLOWED, FALLEN, Resistance, allowed
from handeye.program.diagnosis.causes import HoldOff, MetEarly, UndoResisted, UndoUnknown
from handeye.program.events import OperatorCalled, StageUndone, UndoEnded, UndoFinished, UndoStarted
from handeye.program.guards import GuardKind
from handeye.runs.runner import Runner
from handeye.runs.snapshot import Checkpoint
from handeye.touch.guards import Reading, Trip
from handeye.touch.senses import SKEW

pytestmark = pytest.mark.slow

TAKE = """
        STAGE   "go to the pin"
        OPEN    1
        MOVE    P1
        STAGE   "take the pin"
        CENTER  .1
        SAVE    C1
        CLOSE   0.1
        CHANGE  [0 0 1] 1.5
        STAGE   "feel for nothing"
        ASSIGN  N 3
ROUND:  MOVE    T1
        STOP    [0 0 -50]
        CHANGE  [0 0 -1] .2
        SKIPN   23
        SOJG    N ROUND
        CHANGE  [0 0 1] 1
"""
"""Takes a pin out of its holder and goes down with it three times."""
GRASP = (2, 4)
"""Its steps in which fingers move on the pin."""
CLOSED = 4
"""Its step that grasps the pin."""
DROP = f"{TAKE}        OPEN    1\n"
TRY = """
        STAGE   "try beside the pin, and take it"
        OPEN    1
        MOVE    P1
        CHANGE  [0 0 1] 2
        CHANGE  [0 1 0] 3
        ASSIGN  TRIES 3
AGAIN:  CLOSE   .1
        SKIPE   2
        JUMP    GOT
        OPEN    1
        CHANGE  [0 -1 0] 3
        CHANGE  [0 0 -1] 2
        SOJG    TRIES AGAIN
        WAIT    "no pin"
GOT:    CHANGE  [0 0 1] 1
"""
"""Closes on nothing 3 in beside the pin, and then takes it: the loop begins with the grasp."""
SEARCH = """
        OPEN    .5
        SEARCH  .5
        ASSIGN  N 3
ROUND:  MOVE    T1
        CHANGE  [0 0 -1] .2
        SOJG    N NEXT
        JUMP    END
NEXT:   AOJ     ROUND
END:    CHANGE  [0 0 1] .5
"""
"""Goes down at places of a search, through free air."""
HOLD = """
        STAGE   "hold the top on its stand"
        OPEN    3.4
        MOVE    TOPUP
        STOP    [0 0 -25]
        CHANGE  [0 0 -1] .8 .5
        CHANGE  [0 0 1] .15
        CENTER  2
        CLOSE   2 2.4
        STAGE   "let go of it"
        OPEN    3.4
        CHANGE  [0 0 1] 1
"""
"""Takes hold of the top where it stands, and lets go of it: its last stage is undone by holding it again."""
HELD = 6
"""Steps of its first stage."""


@cache
def done(script: str = TAKE) -> Checkpoint:
    """A run that has ended."""
    runner = Runner(begin(script))
    while not runner.ended:
        runner.step()
    assert runner.call is None
    return runner.checkpoint()


def undone(start: Checkpoint, left: int = 0, meddle: Callable[[Runner], None] = lambda _: None) -> Runner:
    """The run, undone until so many steps are left."""
    runner = Runner(start)
    meddle(runner)
    runner.order_reversal(left)
    while not runner.ended and runner.context.state.undoing is not None:
        runner.step()
    return runner


@cache
def back() -> Runner:
    return undone(done())


def strayed(runner: Runner, body: str) -> float:
    """How far a body is from where it was before the run, mm."""
    truth = runner.cell.truth
    first = mujoco.MjData(truth.model)
    mujoco.mj_kinematics(truth.model, first)
    return float(np.linalg.norm(truth.data.body(body).xpos - first.body(body).xpos)) * 1e3


def stopped_by(runner: Runner) -> OperatorCalled:
    assert runner.call is not None
    return runner.call


def test_a_pin_that_was_taken_out_goes_back_into_its_holder() -> None:
    assert strayed(Runner(done()), "pin0") > 100
    assert strayed(back(), "pin0") < 0.3


def test_the_program_can_go_on_from_its_beginning_with_nothing_remembered() -> None:
    state = back().context.state
    assert (state.at, state.saved, state.counters, state.grasping, state.done) == (0, {}, {}, False, [])
    assert not state.drive.clear  # the hand may be where it once met something
    again = Runner(back().checkpoint())
    while not again.ended:
        again.step()
    assert again.call is None
    assert strayed(again, "pin0") == pytest.approx(strayed(Runner(done()), "pin0"), abs=1.0)


def test_rounds_that_changed_nothing_but_memory_are_undone_as_one_lift() -> None:
    texts = [(e.text.split()[0], e.steps) for e in back().events if isinstance(e, UndoStarted)]
    assert texts.count(("MOVE", 8)) == 1
    assert [word for word, _ in texts].count("SOJG") == 1


def test_a_pin_that_a_loop_took_in_its_second_round_goes_back_too() -> None:
    run = undone(done(TRY))
    assert run.call is None
    assert strayed(run, "pin0") < 0.3


def test_fingers_that_closed_on_nothing_must_hold_nothing() -> None:
    def closed_on_nothing(runner: Runner) -> None:
        done = runner.context.state.done
        done[CLOSED] = replace(done[CLOSED], gap=(done[CLOSED].gap[0], 0.0))

    cause = stopped_by(undone(done(), left=CLOSED, meddle=closed_on_nothing)).cause
    assert isinstance(cause, HoldOff)


def test_stages_are_told_as_they_are_undone_the_last_one_first() -> None:
    told = [event.stage for event in back().events if isinstance(event, StageUndone)]
    assert told == ["feel for nothing", "take the pin", "go to the pin"]
    assert isinstance(back().events[-1], UndoEnded)


def test_every_undo_tells_the_greatest_force_that_it_met() -> None:
    met = [event.force for event in back().events if isinstance(event, UndoFinished)]
    assert 0 < max(met) < ALLOWED


def test_an_undo_may_meet_half_as_much_again_as_its_step_did() -> None:
    assert (allowed(0.0), allowed(10.0), allowed(20.0)) == (20.0, 20.0, 30.0)


def test_a_thing_that_is_no_longer_where_it_was_put_down_stops_the_arm_by_the_gap() -> None:
    run = undone(done(DROP))
    cause = stopped_by(run).cause
    assert isinstance(cause, HoldOff)
    assert cause.holding
    assert cause.gap < cause.kept - 1e-3
    assert run.ended
    assert run.context.drive.sensed.braked


def test_what_came_to_lie_straighter_while_it_was_carried_is_let_go_all_the_same() -> None:
    def grasped_skew(runner: Runner) -> None:
        done = runner.context.state.done
        before, after = done[CLOSED].gap
        done[CLOSED] = replace(done[CLOSED], gap=(before, after + 1.3 * SKEW))

    run = undone(done(), left=CLOSED, meddle=grasped_skew)
    assert run.call is None


def test_what_stands_in_the_way_stops_the_arm_by_its_force() -> None:
    def other_pin_in_its_place(runner: Runner) -> None:
        data, model = runner.cell.truth.data, runner.cell.truth.model
        first = mujoco.MjData(model)
        mujoco.mj_kinematics(model, first)
        start = model.jnt_qposadr[model.body("pin1").jntadr[0]]
        data.qpos[start : start + 3] = first.body("pin0").xpos
        mujoco.mj_forward(model, data)

    run = undone(done(), meddle=other_pin_in_its_place)
    cause = stopped_by(run).cause
    assert isinstance(cause, UndoResisted)
    assert ALLOWED < cause.force < 60.0


def slipped_pin(way: float) -> Callable[[Runner], None]:
    """The pin slips down in the fingers, m."""

    def slip(runner: Runner) -> None:
        data, model = runner.cell.truth.data, runner.cell.truth.model
        data.qpos[model.jnt_qposadr[model.body("pin0").jntadr[0]] + 2] -= way

    return slip


def pressed(run: Runner) -> float:
    """The greatest force that the hand has felt while its grasp was undone, N."""
    return max(event.force for event in run.events if isinstance(event, UndoFinished) and event.step in GRASP)


def test_a_thing_that_came_lower_in_the_hand_is_let_go_where_it_stands() -> None:
    run = undone(done(), meddle=slipped_pin(0.5 * FALLEN))
    assert run.call is None
    assert strayed(run, "pin0") < 0.3
    assert pressed(run) < 0.2 * ALLOWED


def test_it_is_let_go_there_too_when_undoing_goes_on_later() -> None:
    stands = undone(done(), left=CLOSED + 1, meddle=slipped_pin(0.5 * FALLEN))
    run = undone(stands.checkpoint())
    assert (stands.call, run.call) == (None, None)
    assert strayed(run, "pin0") < 0.3
    assert pressed(run) < 0.2 * ALLOWED


def test_a_hand_that_is_farther_above_the_place_than_a_thing_can_have_fallen_is_stopped() -> None:
    cause = stopped_by(undone(done(), meddle=slipped_pin(1.2 * FALLEN))).cause
    assert isinstance(cause, UndoResisted)


def moved_top(way: float) -> Callable[[Runner], None]:
    """Somebody moves the top along the line of the fingers, m, which lies along table y."""

    def move(runner: Runner) -> None:
        data, model = runner.cell.truth.data, runner.cell.truth.model
        data.qpos[model.jnt_qposadr[model.body("top").jntadr[0]] + 1] += way

    return move


@pytest.mark.parametrize("way", [0.004, -0.004])
def test_a_thing_that_was_moved_across_the_fingers_stops_them_as_the_first_one_touches_it(way: float) -> None:
    run = undone(done(HOLD), left=HELD, meddle=moved_top(way))
    cause = stopped_by(run).cause
    assert isinstance(cause, MetEarly)
    assert (cause.fingers, cause.holding) == ((way > 0, way < 0), True)
    assert (cause.gap - cause.kept) / 2 == pytest.approx(abs(way), abs=1e-3)
    assert strayed(run, "top") == pytest.approx(strayed(Runner(done(HOLD)), "top") + 4.0, abs=0.5)


def test_fingers_of_a_program_that_does_without_touch_close_on_it() -> None:
    held = done(HOLD)
    blind = replace(held, setup=replace(held.setup, without=("touch",)))
    assert undone(blind, left=HELD, meddle=moved_top(0.004)).call is None


def test_a_thing_that_was_hardly_moved_is_taken_again() -> None:
    assert undone(done(HOLD), left=HELD, meddle=moved_top(0.001)).call is None


def test_a_way_that_cannot_be_used_stops_the_arm_and_breaks_nothing() -> None:
    def spoil(runner: Runner) -> None:
        state = runner.context.state
        state.done[:] = [replace(done, way=b"spoilt" if done.way else b"") for done in state.done]

    assert isinstance(stopped_by(undone(done(), meddle=spoil)).cause, UndoUnknown)


def test_a_memory_that_cannot_be_the_programs_stops_the_arm_before_it_moves() -> None:
    def spoil(runner: Runner) -> None:
        state = runner.context.state
        state.done[-1] = replace(state.done[-1], remembered={"saved": encoded({"C1": np.zeros(5)})})

    run = undone(done(), meddle=spoil)
    assert isinstance(stopped_by(run).cause, UndoUnknown)
    assert run.context.state.saved["C1"].shape == (3,)


def test_a_lift_that_was_stopped_goes_on_as_a_lift(monkeypatch: pytest.MonkeyPatch) -> None:
    run = Runner(done(SEARCH))
    run.order_reversal(0)

    def lifts() -> list[int]:
        return [event.steps for event in run.events if isinstance(event, UndoStarted) and event.steps > 1]

    def hinders_a_lift(self: Resistance, reading: Reading) -> Trip | None:
        return Trip(guard=GuardKind.FORCE, value=21.0, limit=20.0) if lifts() else None

    monkeypatch.setattr(Resistance, "check", hinders_a_lift)
    while run.call is None:
        run.step()
    monkeypatch.undo()
    (first,) = lifts()
    run.answer("proceed")
    run.step()
    assert (lifts(), run.call) == (2 * [first], None)


def test_an_undo_that_was_stopped_goes_on_from_where_the_arm_is() -> None:
    run = undone(done(DROP))
    left = len(run.context.state.done)
    run.answer("proceed")
    run.step()
    assert isinstance(stopped_by(run).cause, HoldOff)
    assert len(run.context.state.done) == left


def test_undoing_is_the_same_to_the_byte_when_it_is_taken_up_again() -> None:
    run = Runner(done())
    run.order_reversal(0)
    for _ in range(6):
        run.step()
    again = Runner(run.checkpoint())
    while again.context.state.undoing is not None:
        again.step()
    assert again.events == back().events


def test_a_run_is_repeated_with_what_was_undone_in_it() -> None:
    again = Runner(begin(TAKE))
    again.repeat(back().events)
    assert again.events == back().events


def test_one_can_go_back_in_time_through_what_was_undone() -> None:
    run = undone(done())
    ends = run.position
    run.back_to(ends - 3)
    assert run.context.state.undoing is not None
    while run.context.state.undoing is not None:
        run.step()
    assert run.events == back().events


def test_no_more_can_be_undone_than_was_done() -> None:
    run = Runner(begin(TAKE))
    with pytest.raises(InvalidInput, match=r"^there is nothing to undo$"):
        run.order_reversal(0)
