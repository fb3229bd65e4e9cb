"""A run in the hands of a program: it goes on, goes back, tells where it stands and what came of it."""

from collections.abc import Callable, Iterator
from pathlib import Path

import mujoco
import numpy as np
import pytest

import handeye
from handeye.core.errors import InvalidInput
from handeye.program.events import RunFinished, StepFinished

pytestmark = pytest.mark.slow

SCRIPT = """\
        STAGE   "open up"
        OPEN    1
        OPEN    2
        STAGE   "shut the hand"
L1:     SEARCH  .1
        OPEN    1.5
"""
STOPS = "OPEN 1\nCLOSE .5\nOPEN 2\n"
"""The operator is called at its second line: nothing is between the fingers."""


@pytest.fixture(scope="module")
def whole() -> handeye.Run:
    return handeye.begin(SCRIPT, seed=3, camera="ray")


@pytest.fixture
def run(whole: handeye.Run) -> Iterator[handeye.Run]:
    """A run of which nothing is done."""
    yield whole
    if whole.state.position:
        whole.back(whole.state.position)
    for made in whole.say("breaks").breaks:
        whole.say(f"delete {made.number}")


@pytest.fixture(scope="module")
def kept(tmp_path_factory: pytest.TempPathFactory) -> handeye.Run:
    """A run that was carried out to its end and kept in a folder."""
    return handeye.assemble(3, script=SCRIPT, camera="ray", out=tmp_path_factory.mktemp("runs") / "kept")


def test_a_step_tells_where_the_run_then_stands(run: handeye.Run) -> None:
    state = run.step()
    assert (state.position, state.stage, state.line, state.text) == (1, "open up", 3, "OPEN 2")
    assert state.why == "paused after 1 step"
    assert state.time > 0


def test_the_state_is_in_si_units_and_cannot_be_changed(run: handeye.Run) -> None:
    state = run.step()
    assert state.gap == pytest.approx(0.0254, abs=0.0005)
    assert (state.joints.shape, state.hand.shape, state.force.shape) == ((6,), (4, 4), (3,))
    assert np.linalg.det(state.hand[:3, :3]) == pytest.approx(1)
    with pytest.raises(ValueError, match="read-only"):
        state.joints[0] = 1.0


def test_a_state_stays_as_it_was_when_the_run_goes_on(run: handeye.Run) -> None:
    state = run.step()
    run.step()
    assert (state.position, state.gap < run.state.gap) == (1, True)


def test_states_are_equal_if_all_in_them_is(run: handeye.Run) -> None:
    state = run.step()
    run.back()
    assert run.state != state
    assert run.step() == state
    assert run.state.memory == state.memory
    assert run.step() != state


@pytest.mark.parametrize(
    ("place", "line", "why"),
    [
        ("shut", 5, "breakpoint at stage 2, shut the hand"),
        ("hand", 5, "breakpoint at stage 2, shut the hand"),
        ("L1", 5, "breakpoint at label L1"),
        ("SEARCH", 5, "breakpoint at SEARCH"),
        (6, 6, "breakpoint at line 6"),
        ("6", 6, "breakpoint at line 6"),
    ],
)
def test_a_run_goes_on_to_a_place(run: handeye.Run, place: str | int, line: int, why: str) -> None:
    state = run.until(place)
    assert (state.line, state.why) == (line, why)


def test_a_run_goes_on_to_its_end(run: handeye.Run) -> None:
    state = run.until()
    assert (state.step, state.line, state.why) == (None, None, "the program finished")
    assert (run.ended, run.completed, run.assembled) == (True, True, None)


def test_a_break_stops_every_way_of_going_on(run: handeye.Run) -> None:
    assert run.break_at("L1").number >= 1
    assert run.until().line == 5
    assert run.until().line is None


def test_a_run_goes_back_by_steps_and_by_stages(run: handeye.Run) -> None:
    before = [run.state, run.step(), run.step()]
    run.until()
    assert [run.back("shut").position, run.back().position, run.back("open up").position] == [2, 1, 0]
    again = [run.state, run.step(), run.step()]
    assert [list(state.joints) for state in again] == [list(state.joints) for state in before]


def test_the_arm_undoes_steps_and_stages_and_that_is_part_of_the_run(run: handeye.Run) -> None:
    opened = run.step().gap
    run.until()
    assert run.undo().text == "OPEN 1.5"
    state = run.undo("open")
    assert (state.text, state.stage, state.position) == ("OPEN 1", "open up", 8)
    assert state.gap < opened / 2
    with pytest.raises(InvalidInput, match=r"^1 step cannot be undone: none has been executed$"):
        run.undo()
    assert run.step().text == "OPEN 2"
    assert not run.dismantle().step
    assert (run.ended, run.result.apart) == (True, True)


def test_what_is_undone_has_not_happened(run: handeye.Run) -> None:
    run.step(2)
    run.back(2)
    assert not any(isinstance(event, StepFinished) for event in run.events)


def test_the_stepper_is_spoken_to(run: handeye.Run) -> None:
    reply = run.say("step 2")
    assert (reply.position, reply.line, run.state.position) == (2, 5, 2)
    assert "gap" in str(run.say("show gap"))
    assert run.say("stpe").error == str(run.say("stpe")) == "there is no command `stpe`; did you mean `step`?"


@pytest.mark.parametrize(
    ("wrong", "sentence"),
    [
        (lambda run: run.step(0), r"^steps must be a whole number of 1 or more, not 0$"),
        (lambda run: run.step("2"), r"^steps must be a whole number of 1 or more, not '2'$"),
        (
            lambda run: run.step(np.array([1, 2])),
            r"^steps must be a whole number of 1 or more, not array\(\[1, 2\]\)$",
        ),
        (
            lambda run: run.until("L9"),
            r"^the program has no label, instruction or stage `L9`; did you mean `L1`",
        ),
        (lambda run: run.until() and run.until(), r"^the program has ended"),
        (lambda run: run.until("L1") and run.until("open up"), r"^the run cannot reach open up from here$"),
        (lambda run: run.until(3.5), r"^a place must be a text or a line number, not 3\.5$"),
        (lambda run: run.say(3), r"^a command of the stepper must be a text, not 3$"),
        (lambda run: run.back(), r"^1 step cannot be undone: none has been done$"),
        (lambda run: run.step() and run.back(2), r"^2 steps cannot be undone: only 1 has been done$"),
        (lambda run: run.until() and run.undo(99), r"^99 steps cannot be undone: only 4 have been executed$"),
        (lambda run: run.back("shut"), r"^stage shut the hand has not begun yet$"),
        (lambda run: run.checkpoint(), r"^this run has no folder for checkpoints; name a file$"),
        (lambda run: run.trace, r"^the run has no folder, and so no trace; begin the run with out=\.\.\.$"),
    ],
)
def test_what_cannot_be_done_is_told_in_one_sentence(run: handeye.Run, wrong: object, sentence: str) -> None:
    with pytest.raises(InvalidInput, match=sentence):
        wrong(run)


def test_a_call_of_the_operator_stops_the_run_and_can_be_answered() -> None:
    run = handeye.begin(STOPS, camera="ray")
    assert run.until().why.startswith(
        "the program called the operator: the fingers closed beyond the minimum gap"
    )
    assert (run.completed, run.result.error, run.result.stopped_at) == (False, 2, "program")
    run.say("proceed")
    assert run.until().why == "the program finished"
    assert run.result.interventions != ()


def test_a_step_that_is_broken_off_is_not_done(run: handeye.Run, monkeypatch: pytest.MonkeyPatch) -> None:
    def interrupt(*_: object) -> None:
        raise KeyboardInterrupt

    begun, gap = len(run.events), run.state.gap
    with monkeypatch.context() as broken:
        broken.setattr(run._runner.context.drive, "watch", interrupt)
        with pytest.raises(KeyboardInterrupt):
            run.step()
    assert (run.state.position, len(run.events), run.state.gap) == (0, begun, gap)
    assert run.step().position == 1


def test_a_checkpoint_is_gone_on_from(run: handeye.Run, tmp_path: Path) -> None:
    run.until("L1")
    file = run.checkpoint(tmp_path / "here.checkpoint")
    other = handeye.begin(file)
    assert (other.state.position, other.plan) == (2, run.plan)
    assert list(other.until().joints) == list(run.until().joints)


@pytest.mark.parametrize(
    "act",
    [
        lambda run: run.step(),
        lambda run: run.break_at("L1"),
        lambda run: run.checkpoint(),
        lambda run: run.say("show"),
    ],
)
def test_with_a_run_that_is_closed_nothing_more_is_done(
    kept: handeye.Run, act: Callable[[handeye.Run], object]
) -> None:
    with pytest.raises(InvalidInput, match=r"^the run is closed; "):
        act(kept)
    kept.close()
    assert kept.completed


def test_the_folder_is_that_of_the_command_line(kept: handeye.Run) -> None:
    names = {path.relative_to(kept.out).as_posix() for path in kept.out.rglob("*") if path.is_file()}
    assert names >= {"plan.json", "events.jsonl", "trace.mcap", "result.json", "host.json"}
    assert {name for name in names if name.startswith("checkpoints/")} != set()
    assert isinstance(kept.trace.events[-1], RunFinished)
    assert kept.trace.head.world.seed == 3


def test_a_run_is_exported_as_it_now_is(kept: handeye.Run, run: handeye.Run, tmp_path: Path) -> None:
    run.step()
    half, whole = run.export(tmp_path / "half"), kept.export(tmp_path / "whole")
    assert (half.moment, whole.moment) == ("unfinished", "final")
    assert "after 1 step" in half.shows
    model = mujoco.MjModel.from_xml_path(f"{half.path}/scene.xml")
    assert model.key_time[-1] == pytest.approx(run.state.time)


def test_an_export_is_replaced_only_if_it_may_be(run: handeye.Run, tmp_path: Path) -> None:
    run.export(tmp_path / "scene")
    with pytest.raises(
        InvalidInput, match=r"scene already holds an export of handeye; overwrite=True replaces it$"
    ):
        run.export(tmp_path / "scene")
    assert run.export(tmp_path / "scene", overwrite=True).format == "mjcf"


def test_a_run_that_is_left_before_its_end_can_be_gone_on_with_in_its_folder(tmp_path: Path) -> None:
    with handeye.begin(SCRIPT, camera="ray", out=tmp_path / "run") as run:
        run.step(3)
    assert run.result.paused
    with handeye.begin(tmp_path / "run", out=tmp_path / "run") as run:
        assert run.state.position == 3
        run.until()
    assert (
        run.trace.counts == handeye.assemble(0, script=SCRIPT, camera="ray", out=tmp_path / "b").trace.counts
    )
    with pytest.raises(InvalidInput, match=r"has ended; omit `out="):
        handeye.begin(tmp_path / "run", out=tmp_path / "run")


def test_the_result_of_a_run_that_was_left_says_what_broke_it_off() -> None:
    run = handeye.begin(SCRIPT, camera="ray")
    with pytest.raises(InvalidInput, match="nowhere"), run:
        run.until("nowhere")
    said = "stopped by NoSuchName in the calling program"
    assert (run.result.message, run.result.paused) == (said, True)


def test_a_run_shows_itself(kept: handeye.Run, run: handeye.Run) -> None:
    assert repr(run) == "<Run script, seed 3: 0 steps done, 0.00 s, open up, line 2: OPEN 1; paused>"
    page = kept._repr_html_()
    assert "shut the hand" in page
    assert "The program reported success, but the pump is not right" in page
    assert "screws_clamp" in page


def test_the_page_of_a_run_has_the_times_of_the_cell_and_none_of_the_computer(kept: handeye.Run) -> None:
    page = kept._repr_html_()
    assert "working phase, without vision" in page
    assert "processor" not in page
    assert "1973" not in page  # another program than the one that was timed then


def test_the_page_of_a_run_escapes_what_a_script_says() -> None:
    page = handeye.begin('STAGE "<script>x</script>"\nOPEN 1\n', camera="ray")._repr_html_()
    assert "&lt;script&gt;" in page
    assert "<script" not in page
