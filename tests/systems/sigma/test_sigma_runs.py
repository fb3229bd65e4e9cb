"""MAL programs as runs: stepped through all tasks, taken back, kept anywhere, resumed to the same bytes."""

import json
from collections.abc import Callable
from pathlib import Path

import pytest
from mal_bench import PLANS, mal

from handeye.core.errors import BadFile, Refused
from handeye.core.variation import WorldSpec
from handeye.program.events import OperatorCalled, to_line
from handeye.runs.advance import advance
from handeye.runs.checkpoint_file import read_checkpoint, write_checkpoint
from handeye.runs.runner import Runner
from handeye.runs.setup import Setup
from handeye.runs.snapshot import Checkpoint
from handeye.systems.sigma.mal.happenings import CommandSent, Printed
from handeye.systems.sigma.run.plan import ArmName, MalPlan

Command = Callable[..., tuple[int, str, str]]


def begin(text: str, arm: ArmName = "none") -> Checkpoint:
    """A run of a program that has not begun."""
    plan = MalPlan(name="test.mal", text=text, arm=arm)
    return Checkpoint(setup=Setup(system="sigma", plan=plan, world=WorldSpec(seed=0), camera="auto"))


def lines(runner: Runner) -> list[bytes]:
    return [to_line(event) for event in runner.events]


@pytest.mark.slow
@pytest.mark.sigma_row(40)
@pytest.mark.parametrize("arm", ["none", "wired"])
def test_a_run_kept_on_disk_before_any_statement_is_resumed_to_the_same_bytes(
    arm: ArmName, tmp_path: Path
) -> None:
    whole = Runner(begin(mal("handover"), arm))
    advance(whole)
    whole.finish()
    for steps in (6, 40):
        first = Runner(begin(mal("handover"), arm))
        advance(first, steps=steps)
        write_checkpoint(tmp_path / f"{steps}.checkpoint", first.checkpoint())
        second = Runner(read_checkpoint(tmp_path / f"{steps}.checkpoint"))
        advance(second)
        second.finish()
        assert lines(second) == lines(whole)
        first.back_to(2)
        advance(first)
        first.finish()
        assert lines(first) == lines(whole)


def test_true_firmware_on_wires_gets_the_commands_that_perfect_motors_get() -> None:
    def sent(arm: ArmName) -> list[tuple[str, str]]:
        runner = Runner(begin(mal("handover"), arm))
        assert advance(runner).kind == "end"
        return [(event.task, event.frame) for event in runner.events if isinstance(event, CommandSent)]

    assert sent("wired") == sent("none")


def test_true_firmware_stops_at_the_rail_by_its_steepest_ramp_and_says_where_it_was() -> None:
    text = "5 ON ABORT GOTO 100\n10 ORIGIN X1\n20 MOVE X1 BY 700\n30 END\n100 PRINT CRASHPOS(X1), POS(X1)\n110 RESUME"
    runner = Runner(begin(text, "wired"))
    advance(runner)
    (said,) = [event.text.split() for event in runner.events if isinstance(event, Printed)]
    assert 599 < float(said[0]) < 601
    assert 15 < float(said[1]) - float(said[0]) < 30


def test_going_back_takes_all_tasks_back_together_and_forward_again_is_the_same() -> None:
    runner = Runner(begin(mal("handover")))
    advance(runner, steps=30)
    places, events = runner.places, lines(runner)
    assert {place.task for place in places} == {"MAIN", "FEEDER", "SCREWER"}
    advance(runner, steps=25)
    runner.back_to(30)
    assert (runner.places, lines(runner)) == (places, events)
    runner.back_to(4)
    assert {place.task: place.step for place in runner.places} == {"MAIN": 3, "FEEDER": 7, "SCREWER": 21}
    advance(runner, steps=26)
    assert (runner.places, lines(runner)) == (places, events)


def test_each_task_tells_what_it_waits_for() -> None:
    runner = Runner(begin(mal("dead")))
    advance(runner)
    waits = {place.task: place.waits_for for place in runner.places}
    assert waits == {
        "MAIN": "flags LEFTDONE and RIGHTDONE", "LEFT": "flag DRIVERFREE", "RIGHT": "flag JIGFREE",
    }  # fmt: skip


def test_a_person_ends_a_deadlock_by_setting_a_flag() -> None:
    runner = Runner(begin(mal("dead")))
    advance(runner)
    runner.experiment("flag", "JIGFREE", (1.0,))
    runner.answer("proceed")
    assert advance(runner).kind == "end"
    with pytest.raises(Refused, match=r"^a flag is set by 1 and cleared by 0, not by 2$"):
        runner.experiment("flag", "JIGFREE", (2.0,))


@pytest.mark.sigma_row(39)
@pytest.mark.parametrize(("choice", "printed"), [("proceed", 1), ("skip", 0)])
def test_after_an_abort_the_operator_goes_on_behind_the_move_or_ends_the_program(choice, printed) -> None:  # type: ignore[no-untyped-def]
    runner = Runner(begin("10 ORIGIN X1\n20 MOVE X1 BY 700\n30 PRINT 1"))
    assert advance(runner).message == "ABORT X1 RAIL 600.00: the task MAIN, line 20"
    runner.answer(choice)
    advance(runner)
    assert (runner.ended, sum(b"Printed" in line for line in lines(runner))) == (True, printed)
    assert runner.finish()


def test_a_statement_is_carried_out_once_more_by_retry() -> None:
    runner = Runner(begin("10 A = 1 / B\n20 PRINT A\n30 B = B"))
    assert advance(runner).message == "line 10: this divides by zero"
    runner.experiment("variable", "B", (2.0,))
    runner.answer("retry")
    advance(runner)
    assert any(b'"text":"0.5"' in line for line in lines(runner))


def test_a_typed_number_is_an_event_that_a_replay_repeats() -> None:
    runner = Runner(begin("10 INPUT HEIGHT\n20 PRINT HEIGHT\n30 END"))
    assert advance(runner).kind == "operator"
    runner.type_line("12.5")
    advance(runner, steps=1)
    events = lines(runner)
    runner.back_to(1)
    runner.type_line("12.5") if runner.call is not None else None
    advance(runner, steps=1)
    assert lines(runner) == events


def test_a_state_that_does_not_fit_the_program_is_refused() -> None:
    runner = Runner(begin(mal("handover")))
    advance(runner, steps=20)
    kept = runner.checkpoint()
    other = Checkpoint(setup=begin("10 END").setup, snapshot=kept.snapshot, events=kept.events)
    with pytest.raises(BadFile, match=r"^the state of the run does not fit this program$"):
        Runner(other)


def test_events_of_a_run_begin_with_its_tasks_and_end_with_them() -> None:
    runner = Runner(begin(mal("dead")))
    advance(runner)
    runner.finish()
    kinds = [type(event).__name__ for event in runner.events]
    assert (kinds[:2], kinds[-3:]) == (
        ["RunStarted", "TaskStarted"],
        ["OperatorCalled", "StageFinished", "RunFinished"],
    )
    assert sum(isinstance(event, OperatorCalled) for event in runner.events) == 1


# -- commands -------------------------------------------------------------------------------------------


@pytest.mark.slow
def test_a_program_is_run_from_the_shell_and_what_it_prints_is_shown(command: Command) -> None:
    code, out, _ = command("sigma", "run", str(PLANS / "handover.mal"))
    assert (code, out.split()[:4]) == (0, ["PIECES", "4", "SECONDS", "15.6936"])
    assert "The program finished." in out


@pytest.mark.slow
def test_the_answer_for_programs_has_the_fields_of_every_run(command: Command) -> None:
    code, out, err = command("sigma", "run", str(PLANS / "dead.mal"), "--json", "--out", "run")
    result = json.loads(out)
    assert (code, result["completed"], result["assembled"], result["task"]) == (1, False, None, "mal")
    assert result["message"].startswith("DEADLOCK: the task MAIN, line 60")
    assert "Traceback" not in err
    assert command("trace", "verify", "run")[0] == 0
    assert "LEFT takes the flag JIGFREE" in command("trace", "show", "run")[1]


def test_a_program_is_stepped_by_its_own_line_numbers_and_back(command: Command) -> None:
    typed = "until 160\nshow tasks\nback 3\nbreak FEEDER\nquit\n"
    code, out, _ = command("sigma", "run", str(PLANS / "handover.mal"), "--step", typed=typed)
    assert "→ 160  TAKE PLACEFREE   [FEEDER]" in out
    assert "MAIN        50  WAIT FEEDERDONE AND SCREWERDONE, waiting for flags" in out
    assert "3 steps undone" in out
    assert code == 0


def test_a_number_is_typed_for_a_task_in_the_stepper(command: Command, tmp_path: Path) -> None:
    (tmp_path / "ask.mal").write_text("10 INPUT A\n20 PRINT A * 2\n30 END", encoding="utf-8")
    code, out, _ = command("sigma", "run", "ask.mal", "--step", typed="c\ntype MAIN 21\nc\nquit\n")
    assert "in the stepper, `type MAIN 5` answers with 5" in out
    assert "MAIN prints: 42" in out
    assert code == 0


@pytest.mark.parametrize(
    ("text", "told"),
    [
        ("", "test.mal has no line that can be executed"),
        ("10 REM ONLY THIS", "test.mal has no line that can be executed"),
        ("10 MOVE", "error[syntax]: an axis"),
        ("10 GOTO 20", "error[line-missing]: there is no line 20"),
    ],
)
def test_a_program_that_cannot_be_run_is_refused_in_a_sentence(
    text: str,
    told: str,
    command: Command,
    tmp_path,  # type: ignore[no-untyped-def]
) -> None:
    (tmp_path / "test.mal").write_text(text, encoding="utf-8")
    code, out, err = command("sigma", "run", "test.mal")
    assert (code, out) == (2, "")
    assert told in err


def test_what_the_system_cannot_do_is_refused_by_its_name(command: Command) -> None:
    file = str(PLANS / "dead.mal")
    assert "SUPERSIGMA cannot run a plan of motions: `handeye sigma run FILE.mal`" in command("plan", file)[2]
    assert command("check", file)[:2] == (0, f"{file}: no errors\n")
    assert "MOVE axis (TO|BY)" in command("sigma", "words", "move")[1]
    assert "`MOOVE` is not a word of MAL; did you mean `MOVE`?" in command("sigma", "words", "MOOVE")[2]
    assert "the arms" not in command("sigma", "words")[1]
