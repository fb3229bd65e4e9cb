"""Runs that `python -m benchmarks breaking` interrupts, and that it refuses to."""

import subprocess
from pathlib import Path

import pytest
from conftest import Command

from benchmarks import breaking

CHOSEN = ("--seed", "3", "--level", "high", "--without", "camera,base.x", "--set", "part_mass=5%")


@pytest.fixture
def seen(monkeypatch: pytest.MonkeyPatch) -> list[str]:
    """Words of the commands that trials carry out, each of which fails."""
    found: list[str] = []

    def handeye(*words: str) -> subprocess.CompletedProcess[str]:
        found.extend(words)
        return subprocess.CompletedProcess(words, 1)

    monkeypatch.setattr(breaking, "handeye", handeye)
    return found


def test_runs_that_are_to_be_broken_off_are_in_the_chosen_world(seen: list[str], tmp_path: Path) -> None:
    with pytest.raises(breaking.TrialFailed):
        breaking.whole_run(tmp_path, 3, CHOSEN)
    assert tuple(seen) == ("assemble", *CHOSEN, "--out", str(tmp_path))


def test_a_dismantling_that_is_to_be_broken_off_is_of_the_run_that_was_not(
    seen: list[str], tmp_path: Path
) -> None:
    whole = breaking.UnbrokenRun(
        folder=tmp_path / "pump", seed=3, world=CHOSEN, command=("assemble", *CHOSEN), events=(), stages=()
    )
    with pytest.raises(breaking.TrialFailed, match="the pump of seed 3 is not taken apart even without"):
        breaking.whole_undo(whole, tmp_path / "apart")
    assert tuple(seen) == ("dismantle", str(tmp_path / "pump"), "--out", str(tmp_path / "apart"))


def test_only_runs_are_interrupted_while_they_are_undone(benchmark: Command) -> None:
    said = "handeye: --dismantling can be used with `killed` and `interrupted`, not with `stepped`\n"
    assert benchmark("breaking", "stepped", "--dismantling") == (2, "", said)


@pytest.mark.parametrize("words", [("breaking", "killed"), ("overhead",)])
def test_an_error_of_the_world_that_there_is_not_is_refused(
    benchmark: Command, words: tuple[str, ...]
) -> None:
    code, out, err = benchmark(*words, "--without", "camra")
    assert (code, out) == (2, "")
    assert err.endswith("the world has no quantity `camra`; did you mean `camera`?\n")
