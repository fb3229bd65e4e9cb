"""The report of a run in a browser: it fits, fetches nothing, answers keys and addresses, and tells the truth.

Not collected with the tests, for it needs a Chromium: `python3 run.py test browser`. `HANDEYE_CHECK_TRACE` names a
trace to look at instead of that of a short run.
"""

import os
from collections.abc import Iterator
from pathlib import Path

import numpy as np
import pytest
from chromium import Browser, Page
from report_pages import renamed
from short_runs import begin, through

from handeye.runs.folder import TRACE, open_new
from handeye.runs.runner import Runner
from handeye.see.animation import animation
from handeye.see.page.document import report_page
from handeye.see.photographs import album
from handeye.see.player import shown_poses
from handeye.see.recorded import Recorded
from handeye.trace.reading import read_trace

EVIL = "</script><img src=x onerror=alert(1)>"
PLACE, TURN = 3e-4, np.radians(0.3)
"""How far a body may be from where it was: m, rad."""
LIT = "document.querySelector('#script .on')?.id"


@pytest.fixture(scope="module")
def run(tmp_path_factory: pytest.TempPathFactory) -> Recorded:
    """A run in which the arm takes a pin out of its holder."""
    told = os.environ.get("HANDEYE_CHECK_TRACE")
    if told is not None:
        return Recorded(trace=read_trace(Path(told)))
    start, path = begin(), tmp_path_factory.mktemp("short") / "run"
    folder = open_new(path, start)
    runner = Runner(start, observers=lambda runner: [folder.watch(runner, start, again=False)])
    through(runner).finish()
    folder.close()
    return Recorded(trace=read_trace(path / TRACE))


def written(run: Recorded, folder: Path) -> Path:
    """The file of its report."""
    (folder / "report.html").write_bytes(report_page(run, album(run), animation(run)))
    return folder / "report.html"


@pytest.fixture(scope="module")
def file(run: Recorded, tmp_path_factory: pytest.TempPathFactory) -> Path:
    return written(run, tmp_path_factory.mktemp("report"))


@pytest.fixture(scope="module")
def browser(tmp_path_factory: pytest.TempPathFactory) -> Iterator[Browser]:
    with Browser.started(tmp_path_factory.mktemp("profile")) as browser:
        yield browser


@pytest.fixture(scope="module")
def page(browser: Browser, file: Path) -> Page:
    return opened(browser, file)


def opened(browser: Browser, file: Path, width: int = 1360) -> Page:
    """A report, with its view drawn."""
    page = browser.page(file, width=width, height=860)
    page.wait("document.querySelector('#run.drawn') !== null")
    return page


def sought(page: Page, seconds: float) -> None:
    """Go to a moment by the address."""
    page.evaluate(f"location.hash = '#t={seconds:.4f}'")
    page.wait(f"Math.abs(Number(document.getElementById('time').value) - {seconds:.4f}) < .02")


@pytest.mark.parametrize("width", [1360, 390])
@pytest.mark.parametrize("scheme", ["light", "dark"])
def test_it_fits_the_window_and_asks_for_nothing(
    browser: Browser, file: Path, width: int, scheme: str
) -> None:
    page = opened(browser, file, width)
    page.ask("Emulation.setEmulatedMedia", features=[{"name": "prefers-color-scheme", "value": scheme}])
    assert page.evaluate("document.documentElement.scrollWidth") <= width
    assert (page.errors, page.requests) == ([], [file.as_uri()])


def test_the_line_that_is_lit_is_the_one_under_way(run: Recorded, page: Page) -> None:
    begin, end = run.trace.covers
    for clock in np.linspace(begin + 0.1, end - 0.1, 20):
        sought(page, run.seconds(clock))
        step = run.trace.at(run.trace.head.time + float(f"{run.seconds(clock):.4f}")).step
        assert page.evaluate(LIT) == (None if step is None else f"line-0-{step.line}")


def test_every_body_is_where_it_was(run: Recorded, page: Page) -> None:
    rows, shown = np.linspace(0, len(run.trace.times) - 1, 20).astype(int), shown_poses(run.trace)
    for row in rows:
        seconds = run.seconds(run.trace.times[row])
        told = page.evaluate(
            f"(p => Object.fromEntries(p.names.map(n => [n, p.pose(n, {seconds})])))(view.player)"
        )
        for name, pose in told.items():
            true = shown[name][row]
            if true[2] > -1.0:
                chord = min(np.linalg.norm(pose[3:] - sign * true[3:]) for sign in (1, -1))
                assert np.linalg.norm(pose[:3] - true[:3]) < PLACE, (name, row)
                assert 4 * np.arcsin(chord / 2) < TURN, (name, row)
            else:
                assert pose is None, (name, row)


def test_keys_play_and_go_by_steps_and_stages(run: Recorded, page: Page) -> None:
    second = run.seconds(run.trace.stages[1].begin)
    sought(page, run.begins)
    page.key("ArrowRight", shift=True)
    assert float(page.evaluate("document.getElementById('time').value")) == pytest.approx(second, abs=0.01)
    lit = page.evaluate(LIT)
    page.key("ArrowRight")
    assert page.evaluate(LIT) != lit
    page.key(" ")
    assert page.evaluate("play.textContent") == "Pause"
    page.key(" ")
    assert page.evaluate("play.textContent") == "Play"


def test_keys_choose_views(page: Page) -> None:
    page.key("3")
    assert page.evaluate("document.querySelector('#views [aria-pressed=true]').textContent") == "pump"


def test_a_figure_leads_to_its_moment(page: Page) -> None:
    page.evaluate("document.querySelector('#felt a').click()")
    told = float(page.evaluate("document.querySelector('#felt a').hash.slice(3)"))
    page.wait(f"Math.abs(Number(document.getElementById('time').value) - {told}) < .02")


def test_whatever_a_stage_is_called_nothing_runs(run: Recorded, browser: Browser, tmp_path: Path) -> None:
    page = opened(browser, written(renamed(run, stage=EVIL), tmp_path))
    page.evaluate("location.hash = '#t=1'")
    assert page.evaluate("document.querySelectorAll('img[src=x]').length") == 0
    assert page.evaluate("document.getElementById('caption').textContent").startswith(EVIL)
    assert page.errors == []


def test_without_webgl_it_says_so_and_shows_photographs(file: Path, tmp_path: Path) -> None:
    with Browser.started(tmp_path, "--disable-3d-apis") as browser:
        page = browser.page(file, width=1360, height=860)
        told = page.wait("document.getElementById('instead')?.textContent")
        assert told == "This browser offers no WebGL 2. Photographs stand in the place of the view."
        assert page.evaluate("document.querySelectorAll('#strip figure.on').length") == 1


def test_without_scripts_everything_but_the_view_is_there(
    browser: Browser, file: Path, run: Recorded
) -> None:
    page = browser.page(Path("/dev/null"))
    page.ask("Emulation.setScriptExecutionDisabled", value=True)
    page.ask("Page.navigate", url=file.as_uri())
    page.wait("document.querySelectorAll('#record').length")
    assert page.evaluate("document.getElementById('controls').hidden")
    assert page.evaluate("document.querySelectorAll('#strip img').length") == len(run.trace.stages)
