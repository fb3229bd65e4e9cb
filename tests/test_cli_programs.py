"""Programs by name: each is planned and run in the task that comes with it; a file of that name wins."""

import json
from pathlib import Path

import pytest
from conftest import Command

from handeye.core.resources import plans


@pytest.mark.parametrize("name", ["insertion", "insertion_1973", "water_pump_1973"])
def test_a_program_is_checked_by_its_name(command: Command, name: str) -> None:
    code, out, err = command("check", name)
    file = plans() / f"{name}.al"
    task = name.removesuffix("_1973")
    assert (code, out) == (0, f"{file}: no errors\n")
    assert err.startswith(f"{name}: using the program of the task {task}, {file}\n")


@pytest.mark.slow
def test_a_program_is_run_in_its_own_task_and_judged(command: Command) -> None:
    code, out, _ = command("run", "insertion", "--json")
    assert (code, json.loads(out)["assembled"], json.loads(out)["task"]) == (0, True, "insertion")


def test_the_plan_of_a_program_is_left_here(command: Command) -> None:
    code, out, _ = command("plan", "insertion")
    assert (code, out) == (0, "insertion.plan.json: 20 steps, 8 motions, 2 stages\n")
    assert json.loads(Path("insertion.plan.json").read_text(encoding="utf-8"))["task"] == "insertion"
    code, listed, err = command("stages", "insertion")
    assert (code, "lines 8 to 13" in listed, "using the program" in err) == (0, True, True)


def test_a_file_of_the_name_wins_and_a_folder_does_not(command: Command) -> None:
    command("plan", "insertion", "-o", "insertion.plan.json")
    Path("insertion.plan.json").rename("insertion")
    code, _, err = command("stages", "insertion")
    assert (code, err) == (0, "insertion: using this file, not the program of the same name\n")
    Path("insertion").unlink()
    Path("insertion").mkdir()
    assert command("stages", "insertion")[0] == 0


@pytest.mark.parametrize(
    ("words", "said"),
    [
        ("run water_pmup", "water_pmup: there is no such file, and no program of that name; did you mean"),
        ("run palletise",
         "the task `palletise`: TRIG cannot run a plan of motions: each program of TRIG is taught in the world in "
         "which the program runs; `handeye trig palletise`, "),
        ("export mjcf --task palletise -o out", "the task `palletise` exports no scene\n"),
        ("trig palletise --task bucket", "`trig palletise` has no option `--task` (see"),
        (
            "check insertion --task water_pump",
            "the program `insertion` belongs to the task `insertion`, not to `water_pump`; leave out --task",
        ),
        (
            "world --task clock:TASK",
            "the task `clock:TASK` cannot be imported: ModuleNotFoundError: No module named 'clock'",
        ),
        ("world --task block_task:HALF",
         "`block_task:HALF` is not a task; a task is an instance of a class derived from handeye.Task"),
        ("world --task clock-TASK", "there is no task `clock-TASK`; "),
        ("world --task :x", "name a task as MODULE:NAME, such as my_task:TASK, not `:x`"),
    ],
)  # fmt: skip
def test_what_cannot_be_taken_is_told_in_a_sentence(command: Command, words: str, said: str) -> None:
    code, out, err = command(*words.split())
    assert (code, out) == (2, "")
    assert err.startswith(f"handeye: {said}")


def test_no_plan_has_a_module_imported(command: Command) -> None:
    Path("exits.py").write_text("raise SystemExit(7)", encoding="utf-8")
    command("plan", "insertion", "-o", "plan.json")
    text = (
        Path("plan.json").read_text(encoding="utf-8").replace('"task": "insertion"', '"task": "exits:TASK"')
    )
    Path("plan.json").write_text(text, encoding="utf-8")
    for words in (
        ("run", "plan.json", "--out", "run"),
        ("trials", "assembly", "--n", "1", "--plan", "plan.json"),
    ):
        code, _, err = command(*words)
        assert (code, err[:39]) == (2, "handeye: there is no task `exits:TASK`;")
    assert not Path("run").exists()
    code, _, err = command("world", "--task", "exits:TASK")
    assert (code, err) == (2, "handeye: the task `exits:TASK` cannot be imported: SystemExit: 7\n")


@pytest.mark.parametrize(
    "words", ["trace show", "report", "video", "resume", "show", "dismantle", "compare . ."]
)
def test_that_a_folder_holds_no_run_is_told_in_the_same_words(command: Command, words: str) -> None:
    Path("empty").mkdir()
    given = words.replace(".", "empty").split() if "." in words else [*words.split(), "empty"]
    assert command(*given) == (2, "", "handeye: empty holds no run\n")


@pytest.mark.slow
def test_a_pin_that_was_put_in_is_put_back_into_its_holder(command: Command) -> None:
    code, out, _ = command(
        "trials", "dismantling", "--plan", "insertion", "--n", "1", "--camera", "ray", "--json"
    )
    assert (code, json.loads(out)["right"]) == (0, 1)


@pytest.mark.parametrize(
    ("words", "said"),
    [
        ("world --task palletise", ""),
        ("trials disturbed --list --task insertion", "this task has no disturbances"),
        ("trials base --n 1 --task insertion", "the task `insertion` has no trial `base`"),
    ],
)
def test_what_a_task_does_not_have_is_told_and_no_traceback(command: Command, words: str, said: str) -> None:
    code, _, err = command(*words.split())
    assert (code, said in err) == (2 if said else 0, True)


def test_a_script_of_the_name_wins_too_and_is_told(command: Command) -> None:
    Path("insertion").write_text("OPEN 1\n", encoding="utf-8")
    code, out, err = command("check", "insertion")
    assert (code, out) == (0, "insertion: no errors\n")
    assert err.startswith("insertion: using this file, not the program of the same name\n")
