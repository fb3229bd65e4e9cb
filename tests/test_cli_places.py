"""Where a command writes: it replaces nothing but what it would have written itself."""

import json
from collections.abc import Callable, Iterator
from pathlib import Path

import pytest
from conftest import Command
from cyclopts import App, ArgumentCollection

from handeye import cli
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
    article = "an" if kind == "SVG drawing" else "a"
    assert (code, out) == (2, "")
    assert err == f"handeye: {kept} exists and is not {article} {kind}; nothing was written\n"
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
def test_what_was_written_once_is_replaced_only_where_that_is_asked_for(
    command: Command, planned: Planned, words: tuple[str, ...]
) -> None:
    planned("OPEN 1")
    place = Path(words[-1])
    assert command(*words)[0] == 0
    place.write_bytes(before := place.read_bytes() + b"\n")
    assert command(*words) == (2, "", f"handeye: {place} already exists; --overwrite replaces it\n")
    assert place.read_bytes() == before
    assert command(*words, "--overwrite")[0] == 0
    assert place.read_bytes() == before[:-1]


def test_a_plan_that_replaces_another_says_so(command: Command, planned: Planned) -> None:
    planned("OPEN 1")
    told = [command("plan", "job.al")[1]]
    Path("job.al").write_text("OPEN 2\n", encoding="utf-8")
    told.append(command("plan", "job.al")[1])
    assert told == [
        "job.plan.json: 1 step, 0 motions, 1 stage\n",
        "job.plan.json: 1 step, 0 motions, 1 stage, replacing an earlier plan\n",
    ]


def leaves() -> Iterator[tuple[str, ArgumentCollection]]:
    """Every command by its words, with its arguments."""

    def walk(group: App, words: str) -> Iterator[tuple[str, ArgumentCollection]]:
        for name in group:
            if not name.startswith("-"):
                yield from walk(group[name], f"{words} {name}".strip())
        if words and group.default_command is not None:
            yield words, group.assemble_argument_collection(parse_docstring=True)

    yield from walk(cli.app, "")


def options() -> dict[str, dict[str, str]]:
    """The help of every option, by command and name."""
    return {
        words: {name: str(each.parameter.help) for each in arguments if each.parse for name in each.names}
        for words, arguments in leaves()
    }


def test_an_option_means_the_same_wherever_it_is() -> None:
    """`-o`, `--out` names what is written, `--overwrite` goes with it, and no command counts by another word."""
    for words, named in options().items():
        assert ("-o" in named) == ("--out" in named), words
        assert not {"--output", "--workers", "--width", "--height", "--count", "COUNT"} & set(named) - (
            {"--width"} if words == "trig show" else set()
        ), words
        if "--out" in named or "--keep" in named:
            assert "--overwrite" in named, words
        if "--jobs" in named and words not in ("trials mutants", "exercise"):  # their numbers are given
            assert "--n" in named, words
        for name, told in {
            "--jobs": "Number of processes that work at the same time.",
            "--size": "Width and height in pixels.",
        }.items():
            assert named.get(name, told) == told, words
        if "--seed" in named:
            assert "world" in named["--seed"].lower(), words
        if "RUN" in named:
            assert named["RUN"].startswith("The folder of a run"), words


NEEDED = {
    "report": ("-o", "it.html"), "compare": ("absent",), "view": (), "trace photograph": ("--at", "1", "-o", "it.png"),
    "trace thin": ("-o", "it.mcap"), "trace plot": ("-o", "it.png"), "trace export csv": ("-o", "tables"),
    "trace export parquet": ("-o", "tables"), "export mjcf": ("-o", "scene"), "export glb": ("-o", "it.glb"),
}  # fmt: skip
"""Words that a command needs besides the run."""


def test_every_command_that_takes_a_run_says_the_same_where_there_is_none(command: Command) -> None:
    takers = {words for words, named in options().items() if {"RUN", "A"} & set(named)}
    assert {"show", "resume", "dismantle", "video", *NEEDED} - {"view"} <= takers
    for folder in ("empty", "batch"):
        Path(folder).mkdir()
    for name in ("plan.json", "trials.jsonl"):
        Path("batch", name).touch()
    sentences = {
        "absent": "absent: there is no such file",
        "empty": "empty holds no run",
        "batch": "batch is the folder of a batch of trials, not of a run",
    }
    for words in sorted(takers):
        for place, sentence in sentences.items():
            code, _, err = command(*words.split(), place, *NEEDED.get(words, ()))
            assert (words, code, err.splitlines()[-1]) == (words, 2, f"handeye: {sentence}")


def test_what_is_typed_replaces_nothing(command: Command, planned: Planned) -> None:
    plan = planned("OPEN 1")
    Path("it.checkpoint").write_bytes(b"handeye-checkpoint 1 ours")
    for typed in ("checkpoint it.checkpoint", "checkpoint job.al"):
        code, out, _ = command("run", plan, "--camera", "ray", "--step", "--json", typed=f"{typed}\nquit\n")
        assert (code, "nothing was written" in out) == (2, True)
    assert Path("it.checkpoint").read_bytes() == b"handeye-checkpoint 1 ours"


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
