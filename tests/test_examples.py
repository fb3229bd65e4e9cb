"""Every example does what it says, with nothing but what it comes with."""

import os
import runpy
import subprocess
import sys
from pathlib import Path

import pytest

pytestmark = pytest.mark.slow

ROOT = Path(__file__).parent.parent
EXAMPLES = sorted((ROOT / "examples").glob("*.py"))
LONGEST = 50
"""Lines of an example."""
LEAVES = {"force_against_time.py": "force.svg"}
"""A file that an example leaves."""
SAYS = {
    "guess_and_check.py": "left solution.al with a search of 2 rings",
    "insert_a_pin.py": "right after ",
    "missing_pin.py": "by a person: at 0.0 s position PIN was set by the experimenter",
    "referee_limit.py": "wrong: greatest tilt of a pin in its holder (at most 0.2 deg)",
    "replay_a_moment.py": "line 7: CHANGE  [0 0 -1] 1 .2",
    "search_pattern.py": "row      5 places",
    "seventh_screw.py": "new: S7",
}
"""What an example prints."""


@pytest.mark.parametrize("example", EXAMPLES, ids=lambda path: path.stem)
def test_it_runs_and_leaves_what_it_says(
    tmp_path: Path, example: Path, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    monkeypatch.chdir(tmp_path)
    monkeypatch.setattr(sys, "argv", [str(example)])
    runpy.run_path(str(example), run_name="__main__")
    out, err = capsys.readouterr()
    assert err == ""
    assert SAYS.get(example.name, "") in out
    assert (tmp_path / LEAVES.get(example.name, "")).exists()


def test_one_runs_in_a_process_of_its_own(tmp_path: Path) -> None:
    """The others would too: none needs a module that it does not import."""
    done = subprocess.run(
        [sys.executable, str(ROOT / "examples" / "missing_pin.py")],
        cwd=tmp_path,
        env={**os.environ, "PYTHONPATH": str(ROOT)},
        capture_output=True,
        text=True,
        check=False,
    )
    assert (done.returncode, done.stderr) == (0, "")
    assert SAYS["missing_pin.py"] in done.stdout


@pytest.mark.parametrize("example", EXAMPLES, ids=lambda path: path.stem)
def test_it_is_short(example: Path) -> None:
    assert len(example.read_text(encoding="utf-8").splitlines()) < LONGEST
