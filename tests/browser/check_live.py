"""The live cell in a browser: run, pause, step, back, break, panic, an operator called, a second page, a reload; an arm
that is jogged and positions that are recorded; a run that was carried out.

Not collected with the tests, for it needs a Chromium: `python3 run.py test browser`. What is pressed is found by its
name, as people find it.
"""

import re
import subprocess
import sys
from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path

import pytest
from chromium import Browser, Page

from handeye.core import resources

CALLS = """\
        STAGE   "shut the hand"
        OPEN    1
        CLOSE   .5
        STAGE   "open it"
        OPEN    2
"""
"""Calls the operator on line 3: nothing is between the fingers."""
TOLD = "document.getElementById('told').textContent"
HERE = "document.querySelector('#script li.on')?.id"


@contextmanager
def served(folder: Path, *words: str) -> Iterator[str]:
    """The address of a live cell."""
    with (folder / "told").open("w+") as told:
        line = [sys.executable, "-m", "handeye", "view", *words]
        with subprocess.Popen(line, stdout=subprocess.PIPE, stderr=told, text=True) as process:
            try:
                assert process.stdout is not None
                yield process.stdout.readline().strip()
            finally:
                process.terminate()


@pytest.fixture(scope="module")
def browser(tmp_path_factory: pytest.TempPathFactory) -> Iterator[Browser]:
    with Browser.started(tmp_path_factory.mktemp("profile")) as browser:
        yield browser


LIVE = "document.getElementById('view')?.player && document.getElementById('looking').textContent"


def opened(browser: Browser, address: str, ready: str = LIVE) -> Page:
    """A page, drawn and, of the live cell, connected."""
    target = browser.pipe.ask("Target.createTarget", url="about:blank")["targetId"]
    session = browser.pipe.ask("Target.attachToTarget", targetId=target, flatten=True)["sessionId"]
    page = Page(browser.pipe, session)
    for domain in ("Page", "Runtime", "Log", "Network"):
        page.ask(f"{domain}.enable")
    page.resize(1280, 900)
    page.ask("Page.navigate", url=address)
    page.wait(f"Boolean({ready})")
    return page


def press(page: Page, name: str) -> None:
    """Press the button of a name that can be seen."""
    page.evaluate(
        "[...document.querySelectorAll('button')].find(button => (button.ariaLabel ?? button.textContent) === "
        f"'{name}' && button.checkVisibility() && !button.disabled).click()"
    )


def type_in(page: Page, line: str) -> None:
    page.evaluate(f"document.getElementById('line').value = '{line}'")
    page.evaluate("document.getElementById('form').requestSubmit()")


def test_a_run_is_driven_from_a_page(browser: Browser, tmp_path: Path) -> None:
    with served(tmp_path, "--demo") as address:
        page = opened(browser, address)
        page.wait(f"/9 MOVE PIN/.test({TOLD})")
        press(page, "Step")
        page.wait(f"/`step` was ignored/.test({TOLD})")
        press(page, "Pause")
        page.wait(f"/paused on request/.test({TOLD})")
        before = page.evaluate(HERE)
        press(page, "Step")
        page.wait(f"{HERE} !== '{before}'")
        press(page, "Back")
        page.wait(f"/1 step undone/.test({TOLD}) && {HERE} === '{before}'")
        page.evaluate("document.getElementById('line-0-19').click()")
        page.wait("document.getElementById('line-0-19').classList.contains('break')")
        type_in(page, "pace free")
        press(page, "Run")
        page.wait(f"/breakpoint at line 19/.test({TOLD})")
        assert page.evaluate(HERE) == "line-0-19"
        page.evaluate("document.getElementById('line-0-19').click()")
        page.wait("!document.querySelector('li.break')")
        type_in(page, "pace 1x")
        press(page, "Run")
        page.wait(f"({TOLD}.match(/19 CHANGE/g) || []).length > 0 && !/panic/.test({TOLD})")
        assert page.evaluate("document.querySelectorAll('#axes li').length") == 6
        press(page, "Panic")
        page.wait(f"/stopped by the panic button/.test({TOLD})")
        (tmp_path / "live.png").write_bytes(page.screenshot())
        assert page.errors == []
        assert all(url.startswith(address[:20]) for url in page.requests)


def test_others_look_on_take_the_drive_and_reload(browser: Browser, tmp_path: Path) -> None:
    (tmp_path / "calls.al").write_text(CALLS)
    plan = [
        sys.executable,
        "-m",
        "handeye",
        "plan",
        str(tmp_path / "calls.al"),
        "-o",
        str(tmp_path / "calls.plan.json"),
    ]
    subprocess.run(plan, check=True)
    with served(tmp_path, str(tmp_path / "calls.plan.json")) as address:
        first, second = opened(browser, address), opened(browser, address)
        assert re.match(
            "2 viewers; another viewer has control",
            second.evaluate("document.getElementById('looking').textContent"),
        )
        press(second, "Take control")
        first.wait("/another viewer has control/.test(document.getElementById('looking').textContent)")
        press(second, "Run")
        for page in (first, second):
            page.wait("!document.getElementById('answers').hidden")
        press(second, "Skip")
        second.wait(f"/line-0-5/.test({HERE})")
        first.ask("Page.reload")
        first.wait(f"document.getElementById('told') && /> skip/.test({TOLD})")
        second.ask("Page.navigate", url="about:blank")
        first.wait("/1 viewer; no viewer has control/.test(document.getElementById('looking').textContent)")
        press(first, "Take control")
        first.wait("/you have control/.test(document.getElementById('looking').textContent)")
        press(first, "Run")
        first.wait(f"/the program has ended/.test({TOLD})")
        assert first.errors == second.errors == []


def test_positions_are_taught_from_a_page(browser: Browser, tmp_path: Path) -> None:
    with served(tmp_path, "--teach", str(tmp_path / "job.al")) as address:
        page = opened(browser, address)

        def answered(sentence: str) -> None:
            page.wait(
                f"/{sentence}/.test({TOLD}) && /is held/.test(document.getElementById('state').textContent)"
            )

        answered("lists the commands")
        press(page, "z −")
        answered("table z -.5[^>]+hand +at")
        press(page, "boom +")
        answered("j3 [+].5[^>]+boom")
        press(page, "Open 2 in")
        answered("gap 2.00 in")
        page.evaluate("document.getElementById('name').value = 'ABOVE'")
        press(page, "Record")
        answered("ABOVE is ")
        page.wait(
            "[...document.querySelectorAll('#taught li.new')].some(line => /^ABOVE/.test(line.textContent))"
        )
        press(page, "turn z +")
        answered("table turn z [+]5[^>]+hand")
        press(page, "Undo")
        answered("the last motion is undone")
        type_in(page, "push x 5 60")
        answered("the arm cannot be pushed while its brakes are set")
        press(page, "Float")
        page.wait("/brakes are off/.test(document.getElementById('state').textContent)")
        type_in(page, "push x 1 60")
        page.wait("/the arm is moving/.test(document.getElementById('state').textContent)")
        press(page, "Where")
        page.wait(f"/`where` was refused/.test({TOLD})")
        press(page, "Panic")
        answered("stopped by the panic button; the brakes are set")
        press(page, "Save")
        answered("ABOVE written to ")
        (tmp_path / "teach.png").write_bytes(page.screenshot())
        assert page.errors == []
    assert "ABOVE = {" in (tmp_path / "job.toml").read_text()


def test_a_run_that_was_carried_out_plays(browser: Browser, tmp_path: Path) -> None:
    with served(tmp_path, str(resources.demo())) as address:
        page = opened(browser, address, ready="document.getElementById('view')?.player")
        press(page, "Play")
        page.wait("document.getElementById('view').player.time > 20")
        assert page.evaluate("Number(document.getElementById('time').value)") > 20
        assert page.errors == []
        assert all(url.startswith(address[:20]) for url in page.requests)


def test_the_demo_takes_no_pictures() -> None:
    assert "PICTURE" not in (resources.plans() / "insertion.al").read_text().upper()
