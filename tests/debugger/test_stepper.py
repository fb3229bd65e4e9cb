"""The interactive stepper, as whoever uses it sees it."""

import math
from collections.abc import Callable
from pathlib import Path

import msgspec
import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from short_runs import begin, history, through
from stepper_bench import AIR, before_pins, reset

from handeye.core.errors import InvalidInput
from handeye.core.files import write_whole
from handeye.core.pose import hand, hand_angles
from handeye.core.units import INCH, OUNCE_FORCE
from handeye.debugger.command_table import COMMANDS
from handeye.debugger.formatting import as_text
from handeye.debugger.live import LineInput, Pace
from handeye.debugger.reply import Reply
from handeye.debugger.stepper import Stepper, interact
from handeye.execution.state import Shot, VisionResult
from handeye.program.events import (
    AnyEvent,
    ExperimentMade,
    GuardTripped,
    OperatorAnswered,
    PictureTaken,
    Restored,
    StepStarted,
)
from handeye.program.guards import GuardKind
from handeye.results.pauses import pause_sentence, stop_name
from handeye.runs.advance import AtLabel, ByHand
from handeye.runs.checkpoint_file import read_checkpoint, write_checkpoint
from handeye.runs.checkpoint_store import CheckpointStore
from handeye.runs.observer import Observer
from handeye.runs.runner import Runner
from handeye.runs.snapshot import Checkpoint
from handeye.systems.stanford.topics import TOPICS
from handeye.tasks.water_pump.world.nominal import DRAWING
from handeye.vision.base import GeneralLocation
from handeye.vision.blob import BoundingBox

pytestmark = pytest.mark.slow

CALLED = (
    "the fingers closed beyond the minimum gap: there is nothing between them, or the object is too thin "
    "(gap 0.00 in, minimum 0.40 in)"
)
Say = Callable[..., list[Reply]]


@pytest.fixture(scope="module")
def built() -> Runner:
    return Runner(begin(AIR))


@pytest.fixture
def runner(built: Runner) -> Runner:
    """A run in the air that has done nothing yet; it would call the operator in its third stage."""
    return reset(built)


@pytest.fixture
def stepper(runner: Runner, tmp_path: Path) -> Stepper:
    return Stepper(runner, pictures=tmp_path / "pictures")


@pytest.fixture
def say(stepper: Stepper) -> Say:
    """Say some commands; the answers."""
    return lambda *commands: [stepper.do(command) for command in commands]


@pytest.fixture(scope="module")
def whole(built: Runner) -> bytes:
    """What happens up to the call to the operator when nobody interferes."""
    return history(through(reset(built)).events)


def why(reply: Reply) -> tuple[str, str]:
    """The kind of a pause, and its sentence."""
    assert reply.pause is not None
    return reply.pause.kind, pause_sentence(reply.pause)


def lines_of(stepper: Stepper, *commands: str, json: bool = False, prompt: bool = False) -> list[str]:
    """What is put out for some lines of input."""
    out: list[str] = []
    interact(stepper, iter(commands), out.append, json=json, prompt=prompt)
    return out


# -- going on and back ----------------------------------------------------------------------------------


def test_stepping_from_standard_input_gives_the_events_of_a_run_through(
    stepper: Stepper, runner: Runner, whole: bytes
) -> None:
    lines_of(stepper, *["step"] * 11)
    assert history(runner.events) == whole


def test_pauses_and_a_pace_change_no_event(stepper: Stepper, runner: Runner, whole: bytes) -> None:
    slept: list[float] = []
    stepper.session.pace = Pace(4.0, clock=lambda: sum(slept), sleep=slept.append)
    stepper.session.input = LineInput(
        lambda: None if stepper.session._pause_asked else "pause", stepper.meanwhile
    )
    assert [stepper.do("c").position for _ in range(11)] == [*range(1, 12)]
    assert history(runner.events) == whole
    assert sum(slept) == pytest.approx(runner.time / 4, rel=0.2)


def test_the_pin_insertion_with_breaks_and_ten_times_back_gives_the_events_of_a_run_through(
    tmp_path: Path,
) -> None:
    begun = before_pins()
    expected = history(through(Runner(begun)).events)
    runner = Runner(begun)
    stepper = Stepper(runner, breaks=["AOJ", "error:23"], pictures=tmp_path)
    said = ["c", "b", "s", "b 3", "c", "s", "c", "b 2", "c", "b", "b", "until AOJ", "bs", "until AOJ", "c"]
    said += ["b 4", "c", "c", "b", "c", "c", "b", "c", "b 9", *["c"] * 20]
    out = lines_of(stepper, *said)
    assert runner.call is None
    assert history(runner.events) == expected
    assert sum("undone" in answer for answer in out) == 10


def test_going_back_and_forward_again_gives_the_same_answers_to_the_byte(say: Say) -> None:
    forth = say("s", "s 2", "s 3", "s")
    say("b 4", "back", "b 2")
    assert say("s", "s 2", "s 3", "s") == forth


@pytest.mark.parametrize(
    ("commands", "position", "line"),
    [
        (["step"], 1, 5),
        (["s 3"], 3, 8),
        (["stage"], 2, 7),
        (["n", "n"], 9, 18),
        (["continue"], 11, None),
        (["u 8"], 3, 8),
        (["until L2"], 7, 14),
        (["until search"], 2, 7),
        (["s 5", "back"], 4, 10),
        (["s 5", "b 3"], 2, 7),
        (["s 5", "back stage"], 2, 7),
        (["s 5", "bs", "bs"], 0, 4),
        (["s 2", "bs"], 0, 4),
        (["STEP 2"], 2, 7),
        (["  s   2  "], 2, 7),
    ],
)
def test_commands_lead_where_they_say(say: Say, commands: list[str], position: int, line: int | None) -> None:
    last = say(*commands)[-1]
    assert (last.error, last.position, last.line) == (None, position, line)


def test_an_answer_says_what_was_done_and_where_the_run_now_stands(say: Say) -> None:
    say("until 9")
    assert as_text(say("s 2")[0]).splitlines() == [
        "   10 CHANGE [0 0 -1] .1             error 23: the motion ended without meeting the force of its STOP",
        "   11 SKIPE 23                       error 23 occurred: continue at line 13",
        "── stage 2, search in the air, step 7; 6 steps done, 3.22 s",
        "    11          SKIPE   23",
        "    12          JUMP    L1",
        "  → 13          SAVE    H",
        "    14  L2:     AOJ     L3",
        "    15  L3:     MOVE    T",
    ]


def test_of_a_long_way_the_last_lines_are_told(say: Say) -> None:
    reply = say("s 2")[0]
    many = msgspec.structs.replace(reply, did=reply.did[1:2] * 30 + reply.did[2:])
    assert as_text(many, most=24).splitlines()[:2] == [
        "      … 7 lines before these",
        "    4 OPEN .5                        gap 0.50 in",
    ]
    assert len(as_text(many).splitlines()) == 7 + len(as_text(many, most=24).splitlines()) - 1


# -- breaks ---------------------------------------------------------------------------------------------


def test_breaks_stop_the_run_and_can_be_listed_and_deleted(say: Say) -> None:
    listed = say("break AOJ", "break error:23", "break 8", "delete 1", "breaks")[-1]
    assert [(each.number, stop_name(each.stop)) for each in listed.breaks] == [(2, "error 23"), (3, "line 8")]
    assert [answer.line for answer in say("c", "c", "delete 2", "delete 3", "u 18")] == [8, 11, 11, 11, 18]


def test_a_number_of_a_break_is_not_used_again(say: Say) -> None:
    listed = say("break AOJ", "delete 1", "break 8")[-1]
    assert [each.number for each in listed.breaks] == [2]


@pytest.mark.parametrize(("place", "again"), [("AOJ", "aoj"), ("L1", "l1"), ("8", "here/short.al:8")])
def test_a_break_that_is_set_already_is_not_set_again(say: Say, place: str, again: str) -> None:
    first, second, listed = say(f"break {place}", f"break {again}", "breaks")
    assert (second.breaks, second.said) == (first.breaks, "this breakpoint is already set")
    assert listed.breaks == first.breaks


def test_breaks_given_at_the_beginning_are_set(runner: Runner, tmp_path: Path) -> None:
    stepper = Stepper(runner, breaks=["L1"], pictures=tmp_path)
    pause = stepper.do("c").pause
    assert pause is not None
    assert (pause.met, pause.next) == (AtLabel(steps=(3,), label="L1"), 3)


def test_a_stepper_with_a_wrong_break_is_refused(runner: Runner, tmp_path: Path) -> None:
    with pytest.raises(InvalidInput, match=r"^the program has no label, instruction or stage `L7`"):
        Stepper(runner, breaks=["L7"], pictures=tmp_path)


# -- looking --------------------------------------------------------------------------------------------


def test_the_script_is_listed_around_a_line_with_its_labels_and_comments(say: Say) -> None:
    lines = as_text(say("until L1", "list")[-1]).splitlines()[1:]
    assert len(lines) == 16
    assert lines[7] == "  →  8  L1:     MOVE    T               ;OVER THE TABLE"
    assert [line.line for line in say("list 20")[0].source] == list(range(12, 23))


def test_everything_there_is_to_see_has_a_line(say: Say) -> None:
    shown = as_text(say("until AOJ", "show")[-1])
    titles = [line.split()[0] for line in shown.splitlines()[1:] if not line.startswith(" ")]
    assert titles == [topic for topic in TOPICS if topic != "positions"]


@pytest.mark.parametrize(
    ("what", "field"), [(topic, field) for topic, (field, _) in TOPICS.items()] + [("sa", "saved_in")]
)
def test_one_thing_can_be_shown(say: Say, what: str, field: str) -> None:
    shown = msgspec.to_builtins(say(f"show {what}")[0])["show"]
    assert list(shown) == [field]


def test_what_is_shown_is_in_the_units_of_the_language(say: Say) -> None:
    shown = say("until AOJ", "p")[-1].show
    assert shown.hand.at_in == pytest.approx((20, 28, 7.8), abs=0.05)
    assert shown.hand.angles_deg == pytest.approx((90, 90, 0), abs=0.2)
    assert [joint.unit for joint in shown.joints] == ["deg", "deg", "in", "deg", "deg", "deg"]
    assert shown.gap_in == pytest.approx(0.4, abs=0.03)
    assert shown.saved_in["H"] == pytest.approx((0, 0, -0.1), abs=0.03)
    assert (shown.search.place, shown.search.places) == (1, 49)
    assert shown.parts["PUMP"].planned.at_in == (25.0, 38.0, 0.0)


def test_an_error_that_the_next_step_tests_is_shown(say: Say) -> None:
    assert say("break error:23", "c", "show error")[-1].show.error.number == 23
    assert say("s", "show error")[-1].show.error is None


def test_measured_parts_are_shown_beside_their_plan(say: Say, runner: Runner) -> None:
    X_WP = runner.context.world.part("BASE").copy()
    X_WP[0, 3] += 0.1 * INCH
    runner.context.world.measure("BASE", X_WP)
    part = say("show parts")[0].show.parts["BASE"]
    assert part.difference.at_in == pytest.approx((0.1, 0, 0))
    assert part.measured.at_in[0] == pytest.approx(part.planned.at_in[0] + 0.1)


def test_force_is_shown_where_a_guard_has_just_stopped_the_hand_and_nowhere_else(
    say: Say, runner: Runner
) -> None:
    say("until 13")
    shown = say("show force")[0]
    assert shown.show.force_oz is None
    assert (
        as_text(shown).splitlines()[-1]
        == "force     there is no force estimate here, because no guard ended the last step"
    )
    runner.context.state.drive.wrench = np.array((0, 0, -8.0, 0, 0, 0))
    runner.events.append(GuardTripped(time=runner.time, guard=GuardKind.FORCE, value=8.0, limit=7.0))
    assert say("show force")[0].show.force_oz == pytest.approx((0, 0, 8 / OUNCE_FORCE), abs=1e-3)
    assert say("s", "show force")[-1].show.force_oz is not None
    assert say("until 18", "show force")[-1].show.force_oz is None


def test_the_last_picture_is_written_to_a_file_that_is_told(say: Say, runner: Runner, tmp_path: Path) -> None:
    picture = np.full((256, 333), 7, np.uint8)
    runner.context.state.shots["CLOSE_UP"] = Shot(picture=picture, view=DRAWING.view(0.05, 0.0, 0.0))
    runner.events.append(PictureTaken(time=0.0, picture="CLOSE_UP", lens=0.05))
    shown = say("show picture")[0].show.picture
    assert (shown.name, shown.file) == ("CLOSE_UP", str(tmp_path / "pictures" / "close_up.png"))
    assert Path(shown.file).read_bytes().startswith(b"\x89PNG")


def test_without_a_folder_a_picture_is_named_and_written_only_where_somebody_says(
    runner: Runner, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.chdir(tmp_path)
    picture = np.full((256, 333), 7, np.uint8)
    runner.context.state.shots["CLOSE_UP"] = Shot(picture=picture, view=DRAWING.view(0.05, 0.0, 0.0))
    runner.events.append(PictureTaken(time=0.0, picture="CLOSE_UP", lens=0.05))
    stepper = Stepper(runner)
    assert as_text(stepper.do("show picture")).splitlines()[1:] == ["picture   CLOSE_UP"]
    assert list(tmp_path.iterdir()) == []
    assert stepper.do("picture seen.png").said == "CLOSE_UP, in seen.png"
    written = Path("seen.png").read_bytes()
    assert written.startswith(b"\x89PNG")
    assert (
        stepper.do("picture seen.png").error
        == "seen.png already exists; nothing was written, choose another name"
    )
    assert Path("seen.png").read_bytes() == written


@given(
    st.tuples(*[st.floats(-3, 3)] * 3), st.floats(-math.pi, math.pi), st.floats(-1.5, 1.5), st.floats(-3, 3)
)
def test_the_angles_of_a_hand_are_those_it_was_put_to(
    at: tuple[float, float, float], o: float, a: float, t: float
) -> None:
    X_WT = hand(*at, o, a, t)
    assert hand(*at, *hand_angles(X_WT)) == pytest.approx(X_WT, abs=1e-9)


def test_a_hand_that_points_down_has_its_turn_in_the_first_angle() -> None:
    assert hand_angles(hand(0, 0, 0, 0.3, math.pi / 2, 0.0)) == pytest.approx((0.3, math.pi / 2, 0.0))


# -- experiments ----------------------------------------------------------------------------------------


def test_a_saved_difference_can_be_set_for_an_experiment(say: Say, runner: Runner) -> None:
    made = say("until L3", "set saved h [0 .5 0]")[-1]
    assert [type(event) for event in made.events] == [ExperimentMade]
    assert made.did[0].text == "experiment: saved H is set to (0.000, 0.500, 0.000) in"
    say("s")
    (restored,) = [event for event in runner.events if isinstance(event, Restored)]
    assert restored.difference == pytest.approx((0, 0.5 * INCH, 0))


@pytest.mark.parametrize(("angles", "expected"), [("", (90, 90, 0)), (" 80 90 0", (80, 90, 0))])
def test_a_position_can_be_taught_anew_for_an_experiment(
    say: Say, angles: str, expected: tuple[float, ...]
) -> None:
    taught = say(f"set position T 20 28.5 8{angles}", "show positions")[-1].show.positions["T"]
    assert taught.at == pytest.approx((20, 28.5, 8, *expected))
    assert taught.moved
    assert say("until 9", "show hand")[-1].show.hand.at_in == pytest.approx((20, 28.5, 8), abs=0.05)


def test_going_back_undoes_an_experiment(say: Say) -> None:
    assert say("s", "set saved H 1 1 1", "b", "show saved")[-1].show.saved_in == {}


# -- the operator ---------------------------------------------------------------------------------------


def test_the_call_of_the_operator_is_told_with_what_can_be_said(say: Say) -> None:
    called = say("c")[0]
    assert why(called) == ("operator", CALLED)
    assert (
        called.said
        == "the program calls the operator: answer `proceed`, `retry`, `skip` or `abort`, or use `back` or `undo`"
    )
    assert called.did[-1].outcome == f"error 2: {CALLED}; the program calls the operator"
    assert "  ■ 19          CLOSE   .4" in as_text(called).splitlines()


@pytest.mark.parametrize(("choice", "line"), [("proceed", 20), ("retry", 18), ("skip", 22)])
def test_the_operator_says_where_the_program_goes_on(say: Say, choice: str, line: int) -> None:
    answer = say("c", choice)[-1]
    assert answer.line == line
    assert [event.choice for event in answer.events if isinstance(event, OperatorAnswered)] == [choice]


def test_abort_ends_the_run_where_the_operator_was_called(stepper: Stepper) -> None:
    assert interact(stepper, iter(["c", "abort", "step"]), lambda _: None).kind == "operator"
    assert stepper.over


def test_one_can_go_back_instead_of_answering(say: Say, whole: bytes, runner: Runner) -> None:
    assert why(say("c", "b", "c")[-1]) == ("operator", CALLED)
    assert history(runner.events) == whole


# -- ends -----------------------------------------------------------------------------------------------


def test_the_end_of_the_program_is_told_and_one_can_go_back_from_it(say: Say) -> None:
    ended = say("c", "skip", "c")[-1]
    assert why(ended) == ("end", "the program finished")
    assert (ended.stage, ended.line) == (None, None)
    assert say("step")[0].error == "the program has ended: `back` goes back from here, `quit` leaves"
    assert [answer.line for answer in say("b", "s", "bs")] == [22, None, 22]


def test_an_answer_that_ends_the_program_says_so(tmp_path: Path) -> None:
    stepper = Stepper(Runner(begin("OPEN .3\nWAIT HERE\n")), pictures=tmp_path)
    called, ended = stepper.do("c"), stepper.do("proceed")
    assert called.did[-1].outcome == "brakes set, operator called: HERE"
    assert why(ended) == ("end", "the program finished")
    assert ended.said == "the program has ended: `back` goes back from here, `quit` leaves"


def test_the_end_of_the_input_is_taken_for_quit(stepper: Stepper) -> None:
    out: list[str] = []
    pause = interact(stepper, iter(["s"]), out.append)
    assert (pause.kind, pause.met) == ("break", ByHand())
    assert out[-1].splitlines()[-1] == "nothing was saved, because this run has no folder for checkpoints"


@pytest.mark.parametrize("commands", [("q",), ("exit",), ("s 2", "b 2", "q"), ("s", "b", "set x", "q")])
def test_where_nothing_was_done_nothing_is_kept(runner: Runner, commands: tuple[str, ...]) -> None:
    def keep(checkpoint: Checkpoint) -> Path:
        raise AssertionError

    out = lines_of(Stepper(runner, keep=keep), *commands)
    assert out[-1].splitlines()[-1] == "no step has run, so there is no state to save"


def test_an_experiment_is_something_that_was_done(stepper: Stepper) -> None:
    assert (
        lines_of(stepper, "set saved H 0 0 0", "q")[-1].splitlines()[-1]
        == "nothing was saved, because this run has no folder for checkpoints"
    )


def test_a_run_that_begins_at_a_checkpoint_says_so_to_those_who_go_back_behind_it(runner: Runner) -> None:
    Stepper(runner).do("until 14")
    again = Stepper(Runner(runner.checkpoint()))
    reach = "this run begins with 7 steps already done: there is no earlier state to go back to"
    assert [again.do(text).error for text in ("b", "bs", "b 1000")] == [reach] * 3
    again.do("s 2")
    assert [again.do(text).error for text in ("b 3", "b 2")] == [reach, None]


def test_going_back_behind_the_beginning_of_a_run_uses_earlier_checkpoints(
    runner: Runner, tmp_path: Path, whole: bytes
) -> None:
    folder, stepper = CheckpointStore(tmp_path), Stepper(runner)
    stepper.do("stage")
    folder.save(runner.checkpoint())
    stepper.do("until 14")
    again = Stepper(Runner(runner.checkpoint()), kept=folder.at_or_before)
    assert [again.do(text).position for text in ("bs", "s 3", "b 2")] == [2, 5, 3]
    assert (
        again.do("b 3").error
        == "this run begins with 2 steps already done: there is no earlier state to go back to"
    )
    again.do("c")
    assert history(again.session.runner.events) == whole


def test_quit_keeps_a_checkpoint_that_goes_on_from_there(
    runner: Runner, tmp_path: Path, whole: bytes
) -> None:
    file = tmp_path / "kept.checkpoint"

    def keep(checkpoint: Checkpoint) -> Path:
        write_checkpoint(file, checkpoint)
        return file

    stepper = Stepper(runner, keep=keep, pictures=tmp_path)
    out = lines_of(stepper, "s 4", "q", "s")
    assert out[-1].splitlines()[-1] == f"saved to {file}"
    assert history(through(Runner(read_checkpoint(file))).events) == whole


def test_a_checkpoint_that_cannot_be_kept_does_not_keep_anybody_from_leaving(
    runner: Runner, tmp_path: Path
) -> None:
    def keep(checkpoint: Checkpoint) -> Path:
        write_whole(tmp_path / "nowhere" / "x", b"")
        raise AssertionError

    stepper = Stepper(runner, keep=keep, pictures=tmp_path)
    assert "cannot be written: No such file or directory" in lines_of(stepper, "s", "q")[-1]
    assert stepper.over


def test_a_checkpoint_goes_to_the_file_that_is_named(say: Say, tmp_path: Path) -> None:
    file = tmp_path / "here and now.checkpoint"
    assert say("s 3", f"checkpoint {file}")[-1].file == str(file)
    assert read_checkpoint(file).position == 3
    assert (
        say("s", f"checkpoint {file}")[-1].error
        == f"{file} already exists; nothing was written, choose another name"
    )
    assert read_checkpoint(file).position == 3


def test_a_file_that_is_no_checkpoint_is_left_alone(say: Say, tmp_path: Path) -> None:
    file = tmp_path / "pump.al"
    file.write_text("PARK\n")
    assert say(f"checkpoint {file}")[0].error == f"{file} exists and is not a checkpoint; nothing was written"
    assert file.read_text() == "PARK\n"


def test_the_panic_button_is_told_and_the_step_can_be_done_again(tmp_path: Path, whole: bytes) -> None:
    pressed, events = iter([False] * 5 + [True]), list[object]()
    runner = Runner(
        begin(AIR),
        halt=lambda: any(isinstance(event, StepStarted) for event in events) and next(pressed, False),
    )
    events = runner.events  # pressed in the first step, after the joints have been measured
    stepper = Stepper(runner, pictures=tmp_path)
    stopped = stepper.do("s 2")
    assert why(stopped) == ("panic", "stopped by the panic button; the brakes are set")
    assert (
        stopped.said
        == "stopped by the panic button; the brakes are set; the simulator is back at the start of the interrupted step"
    )
    assert stopped.position < 2
    stepper.do("c")
    assert history(runner.events) == whole


def test_findings_that_no_picture_can_hold_are_refused_in_a_sentence(runner: Runner, tmp_path: Path) -> None:
    runner.context.state.shots["WIDE"] = Shot(
        picture=np.zeros((256, 333), np.uint8), view=DRAWING.view(0.025, 0.0, 0.0)
    )
    box = BoundingBox(10**9, 0, 10**9, 1)
    far = GeneralLocation(box=box, x=0.0, y=0.0, corners=(), beams=0, points=0)
    runner.context.state.found["WIDE"] = VisionResult(general=far)
    runner.events.append(PictureTaken(time=0.0, picture="WIDE", lens=0.025))
    refused = Stepper(runner).do(f"picture {tmp_path / 'wide.png'}")
    assert refused.error == "the findings in picture WIDE cannot be drawn"


def test_a_picture_of_which_only_the_event_is_left_is_not_shown(say: Say, runner: Runner) -> None:
    runner.events.append(PictureTaken(time=0.0, picture="../../GONE", lens=0.05))
    shown, written = say("show picture", "picture gone.png")
    assert shown.show.picture is None
    assert written.error == "the program has taken no picture yet"


def test_a_run_in_trouble_goes_nowhere_but_back(say: Say, runner: Runner) -> None:
    say("s 2")
    runner._broken = "the simulation lost its footing"
    assert (
        say("s")[0].error
        == "the run can only go back, and cannot continue from here: the simulation lost its footing"
    )
    assert (
        say("set saved H 0 0 0")[0].error
        == "no value can be set, because the run cannot continue from here; first go back with `back`"
    )
    assert [answer.position for answer in say("b", "s")] == [1, 2]


def test_a_step_that_cannot_be_written_down_is_undone_and_can_be_done_again(
    say: Say, runner: Runner, whole: bytes
) -> None:
    class Full(Observer):
        def event(self, event: AnyEvent) -> None:
            raise InvalidInput("trace.mcap cannot be written: No space left on device")

    say("s")
    runner.observers.append(Full())
    refused = say("s")[0]
    assert (refused.error, refused.position) == ("trace.mcap cannot be written: No space left on device", 1)
    runner.observers.clear()
    say("c")
    assert history(runner.events) == whole


# -- wrong commands -------------------------------------------------------------------------------------


@pytest.mark.parametrize(
    ("command", "sentence"),
    [
        ("stpe", "there is no command `stpe`; did you mean `step`?"),
        ("run", "there is no command `run`; did you mean `continue`?"),
        ("frobnicate", "there is no command `frobnicate`; `help` lists the commands"),
        ("contineu", "there is no command `contineu`; did you mean `continue`?"),
        ("step x", "`step` takes a number of 1 or more, not `x`"),
        ("step 0", "`step` takes a number of 1 or more, not `0`"),
        ("step -1", "`step` takes a number of 1 or more, not `-1`"),
        ("stage 2", "`stage` takes no operand; remove `2`"),
        ("pause", "the run is already paused"),
        ("pace 0", "`pace` takes `1x`, `4x`, another number from 0.25x to 100x, or `free`, not `0`"),
        ("until", "give an error (error:23), a line, a label, an instruction or a stage"),
        ("until L7", "the program has no label, instruction or stage `L7`; did you mean `L1`?"),
        ("back", "the run is at its first step: there is no earlier state to go back to"),
        ("back stage", "the run is at its first step: there is no earlier state to go back to"),
        ("back x", "`back` takes a number of 1 or more, or `stage`, not `x`"),
        ("break", "give an error (error:23), a line, a label, an instruction or a stage"),
        ("break 99", "line 99 is after the last step, which is on line 22"),
        ("delete", "`delete` takes the number of a breakpoint; breakpoints: none"),
        ("delete foo", "`delete` takes the number of a breakpoint, not `foo`; breakpoints: none"),
        ("delete 4", "there is no breakpoint 4; breakpoints: none"),
        ("picture", "give `picture` the name of a new file, such as `picture base.png`"),
        ("picture x.png", "the program has taken no picture yet"),
        ("list 23", "`list` takes a line from 1 to 22, not `23`"),
        ("list x", "`list` takes a line from 1 to 22, not `x`"),
        ("show jiont", "there is no `jiont` to show; did you mean `joints`?"),
        ("show s", "there is no `s` to show; the topics are " + ", ".join(TOPICS)),
        ("set", "write `set saved NAME x y z` or `set position NAME x y z [o a t]`"),
        ("set speed 3", "write `set saved NAME x y z` or `set position NAME x y z [o a t]`"),
        ("set saved H 1 2", "write `set saved NAME x y z`"),
        ("set saved H 1 2 nan", "`nan` is not a number from -1000 to 1000"),
        ("set saved H 1 2 1e9", "`1e9` is not a number from -1000 to 1000"),
        ("set saved HH 1 2 3", "the program has no saved difference `HH`; did you mean `H`?"),
        ("set position T 1 2 3 4", "write `set position NAME x y z [o a t]`"),
        ("set position TT 1 2 3", "the program has no position `TT`; did you mean `T`?"),
        ("proceed", "`proceed` answers a call to the operator, but no call is waiting for an answer"),
        ("retry", "`retry` answers a call to the operator, but no call is waiting for an answer"),
        ("skip", "`skip` answers a call to the operator, but no call is waiting for an answer"),
        ("abort", "`abort` answers a call to the operator, but no call is waiting for an answer"),
        ("checkpoint", "this run has no folder for checkpoints; `checkpoint FILE` writes a checkpoint to a file"),
        ("help me", "there is no command `me`; `help` lists the commands"),
    ],
)  # fmt: skip
def test_a_wrong_command_is_answered_by_one_sentence_and_changes_nothing(
    say: Say, stepper: Stepper, runner: Runner, command: str, sentence: str
) -> None:
    before = (history(runner.events), runner.position, len(runner.history))
    answer = say(command)[0]
    assert as_text(answer) == sentence
    assert (history(runner.events), runner.position, len(runner.history)) == before
    assert not stepper.over


def test_going_back_farther_than_the_beginning_is_refused(say: Say) -> None:
    assert say("s 2", "b 3")[-1].error == "`back` can go back at most 2 steps"


def test_after_the_call_of_the_operator_going_on_needs_an_answer(say: Say) -> None:
    refusal = "the program calls the operator: answer `proceed`, `retry`, `skip` or `abort`, or use `back` or `undo`"
    assert [answer.error for answer in say("c", "step", "stage", "continue")] == [None, *[refusal] * 3]


# -- the two faces --------------------------------------------------------------------------------------


def test_each_command_is_answered_by_one_json_object_on_one_line(stepper: Stepper) -> None:
    commands = ["s", "frobnicate", "show", "help", "list", "break AOJ", "c", "b 2", "q"]
    out = lines_of(stepper, *commands, json=True)
    assert [msgspec.json.decode(line)["command"] for line in out] == commands
    assert not any("\n" in line for line in out)


def test_the_json_of_an_answer_says_where_the_run_stands_and_what_happened(stepper: Stepper) -> None:
    out = lines_of(stepper, "until L1", "frobnicate", "q", json=True)
    first, wrong = msgspec.json.decode(out[0]), msgspec.json.decode(out[1])
    assert list(first)[:8] == ["command", "position", "time", "stage", "stage_number", "step", "line", "text"]
    assert (first["position"], first["stage"], first["line"], first["text"]) == (
        3, "search in the air", 8, "MOVE    T"
    )  # fmt: skip
    assert (first["pause"]["kind"], first["pause"]["sentence"]) == ("break", "breakpoint at label L1")
    assert [event["event"] for event in first["events"]].count("StepFinished") == 3
    assert (first["error"], wrong["error"]) == (
        None,
        "there is no command `frobnicate`; `help` lists the commands",
    )
    assert (wrong["pause"], wrong["events"], wrong["position"]) == (None, [], 3)


def test_text_begins_with_where_the_run_stands(stepper: Stepper) -> None:
    assert lines_of(stepper, "q")[0].splitlines() == [
        "── stage 1, open the hand, step 0; 0 steps done, 0.00 s",
        "    2          TRANS   T [20 28 7.9 90 90 0]",
        '    3          STAGE   "open the hand"',
        "  → 4          OPEN    .5",
        "    5          OPEN    .4",
        '    6          STAGE   "search in the air"',
        "short, 14 steps; `help` lists the commands",
    ]


def test_an_empty_line_repeats_at_a_prompt_what_made_the_run_go(stepper: Stepper, runner: Runner) -> None:
    lines_of(stepper, "", "s 2", "", "show gap", "", prompt=True)
    assert runner.position == 4


def test_an_empty_line_says_nothing_where_nobody_is_asked(stepper: Stepper, runner: Runner) -> None:
    assert len(lines_of(stepper, "s", "", "  ", "q", json=True)) == 2
    assert runner.position == 1


def test_help_tells_all_commands_and_of_each_alone(say: Say) -> None:
    text = as_text(say("help")[0])
    others = [
        c for c in COMMANDS if c.name not in ("type", "set")
    ]  # there is no console; a program sets its own
    assert all(c.usage in text and c.help in text for c in others)
    assert "set saved NAME x y z" in text
    assert say("help bs")[0].said.splitlines()[0].startswith("back [N], b: go back one step")
    assert say("?")[0].said == say("h")[0].said == say("help")[0].said


def test_undo_has_the_arm_take_back_what_back_would_restore(say: Say) -> None:
    there, undone = say("step 2", "undo", "step")[1:]
    assert undone.position == there.position + 1
    (told,) = [step for step in there.did if step.line is not None]
    assert told.text.startswith("undo ")
    assert there.step is not None
    assert [event.step for event in undone.events if isinstance(event, StepStarted)] == [there.step]


def test_undo_takes_back_a_stage_and_no_more_than_was_done(say: Say) -> None:
    stage, nothing, far = say("step", "undo stage", "undo", "undo 2")[1:]
    assert (stage.step, stage.error) == (0, None)
    assert nothing.error == far.error == "there is nothing for the arm to undo"
