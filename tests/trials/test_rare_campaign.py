"""The commands `trials rare` and `trials worst` in worlds whose outcome is computed instead of simulated."""

import math
from collections.abc import Callable, Generator, Sequence
from pathlib import Path
from typing import Any

import msgspec
import numpy as np
import pytest
from conftest import Command
from results import result

from handeye.cli import rare
from handeye.core.variation import WorldSpec
from handeye.core.world_file import read_world
from handeye.tasks import task
from handeye.trials.rare.row import RareCase, RareRow, world_digest
from handeye.trials.sweep import Case
from handeye.trials.workers import Answer

pytestmark = pytest.mark.slow

FAR = 2.4  # standard deviations of plate.x + plate.y at which the program stops
WORDS = ("--task", "insertion", "--n", "60", "--camera", "ray", "--failure", "stopped", "--seed", "5")


def aside(world: WorldSpec) -> float:
    """How far the hole is to the side, in standard deviations."""
    drawn = task("insertion").variation()
    return sum(drawn.value(f"plate.{axis}", world) for axis in "xy") / (math.sqrt(2) * 1e-3)


def row_of(case: Case) -> RareRow:
    """The row of a run that stops if the hole is too far to the side."""
    assert isinstance(case, RareCase)
    left = FAR - aside(case.world)
    done = result(completed=left > 0, assembled=left > 0, message="" if left > 0 else "no hole here")
    return RareRow(
        trial=case.trials[0], seed=case.seed, condition=case.condition, result=done,
        left={"room": left}, world=world_digest(case.world),
    )  # fmt: skip


@pytest.fixture
def runs(monkeypatch: pytest.MonkeyPatch) -> list[str]:
    """The conditions of the runs that were asked for. None is executed; after a hundred, Ctrl-C is pressed."""
    asked: list[str] = []

    def engine(*_: object) -> Callable[..., Generator[Answer[Case, list[Any]], None, None]]:
        def answers(_: object, cases: Sequence[Case]) -> Generator[Answer[Case, list[Any]], None, None]:
            for case in cases:
                if len(asked) == INTERRUPTED_AFTER:
                    asked.append("")
                    raise KeyboardInterrupt
                asked.append(case.condition)
                yield Answer(item=case, value=[row_of(case)])

        return answers

    monkeypatch.setattr(rare, "trial_engine", engine)
    return asked


INTERRUPTED_AFTER = 100


def test_a_search_that_was_interrupted_goes_on_and_ends_as_one_that_was_not(
    command: Command, runs: list[str]
) -> None:
    assert command("trials", "rare", *WORDS, "--out", "rare")[0] == 130
    assert len(Path("rare/trials.jsonl").read_text().splitlines()) == 1 + INTERRUPTED_AFTER
    code, out, _ = command("trials", "rare", *WORDS, "--out", "rare", "--json")
    told = msgspec.json.decode(out)
    made = len(runs) - 1
    code_whole, out_whole, _ = command("trials", "rare", *WORDS, "--json")
    whole = msgspec.json.decode(out_whole)
    assert (code, code_whole) == (0, 0)
    assert told["estimates"] == whole["estimates"]
    assert made == whole["runs"]
    drawn = np.random.default_rng(0).standard_normal((1_000_000, 2)).clip(-2, 2).sum(axis=1) / math.sqrt(2)
    guess = told["estimates"][0]["estimate"]
    assert guess["low"] < (drawn >= FAR).mean() < guess["high"]
    for failing in told["failing"]:
        assert (
            aside(read_world(Path("rare") / failing["file"]).world) >= FAR
            or failing["condition"] == "level 0"
        )


def test_the_nearest_worlds_need_only_what_makes_the_program_fail(command: Command, runs: list[str]) -> None:
    runs.append("")  # not to be interrupted
    runs.extend([""] * INTERRUPTED_AFTER)
    code, out, _ = command(
        "trials", "worst", *WORDS, "--out", "rare", "--nearest", "3", "--rounds", "40", "--json"
    )
    found = msgspec.json.decode(out)["worlds"]
    assert code == 0
    assert len(found) == 3
    for each in found:
        assert set(each["quantities"]) <= {"plate.x", "plate.y"}
        assert each["distance"] < each["found_at"]
        assert aside(read_world(Path("rare") / each["file"]).world) >= FAR
    pushes = msgspec.json.decode(out)["pushes"]["stopped"]
    assert {push["quantity"] for push in pushes[:2]} == {"plate.x", "plate.y"}
    assert Path("rare/worst.html").read_bytes().startswith(b"<!DOCTYPE html>")
    done = len(runs)
    _, text, _ = command("trials", "worst", *WORDS, "--out", "rare", "--nearest", "3", "--rounds", "40")
    assert len(runs) == done
    assert "handeye assemble --world rare/worlds/nearest-stopped-1.json --camera ray" in text


def test_a_row_of_another_world_is_refused(command: Command, runs: list[str]) -> None:
    runs.extend([""] * (INTERRUPTED_AFTER + 1))
    assert command("trials", "rare", *WORDS, "--levels", "2", "--out", "rare")[0] == 0
    file = Path("rare/trials.jsonl")
    lines = file.read_text().splitlines()
    one = next(line for line in lines if '"condition":"stopped, level 1"' in line)
    changed = msgspec.json.decode(one) | {"world": "0" * 16}
    file.write_text(
        "".join(f"{msgspec.json.encode(changed).decode() if line == one else line}\n" for line in lines)
    )
    code, _, err = command("trials", "rare", *WORDS, "--levels", "2", "--out", "rare")
    assert code == 2
    assert "was tried in one world, and this command would try it in another" in err
