"""ML programs as runs: the worked example, stepping, going back, kept anywhere and resumed to the same bytes."""

from collections.abc import Sequence
from pathlib import Path

import pytest
from msgspec.structs import replace
from run_bench import FELT, HELD, NEAR, begin, lines, printed, program, ran

from handeye.core.errors import BadFile, Refused
from handeye.execution.servo import ServoPeriod
from handeye.program.events import LineTyped, OperatorCalled, StepFinished
from handeye.runs.advance import advance
from handeye.runs.checkpoint_file import read_checkpoint, write_checkpoint
from handeye.runs.observer import Observer
from handeye.runs.runner import Runner
from handeye.runs.snapshot import Checkpoint
from handeye.systems.ml.happenings import Nullified
from handeye.systems.ml.machine.surroundings import Stimulus
from handeye.systems.ml.realtime.happenings import Froze, LimitCrossed
from handeye.systems.ml.run.hardware import Ending
from handeye.systems.ml.run.running import RunningMl

FAR = Stimulus(channel="range", value=0.2, motor=3, beyond=2750)


def level(runner: Runner):  # type: ignore[no-untyped-def]
    assert isinstance(runner.system, RunningMl)
    return runner.system.machine.levels["right"]


@pytest.mark.ml_row(18)
def test_a_sensor_that_trips_at_2750_freezes_the_arm_and_nullifies_the_next_motion() -> None:
    runner = Runner(begin(program("guarded_move"), HELD, NEAR, FELT))
    advance(runner, steps=11)
    (froze,) = [event for event in runner.events if isinstance(event, Froze)]
    assert 2750 <= froze.positions[3] <= 2829
    assert (level(runner).position(2), level(runner).goal(2)) == (0, 0)
    assert [event.statement for event in runner.events if isinstance(event, Nullified)] == [295]
    advance(runner)
    assert printed(runner) == ["500"]


@pytest.mark.ml_row(19)
@pytest.mark.parametrize(
    ("stimuli", "ending", "y", "z"),
    [((HELD, NEAR, FAR), "550", 2787, 0), ((HELD, NEAR), "600", 4000, -100), ((NEAR,), "500", -500, 0)],
)
def test_the_other_endings(stimuli: Sequence[Stimulus], ending: str, y: int, z: int) -> None:
    runner = ran(program("guarded_move"), *stimuli)
    assert (printed(runner), level(runner).position(3), level(runner).position(2)) == ([ending], y, z)


@pytest.mark.ml_row(57)
@pytest.mark.parametrize("share", [1, 2, 3, 10, 100])
@pytest.mark.parametrize("stimuli", [(HELD, NEAR, FELT), (HELD, NEAR, FAR), (HELD, NEAR)])
def test_the_share_of_the_background_level_changes_no_outcome(
    share: int, stimuli: Sequence[Stimulus]
) -> None:
    def outcome(text: str) -> object:
        runner = ran(text, *stimuli)
        frozen = [event.positions for event in runner.events if isinstance(event, Froze)]
        return printed(runner), frozen, runner.system.state.machine.arms["right"].MT[2].position  # type: ignore[attr-defined]

    text = program("guarded_move")
    assert outcome(f"1 PUT CY 1 5 {share}\n{text}") == outcome(text)


@pytest.mark.ml_row(57)
def test_cy_shows_that_8_of_10_ms_are_used() -> None:
    runner = ran("1 GET 1 CY 1 3\n2 GET 2 CY 1 4\n3 PRINT &1 &2")
    assert printed(runner) == ["10 8"]


@pytest.mark.ml_row(42)
def test_two_runs_have_the_same_bytes() -> None:
    text = program("guarded_move")
    assert lines(ran(text, HELD, NEAR, FELT)) == lines(ran(text, HELD, NEAR, FELT))


@pytest.mark.slow
@pytest.mark.ml_row(42)
def test_a_run_kept_before_any_statement_is_resumed_to_the_same_bytes(tmp_path: Path) -> None:
    start = begin(program("guarded_move"), HELD, NEAR, FELT)
    whole = Runner(start)
    advance(whole)
    whole.finish()
    for steps in range(1, 15):
        first = Runner(start)
        advance(first, steps=steps)
        write_checkpoint(tmp_path / "kept", first.checkpoint())
        second = Runner(read_checkpoint(tmp_path / "kept"))
        advance(second)
        second.finish()
        assert lines(second) == lines(whole)


def test_going_back_and_forward_again_is_the_same() -> None:
    runner = Runner(begin(program("guarded_move"), HELD, NEAR, FELT))
    advance(runner, steps=9)
    before, flags = lines(runner), list(level(runner).flags)
    advance(runner, steps=4)
    runner.back_to(9)
    assert (lines(runner), list(level(runner).flags)) == (before, flags)
    runner.back_to(3)
    advance(runner, steps=6)
    assert lines(runner) == before


@pytest.mark.ml_row(32)
def test_a_point_is_defined_gone_to_and_refused_if_it_is_empty() -> None:
    text = (
        "5 POINT\n6 POINT\n10 MOVE 0 100 200 300\n20 DEFPOINT 5\n30 MOVE 0 0 0 0\n40 GOPOINT 5\n50 GETPOS 1 3\n"
        "60 PRINT &1\n70 GOPOINT 6"
    )
    runner = ran(text)
    assert printed(runner) == ["200"]
    assert runner.call is not None
    assert runner.call.message.startswith("M08: POINT 6 was never filled")


@pytest.mark.ml_row(34)
def test_a_table_is_read_as_the_command_for_its_sensor_reads_it() -> None:
    runner = ran(
        "10 DELAY 2\n20 GET 1 ST 5 7\n30 GETSEN 2 5\n40 PRINT &1 &2",
        Stimulus(channel="right_strain_x", value=1.0),
    )
    assert printed(runner) == ["102 102"]


@pytest.mark.ml_row(24)
def test_an_error_of_a_stored_program_is_an_emergency_that_names_its_statement() -> None:
    runner = ran("5 LOAD 1 20000\n10 MOTOR 3 100\n20 MOTOR 3 &1")
    assert runner.call is not None
    assert "statement 20" in runner.call.message
    assert (level(runner).read("EM", 1, 3), level(runner).enabled) == (20, False)


def test_the_operator_goes_on_after_a_stop_with_the_pump_on_again() -> None:
    runner = ran("5 LOAD 1 20000\n10 MOTOR 3 &1\n20 PRINT 7")
    runner.answer("proceed")
    advance(runner)
    assert (printed(runner), runner.finish()) == (["7"], True)


@pytest.mark.ml_row(25)
def test_an_interlock_that_a_person_opens_stops_the_program_and_persists() -> None:
    runner = Runner(begin("10 MOTOR 3 1000\n20 MOTOR 3 2000\n30 PRINT 1"))
    advance(runner, steps=1)
    runner.experiment("interlock", "panic", (1.0,))
    advance(runner)
    assert runner.call is not None
    assert runner.call.message.startswith("the panic button is pressed")
    runner.answer("proceed")
    assert runner.call is not None
    assert "the pump stays off: the panic button is pressed" in runner.call.message
    runner.experiment("interlock", "panic", (0.0,))
    runner.answer("proceed")
    advance(runner)
    assert printed(runner) == ["1"]
    with pytest.raises(Refused, match=r"^an interlock must be 0 or 1, not 2$"):
        runner.experiment("interlock", "panic", (2.0,))


ENDINGS = {
    "nullified": "10 SENSOR 5 -100 100\n20 MOTOR 3 1000\n30 MOTOR 3 2000\n40 MOTOR 3 3000",
    "printed": "10 LOAD 1 1\n20 MOTOR 3 100\n30 PRINT 1",
    "ended": "10 LOAD 1 1\n20 MOTOR 3 100\n30 STOP",
}


@pytest.mark.ml_row(25)
@pytest.mark.parametrize("text", ENDINGS.values(), ids=ENDINGS)
def test_no_program_ends_before_a_last_look_at_the_interlocks(text: str) -> None:
    """The remaining statements wait for no motion."""
    runner = Runner(begin(text, replace(FELT, beyond=500)))
    advance(runner, steps=2)
    runner.experiment("interlock", "panic", (1.0,))
    advance(runner)
    assert runner.call is not None
    assert runner.call.message == "the panic button is pressed"
    assert not runner.finish()


@pytest.mark.ml_row(25)
def test_no_job_ends_before_a_last_look_at_the_interlocks(monkeypatch: pytest.MonkeyPatch) -> None:
    runner = Runner(begin("10 MOTOR 3 100\n20 PRINT 1\n30 PRINT 2"))
    advance(runner, steps=1)
    runner.experiment("interlock", "door", (1.0,))
    assert isinstance(runner.system, RunningMl)
    monkeypatch.setattr(runner.system.hardware, "ending", lambda _: Ending(done=True, text="done"))
    advance(runner)
    assert runner.call is not None
    assert runner.call.message == "the door of the room is open"
    assert not runner.finish()


@pytest.mark.ml_row(25)
@pytest.mark.parametrize("delay", [3, 4])
def test_the_slower_arm_looks_at_the_interlocks_before_its_program_ends(delay: int) -> None:
    runner = Runner(begin(f"10 STOP\n100 DELAY {delay}\n110 PRINT 1", left=100))
    advance(runner, steps=2)
    runner.experiment("interlock", "panic", (1.0,))
    advance(runner)
    assert runner.call is not None
    assert runner.call.message == "the panic button is pressed"


@pytest.mark.ml_row(25)
def test_an_emergency_of_an_arm_whose_program_has_ended_is_reported() -> None:
    """Emergency limits of the right arm, which the left arm does not have."""
    text = "10 PUT ST 5 14 100\n20 PUT ST 5 15 1\n30 STOP\n100 DELAY 50\n110 PRINT 1"
    runner = ran(text, Stimulus(channel="right_strain_x", value=5.0, since=20), left=100)
    assert printed(runner) == ["1"]
    assert runner.call is not None
    assert runner.call.message == "sensor 5 is outside its emergency limits"
    runner.answer("skip")
    assert runner.call is None


@pytest.mark.ml_row(43)
def test_an_arm_waits_for_its_motion_though_the_program_of_the_other_ends() -> None:
    runner = ran("10 MOTOR 3 7000\n20 GETPOS 1 3\n30 PRINT &1\n40 STOP\n100 MOTOR 3 100", first=100, left=10)
    assert printed(runner) == ["7000"]
    assert runner.finish()


def test_an_error_keeps_its_sentence_where_each_statement_takes_a_cycle() -> None:
    runner = ran("5 PUT CY 1 5 1\n10 LOAD 1 20000\n20 MOTOR 3 &1\n30 PRINT 7")
    assert runner.call is not None
    assert runner.call.message.startswith("M10: motor 3 can go from -10039 to 10039, not to 20000")
    runner.answer("proceed")
    advance(runner)
    assert (printed(runner), runner.finish()) == (["7"], True)


@pytest.mark.ml_row(53)
def test_a_typed_line_is_an_event_between_two_statements_that_a_replay_repeats() -> None:
    runner = Runner(begin("10 MOTOR 3 1000\n20 MOTOR 3 2000\n30 GETPOS 1 2\n40 PRINT &1"))
    advance(runner, steps=1)
    runner.type_line("MOTOR 2 300")
    runner.type_line("FILE MT 3 8 10")
    advance(runner, steps=1)
    middle = lines(runner)
    advance(runner)
    assert printed(runner) == ["300"]
    assert [event.text for event in runner.events if isinstance(event, LineTyped)] == [
        "MOTOR 2 300",
        "FILE MT 3 8 10",
    ]
    runner.back_to(2)
    assert lines(runner) == middle
    steps = [event.time for event in runner.events if isinstance(event, StepFinished)]
    assert steps[-1] - steps[-2] > 1.0  # at 10 units a cycle


def test_a_state_that_does_not_fit_the_program_is_refused() -> None:
    runner = Runner(begin(program("guarded_move"), HELD, NEAR))
    advance(runner, steps=8)
    kept = runner.checkpoint()
    other = Checkpoint(setup=begin("10 STOP").setup, snapshot=kept.snapshot, events=kept.events)
    with pytest.raises(BadFile, match=r"^the state of the run does not fit this program$"):
        Runner(other)


def test_every_cycle_of_the_tables_is_watched_in_ml_units() -> None:
    seen: list[dict[str, tuple[float, ...]]] = []

    class Watching(Observer):
        def tick(self, period: ServoPeriod) -> None:
            seen.append({channel.name: values for channel, values in period.sensed.channels.items()})

    runner = Runner(begin(program("guarded_move"), HELD, NEAR, FELT), observers=lambda _: [Watching()])
    advance(runner)
    first = next(n for n, moment in enumerate(seen) if moment["flag"][4])
    assert seen[first]["reading"][4] == 500
    assert seen[first]["strategic"][2] == seen[first]["position"][2] == 2787
    assert seen[first - 1]["strategic"][2] == 4000
    assert [moment["position"][2] for moment in seen[first - 2 : first]] == [2630, 2709]
    assert len(seen) == 121


LEFT_AND_RIGHT = (
    "10 SENSOR 5 -178 450\n20 MOTOR 3 4000\n30 MOTOR 2 100\n40 LOAD 1 1\n50 STOP\n"
    "100 MOTOR 3 1000\n110 MOTOR 3 -1000\n120 GETPOS 2 3\n130 PRINT &1 &2"
)


@pytest.mark.ml_row(43)
def test_a_freeze_of_one_arm_leaves_the_other_going() -> None:
    runner = ran(LEFT_AND_RIGHT, FELT, left=100)
    assert printed(runner) == ["1 -1000"]
    crossed = [(event.arm, event.sensor) for event in runner.events if isinstance(event, LimitCrossed)]
    assert crossed == [("right", 5)]
    assert [event.arm for event in runner.events if isinstance(event, Froze)] == ["right"]
    assert not any(isinstance(event, OperatorCalled) for event in runner.events)


@pytest.mark.ml_row(43)
def test_the_left_arm_lacks_motors_that_the_right_one_has() -> None:
    runner = ran("10 DELAY 1\n20 STOP\n100 LOAD 1 12\n110 MOTOR &1 100", left=100)
    assert runner.call is not None
    assert runner.call.message.startswith("M09: the left arm has no motor 12")


@pytest.mark.ml_row(40)
def test_left_without_a_left_arm_is_refused_and_with_one_only_that_arm_moves() -> None:
    alone = ran("10 LEFT\n20 MOTOR 3 100")
    assert alone.call is not None
    assert alone.call.message.startswith("M12: there is no left arm")
    both = ran("10 LEFT\n20 MOTOR 3 100\n30 STOP\n100 STOP", left=100)
    assert isinstance(both.system, RunningMl)
    levels = both.system.machine.levels
    assert (levels["left"].position(3), levels["right"].position(3)) == (100, 0)


@pytest.mark.slow
def test_two_arms_kept_in_the_middle_are_resumed_to_the_same_bytes(tmp_path: Path) -> None:
    whole = ran(LEFT_AND_RIGHT, FELT, left=100)
    whole.finish()
    for steps in range(1, 9):
        first = Runner(begin(LEFT_AND_RIGHT, FELT, left=100))
        advance(first, steps=steps)
        write_checkpoint(tmp_path / "kept", first.checkpoint())
        second = Runner(read_checkpoint(tmp_path / "kept"))
        advance(second)
        second.finish()
        assert lines(second) == lines(whole)


def test_each_arm_says_where_it_stands_and_what_it_waits_for() -> None:
    runner = Runner(begin(LEFT_AND_RIGHT, FELT, left=100))
    advance(runner, steps=4)
    assert {place.task for place in runner.places} == {"right", "left"}
    assert any(place.waits_for == "the end of its motion" for place in runner.places)
