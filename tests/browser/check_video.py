"""The video of a run in a browser: it plays, as long and as large as it was to be.

Not collected with the tests, for it needs a Chromium and OpenGL: `python3 run.py test browser`. `HANDEYE_CHECK_TRACE`
names a trace to film instead of that of a short run.
"""

import os
from collections.abc import Iterator
from pathlib import Path

import pytest
from chromium import Browser, Page
from short_runs import begin, through

import handeye
from handeye.runs.folder import TRACE, open_new
from handeye.runs.runner import Runner
from handeye.trace.reading import read_trace
from handeye.trace.trace import Trace

HAVE_ENOUGH_DATA = 4
SECONDS = 3.0


@pytest.fixture(scope="module")
def trace(tmp_path_factory: pytest.TempPathFactory) -> Trace:
    """A run in which the arm takes a pin out of its holder."""
    told = os.environ.get("HANDEYE_CHECK_TRACE")
    if told is not None:
        return handeye.open(told)
    start, path = begin(), tmp_path_factory.mktemp("short") / "run"
    folder = open_new(path, start)
    runner = Runner(start, observers=lambda runner: [folder.watch(runner, start, again=False)])
    through(runner).finish()
    folder.close()
    return read_trace(path / TRACE)


@pytest.fixture(scope="module")
def browser(tmp_path_factory: pytest.TempPathFactory) -> Iterator[Browser]:
    with Browser.started(
        tmp_path_factory.mktemp("profile"), "--autoplay-policy=no-user-gesture-required"
    ) as browser:
        yield browser


def opened(browser: Browser, folder: Path, element: str) -> Page:
    """A page with nothing but a video or picture, which has the name `it`."""
    (folder / "page.html").write_text(f"<!DOCTYPE html><title>it</title>{element}", encoding="utf-8")
    return browser.page(folder / "page.html")


def test_a_webm_plays_to_its_end(trace: Trace, browser: Browser, tmp_path: Path) -> None:
    made = trace.video(tmp_path / "it.webm", width=160, height=120, seconds=SECONDS, captions=True)
    page = opened(browser, tmp_path, "<video id=it src=it.webm muted></video>")
    page.wait(f"it.readyState === {HAVE_ENOUGH_DATA}")
    assert page.evaluate("it.duration") == pytest.approx(SECONDS, rel=0.02)
    assert made.seconds == pytest.approx(SECONDS, rel=0.02)
    assert page.evaluate("[it.videoWidth, it.videoHeight]") == [160, 120]
    page.evaluate("it.play()")
    page.wait("it.ended")
    assert page.evaluate("it.error") is None
    assert page.errors == []


def test_a_webp_moves(trace: Trace, browser: Browser, tmp_path: Path) -> None:
    trace.video(tmp_path / "it.webp", width=160, height=120, seconds=SECONDS, captions=True)
    page = opened(browser, tmp_path, "<img id=it src=it.webp>")
    page.wait("it.complete && it.naturalWidth === 160")
    seen = {page.screenshot() for _ in range(20) if page.evaluate("new Promise(d => setTimeout(d, 150, 1))")}
    assert len(seen) > 5
