"""The check beside the libraries that learners bring: its Python runs here as far as those libraries are installed."""

import runpy
import tomllib
from pathlib import Path

import pytest

ROOT = Path(__file__).parent.parent
CHECK = ".ci/neighbours.py"


def test_the_types_of_the_check_are_checked() -> None:
    settings = tomllib.loads((ROOT / "pyproject.toml").read_text(encoding="utf-8"))["tool"]["mypy"]
    assert CHECK in settings["files"]  # so that a function cannot be renamed without it
    assert Path(CHECK).name in (ROOT / ".ci/neighbours").read_text(encoding="utf-8")


@pytest.mark.slow
def test_the_check_finds_what_it_imports_and_its_episode_is_right() -> None:
    runpy.run_path(str(ROOT / CHECK))["play_an_episode"]()
