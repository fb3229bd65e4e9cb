"""A run is the same to the byte, whether it is stopped, put back, or taken up in another cell."""

import numpy as np
import pytest
from short_runs import GRASP, begin, history, through

from handeye.core.errors import InvalidInput, PhysicsFailed
from handeye.execution.servo import Halted
from handeye.program.events import ExperimentMade, OperatorCalled, PanicStopped, Restored
from handeye.runs.runner import Runner
from handeye.trials.assembly import brakes_hold

pytestmark = pytest.mark.slow


@pytest.fixture(scope="module")
def whole() -> Runner:
    """A run that nobody stopped."""
    return through(Runner(begin()))


def state(runner: Runner) -> bytes:
    """Everything the future of a run depends on, as bytes."""
    cell = runner.cell.capture()
    figures = b"".join(cell.figures[name].tobytes() for name in sorted(cell.figures))
    return cell.physics.tobytes() + figures + cell.noise.encode()


def test_the_short_program_comes_to_its_end(whole: Runner) -> None:
    assert whole.ended
    assert whole.call is None


@pytest.mark.parametrize("position", [1, 4, 7])
def test_a_checkpoint_leads_to_the_same_end_in_a_new_cell(whole: Runner, position: int) -> None:
    runner = Runner(begin())
    while runner.position < position:
        runner.step()
    again = through(Runner(runner.checkpoint()))
    assert history(again.events) == history(whole.events)
    assert state(again) == state(whole)


def test_a_run_whose_physics_breaks_down_stops_before_that_step_with_the_brakes_on(
    whole: Runner, monkeypatch: pytest.MonkeyPatch
) -> None:
    def breaks_down(*_: object) -> None:
        monkeypatch.undo()
        raise PhysicsFailed("the simulated cell broke down")

    runner = Runner(begin())
    while runner.position < 2:
        runner.step()
    time, events = runner.time, list(runner.events)
    monkeypatch.setattr("handeye.cell.simulated.check_physics", breaks_down)
    runner.step()
    assert (runner.trouble, runner.position, runner.events) == ("the simulated cell broke down", 2, events)
    assert runner.time >= time
    assert brakes_hold(runner.arm_cell)
    runner.back_to(2)
    assert history(through(runner).events) == history(whole.events)


def test_going_back_and_forward_again_leads_to_the_same_end(whole: Runner) -> None:
    runner = Runner(begin())
    for forward, back in ((3, 1), (4, 2), (6, 0), (7, 5)):
        while runner.position < forward:
            runner.step()
        runner.back_to(back)
        assert runner.position == back
    assert history(through(runner).events) == history(whole.events)
    assert state(runner) == state(whole)


def test_going_back_restores_the_exact_earlier_state() -> None:
    runner = Runner(begin())
    for _ in range(3):
        runner.step()
    before, events = state(runner), history(runner.events)
    for _ in range(3):
        runner.step()
    runner.back_to(3)
    assert (state(runner), history(runner.events)) == (before, events)


def test_one_can_go_back_from_the_end() -> None:
    runner = through(Runner(begin()))
    runner.back_to(2)
    assert not runner.ended
    assert runner.next is not None
    assert runner.next.text == "CENTER  .1"


def test_states_that_are_no_longer_in_memory_come_from_checkpoints_and_from_there_step_by_step() -> None:
    first = Runner(begin())
    first.step()
    kept = first.checkpoint()
    for _ in range(4):
        first.step()
    late = Runner(first.checkpoint())
    late.back_to(3, lambda _: kept)
    assert history(late.events) == history(first.events[: len(late.events)])
    assert late.position == 3


def test_going_back_behind_all_that_was_kept_is_refused() -> None:
    runner = Runner(begin())
    for _ in range(3):
        runner.step()
    late = Runner(runner.checkpoint())
    with pytest.raises(
        InvalidInput,
        match=r"^this run begins with 3 steps already done: there is no earlier state to go back to$",
    ):
        late.back_to(1)
    assert late.position == 3


def test_the_panic_button_sets_the_brakes_at_the_next_tick_and_the_step_can_be_done_again(
    whole: Runner,
) -> None:
    ticks: list[float] = []
    pressed: list[bool] = []
    runner = Runner(begin(), halt=lambda: len(ticks) == 150 and not pressed)
    braked: list[tuple[float, bool]] = []
    watch = runner.context.drive.watch

    def look(_: object) -> None:
        ticks.append(runner.context.drive.sensed.time)
        braked.append((runner.context.drive.sensed.time, runner.context.drive.sensed.braked))

    runner.context.drive.watch = look
    with pytest.raises(Halted):
        through(runner)
    pressed.append(True)
    assert [b for _, b in braked[-2:]] == [False, True]
    stopped = runner.events[-1]
    assert isinstance(stopped, PanicStopped)
    assert stopped.time == pytest.approx(braked[-1][0], abs=1e-5)
    runner.context.drive.watch = watch
    runner.rollback()
    assert history(through(runner).events) == history(whole.events)


def test_an_experiment_with_a_saved_difference_moves_the_next_goal_and_is_told() -> None:
    runner = Runner(begin("OPEN 1\nMOVE P1\nMOVE P1\nRESTORE D\nOPEN 1\nSAVE D\n"))
    runner.step()
    runner.experiment("saved", "D", (0.01, 0.0, 0.0))
    through(runner)
    assert runner.touched
    (made,) = [event for event in runner.events if isinstance(event, ExperimentMade)]
    assert (made.what, made.name, made.value) == ("saved", "D", (0.01, 0.0, 0.0))
    assert [e.difference for e in runner.events if isinstance(e, Restored)] == [(0.01, 0.0, 0.0)]


def test_an_experiment_with_a_position_moves_the_hand_there() -> None:
    runner = Runner(begin("OPEN 1\nMOVE P1\n"))
    position = runner.setup.plan.program.positions["P1"]
    x, *rest = position.at
    runner.experiment("position", "P1", (x + 0.02, *rest))
    planned = runner.context.world.planned_position("P1")[:3, 3]
    through(runner)
    assert runner.context.drive.hand()[:3, 3] - planned == pytest.approx([0.02, 0, 0], abs=1e-3)


def test_an_experiment_is_undone_by_going_back_and_kept_by_a_checkpoint() -> None:
    runner = Runner(begin("OPEN 1\nMOVE P1\n"))
    runner.step()
    runner.experiment("saved", "D", (0.01, 0.0, 0.0))
    kept = Runner(runner.checkpoint())
    assert kept.context.state.saved["D"] == pytest.approx([0.01, 0, 0])
    runner.back_to(0)
    assert "D" not in runner.context.state.saved
    assert not runner.touched


def test_an_unknown_position_is_refused() -> None:
    runner = Runner(begin("OPEN 1\n"))
    with pytest.raises(InvalidInput, match="no position NOWHERE"):
        runner.experiment("position", "NOWHERE", (0, 0, 0, 0, 0, 0))


WAITING = 'STAGE "one"\nOPEN 1\nWAIT "LOOK AT IT"\nOPEN 2\nSTAGE "two"\nOPEN 3\n'


@pytest.mark.parametrize(
    ("choice", "texts"),
    [
        ("proceed", ["OPEN    1", 'WAIT    "LOOK AT IT"', "OPEN    2", "OPEN    3"]),
        ("skip", ["OPEN    1", 'WAIT    "LOOK AT IT"', "OPEN    3"]),
    ],
)
def test_the_operator_says_how_a_stop_goes_on(choice: str, texts: list[str]) -> None:
    runner = through(Runner(begin(WAITING)))
    assert isinstance(runner.events[-1], OperatorCalled)
    runner.answer(choice)
    through(runner)
    done = [" ".join(event.text.split()) for event in runner.events if type(event).__name__ == "StepStarted"]
    assert done == [" ".join(text.split()) for text in texts]
    assert runner.finish()


def test_a_stage_done_again_stops_again() -> None:
    runner = through(Runner(begin(WAITING)))
    runner.answer("retry")
    through(runner)
    assert runner.call is not None
    assert sum(isinstance(event, OperatorCalled) for event in runner.events) == 2


def test_a_stop_survives_a_checkpoint() -> None:
    runner = through(Runner(begin(WAITING)))
    again = Runner(runner.checkpoint())
    assert again.call is not None
    again.answer("proceed")
    runner.answer("proceed")
    assert history(through(again).events) == history(through(runner).events)


def test_equal_seeds_give_equal_runs_and_others_do_not(whole: Runner) -> None:
    assert history(through(Runner(begin(GRASP))).events) == history(whole.events)
    assert history(through(Runner(begin(GRASP, seed=1))).events) != history(whole.events)


def test_the_cell_figures_of_a_run_taken_up_are_those_of_the_run() -> None:
    """Every figure of the model, so that a new one that events change cannot be forgotten."""
    runner = through(Runner(begin()))
    again = Runner(runner.checkpoint())
    mine, other = runner.cell.truth.model, again.cell.truth.model
    names = [name for name in dir(mine) if isinstance(getattr(mine, name, None), np.ndarray)]
    assert len(names) > 100
    assert [n for n in names if not np.array_equal(getattr(mine, n), getattr(other, n))] == []


def test_a_refused_way_back_leaves_the_run_as_it_was() -> None:
    runner = Runner(begin("OPEN .3\nOPEN .4\nOPEN .5\n"))
    runner.step()
    late = Runner(runner.checkpoint())
    with pytest.raises(
        InvalidInput,
        match=r"^this run begins with 1 step already done: there is no earlier state to go back to$",
    ):
        late.back_to(0)
    assert history(through(late).events) == history(through(runner).events)


def test_going_back_over_what_people_did_does_it_again() -> None:
    runner = Runner(begin("OPEN .3\nWAIT HERE\nOPEN .4\nOPEN .5\nSAVE D\n"))
    first = runner.checkpoint()
    through(runner).answer("proceed")
    runner.experiment("saved", "D", (0.01, 0.0, 0.0))
    for _ in range(2):
        runner.step()
    late = Runner(runner.checkpoint())
    late.back_to(3, lambda _: first)
    assert history(late.events) == history(runner.events[: len(late.events)])
    assert late.context.state.saved["D"] == pytest.approx([0.01, 0, 0])
    late.step()
    assert history(late.events) == history(runner.events)
