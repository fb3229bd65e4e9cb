"""`handeye demo`: the first command to try."""

import sys
import webbrowser
from pathlib import Path

import pytest
from conftest import Command

from handeye.cli import reports
from handeye.cli.demo import opened
from handeye.core import resources


@pytest.fixture(autouse=True)
def page(monkeypatch: pytest.MonkeyPatch) -> None:
    """A short page in the place of the report, which takes seconds, and no browser."""
    from handeye.report.page.document import MARK

    monkeypatch.setattr(reports, "page_of", lambda run: MARK.encode() + str(run).encode())
    for name in ("BROWSER", "DISPLAY", "WAYLAND_DISPLAY"):
        monkeypatch.delenv(name, raising=False)


def test_it_writes_the_recorded_report_and_prints_its_path(command: Command) -> None:
    code, out, err = command("demo")
    assert (code, out) == (0, "demo.html\n")
    assert Path("demo.html").read_bytes().endswith(str(resources.demo()).encode())
    assert err.splitlines()[1] == "Open demo.html in a browser."


@pytest.mark.parametrize("name", ["chess", "follow"])
def test_another_recorded_run_is_shown_by_its_name(command: Command, name: str) -> None:
    assert command("demo", name)[:2] == (0, "demo.html\n")
    assert Path("demo.html").read_bytes().endswith(str(resources.demo() / name).encode())


def test_a_name_that_is_unknown_is_refused_and_the_nearest_is_named(command: Command) -> None:
    code, _, err = command("demo", "ches")
    assert (code, err) == (2, "handeye: there is no recorded run `ches`; did you mean `chess`?\n")


def test_it_can_be_repeated_and_replaces_nothing_else(command: Command) -> None:
    assert command("demo")[0] == command("demo")[0] == 0
    mine = Path("demo.html")
    mine.write_bytes(mine.read_bytes() + b"of another run")
    code, out, err = command("demo")
    assert (code, out) == (2, "")
    assert err.splitlines()[-1] == "handeye: demo.html already exists; --overwrite replaces it"
    assert command("demo", "--overwrite")[0] == 0
    assert not mine.read_bytes().endswith(b"of another run")


def test_without_a_display_it_opens_no_browser(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(sys, "platform", "linux")
    monkeypatch.setattr(webbrowser, "get", lambda: pytest.fail("a browser was looked for"))
    assert opened(Path("demo.html")) is False


def test_it_opens_no_browser_that_takes_over_the_terminal(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setenv("DISPLAY", ":0")
    monkeypatch.setattr(webbrowser, "get", lambda: webbrowser.GenericBrowser("w3m"))
    assert opened(Path("demo.html")) is False


def test_it_opens_the_page_where_there_is_a_browser(monkeypatch: pytest.MonkeyPatch) -> None:
    seen: list[str] = []

    class Graphical(webbrowser.BackgroundBrowser):
        def open(self, url: str, new: int = 0, autoraise: bool = True) -> bool:
            seen.append(url)
            return True

    monkeypatch.setenv("DISPLAY", ":0")
    monkeypatch.setattr(webbrowser, "get", lambda: Graphical("firefox"))
    assert opened(Path("demo.html")) is True
    assert seen == [Path("demo.html").resolve().as_uri()]


def test_where_no_browser_is_found_the_path_is_enough(monkeypatch: pytest.MonkeyPatch) -> None:
    def none() -> webbrowser.BaseBrowser:
        raise webbrowser.Error("could not locate runnable browser")

    monkeypatch.setenv("DISPLAY", ":0")
    monkeypatch.setattr(webbrowser, "get", none)
    assert opened(Path("demo.html")) is False
