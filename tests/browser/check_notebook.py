"""A trace in a notebook: its frame shows the report and plays it, in a sandbox of its own.

Not collected with the tests, for it needs a Chromium: `python3 run.py test browser`.
"""

import json
from collections.abc import Iterator
from pathlib import Path

import pytest
from chromium import Browser, Page

from handeye.core import resources
from handeye.trace.reading import read_trace

TIME = "document.getElementById('view').player.time"


@pytest.fixture(scope="module")
def notebook(tmp_path_factory: pytest.TempPathFactory) -> Iterator[tuple[Page, Page]]:
    """A page into which the trace was put as a notebook puts it, and the frame in it."""
    folder = tmp_path_factory.mktemp("notebook")
    shown = json.dumps(read_trace(resources.demo() / "trace.mcap")._repr_html_()).replace("</", "<\\/")
    file = folder / "notebook.html"
    file.write_text(
        "<!DOCTYPE html><meta charset=utf-8><h1>A notebook</h1><div id=out></div>"
        f"<script>document.getElementById('out').innerHTML = {shown}</script>"
    )
    with Browser.started(folder / "profile") as browser:
        page = browser.page(file, width=1000, height=800)
        page.ask("Target.setAutoAttach", autoAttach=True, waitForDebuggerOnStart=False, flatten=True)
        frame = Page(browser.pipe, attached(page))
        for domain in ("Runtime", "Log"):
            frame.ask(f"{domain}.enable")
        frame.wait("Boolean(document.getElementById('view')?.player)")
        yield page, frame


def attached(page: Page) -> str:
    """The session of the frame in a page: what a sandbox keeps apart is a target of its own."""
    page.wait("document.querySelector('iframe') !== null")
    frames = [
        told["params"]["sessionId"]
        for told in page.pipe.heard
        if told["method"] == "Target.attachedToTarget" and told["params"]["targetInfo"]["type"] == "iframe"
    ]
    assert len(frames) == 1
    return str(frames[0])


def test_the_frame_plays_the_run(notebook: tuple[Page, Page], tmp_path: Path) -> None:
    page, frame = notebook
    frame.evaluate("document.getElementById('time').value = 0")
    frame.evaluate("document.getElementById('time').dispatchEvent(new Event('input'))")
    assert frame.evaluate(TIME) == 0
    frame.evaluate("document.getElementById('play').click()")
    frame.wait(f"{TIME} > 2")
    frame.evaluate("document.getElementById('play').click()")
    frame.evaluate("document.getElementById('run').scrollIntoView()")
    frame.evaluate("document.getElementById('view').player.settled()")
    (tmp_path / "notebook.png").write_bytes(page.screenshot())
    assert page.errors == frame.errors == []


def test_the_frame_reaches_nothing_of_the_notebook(notebook: tuple[Page, Page]) -> None:
    page, frame = notebook
    tried = "(() => { try { return parent.document.title } catch (error) { return error.name } })()"
    assert frame.evaluate(tried) == "SecurityError"
    assert frame.evaluate("origin") == "null"
    assert page.evaluate("document.querySelector('iframe').getAttribute('sandbox')") == "allow-scripts"
    assert page.requests == [page.evaluate("location.href")]
