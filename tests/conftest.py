"""The command line as tests call it, and what property tests have in common."""

import gc
import io
import os
import sys
import time
from collections.abc import Callable, Generator
from functools import partial
from pathlib import Path
from tempfile import TemporaryDirectory

import pytest
from hypothesis import settings
from kept_measurements import keep_measurements
from kept_plans import keep_plans
from kept_scenes import keep_scenes

from benchmarks import __main__ as benchmarks
from handeye import cli
from handeye.core import host_time
from handeye.tasks.water_pump.task import WaterPump

# No claim here is about a clock, and what has passed once passes again.
settings.register_profile("handeye", deadline=None, derandomize=True)
# To look for what no one has thought of, where a property sets no number itself: --hypothesis-profile explore
settings.register_profile("explore", deadline=None, max_examples=2000)
settings.load_profile("handeye")

if "PYTEST_XDIST_WORKER" not in os.environ:  # else it is the folder of the process that started this one
    # a world is calibrated once a session; calibrations of the user's runs are not for tests, nor theirs for the user
    _CACHE = TemporaryDirectory(prefix="handeye-tests-")
    os.environ["HANDEYE_CACHE"] = _CACHE.name
    _PLANS = TemporaryDirectory(prefix="handeye-tests-")
    os.environ["HANDEYE_TESTS_PLANS"] = _PLANS.name
keep_plans(Path(os.environ["HANDEYE_TESTS_PLANS"]))
os.environ["HANDEYE_RUNS"] = ""  # no test leaves a run that it has not named
os.environ.pop("PYTHONDONTWRITEBYTECODE", None)  # hundreds of processes would each compile the package anew
sys.dont_write_bytecode = False  # nor would each session rewrite the assertions of all tests anew

Command = Callable[..., tuple[int, str, str]]


def pytest_addoption(parser: pytest.Parser) -> None:
    parser.addoption(
        "--update", action="store_true", help="Write into the manual what really happens (with -n 0)."
    )


@pytest.hookimpl(wrapper=True)
def pytest_collection() -> Generator[None, object, object]:
    """Tests and modules stay to the end: do not search them for garbage, neither now nor in every later pass."""
    gc.disable()
    try:
        return (yield)
    finally:
        gc.freeze()
        gc.enable()
        gc.set_threshold(7_000, 5, 3)  # old objects hold cells, and are searched about as often as by default
        keep_scenes()
        keep_measurements()


@pytest.fixture
def command(monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str], tmp_path: Path) -> Command:
    """Runs `handeye` in an empty folder, `typed` into it: exit code, standard output, standard error.

    A run kept in a folder is not photographed at its end: that takes longer than all else where software draws.
    """
    monkeypatch.chdir(tmp_path)
    monkeypatch.setattr(WaterPump, "photographs", ())
    app = cli.app

    def run(*words: str, typed: str = "") -> tuple[int, str, str]:
        monkeypatch.setattr(
            host_time, "_LOADED", (time.monotonic(), time.process_time())
        )  # as in a new process
        monkeypatch.setattr(cli, "app", partial(app, words))
        monkeypatch.setattr("sys.stdin", io.StringIO(typed))
        with pytest.raises(SystemExit) as end:
            cli.main()
        out, err = capsys.readouterr()
        assert "Traceback" not in out + err
        code = end.value.code
        assert isinstance(code, int)
        return code, out, err

    return run


@pytest.fixture
def benchmark(monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str], tmp_path: Path) -> Command:
    """Runs `python -m benchmarks` in an empty folder: exit code, standard output, standard error."""
    monkeypatch.chdir(tmp_path)

    def run(*words: str) -> tuple[int, str, str]:
        with pytest.raises(SystemExit) as end:
            benchmarks.main(words)
        out, err = capsys.readouterr()
        assert isinstance(end.value.code, int)
        return end.value.code, out, err

    return run


@pytest.fixture
def planned(command: Command) -> Callable[[str], str]:
    """The plan file of a script."""

    def plan(text: str) -> str:
        Path("job.al").write_text(text, encoding="utf-8")
        assert command("plan", "job.al")[0] == 0
        return "job.plan.json"

    return plan
