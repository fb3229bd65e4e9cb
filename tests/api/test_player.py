"""A trace in a notebook is its report, in a frame out of which nothing comes."""

import re
from base64 import b64decode

import pytest
from recordings import record
from report_pages import Node, renamed, tree

from handeye.api.trace import Trace
from handeye.core.errors import InvalidInput
from handeye.report import animation
from handeye.report import recorded as scene
from handeye.report.recorded import RecordedRun
from handeye.trace.reading import read_trace_as

EVIL = "</iframe><script>alert(1)</script>"


@pytest.fixture(scope="module")
def trace(tmp_path_factory: pytest.TempPathFactory) -> Trace:
    path = tmp_path_factory.mktemp("run") / "trace.mcap"
    record(path)
    return read_trace_as(Trace, path)


@pytest.fixture(autouse=True)
def made_up_scene(monkeypatch: pytest.MonkeyPatch) -> None:
    """The run is made up, and its scene with it."""
    monkeypatch.setattr(scene, "check_scene", lambda _: None)
    monkeypatch.setattr(animation, "scene_bytes", lambda _: b"scene")


def framed(page: str) -> tuple[dict[str, str | None], Node]:
    """The attributes of the frame on a page, and the page in it."""
    (frame,) = tree(page).all("iframe")
    data = (frame.attributes["src"] or "").removeprefix("data:text/html;base64,")
    return frame.attributes, tree(b64decode(data).decode())


def test_its_scripts_run_and_reach_nothing_of_the_notebook(trace: Trace) -> None:
    attributes, _ = framed(trace._repr_html_())
    assert attributes["sandbox"] == "allow-scripts"


def test_the_report_is_in_the_frame_and_asks_for_no_photographs(trace: Trace) -> None:
    _, inside = framed(trace._repr_html_())
    assert inside.one("script").text.count("OPEN 1") == 1
    assert "trace.frame(time) takes a photograph" in inside.text


def test_it_says_what_it_weighs(trace: Trace) -> None:
    assert re.search(r"The report of short, seed 7: 0\.\d MB in this notebook\.", trace._repr_html_())


def test_words_of_the_run_are_data(trace: Trace) -> None:
    page = renamed(RecordedRun(trace=trace), program=EVIL).trace._repr_html_()
    assert "<script" not in page
    assert page.count("<iframe") == page.count("</iframe>") == 1


def test_a_trace_that_cannot_be_shown_says_why(trace: Trace, monkeypatch: pytest.MonkeyPatch) -> None:
    def refuse(_: RecordedRun) -> None:
        raise InvalidInput("recorded by <an older> handeye")

    monkeypatch.setattr(scene, "check_scene", refuse)
    page = trace._repr_html_()
    assert "recorded by &lt;an older&gt; handeye" in page
    assert "<iframe" not in page
