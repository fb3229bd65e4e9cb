"""`--world FILE`: the world of a file on the commands that build a world, or one sentence on why it cannot be had."""

from collections.abc import Callable
from pathlib import Path

import msgspec
import pytest
from conftest import Command

from handeye.core.faults import Fault
from handeye.core.variation import Overrides, WorldSpec
from handeye.core.world_file import WorldFile, read_world, write_world
from handeye.program.events import RunStarted
from handeye.trace.eventlist import read_events

SET = {"plate.x": 0.002, "plate.y": -0.001}


def written(task: str = "insertion", **fields: object) -> str:
    """A file with a world of the insertion bench."""
    world = WorldSpec(**{"seed": 11, "level": "high", "overrides": Overrides(set=SET), **fields})  # type: ignore[arg-type]
    write_world(Path("w.json"), WorldFile(task=task, world=world))
    return "w.json"


def told(command: Command, *words: str) -> str:
    """The sentence with which a command is refused."""
    code, out, err = command(*words)
    assert (code, out) == (2, "")
    assert err.count("\n") == 1
    return err.removeprefix("handeye: ").rstrip("\n")


def test_a_command_shows_the_world_of_a_file_and_takes_the_task_from_it(command: Command) -> None:
    code, out, _ = command("world", "--world", written(), "--json")
    made = msgspec.json.decode(out)
    assert code == 0
    assert msgspec.convert(made["world"], WorldSpec).seed == 11
    (x,) = [each for each in made["quantities"] if each["name"] == "plate.x"]
    assert x["value"] == pytest.approx(2.0)


@pytest.mark.slow
def test_a_run_in_the_world_of_a_file_records_this_world(
    command: Command, planned: Callable[[str], str]
) -> None:
    plan = planned('STAGE "open"\nOPEN 1\n')
    file = written("water_pump", overrides=Overrides(set={"camera.place.x": 0.002}))
    code, out, _ = command("run", plan, "--world", file, "--camera", "ray", "--out", "run", "--json")
    begun = read_events(Path("run/events.jsonl"))[0]
    assert code == 0
    assert isinstance(begun, RunStarted)
    assert (
        begun.world
        == msgspec.convert(msgspec.json.decode(out)["world"], WorldSpec)
        == read_world(Path(file)).world
    )


WHOLE = (
    "--world w.json gives the whole world; leave out --seed, --level, --set and --scale, and do not name errors in "
    "--without"
)


@pytest.mark.parametrize(
    ("words", "sentence"),
    [
        (("--seed", "3"), WHOLE),
        (("--set", "plate.x=1"), WHOLE),
        (
            ("--task", "water_pump"),
            "the world in w.json belongs to the task `insertion`, not to `water_pump`",
        ),
    ],
)
def test_other_options_cannot_change_the_world_of_a_file(
    command: Command, words: tuple[str, ...], sentence: str
) -> None:
    assert told(command, "world", "--world", written(), *words) == sentence


@pytest.mark.parametrize(
    ("text", "sentence"),
    [
        (b"", "w.json does not hold a world: Input data was truncated"),
        (b"[" * 100_000, "w.json does not hold a world: "),
        (b'{"format": "handeye batch"}', "w.json does not hold a world: "),
        (b'{"task": "insertion", "world": {"seed": -1}}', "w.json does not hold a world: "),
        (b'{"task": "insertion", "world": {"seed": 1, "more": 2}}', "w.json does not hold a world: "),
        (b'{"task": "insertion", "world": {"seed": 1, "overrides": {"set": {"no.such": 1.0}}}}',
         "w.json: the world has no quantity `no.such`; "),
        (b'{"task": "insertion", "world": {"seed": 1, "overrides": {"set": {"plate.x": 1e300}}}}',
         "w.json: plate.x must be between "),
        (b'{"task": "no_such", "world": {"seed": 1}}', ""),
        (b'{"task": "insertion", "world": {"seed": 1, "drawing": 1}}', "w.json: the world of seed 1 comes from "),
    ],
)  # fmt: skip
def test_a_file_that_holds_no_such_world_is_refused_in_a_sentence(
    command: Command, text: bytes, sentence: str
) -> None:
    Path("w.json").write_bytes(text)
    assert told(command, "world", "--world", "w.json").startswith(sentence)


def test_a_file_with_faults_is_refused(command: Command) -> None:
    assert "use --fault" in told(command, "world", "--world", written(faults=(Fault(name="x"),)))


def test_a_world_is_not_written_over_another_file(command: Command) -> None:
    Path("w.json").write_text('{"format": "other"}\n')
    with pytest.raises(Exception, match=r"w\.json"):
        written()
    assert Path("w.json").read_text() == '{"format": "other"}\n'
