"""`handeye run --world-of`: another script in the world of a recorded run, or one sentence on why it cannot be had."""

from collections.abc import Callable
from pathlib import Path

import msgspec
import pytest
from conftest import Command

from handeye.core.variation import DRAWING
from handeye.program.events import RunStarted, to_line
from handeye.trace.eventlist import read_events

pytestmark = pytest.mark.slow

SCRIPT = 'STAGE "open"\nOPEN 1\nSTAGE "open on"\nOPEN 1.2\n'
WORLD = ("--seed", "3", "--level", "high", "--without", "camera", "--set", "part_mass=5%", "--camera", "ray")
FAULTS = ("--fault", "lamp.dead@2")


@pytest.fixture
def recorded(command: Command, planned: Callable[[str], str]) -> str:
    """The plan of a run that is kept in `run`, in a world of its own."""
    plan = planned(SCRIPT)
    assert command("run", plan, *WORLD, *FAULTS, "--out", "run")[0] == 0
    return plan


def head(folder: str) -> RunStarted:
    """The beginning of the run in a folder."""
    begun = read_events(Path(folder, "events.jsonl"))[0]
    assert isinstance(begun, RunStarted)
    return begun


def refused(command: Command, *words: str) -> str:
    """The sentence with which a run is refused, which leaves no folder."""
    code, out, err = command("run", *words, "--out", "new")
    assert (code, out, Path("new").exists()) == (2, "", False)
    return err.removeprefix("handeye: ").rstrip("\n")


@pytest.mark.parametrize("given", ["run", "run/trace.mcap", "run/events.jsonl"])
def test_the_same_plan_in_the_world_of_a_run_is_that_run_to_the_byte(
    command: Command, recorded: str, given: str
) -> None:
    assert command("run", recorded, "--world-of", given, "--out", "again")[0] == 0
    assert Path("again/trace.mcap").read_bytes() == Path("run/trace.mcap").read_bytes()


def test_another_plan_meets_the_same_world(
    command: Command, recorded: str, planned: Callable[[str], str]
) -> None:
    other = planned(SCRIPT + "OPEN 1.4\n")
    assert command("run", other, "--world-of", "run", "--out", "other")[0] == 0
    assert (head("other").world, head("other").camera) == (head("run").world, head("run").camera)
    assert head("other").plan != head("run").plan


@pytest.mark.parametrize("words", [("--seed", "3"), FAULTS, ("--camera", "ray")])
def test_a_world_of_ones_own_does_not_go_with_that_of_a_run(
    command: Command, recorded: str, words: tuple[str, ...]
) -> None:
    others = "--seed, --world, --level, --without, --set, --scale, --fault and --camera"
    assert refused(command, recorded, "--world-of", "run", *words) == (
        f"run has its own world; {others} cannot be given with --world-of"
    )


def test_a_run_that_is_not_there_has_no_world(command: Command, recorded: str) -> None:
    assert refused(command, recorded, "--world-of", "nowhere") == "nowhere: there is no such file"


def begins_otherwise(**fields: object) -> str:
    """An event list with another beginning than that of the run."""
    Path("other.jsonl").write_bytes(to_line(msgspec.structs.replace(head("run"), **fields)))
    return "other.jsonl"


def test_a_world_of_another_version_is_refused(command: Command, recorded: str) -> None:
    other = begins_otherwise(world=msgspec.structs.replace(head("run").world, drawing=DRAWING - 1))
    assert refused(command, recorded, "--world-of", other) == (
        "the world of other.jsonl comes from another version of handeye: seed 3 gives a different world here "
        f"(the rules that generate worlds have version {DRAWING - 1} in that version of handeye, "
        f"and version {DRAWING} in this one)"
    )


def test_a_world_with_code_of_somebody_elses_is_refused(command: Command, recorded: str) -> None:
    other = begins_otherwise(replaced={"camera": "fog.Foggy"})
    assert refused(command, recorded, "--world-of", other) == (
        "the run in other.jsonl used code of the calling program (camera); this command does not have that code"
    )


def test_a_fault_that_cannot_set_in_is_told(
    command: Command, recorded: str, planned: Callable[[str], str]
) -> None:
    short = planned("OPEN 1\n")
    assert refused(command, short, "--world-of", "run") == (
        "the fault lamp.dead from stage 2 on of run begins at a stage that this plan does not have; the plan "
        "has 1 stage"
    )


def test_an_event_list_without_a_beginning_tells_no_world(command: Command, recorded: str) -> None:
    Path("empty.jsonl").touch()
    assert refused(command, recorded, "--world-of", "empty.jsonl") == (
        "empty.jsonl does not contain the start of the run, which records its world"
    )
