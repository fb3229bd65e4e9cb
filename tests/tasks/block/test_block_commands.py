"""The second task on the command line, named by `--task`: nothing it does leads to the pump's cell or speaks of it."""

import shutil
from pathlib import Path

import block_task
import pytest
from conftest import Command

from handeye.runs.folder import CHECKPOINTS
from handeye.tasks import ELSEWHERE

BLOCK = ("--task", "block_task:BLOCK")
PLAN, RAY = "block.plan.json", ("--camera", "ray")


@pytest.fixture(autouse=True)
def _nothing_is_left_in_the_environment(monkeypatch: pytest.MonkeyPatch, tmp_path: Path) -> None:
    monkeypatch.setenv(ELSEWHERE, "")
    for ending in (".al", ".toml"):
        shutil.copy(block_task.SCRIPT.with_suffix(ending), tmp_path)


def told(command: Command, *words: str, typed: str = "") -> str:
    """What a command says that ends well, and does not speak of the pump."""
    code, out, err = command(*words, typed=typed)
    assert (code, "pump" in (out + err).lower()) == (0, False), out + err
    return out + err


@pytest.mark.slow
def test_the_second_task_passes_the_ordinary_commands(command: Command) -> None:
    assert "block.al: no errors" in told(command, "check", *BLOCK, "block.al")
    assert "8 steps, 4 motions" in told(command, "plan", *BLOCK, "block.al")
    done = told(command, "run", *BLOCK, PLAN, "--judge", "--out", "whole", *RAY)
    assert "The block stands where it should." in done
    stepped = told(command, "run", *BLOCK, PLAN, "--step", "--out", "stepped", *RAY, typed="step\nquit\n")
    assert "resume with: handeye resume stepped --task block_task:BLOCK" in stepped
    assert "put it down        done" in told(command, "resume", "stepped", "--details", *BLOCK)
    told(command, "report", "whole", *BLOCK)
    page = Path("whole/report.html").read_text(encoding="utf-8")
    assert f"handeye run plan.json {' '.join(BLOCK)} --judge --seed 0" in page
    assert "pump" not in page.lower()
    assert "Both runs are identical" in told(
        command, "compare", "whole", "stepped", *BLOCK, "-o", "both.html"
    )
    assert "pump" not in Path("both.html").read_text(encoding="utf-8").lower()
    tried = told(command, "trials", "assembly", "--plan", PLAN, *BLOCK, "--n", "1", "--out", "batch", *RAY)
    assert "1 of 1 assembled" in tried
    assert "everything" not in told(command, "dismantle", "whole", *BLOCK)


@pytest.mark.slow
@pytest.mark.render
def test_the_second_task_is_filmed_and_photographed(command: Command) -> None:
    told(command, "plan", *BLOCK, "block.al")
    told(command, "run", *BLOCK, PLAN, "--out", "whole", "--to", "1", *RAY)
    told(command, "video", "whole", *BLOCK, "--seconds", "1", "--size", "96x72")
    told(command, "trace", "photograph", "whole", *BLOCK, "--at", "2", "-o", "at.png", "--size", "64x960")
    told(command, "render", *BLOCK, "-o", "world.png", "--size", "64x960")


def test_its_world_is_listed_and_set(command: Command) -> None:
    listed = told(command, "world", *BLOCK, "--set", "block.x=.1in", "--level", "high")
    assert "block.x                0.1 in    set" in listed


def test_a_task_that_contradicts_the_plan_is_refused(command: Command) -> None:
    told(command, "plan", *BLOCK, "block.al")
    assert command("run", PLAN, "--task", "water_pump") == (
        2, "", f"handeye: {PLAN} is a plan for the task `block`, not for `water_pump`; "
        "leave out --task, or give the right task\n",
    )  # fmt: skip


@pytest.mark.slow
def test_a_run_of_another_task_is_refused_and_left_as_it_is(command: Command) -> None:
    told(command, "plan", *BLOCK, "block.al")
    told(command, "run", *BLOCK, PLAN, "--out", "whole", "--to", "1", *RAY)
    kept = sorted(Path("whole", CHECKPOINTS).iterdir())
    for name in ("resume", "dismantle", "video", "trace verify"):
        code, _, err = command(*name.split(), "whole", "--task", "insertion")
        assert code == 2
        assert err.startswith("handeye: the run in whole belongs to the task `block`, not to `insertion`")
    assert sorted(Path("whole", CHECKPOINTS).iterdir()) == kept


@pytest.mark.slow
def test_a_batch_in_which_every_trial_is_broken_off_does_not_end_well(command: Command) -> None:
    told(command, "plan", *BLOCK, "block.al")
    short = ("--simulated-limit", ".01", *RAY)
    code, out, _ = command("trials", "assembly", "--plan", PLAN, *BLOCK, "--n", "1", *short)
    assert (code, "1 unfinished" in out) == (1, True)
