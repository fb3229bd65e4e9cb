"""Stages, steps, breakpoints, interrupted runs and traces, as somebody at the command line meets them."""

import json
import resource
import shutil
import signal
import subprocess
import sys
from collections.abc import Callable, Sequence
from contextlib import chdir
from pathlib import Path

import pytest
from conftest import Command

from handeye import cli
from handeye.program.events import AnyEvent, PanicStopped, RunStarted, StepStarted
from handeye.runs.checkpoint_file import read_head
from handeye.runs.folder import open_again
from handeye.systems.stanford.executor_run import RunningPlan
from handeye.trace.compare import Repetition
from handeye.trace.eventlist import effective, read_events

pytestmark = pytest.mark.slow

Planned = Callable[[str], str]

SCRIPT = """TRANS HERE_ [20 28 9 90 90 0]
TRANS THERE [20 28 8 90 90 0]
        STAGE   "to and fro"
        OPEN    1
TO:     MOVE    HERE_
        MOVE    THERE
        STAGE   "once more"
        OPEN    2
        MOVE    HERE_
        STAGE   "feel"
        STOP    [0 0 -50]
        CHANGE  [0 0 -1] .3
        SKIPE   23
        WAIT    "THERE IS SOMETHING"
        OPEN    3
"""


JAWS = """; the same stages,
; where only the fingers move
        STAGE   "to and fro"
        OPEN    1
TO:     OPEN    1.1
        OPEN    1
        STAGE   "once more"
        OPEN    1.1
        OPEN    1
        STAGE   "feel"
        OPEN    1.1
"""
"""For claims that ask nothing of the arm: it takes a third of the time."""


def done(out: str) -> dict[str, str]:
    """Status of each stage by the result on standard output."""
    return {stage["name"]: stage["status"] for stage in json.loads(out)["stages"]}


def carried_out(place: Path, script: str, *words: str) -> Path:
    """The folder of a whole run of a script, made by a process of its own."""
    (place / "job.al").write_text(script, encoding="utf-8")
    with chdir(place):
        assert cli.app(["plan", "job.al"], result_action="return_value", exit_on_error=False) == 0
    line = [sys.executable, "-m", "handeye", "run", "job.plan.json", "--out", "it", *words]
    subprocess.run(line, cwd=place, capture_output=True, check=True)
    return place / "it"


@pytest.fixture(scope="module")
def folder(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """The folder of a whole run, with the photographs of its end."""
    return carried_out(tmp_path_factory.mktemp("whole"), SCRIPT)


# -- stages -------------------------------------------------------------------------------------------


def test_stages_are_listed_with_their_steps_and_lines(command: Command, planned: Planned) -> None:
    code, out, _ = command("stages", planned(SCRIPT))
    assert code == 0
    assert [line.split() for line in out.splitlines() if "MOVE THERE" in line] == [
        ["2", "line", "6", "MOVE", "THERE"]
    ]


def test_a_stage_alone_without_a_checkpoint_has_the_earlier_ones_carried_out_first_and_says_so(
    command: Command, planned: Planned
) -> None:
    code, out, err = command("run", planned(JAWS), "--stage", "once", "--json")
    assert (code, json.loads(out)["paused"]) == (0, True)
    assert done(out) == {"to and fro": "done", "once more": "done", "feel": "not reached"}
    assert "no checkpoint of “once more” for this plan and world: running the earlier steps" in err


def test_a_stage_alone_begins_at_its_checkpoint_if_there_is_one(
    command: Command, planned: Planned, folder: Path
) -> None:
    words = ("--stage", "2", "--checkpoints", str(folder), "--out", "one", "--json")
    code, out, err = command("run", planned(SCRIPT), *words)
    assert (code, "no checkpoint" in err) == (0, False)
    assert done(out) == {"to and fro": "done", "once more": "done", "feel": "not reached"}
    alone, whole = (place / "checkpoints" / "0005-feel.checkpoint" for place in (Path("one"), folder))
    assert alone.read_bytes() == whole.read_bytes()


def test_checkpoints_made_on_the_way_are_there_the_next_time(command: Command, planned: Planned) -> None:
    plan = planned(JAWS)
    assert "no checkpoint" in command("run", plan, "--stage", "3", "--checkpoints", "kept")[2]
    assert "no checkpoint" not in command("run", plan, "--stage", "3", "--checkpoints", "kept")[2]


def test_from_and_to_bound_a_run(command: Command, planned: Planned) -> None:
    plan = planned(JAWS)
    code, out, _ = command("run", plan, "--to", "to and fro", "--json")
    assert (code, done(out)["once more"]) == (0, "not reached")
    code, out, _ = command("run", plan, "--from", "feel", "--json")
    assert (code, done(out)["feel"], json.loads(out)["completed"]) == (0, "done", True)


@pytest.mark.parametrize(
    ("words", "sentence"),
    [
        (("--stage", "onze"), "onze"),
        (("--stage", "feel", "--to", "feel"), "--stage cannot be given with --from or --to"),
        (("--live",), "--live needs --step"),
        (("--until", "99"), "99"),
        (("--break", "NOWHERE"), "NOWHERE"),
        (("--stage", ""), "there is no stage"),
        (
            ("--from", "3", "--to", "1"),
            "the run would begin with the stage “feel” and end with an earlier stage, “to and fro”",
        ),
        (("--break", "error:99"), "99"),
        (("--on-stop", "sleep"), "sleep"),
        (("--on-stop", "retry:x"), "retry:x"),
    ],
)
def test_what_the_plan_does_not_have_ends_with_two(
    command: Command, planned: Planned, words: tuple[str, ...], sentence: str
) -> None:
    code, out, err = command("run", planned(SCRIPT), *words)
    assert (code, out) == (2, "")
    assert sentence in err


def test_checkpoints_of_another_plan_end_with_two(command: Command, planned: Planned, folder: Path) -> None:
    other = planned(SCRIPT.replace("OPEN    3", "OPEN    4"))
    code, _, err = command("run", other, "--stage", "2", "--checkpoints", str(folder))
    assert code == 2
    assert "belongs to another plan" in err


# -- stopping and stepping ----------------------------------------------------------------------------


def test_a_wrong_option_costs_nobody_the_record_of_a_run(
    command: Command, planned: Planned, folder: Path
) -> None:
    plan = planned(SCRIPT)
    shutil.copytree(folder, "it")
    before = {file: file.read_bytes() for file in Path("it").rglob("*.*")}
    for words in (("--on-stop", "sleep"), ("--step", "--on-stop", "sleep"), ("--seed", "1")):
        assert command("run", plan, "--out", "it", *words)[0] == 2
    assert {file: file.read_bytes() for file in Path("it").rglob("*.*")} == before


def test_a_run_takes_the_place_of_another_only_if_it_is_told_to(
    command: Command, planned: Planned, folder: Path
) -> None:
    shutil.copytree(folder, "it")
    other = planned("        OPEN    2\n")
    code, _, err = command("run", other, "--out", "it")
    assert (code, "it holds a run: `handeye resume it` resumes it, --overwrite replaces it" in err) == (
        2,
        True,
    )
    code, out, _ = command("run", other, "--out", "it", "--overwrite", "--json")
    assert (code, done(out)) == (0, {"program": "done"})


def test_a_break_that_lies_behind_the_start_is_told(command: Command, planned: Planned) -> None:
    code, _, err = command(
        "run", planned(JAWS), "--stage", "2", "--break", "to and fro", "--checkpoints", "kept"
    )
    assert (code, "created kept for the checkpoints" in err) == (0, True)
    code, _, err = command(
        "run", planned(JAWS), "--stage", "2", "--break", "to and fro", "--checkpoints", "kept"
    )
    assert (code, "the run never reaches to and fro from the step at which the run begins" in err) == (
        0,
        True,
    )


def test_a_step_that_lies_behind_the_start_is_no_place_to_stop(command: Command, planned: Planned) -> None:
    plan = planned(JAWS)
    assert command("run", plan, "--to", "1", "--checkpoints", "kept")[0] == 0
    code, out, err = command("run", plan, "--from", "2", "--until", "TO", "--checkpoints", "kept")
    assert (code, out) == (2, "")
    assert "the run never reaches step 1 from the step at which the run begins" in err


def test_the_referee_looks_at_what_is_gone_on_with_if_it_was_to_look_at_the_run(
    command: Command, planned: Planned
) -> None:
    plan = planned(JAWS)
    for words, code in (((), 0), (("--judge",), 3)):  # nothing is assembled by this script
        assert command("run", plan, "--to", "1", "--out", "it", "--overwrite", *words)[0] == 0
        assert command("resume", "it")[0] == code
    assert command("run", plan, "--to", "1", "--out", "it", "--overwrite", "--judge")[0] == 0
    assert command("resume", "it", "--no-judge")[0] == 0


def test_the_checkpoints_of_a_run_stand_for_it(command: Command, planned: Planned) -> None:
    plan = planned(JAWS)
    assert command("run", plan, "--to", "1", "--out", "it")[0] == 0
    assert command("run", plan, "--stage", "2", "--checkpoints", "kept")[0] == 0
    assert command("resume", "it/checkpoints")[0] == 0
    code, _, err = command("resume", "kept")
    assert code == 2
    assert "kept is a folder of checkpoints, not of a run; give the path of one checkpoint" in err


def test_a_stage_that_has_ended_is_no_place_to_stop_any_more(command: Command, planned: Planned) -> None:
    assert command("run", planned(JAWS), "--to", "2", "--out", "it")[0] == 0
    code, _, err = command("resume", "it", "--to", "1")
    assert (
        code,
        "the run would begin with the stage “feel” and end with an earlier stage, “to and fro”" in err,
    ) == (2, True)


@pytest.mark.parametrize(
    ("words", "typed"), [(("--break", "8"), ""), (("--to", "1"), ""), (("--step",), "step\nquit\n")]
)
def test_a_run_without_a_folder_leaves_no_file_and_says_how_it_would(
    command: Command, planned: Planned, words: tuple[str, ...], typed: str
) -> None:
    plan = planned(JAWS)
    before = sorted(Path().iterdir())
    code, _, err = command("run", plan, *words, typed=typed)
    assert (code, err.splitlines()[-1]) == (
        0,
        "the run is not saved and cannot be resumed; --out FOLDER would save it",
    )
    assert sorted(Path().iterdir()) == before


def test_a_break_leaves_a_checkpoint_in_the_folder_of_checkpoints(command: Command, planned: Planned) -> None:
    code, _, err = command("run", planned(JAWS), "--break", "6", "--seed", "3", "--checkpoints", ".")
    (left,) = Path().glob("job-3-*.checkpoint")
    assert (code, f"resume with: handeye resume {left}" in err) == (0, True)
    assert "-3-" in left.name
    assert command("resume", str(left), "--no-judge")[0] == 0


def everything(folder: str) -> dict[Path, bytes]:
    """All files of a run."""
    return {file: file.read_bytes() for file in Path(folder).rglob("*") if file.is_file()}


def test_a_run_that_has_ended_is_shown_and_not_resumed(command: Command, planned: Planned) -> None:
    assert command("run", planned("OPEN 1\n"), "--judge", "--out", "it")[0] == 3  # it assembles nothing
    before = everything("it")
    for words, code in ((("resume", "it"), 3), (("show", "it"), 0)):
        ended, out, err = command(*words, "--json")
        assert (ended, out.encode()) == (code, before[Path("it/result.json")])
        assert ("the run in it has ended: there is nothing to resume" in err) == (code == 3)
    assert everything("it") == before


def test_the_referee_can_be_called_to_a_run_that_has_ended(command: Command, planned: Planned) -> None:
    assert command("run", planned("OPEN 1\n"), "--out", "it")[0] == 0
    first = json.loads(Path("it/result.json").read_bytes())
    code, out, _ = command("resume", "it", "--judge", "--json")
    assert (code, first["assembled"], json.loads(out)["assembled"]) == (3, None, False)
    assert json.loads(out)["timing"]["run_cpu_s"] > first["timing"]["run_cpu_s"]


def test_a_run_that_stopped_is_shown_with_how_to_go_on(command: Command, planned: Planned) -> None:
    assert command("run", planned('OPEN 1\nWAIT "HELP"\n'), "--out", "it")[0] == 1
    code, out, err = command("show", "it")
    assert (code, "HELP" in out, err) == (0, True, "resume with: handeye resume it\n")


def test_what_is_no_run_cannot_be_shown(command: Command) -> None:
    assert command("show", ".") == (2, "", "handeye: . holds no run\n")


@pytest.mark.parametrize("words", [("show",), ("report",), ("trace", "stats")])
def test_a_batch_of_trials_is_told_from_a_run(command: Command, words: tuple[str, ...]) -> None:
    Path("batch").mkdir()
    for name in ("plan.json", "trials.jsonl"):
        Path("batch", name).touch()
    sentence = "handeye: batch is the folder of a batch of trials, not of a run\n"
    assert command(*words, "batch") == (2, "", sentence)


def test_leaving_a_run_that_has_ended_leaves_nothing_behind(command: Command, planned: Planned) -> None:
    before = sorted(Path().iterdir())
    plan = planned("OPEN 1\n")
    made = sorted(Path().iterdir())
    assert command("run", plan, "--step", typed="continue\nquit\n")[0] == 0
    assert sorted(Path().iterdir()) == made != before


@pytest.mark.parametrize(
    ("words", "line"),
    [(("--until", "2"), 6), (("--break", "TO"), 5), (("--break", "8"), 8), (("--break", "once"), 8)],
)
def test_a_run_stops_where_it_is_told_to(
    command: Command, planned: Planned, words: tuple[str, ...], line: int
) -> None:
    assert command("run", planned(JAWS), *words, "--out", "it")[0] == 0
    started = [e.line for e in read_events(Path("it/events.jsonl")) if isinstance(e, StepStarted)]
    assert max(started) < line
    assert command("resume", "it", "--no-judge")[0] == 0
    started = [e.line for e in effective(read_events(Path("it/events.jsonl"))) if isinstance(e, StepStarted)]
    assert line in started


def test_stepping_from_standard_input_answers_every_command(command: Command, planned: Planned) -> None:
    code, out, _ = command("run", planned(SCRIPT), "--step", typed="step\nback\nwobble\ncontinue\nquit\n")
    assert code == 2
    assert "MOVE    HERE_" in out
    assert "wobble" in out
    assert "The program finished." in out


@pytest.mark.parametrize(
    ("typed", "code"), [("step\nquit\n", 0), ("stpe\nquit\n", 2), ("wobble\ncontinue\nabort\n", 1)]
)
def test_a_refused_command_that_came_from_no_terminal_ends_with_two_if_nothing_is_worse(
    command: Command, planned: Planned, typed: str, code: int
) -> None:
    assert command("run", planned('OPEN 1\nWAIT "HELP"\n'), "--step", typed=typed)[0] == code


def test_going_on_more_often_than_there_is_a_way_is_no_failure(command: Command, planned: Planned) -> None:
    code, out, _ = command("run", planned("OPEN 1\nOPEN 2\n"), "--step", typed="step\n" * 5)
    assert (code, "the program has ended: `back` goes back" in out) == (0, True)
    assert command("run", planned("OPEN 1\n"), "--step", typed="step\nstpe\n")[0] == 2


def test_states_that_the_stepper_keeps_do_not_lose_each_other(command: Command, planned: Planned) -> None:
    plan = planned(SCRIPT)
    tried = "step 3\nset position THERE 25 35 9\nquit\n"
    kept = []
    for typed in (tried, "step 3\nquit\n", tried):
        err = command("run", plan, "--step", "--checkpoints", "kept", typed=typed)[2]
        kept.append(err.splitlines()[-1])
    go_on = "resume with: handeye resume kept/job-0-0003-once-more"
    assert kept == [f"{go_on}.checkpoint", f"{go_on}-2.checkpoint", f"{go_on}.checkpoint"]
    touched, plain = (read_head(Path(f"kept/job-0-0003-once-more{end}.checkpoint")) for end in ("", "-2"))
    assert (touched.touched, plain.touched) == (True, False)


def test_states_go_to_the_folder_of_checkpoints_which_can_still_be_used(
    command: Command, planned: Planned
) -> None:
    plan = planned(SCRIPT)
    files = {path.name for path in Path().iterdir()}
    words = ("run", plan, "--checkpoints", "kept")
    assert command(*words, "--break", "THERE")[0] == 2  # no such label: nothing moves
    for more, typed in ((("--break", "8"), ""), (("--step",), "step\nset position THERE 25 35 9\nquit\n")):
        code, _, err = command(*words, *more, typed=typed)
        assert (code, "resume with: handeye resume kept/" in err) == (0, True)
    assert {path.name for path in Path().iterdir()} - files == {"kept"}
    assert command(*words, "--stage", "2")[0] == 0


def test_nobody_who_does_nothing_leaves_a_file(command: Command, planned: Planned) -> None:
    plan = planned(JAWS)
    before = sorted(Path().iterdir())
    assert command("run", plan, "--step")[0] == 0
    assert sorted(Path().iterdir()) == before


def test_a_run_kept_in_a_folder_says_where_and_how_to_go_on(command: Command, planned: Planned) -> None:
    plan = planned(JAWS)
    assert command("run", plan, "--out", "my run", "--until", "2")[2].splitlines()[-1] == (
        "resume with: handeye resume 'my run'"
    )
    said = command("resume", "my run", "--no-judge")[2].splitlines()[-3:]
    assert said[0].startswith("saved in my run (")
    assert said[1:] == ["see it:     handeye report 'my run'", "all tables: handeye show 'my run'"]


def test_back_in_a_run_that_begins_at_a_stage_uses_the_checkpoints_of_the_folder(
    command: Command, planned: Planned, folder: Path
) -> None:
    plan = planned(SCRIPT)
    shutil.copytree(folder, "all")
    code, out, _ = command(
        "run", plan, "--checkpoints", "all", "--from", "feel", "--step", typed="bs\nback\nback 1000\n"
    )
    standing = [line for line in out.splitlines() if line.startswith("──")]
    assert "stage 2, once more, step 3; 3 steps done" in standing[1]
    assert "stage 1, to and fro, step 2; 2 steps done" in standing[2]
    assert (code, "`back` can go back at most 2 steps" in out) == (2, True)


def test_stepping_as_json_gives_one_object_a_line(command: Command, planned: Planned) -> None:
    _, out, _ = command("run", planned(JAWS), "--step", "--json", typed="step\nshow\nstage\nquit\n")
    replies = [json.loads(line) for line in out.splitlines()[:4]]
    assert [reply["command"] for reply in replies] == ["step", "show", "stage", "quit"]


def test_a_stop_ends_with_one_and_can_be_tried_again(command: Command, planned: Planned) -> None:
    plan = planned('STAGE "a"\nOPEN 1\nWAIT "HELP"\nOPEN 2\n')
    assert command("run", plan, "--out", "it")[0] == 1
    code, out, err = command("resume", "it", "--on-stop", "ask", "--no-judge", typed="p\n")
    assert code == 0
    assert "HELP" in out + err
    assert "the operator chose: proceed" in out


def test_each_stage_is_tried_again_as_often_as_told(command: Command, planned: Planned) -> None:
    plan = planned('STAGE "a"\nOPEN 1\nWAIT "HELP"\nOPEN 2\n')
    code, out, _ = command("run", plan, "--on-stop", "retry:2", "--json")
    assert code == 1
    assert len(json.loads(out)["interventions"]) == 2


# -- breaking off -------------------------------------------------------------------------------------


MANY = "        MOVE    HERE_\n        MOVE    THERE\n" * 3
LONG = SCRIPT.replace('STAGE   "once more"', f'STAGE   "half way"\n{MANY}        STAGE   "once more"')
"""Long enough to be broken off."""
BY_RAYS = ("--camera", "ray")
"""Without OpenGL nothing is photographed at the end."""


@pytest.fixture(scope="module")
def unbroken(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """The folder of a long run that nobody broke off."""
    return carried_out(tmp_path_factory.mktemp("unbroken"), LONG, *BY_RAYS)


def started(plan: str, folder: str) -> "subprocess.Popen[str]":
    """A run in a process of its own that has come half way."""
    process = subprocess.Popen(
        [sys.executable, "-m", "handeye", "run", plan, "--out", folder, *BY_RAYS],
        # Tests that a shell runs in the background inherit SIGINT as ignored, and so would the run.
        preexec_fn=lambda: signal.signal(signal.SIGINT, signal.SIG_DFL),
        stdin=subprocess.DEVNULL,
        stdout=subprocess.DEVNULL,
        stderr=subprocess.PIPE,
        text=True,
    )
    assert process.stderr is not None
    for line in process.stderr:
        if "half way" in line:
            return process
    raise AssertionError("it ended before it could be broken off")


@pytest.mark.parametrize("number", [signal.SIGKILL, signal.SIGINT])
def test_a_run_broken_off_goes_on_as_if_nothing_had_happened(
    command: Command, planned: Planned, unbroken: Path, number: signal.Signals
) -> None:
    process = started(planned(LONG), "broken")
    process.send_signal(number)
    process.communicate()
    assert process.returncode == (130 if number == signal.SIGINT else -signal.SIGKILL)
    if number == signal.SIGINT:
        assert isinstance(read_events(Path("broken/events.jsonl"))[-1], PanicStopped)
    assert command("resume", "broken", "--no-judge")[0] == 0
    assert Path("broken/trace.mcap").read_bytes() == (unbroken / "trace.mcap").read_bytes()
    assert effective(read_events(Path("broken/events.jsonl"))) == read_events(unbroken / "events.jsonl")


def test_a_disk_that_fills_up_loses_neither_checkpoints_nor_the_trace_so_far(
    command: Command, planned: Planned, unbroken: Path
) -> None:
    """A limit on the size of files stands for the full disk."""
    room = (unbroken / "trace.mcap").stat().st_size * 6 // 10
    done = subprocess.run(
        [sys.executable, "-m", "handeye", "run", planned(LONG), "--out", "full", *BY_RAYS],
        preexec_fn=lambda: resource.setrlimit(resource.RLIMIT_FSIZE, (room, room)),
        stdin=subprocess.DEVNULL,
        capture_output=True,
        text=True,
        check=False,
    )
    assert (done.returncode, "Traceback" in done.stderr) == (2, False)
    assert "trace.mcap.part cannot be written: File too large" in done.stderr
    _, checkpoint, _ = open_again(Path("full"))
    assert checkpoint.snapshot is not None
    code, out, err = command("trace", "show", "full")
    assert code == 0
    assert "was interrupted" in err
    assert "TO AND FRO" in out
    assert command("resume", "full", "--no-judge")[0] == 0
    assert Path("full/trace.mcap").read_bytes() == (unbroken / "trace.mcap").read_bytes()


DAMAGE: dict[str, Callable[[bytes], bytes]] = {
    "cut short": lambda data: data[: len(data) // 2],
    "empty": lambda _: b"",
    "a bit flipped": lambda data: data[:-2000] + bytes([data[-2000] ^ 4]) + data[-1999:],
    "something else": lambda _: b"hello",
}


@pytest.mark.parametrize("damage", DAMAGE)
@pytest.mark.parametrize("name", ["trace.mcap", "0005-feel.checkpoint"])
def test_a_damaged_file_ends_with_two_and_one_sentence(
    command: Command, folder: Path, damage: str, name: str
) -> None:
    (whole,) = folder.rglob(name)
    Path(name).write_bytes(DAMAGE[damage](whole.read_bytes()))
    words = ("trace", "show", name) if name.endswith("mcap") else ("resume", name)
    code, out, err = command(*words)
    assert (code, out, err.count("\n")) == (2, "", 1)
    assert [path.name for path in Path().iterdir()] == [name]


# -- traces -------------------------------------------------------------------------------------------


@pytest.mark.parametrize("what", ["", "trace.mcap", "events.jsonl"])
def test_a_trace_tells_what_happened(command: Command, folder: Path, what: str) -> None:
    code, out, _ = command("trace", "show", str(folder / what))
    assert code == 0
    assert "CHANGE  [0 0 -1] .3" in out
    assert "error 23 occurred" in out


def test_what_a_trace_says_cannot_steer_a_terminal(command: Command, folder: Path) -> None:
    told = (folder / "events.jsonl").read_bytes()
    Path("events.jsonl").write_bytes(told.replace(b'"OPEN    1"', b'"OPEN    1\\u001b[31m"'))
    code, out, _ = command("trace", "show", "events.jsonl")
    assert (code, "OPEN    1␛[31m" in out, "\x1b" in out) == (0, True, False)


def test_statistics_count_each_stage(command: Command, folder: Path) -> None:
    code, out, _ = command("trace", "stats", str(folder), "--json")
    stages = {stage["stage"]: stage for stage in json.loads(out)["stages"]}
    assert code == 0
    assert (stages["to and fro"]["motions"], stages["feel"]["errors"]) == (2, {"23": 1})


def test_a_trace_that_was_lost_is_told_of_and_shows_nothing_that_it_does_not_hold(
    command: Command, folder: Path
) -> None:
    shutil.copytree(folder, "again")
    Path("again/trace.mcap").unlink()
    for checkpoint in Path("again/checkpoints").glob("*-end.checkpoint"):
        checkpoint.unlink()
    _, _, err = command("resume", "again")
    assert "resuming after 5 steps: feel" in err
    assert (
        "the old trace in again was lost or damaged: the new trace does not contain the motions before "
        in err
    )
    code, _, err = command("trace", "verify", "again")
    assert (code, "are not in this trace and were not compared" in err) == (0, True)
    code, _, err = command("trace", "photograph", "again", "--at", "1", "-o", "it.png")
    assert (code, "; 1 s is outside" in err) == (2, True)


@pytest.mark.parametrize("left", [None, b"", b'{"event":"RunFinished","time":1.0,"completed":true}\n'])
def test_an_event_list_that_was_lost_is_told_of(command: Command, folder: Path, left: bytes | None) -> None:
    shutil.copytree(folder, "again")
    Path("again/result.json").unlink()
    Path("again/events.jsonl").unlink()
    if left is not None:
        Path("again/events.jsonl").write_bytes(left)
    said = "the event list again/events.jsonl was lost, was damaged, or belonged to another run; "
    assert said in command("resume", "again")[2]


def test_of_a_sound_run_nothing_is_said_to_be_lost(command: Command, folder: Path) -> None:
    shutil.copytree(folder, "again")
    Path("again/result.json").unlink()
    assert "lost" not in command("resume", "again")[2]
    assert "not compared" not in command("trace", "verify", "again")[2]


def test_times_begin_at_0_with_the_program_whatever_the_calibration_before_has_taken(
    command: Command, planned: Planned, monkeypatch: pytest.MonkeyPatch
) -> None:
    begin = RunningPlan.begin

    def later(system: RunningPlan) -> Sequence[AnyEvent]:
        system.context.drive.brake(2.0)  # stands for the calibration
        return begin(system)

    monkeypatch.setattr(RunningPlan, "begin", later)
    assert "  0.0 s  program" in command("run", planned("OPEN 1\n"), "--out", "it")[2]
    events = read_events(Path("it/events.jsonl"))
    end = events[-1].time
    assert isinstance(events[0], RunStarted)
    assert (events[0].time, events[0].prepared >= 2.0) == (0.0, True)
    assert f"{0:9.2f}     1  OPEN 1" in command("trace", "show", "it")[1]
    assert (
        f"covers 0.00 to {end:.2f} s"
        in command("trace", "photograph", "it", "--at", "2.5", "-o", "it.png")[2]
    )
    assert json.loads(Path("it/result.json").read_bytes())["timing"]["calibration_s"] == 2.0


@pytest.mark.parametrize("at", ["300", "-3", "nan", "inf"])
def test_there_is_no_photograph_of_a_time_outside_the_run(command: Command, folder: Path, at: str) -> None:
    end = read_events(folder / "events.jsonl")[-1].time
    code, out, err = command("trace", "photograph", str(folder), f"--at={at}", "-o", "it.png")
    assert (code, out) == (2, "")
    assert err == f"handeye: {folder / 'trace.mcap'} covers 0.00 to {end:.2f} s; {at} s is outside\n"


def test_the_end_of_a_run_is_photographed_where_there_is_opengl(folder: Path) -> None:
    _, checkpoint, _ = open_again(folder)
    (begun, *_) = checkpoint.events
    assert isinstance(begun, RunStarted)
    photographs = {path.name for path in (folder / "pictures").iterdir()}
    drawn = begun.camera.method == "opengl"
    assert photographs == ({"end_pump.png", "end_studio.png"} if drawn else set())


def test_a_folder_of_which_nothing_was_carried_out_says_so(command: Command, folder: Path) -> None:
    Path("it").mkdir()
    Path("it/plan.json").write_bytes((folder / "plan.json").read_bytes())
    sentence = "handeye: the run in it has not begun\n"
    assert command("trace", "show", "it") == (2, "", sentence)


def test_a_run_comes_out_the_same_again(command: Command, folder: Path) -> None:
    code, out, _ = command("trace", "verify", str(folder))
    assert (code, "byte for byte" in out) == (0, True)


@pytest.mark.parametrize(
    ("found", "code", "said"),
    [
        (Repetition(), 0, "it repeats exactly: the same"),
        (Repetition(rounded="A"), 0, "it repeats except for rounding, on another kind of processor: the "
            "same"),
        (Repetition(parts="B"), 1, "it does not repeat, on another kind of processor: B"),
        (Repetition(parts="B", rounded="A"), 1, (
            "numbers differ only by rounding, which depends on the kind of processor; "
            "the first difference by rounding: A"
        )),
    ],
)  # fmt: skip
def test_verify_has_three_answers_and_names_the_processors(
    command: Command, folder: Path, monkeypatch: pytest.MonkeyPatch, found: Repetition, code: int, said: str
) -> None:
    monkeypatch.setattr("handeye.runs.verify.repetition", lambda *_: found)
    monkeypatch.setattr("handeye.core.processor.processor", lambda: "a 6502")
    really, out, told = command("trace", "verify", str(folder))
    assert really == code
    assert said in " ".join(out.replace(str(folder), "it").split())
    assert "; this processor is a 6502" in " ".join(told.split())


def test_a_run_with_experiments_and_an_operator_comes_out_the_same_again(
    command: Command, planned: Planned
) -> None:
    plan = planned(
        'TRANS T [20 30 8 90 90 0]\nSTAGE "a"\nMOVE T\nSAVE D\nWAIT "HELP"\nMOVE T\nRESTORE D\nSTAGE "b"\nOPEN 2\n'
    )
    typed = "step 2\nset saved D 0 0 -1\ncontinue\nproceed\ncontinue\nquit\n"
    assert command("run", plan, "--step", "--out", "it", typed=typed)[0] == 0
    code, out, _ = command("trace", "verify", "it")
    assert (code, "byte for byte" in out) == (0, True)
