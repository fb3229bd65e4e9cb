"""`handeye cache` shows what is kept for other runs and clears it; `--calibrate` does without it."""

import json
from collections.abc import Callable
from pathlib import Path

import pytest
from conftest import Command

from handeye.core.errors import CalibrationFailed
from handeye.core.packed import packed, sealed
from handeye.core.variation import WorldSpec
from handeye.ports.camera import Renderer
from handeye.systems.stanford import executor_run as programs
from handeye.systems.stanford.kept_calibrations import MAGIC, VERSION
from handeye.systems.stanford.preparation import Conditions
from handeye.tasks.water_pump.world.nominal import DRAWING
from handeye.vision.calibration import Calibration


@pytest.fixture
def folder(monkeypatch: pytest.MonkeyPatch, tmp_path: Path) -> Path:
    """Where calibrations are kept: two of them, as far as can be seen from outside."""
    monkeypatch.setenv("HANDEYE_CACHE", str(tmp_path / "cache"))
    folder = tmp_path / "cache" / "calibrations"
    folder.mkdir(parents=True)
    for seed in (4, 5):
        of = Conditions(
            task="water_pump", world=WorldSpec(seed=seed), camera=Renderer(method="rays"), driver="", feels=True,
            versions={}, code="", machine=(),
        )  # fmt: skip
        data = sealed(MAGIC, VERSION, of.line + b"\n" + packed(None))
        (folder / f"{seed}.calibration").write_bytes(data)
    return folder


def test_the_cache_tells_folder_number_size_and_worlds(command: Command, folder: Path) -> None:
    code, out, err = command("cache")
    assert (code, err) == (0, "")
    assert out.splitlines()[:2] == [str(folder), "2 calibrations, 1 kB of at most 16 MB"]
    assert {line.split("  ")[-1] for line in out.splitlines()[2:]} == {
        "water_pump, seed 4",
        "water_pump, seed 5",
    }


def test_programs_are_told_the_same(command: Command, folder: Path) -> None:
    told = json.loads(command("cache", "--json")[1])
    assert (told["folder"], told["removed"]) == (str(folder), 0)
    assert {entry["world"]["seed"] for entry in told["calibrations"]} == {4, 5}


def test_what_is_kept_can_be_cleared(command: Command, folder: Path) -> None:
    assert command("cache", "--clear")[:2] == (0, "2 calibrations removed\n")
    assert [*folder.iterdir()] == []


def test_without_a_folder_it_says_that_nothing_is_kept(
    command: Command, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setenv("HANDEYE_CACHE", "")
    assert command("cache")[1].startswith("no calibrations are kept: ")
    assert json.loads(command("cache", "--json")[1])["folder"] is None


@pytest.mark.slow
@pytest.mark.parametrize(
    "words", [("run", "job.plan.json"), ("do", "PARK", "--look")], ids=lambda words: words[0]
)
def test_a_command_calibrates_anew_where_it_is_told_to(
    command: Command,
    planned: Callable[[str], str],
    folder: Path,
    monkeypatch: pytest.MonkeyPatch,
    words: tuple[str, ...],
) -> None:
    def fails(*_: object) -> Calibration:
        raise CalibrationFailed("the lamp is not seen")

    planned("LOOK SETUP\n")
    known = Calibration(model=DRAWING, residual_px={}, residual_m=0.0)
    monkeypatch.setattr(programs, "calibrate_camera", lambda *_: known)
    assert command(*words, "--camera", "ray")[0] == 0
    monkeypatch.setattr(programs, "calibrate_camera", fails)
    assert command(*words, "--camera", "ray")[0] == 0
    assert command(*words, "--camera", "ray", "--calibrate")[0] != 0
