"""How a run is begun: at a stage, from what was kept, in which world; and what is refused."""

import json
from pathlib import Path

import numpy as np
import pytest
from conftest import Command

import handeye
from handeye.core.errors import InvalidInput
from handeye.program.events import RunStarted

pytestmark = pytest.mark.slow

SCRIPT = """\
        STAGE   "open up"
        OPEN    1
        OPEN    2
        STAGE   "shut the hand"
        OPEN    .2
        JUMP    E
        STAGE   "never"
        OPEN    3
        STAGE   "end"
E:      OPEN    1.5
"""
CALLS = 'STAGE "shut"\nCLOSE 1\nSTAGE "open"\nOPEN 2\n'


@pytest.fixture(scope="module")
def folder(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """The folder of a run that is over."""
    path = tmp_path_factory.mktemp("begin") / "run"
    handeye.assemble(3, script=SCRIPT, camera="ray", out=path)
    return path


@pytest.mark.parametrize("stage", ["shut the hand", "shut", "HAND", 2, "2"])
def test_a_run_begins_with_a_stage(stage: str | int) -> None:
    run = handeye.begin(SCRIPT, at=stage, camera="ray")
    assert (run.state.position, run.state.line) == (2, 5)


def test_a_stage_is_begun_with_from_the_checkpoint_in_a_folder(folder: Path) -> None:
    before = sorted(folder.rglob("*")), (folder / "trace.mcap").read_bytes()
    run = handeye.begin(folder, at="shut")
    assert (run.state.position, run.state.why) == (2, "resumed after 2 steps")
    assert run.until().why == "the program finished"
    assert (sorted(folder.rglob("*")), (folder / "trace.mcap").read_bytes()) == before


def test_a_run_is_taken_up_in_its_world(folder: Path) -> None:
    assert "seed 3" in repr(handeye.begin(folder))
    assert handeye.begin(folder, 3, world=None).result.seed == 3
    with pytest.raises(InvalidInput, match=r"uses the world of seed 3, not the world of seed 4$"):
        handeye.begin(folder, 4)


@pytest.mark.parametrize(
    ("words", "sentence"),
    [
        ({"at": "nix"}, r"^there is no stage `nix`"),
        ({"at": 9}, r"^there is no stage 9; the program has stages 1 to 4$"),
        ({"at": "never"}, r"^the run never reaches “never” from the step at which the run begins$"),
        ({"at": ["shut"]}, r"^a place must be a text or a line number, not \['shut'\]$"),
        ({"seed": -1}, r"^a seed must be a whole number from 0 to 9007199254740991 \(2\^53 - 1\), not -1$"),
        ({"seed": "3"}, r"^a seed must be a whole number from 0 to 9007199254740991 \(2\^53 - 1\), not '3'$"),
        (
            {"seed": 1.5},
            r"^a seed must be a whole number from 0 to 9007199254740991 \(2\^53 - 1\), not 1\.5$",
        ),
        (
            {"seed": np.array([1, 2])},
            r"^a seed must be a whole number from 0 to 9007199254740991 \(2\^53 - 1\), not array\(\[1, 2\]\)$",
        ),
        (
            {"seed": True},
            r"^a seed must be a whole number from 0 to 9007199254740991 \(2\^53 - 1\), not True$",
        ),
        ({"seed": 1 << 53}, r"^a seed must be .*, not 9007199254740992$"),
        ({"seed": 10**5000}, r"^a seed must be .*, not a longer number$"),
        ({"seed": 1, "world": handeye.World(1)}, r"^give a seed or a world, not both: "),
        ({"world": 3}, r"^a world must be a handeye\.World, not 3$"),
        ({"world": {"seed": 3}}, r"^a world must be a handeye\.World, not \{'seed': 3\}$"),
        ({"camera": "rya"}, r"^there is no camera `rya`; did you mean `ray`\?$"),
        ({"task": "water_pmup"}, r"^there is no task `water_pmup`; did you mean `water_pump`\?"),
        ({"out": 3}, r"^out= must be a folder, not 3$"),
    ],
)
def test_what_cannot_be_begun_is_told_in_one_sentence(words: dict[str, object], sentence: str) -> None:
    with pytest.raises(InvalidInput, match=sentence):
        handeye.begin(SCRIPT, **{"camera": "ray", **words})


def test_a_run_that_stops_before_its_stage_is_no_run_at_that_stage(tmp_path: Path) -> None:
    with pytest.raises(
        InvalidInput, match=r"^the run stopped before “open”: the program called the operator: "
    ):
        handeye.begin(CALLS, at="open", camera="ray", out=tmp_path / "run")
    assert (tmp_path / "run" / "result.json").is_file()


def test_a_folder_is_not_lost_unless_that_is_said(tmp_path: Path) -> None:
    handeye.assemble(script="OPEN 1\n", camera="ray", out=tmp_path / "run")
    with pytest.raises(
        InvalidInput, match=r"holds a run: handeye\.begin\(.*\) continues it, overwrite=True replaces it"
    ) as told:
        handeye.assemble(script="OPEN 1\n", camera="ray", out=tmp_path / "run")
    assert "--" not in str(told.value)
    again = handeye.assemble(seed=5, script="OPEN 1\n", camera="ray", out=tmp_path / "run", overwrite=True)
    assert again.trace.head.world.seed == 5


def test_a_folder_that_was_made_for_nothing_is_gone(tmp_path: Path) -> None:
    with pytest.raises(InvalidInput, match="has no finding"):
        handeye.begin("OPEN 1\n", camera="ray", referee={"nix": 1}, out=tmp_path / "run")
    assert not (tmp_path / "run").exists()


@pytest.mark.parametrize("word", ["ask", "retry", "retry:0", "", None])
def test_nobody_is_there_to_be_asked(word: object) -> None:
    with pytest.raises(
        InvalidInput, match=r"^on_stop must be `abort`, `retry:N` \(N is at least 1\) or `unwind`, not "
    ):
        handeye.assemble(script="OPEN 1\n", on_stop=word)


def test_a_stage_is_tried_again_as_often_as_is_said() -> None:
    run = handeye.assemble(script=CALLS, camera="ray", on_stop="retry:2")
    assert (run.completed, len(run.result.interventions)) == (False, 2)


def test_a_run_is_in_the_world_that_was_chosen() -> None:
    world = handeye.World(seed=7, level="low", set={"arm.friction": 0})
    begun = handeye.begin("OPEN 1\n", world=world, camera="ray").events[0]
    assert isinstance(begun, RunStarted)
    assert begun.world == world.spec


def test_the_folder_of_a_run_is_to_the_byte_that_of_the_command_line(
    command: Command, tmp_path: Path
) -> None:
    plan = handeye.plan(SCRIPT).save(tmp_path / "a.plan.json")
    words = ("--seed", "3", "--camera", "ray", "--judge", "--out", str(tmp_path / "typed"))
    code, _, _ = command("run", str(plan), *words)
    run = handeye.assemble(3, script=plan, camera="ray", out=tmp_path / "called")
    left = [contents(tmp_path / name) for name in ("typed", "called")]
    assert (code, run.result.exit_code) == (3, 3)
    assert left[0] == left[1]
    assert {"plan.json", "events.jsonl", "trace.mcap", "result.json", "pictures"} <= {*left[0]}


def contents(folder: Path) -> dict[str, object]:
    """What is in the folder of a run, but for the host's seconds."""
    found: dict[str, object] = {
        path.relative_to(folder).as_posix(): path.read_bytes() if path.is_file() else b""
        for path in sorted(folder.rglob("*"))
    }
    result = json.loads(found.pop("result.json"))
    host = [
        name
        for name in result["timing"]
        if name.endswith(("_cpu_s", "_wall_s")) or name == "real_time_factor"
    ]
    for name in host:
        del result["timing"][name]
    return {**found, "host.json": b"", "result.json": result}
