"""Where a command writes: it replaces nothing but what it would have written itself."""

import json
from collections.abc import Callable
from pathlib import Path

import pytest
from conftest import Command

from handeye.core.files import Kind, check_place, write_over
from handeye.trials.faults import FaultRow, FaultTrial, FaultWork
from handeye.trials.sweep import Case

Planned = Callable[[str], str]

OURS = "; somebody's own\nOPEN 1\n"
WRITERS = {
    "plan": ("plan", "job.al", "-o", "kept.al"),
    "JSON schema": ("schema", "-o", "kept.al"),
    "graph": ("inspect", "job.plan.json", "--graph", "dot", "-o", "kept.al"),
    "checkpoint": ("do", "OPEN 1", "--keep", "kept.al"),
    "SVG drawing": ("inspect", "job.plan.json", "--graph", "svg", "-o", "kept.svg"),
    "PNG picture": ("render", "-o", "kept.png"),
    "PNG picture of a run": ("trace", "photograph", "run", "--at", "1", "-o", "kept.png"),
}
"""What is written, and the command that is to write it over a file of somebody's."""


@pytest.mark.parametrize("what", WRITERS)
def test_a_file_of_another_kind_is_left_alone(command: Command, planned: Planned, what: str) -> None:
    planned("OPEN 1")
    kept = Path(WRITERS[what][-1])
    kept.write_text(OURS, encoding="utf-8")
    code, out, err = command(*WRITERS[what])
    kind = what.removesuffix(" of a run")
    assert (code, out) == (2, "")
    assert err == f"handeye: {kept} exists and is no {kind}; nothing was written\n"
    assert kept.read_text(encoding="utf-8") == OURS


@pytest.mark.parametrize("what", ["checkpoint", "PNG picture", "PNG picture of a run"])
def test_a_place_that_cannot_be_written_is_told_before_anything_is_done(command: Command, what: str) -> None:
    *words, name = WRITERS[what]
    code, out, err = command(*words, f"absent/{name}")
    assert (code, out) == (2, "")
    assert err == f"handeye: absent/{name} cannot be written: No such file or directory\n"


@pytest.mark.parametrize("what", ["checkpoint", "PNG picture", "PNG picture of a run"])
def test_a_folder_in_the_place_of_a_file_is_told_before_anything_is_done(command: Command, what: str) -> None:
    *words, name = WRITERS[what]
    Path(name).mkdir()
    assert command(*words, name) == (2, "", f"handeye: {name} cannot be written: it is not a file\n")


def test_trials_of_faults_are_dropped_only_where_that_is_asked_for(
    command: Command, monkeypatch: pytest.MonkeyPatch
) -> None:
    def work(self: FaultWork, case: Case) -> list[FaultRow]:
        tried = FaultTrial(
            name=case.condition, outcome="stopped", stage=None, message="", error=None, line=None, exit_code=1
        )
        return [FaultRow(trial=0, seed=case.seed, condition=case.condition, tried=tried)]

    monkeypatch.setattr(FaultWork, "__call__", work)
    words = ("faults", "--only", "lamp.dead", "--out", "kept")
    assert command(*words)[0] == 0
    sentence = (
        "handeye: kept holds 1 trial of another batch, which differs in worlds; choose another folder\n"
    )
    assert command(*words, "--seed", "3") == (2, "", sentence)
    assert command(*words, "--seed", "3", "--overwrite")[0] == 0
    head, row = map(json.loads, Path("kept/trials.jsonl").read_text("utf-8").splitlines())
    assert (head["world"]["seed"], row["seed"], row["tried"]["name"]) == (3, 3, "lamp.dead")


@pytest.mark.parametrize(
    "words",
    [
        ("plan", "job.al", "-o", "it"),
        ("schema", "-o", "it"),
        ("inspect", "job.plan.json", "--graph", "dot", "-o", "it"),
        ("inspect", "job.plan.json", "--graph", "svg", "-o", "it.svg"),
    ],
)
def test_what_was_written_once_is_written_again(
    command: Command, planned: Planned, words: tuple[str, ...]
) -> None:
    planned("OPEN 1")
    assert [command(*words)[0] for _ in range(2)] == [0, 0]


def test_a_plan_that_replaces_another_says_so(command: Command, planned: Planned) -> None:
    planned("OPEN 1")
    told = [command("plan", "job.al", "-o", "it")[1] for _ in range(2)]
    Path("job.al").write_text("OPEN 2\n", encoding="utf-8")
    told.append(command("plan", "job.al", "-o", "it")[1])
    assert told == [
        *["it: 1 step, 0 motions, 1 stage\n"] * 2,
        "it: 1 step, 0 motions, 1 stage, replacing another plan\n",
    ]


@pytest.mark.parametrize("words", [("teach",), ("view", "--teach")])
def test_what_could_not_be_saved_is_not_taught(command: Command, words: tuple[str, ...]) -> None:
    refused = "handeye: absent/job.toml cannot be written: No such file or directory\n"
    assert command(*words, "absent/job.al") == (2, "", refused)


@pytest.mark.parametrize(
    ("words", "sentence"),
    [
        (("render", "-o", "it.jpg"), "it.jpg: the name of the PNG picture must end in .png"),
        (
            ("inspect", "job.plan.json", "--graph", "svg", "-o", "it.png"),
            "it.png: the name of the SVG drawing must end in .svg",
        ),
    ],
)
def test_no_picture_gets_a_name_that_says_something_else(
    command: Command, planned: Planned, words: tuple[str, ...], sentence: str
) -> None:
    planned("OPEN 1")
    assert command(*words) == (2, "", f"handeye: {sentence}\n")
    assert not Path(words[-1]).exists()


def test_an_empty_file_may_become_anything(tmp_path: Path) -> None:
    place = tmp_path / "made"
    place.touch()
    write_over(place, b"list 1\n", Kind("list", b"list "))
    assert place.read_bytes() == b"list 1\n"


def test_to_look_at_a_place_leaves_nothing_there(tmp_path: Path) -> None:
    check_place(tmp_path / "made", Kind("list", b"list "))
    assert list(tmp_path.iterdir()) == []
