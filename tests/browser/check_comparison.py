"""The page of two runs in a browser: it fits, fetches nothing, and shows both where they stood.

Not collected with the tests, for it needs a Chromium: `python3 run.py test browser`.
"""

from collections.abc import Iterator
from pathlib import Path

import numpy as np
import pytest
from chromium import Browser, Page
from short_runs import GRASP, begin, through

from handeye.comparison.comparison import comparison
from handeye.comparison.page import comparison_page
from handeye.comparison.pairing import Course, TwoRuns, course
from handeye.report.animation import animation
from handeye.report.recorded import RecordedRun
from handeye.runs.folder import TRACE, open_new
from handeye.runs.runner import Runner
from handeye.trace.reading import read_trace

PLACE = 3e-4
"""How far a body may be from where it was, m."""


def kept(script: str, seed: int, folder: Path) -> RecordedRun:
    """A run in which the arm takes a pin out of its holder."""
    start = begin(script, seed)
    keeping = open_new(folder, start)
    runner = Runner(start, observers=lambda runner: [keeping.watch(runner, start, again=False)])
    through(runner).finish()
    keeping.close()
    return RecordedRun(trace=read_trace(folder / TRACE))


@pytest.fixture(scope="module")
def runs(tmp_path_factory: pytest.TempPathFactory) -> TwoRuns:
    """The same pin, taken with and without feeling for it first, in different worlds."""
    folder = tmp_path_factory.mktemp("runs")
    blind = GRASP.replace("        CENTER  .1\n", "")
    return TwoRuns(kept(GRASP, 0, folder / "a"), kept(blind, 1, folder / "b"))


@pytest.fixture(scope="module")
def way(runs: TwoRuns) -> Course:
    return course(runs)


@pytest.fixture(scope="module")
def file(runs: TwoRuns, tmp_path_factory: pytest.TempPathFactory) -> Path:
    shown = animation(runs.a), animation(runs.b)
    path = tmp_path_factory.mktemp("page") / "page.html"
    path.write_bytes(comparison_page(runs.a, runs.b, comparison(runs.a, runs.b), shown))
    return path


@pytest.fixture(scope="module")
def browser(tmp_path_factory: pytest.TempPathFactory) -> Iterator[Browser]:
    with Browser.started(tmp_path_factory.mktemp("profile")) as browser:
        yield browser


def opened(browser: Browser, file: Path, width: int = 1360) -> Page:
    page = browser.page(file, width=width, height=860)
    page.wait("document.querySelector('#run.drawn') !== null")
    return page


@pytest.fixture(scope="module")
def page(browser: Browser, file: Path) -> Page:
    return opened(browser, file)


def sought(page: Page, seconds: float) -> None:
    """Go to a time of the course by the address."""
    page.evaluate(f"location.hash = '#t={seconds:.4f}'")
    page.wait(f"Math.abs(Number(document.getElementById('time').value) - {seconds:.4f}) < .02")


def stands(way: Course, time: float) -> tuple[float, float]:
    """Where both runs stand at a time of the course."""
    begins = [*(leg.begin for leg in way.legs), way.end]
    a, b = ([*(getattr(leg, side) for leg in way.legs), getattr(way, side)] for side in "ab")
    return float(np.interp(time, begins, a)), float(np.interp(time, begins, b))


@pytest.mark.parametrize("width", [1360, 390])
def test_it_fits_the_window_and_asks_for_nothing(browser: Browser, file: Path, width: int) -> None:
    page = opened(browser, file, width)
    assert page.evaluate("document.documentElement.scrollWidth") <= width
    assert (page.errors, page.requests) == ([], [file.as_uri()])
    assert file.stat().st_size < 6e6


def test_both_views_show_where_their_runs_stood(runs: TwoRuns, way: Course, page: Page) -> None:
    for time in np.linspace(0.1, way.end - 0.1, 12):
        sought(page, time)
        for side, run, seconds in zip("ab", (runs.a, runs.b), stands(way, float(f"{time:.4f}")), strict=True):
            assert page.evaluate(f"document.getElementById('view-{side}').player.time") == pytest.approx(
                seconds, abs=0.02
            )
            told = page.evaluate(
                f"(p => p.pose('stanford/finger_a', p.time))(document.getElementById('view-{side}').player)"
            )
            true = run.trace.at(seconds).poses["stanford/finger_a"]
            assert np.linalg.norm(np.subtract(told[:3], true[:3])) < 0.01


def test_a_step_that_one_run_did_alone_finds_the_other_waiting(way: Course, page: Page) -> None:
    alone = next(leg for leg in way.legs if leg.places[1] is None and leg.places[0] is not None)
    sought(page, alone.begin + 0.1)
    lines = page.evaluate("['line-a', 'line-b'].map(name => document.getElementById(name).textContent)")
    assert lines == ["take the pin, line 6: CENTER .1", "waits"]


def test_a_link_leads_to_its_step(way: Course, page: Page) -> None:
    sought(page, 0.0)
    page.evaluate("document.querySelector('#felt a').click()")
    page.wait("Number(document.getElementById('time').value) > 1")
    assert "CHANGE" in page.evaluate("document.getElementById('line-a').textContent")


def test_keys_go_from_step_to_step_and_play(way: Course, page: Page) -> None:
    sought(page, 0.0)
    page.key("ArrowRight")
    ahead = next(leg.begin for leg in way.legs if leg.begin > 0)
    assert float(page.evaluate("document.getElementById('time').value")) == pytest.approx(ahead, abs=0.02)
    page.key(" ")
    assert page.evaluate("document.getElementById('play').textContent") == "Pause"
    page.key(" ")
    assert page.evaluate("document.getElementById('play').textContent") == "Play"
