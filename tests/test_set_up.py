"""`run.py` makes the environment, notices when it is out of date, and mends one that was left half made."""

import sys
import time
from importlib.util import find_spec, module_from_spec, spec_from_file_location
from pathlib import Path
from types import ModuleType
from typing import Any

import pytest

ROOT = Path(__file__).parent.parent
PIECES = ("run.py", "pyproject.toml", "requirements.lock", "requirements-dev.lock", "requirements-docs.lock")


def module_of(checkout: Path) -> ModuleType:
    """The `run.py` of a checkout."""
    spec = spec_from_file_location("start", checkout / "run.py")
    assert spec is not None
    assert spec.loader is not None
    module = module_from_spec(spec)
    spec.loader.exec_module(module)
    return module


class Pip:
    """Notes what it is asked to install, and fails where told to."""

    def __init__(self) -> None:
        self.asked: list[str] = []
        self.fails_at: str | None = None

    def __call__(self, environment: object, *words: str, line: object) -> tuple[int, str]:
        self.asked.append(Path(words[-1]).name)
        failed = self.asked[-1] == self.fails_at
        return int(failed), "there is no network" if failed else "Collecting everything"


@pytest.fixture
def pip() -> Pip:
    return Pip()


@pytest.fixture
def start(tmp_path: Path, monkeypatch: pytest.MonkeyPatch, pip: Pip) -> ModuleType:
    """`run.py` of a checkout of its own, where an environment is a file and pip is ours."""
    for name in PIECES:
        (tmp_path / name).write_bytes((ROOT / name).read_bytes())
    module = module_of(tmp_path)

    def make(environment: Any) -> None:
        environment.python.parent.mkdir()
        environment.python.touch()

    monkeypatch.setattr(module, "pip", pip)
    monkeypatch.setattr(module, "make", make)
    monkeypatch.setattr(module, "run", lambda *command: 0)
    return module


def test_the_first_start_installs_the_lock_and_the_checkout_and_the_second_nothing(
    start: ModuleType, pip: Pip, capfd: pytest.CaptureFixture[str]
) -> None:
    assert start.main(["check"]) == 0
    assert pip.asked == ["requirements.lock", start.ROOT.name]
    assert start.main(["check"]) == 0
    assert len(pip.asked) == 2
    assert capfd.readouterr().out == ""


@pytest.mark.parametrize("piece", ["requirements.lock", "pyproject.toml"])
def test_a_change_of_what_was_installed_is_installed(start: ModuleType, pip: Pip, piece: str) -> None:
    start.main(["check"])
    with (start.ROOT / piece).open("a") as file:
        file.write("# another\n")
    start.main(["check"])
    assert pip.asked[2:] == pip.asked[:2]


def test_an_environment_for_the_tests_serves_the_program_too(start: ModuleType, pip: Pip) -> None:
    start.main(["test"])
    start.main(["check"])
    assert pip.asked == ["requirements-dev.lock", start.ROOT.name]


def test_the_tests_install_what_the_program_does_without(start: ModuleType, pip: Pip) -> None:
    start.main(["check"])
    start.main(["test"])
    assert pip.asked[2:] == ["requirements-dev.lock", start.ROOT.name]


def test_the_site_has_an_environment_of_its_own(
    start: ModuleType, pip: Pip, monkeypatch: pytest.MonkeyPatch
) -> None:
    ran: list[tuple[object, ...]] = []
    monkeypatch.setattr(start, "run", lambda *command: ran.append(command) or 0)
    assert start.main(["docs"]) == 0
    assert pip.asked == ["requirements-docs.lock", start.ROOT.name]
    assert ran == [([str(start.ROOT / "docs" / "make_site.py")], start.SITE_VENV)]
    assert not start.VENV.folder.exists()


def test_with_a_topic_docs_prints_the_page_of_the_topic(
    start: ModuleType, pip: Pip, monkeypatch: pytest.MonkeyPatch
) -> None:
    ran: list[list[str]] = []
    monkeypatch.setattr(start, "run", lambda command: ran.append(command) or 0)
    assert start.main(["docs", "faults"]) == 0
    assert (pip.asked[0], ran) == ("requirements.lock", [["-m", "handeye", "docs", "faults"]])


def test_an_environment_that_was_left_half_made_is_made_anew(
    start: ModuleType, pip: Pip, capfd: pytest.CaptureFixture[str]
) -> None:
    pip.fails_at = "requirements.lock"
    assert start.main(["check"]) == 2
    said = capfd.readouterr().err
    assert "could not install the packages that requirements.lock lists" in said
    assert said.endswith("pip said:\nthere is no network\n")
    (start.VENV.folder / "half").touch()
    pip.fails_at = None
    assert start.main(["check"]) == 0
    assert not (start.VENV.folder / "half").exists()


def test_an_environment_that_somebody_made_is_kept(start: ModuleType, pip: Pip) -> None:
    start.VENV.folder.mkdir()
    start.make(start.VENV)
    (start.VENV.folder / "theirs").touch()
    assert start.main(["check"]) == 0
    assert (start.VENV.folder / "theirs").exists()


def test_an_interruption_says_what_comes_next(
    start: ModuleType, monkeypatch: pytest.MonkeyPatch, capfd: pytest.CaptureFixture[str]
) -> None:
    def interrupted(*words: str, line: object) -> int:
        raise KeyboardInterrupt

    monkeypatch.setattr(start, "pip", interrupted)
    assert start.main(["check"]) == 130
    assert capfd.readouterr().err.endswith(
        "Setting up was interrupted; run the command again to complete it.\n"
    )


def test_the_checks_in_a_browser_say_what_they_need(
    start: ModuleType, monkeypatch: pytest.MonkeyPatch, capfd: pytest.CaptureFixture[str]
) -> None:
    monkeypatch.setenv(start.BROWSER, "nowhere/chromium")
    assert start.main(["test", "browser"]) == 2
    assert "HANDEYE_CHROMIUM names nowhere/chromium, which is not a program" in capfd.readouterr().err


def test_the_checks_in_a_browser_are_found_and_told_where_it_is(
    start: ModuleType, monkeypatch: pytest.MonkeyPatch
) -> None:
    carried_out: list[list[str]] = []
    monkeypatch.setattr(start, "run", lambda command: carried_out.append(command) or 0)
    monkeypatch.setenv(start.BROWSER, sys.executable)
    (start.ROOT / "tests" / "browser").mkdir(parents=True)
    (start.ROOT / "tests" / "browser" / "check_pages.py").touch()
    assert start.main(["test", "browser", "-x"]) == 0
    assert carried_out == [["-m", "pytest", str(start.ROOT / "tests" / "browser" / "check_pages.py"), "-x"]]


def test_a_set_up_that_goes_well_says_two_lines(start: ModuleType, capfd: pytest.CaptureFixture[str]) -> None:
    start.main(["check"])
    first, second = capfd.readouterr().err.splitlines()
    packages = (ROOT / "requirements.lock").read_text().count("==")
    assert first == f"Setting up .venv: {packages} packages. This happens once."
    assert second.startswith("Set up .venv in ")


@pytest.mark.slow
def test_on_a_terminal_it_is_one_line_that_changes(
    start: ModuleType, monkeypatch: pytest.MonkeyPatch, capfd: pytest.CaptureFixture[str]
) -> None:
    monkeypatch.setattr("sys.stderr.isatty", lambda: True)
    with start.ProgressLine(".venv", 2) as line:
        line.heard("Collecting numpy==2.4\n")
        line.heard("  Downloading numpy-2.4.whl\n")
        time.sleep(0.3)
    said = capfd.readouterr().err
    assert said.count("\n") == 1
    assert "\rSetting up .venv (once): 1 of 2 packages fetched, 0 s" in said
    assert max(map(len, said.split("\r"))) < 80


@pytest.mark.slow
@pytest.mark.skipif(find_spec("pip") is None, reason="this environment was made without pip")
def test_pip_speaks_only_if_it_fails(start: ModuleType, capfd: pytest.CaptureFixture[str]) -> None:
    start = module_of(ROOT)
    code, said = start.pip(start.VENV, "--version", line=start.ProgressLine(".venv", 0))
    assert (code, said[:4]) == (0, "pip ")
    assert capfd.readouterr() == ("", "")
