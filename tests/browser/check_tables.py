"""The tables of MOS in a browser: the report agrees with the record at any cycle, and a live page writes words.

python3 run.py test browser
"""

import os
import subprocess
import sys
from collections.abc import Iterator
from pathlib import Path

import pytest
from chromium import Browser, Page

from handeye.core.resources import plans
from handeye.systems.ml.dashboard.kept import kept_history

SENSES = ("--sense", "4=-700", "--sense", "8=300", "--sense", "5=500@3:2750")
TOLD = "document.getElementById('told').textContent"
CELLS = "document.querySelectorAll('#tables-panels td')"
WORD = "(cell) => [cell.dataset.number, [cell.textContent.replace('\u2212', '-'), cell.classList.contains('lit')]]"
CELL = "document.querySelector(`#tables-panels td[data-number='{}']`)"


@pytest.fixture(scope="module")
def browser(tmp_path_factory: pytest.TempPathFactory) -> Iterator[Browser]:
    with Browser.started(tmp_path_factory.mktemp("profile")) as browser:
        yield browser


@pytest.fixture(scope="module")
def run(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """The folder of the paper's example, with its report."""
    folder = tmp_path_factory.mktemp("ml") / "run"
    handeye("ml", "run", str(plans() / "guarded_move.ml"), *SENSES, "--out", str(folder))
    handeye("report", str(folder))
    return folder


def handeye(*words: str) -> None:
    subprocess.run([sys.executable, "-m", "handeye", *words], check=True, capture_output=True)


@pytest.mark.parametrize("width", [1360, 390])
def test_a_report_shows_each_word_at_each_cycle(browser: Browser, run: Path, width: int) -> None:
    page = browser.page(run / "report.html", width=width, height=900)
    page.wait("document.querySelectorAll('#tables-panels table').length === 2")
    done = kept_history(run)
    assert done is not None
    for cycle in (0, 57, 112, 113, done.last):
        page.evaluate(f"location.hash = '#t={cycle / 100}'")
        page.wait(f"Number(document.getElementById('tables-cycle').value) === {cycle}")
        shown = page.evaluate(f"Object.fromEntries([...{CELLS}].map(({WORD})))")
        assert len(shown) == 16 * (9 + 12)  # motors; sensors, with the one that the program connects
        assert {int(number): told for number, told in shown.items()} == {
            int(number): [str(done.value(int(number), cycle)), done.changed(int(number), cycle)]
            for number in shown
        }
    assert page.evaluate("document.documentElement.scrollWidth") <= width
    assert page.errors == []


def test_a_word_is_written_in_a_live_page_while_the_arm_moves(browser: Browser, tmp_path: Path) -> None:
    (tmp_path / "there.ml").write_text("10 MOTOR 3 9000\n20 MOTOR 3 0\n", encoding="utf-8")
    command = [sys.executable, "-m", "handeye", "ml", "view", "there.ml", "--out", "kept"]
    with subprocess.Popen(
        command, stdout=subprocess.PIPE, text=True, cwd=tmp_path, env=dict(os.environ)
    ) as process:
        try:
            write(browser, process)
        finally:
            process.kill()  # a failed check leaves it running
    done = kept_history(tmp_path / "kept")
    assert done is not None
    assert 200 in done.courses[2 * 16 + 7].values


def write(browser: Browser, process: "subprocess.Popen[str]") -> None:
    """Write a word into the page of a running program, let the program end, and leave."""
    assert process.stdout is not None
    page = opened(browser, process.stdout.readline().strip())
    page.wait("document.querySelectorAll('#tables-panels table').length === 2")
    page.wait("live.driving()")
    page.evaluate("live.say('pace .25x'); live.say('continue')")
    page.wait("Number(document.getElementById('tables-cycle').value) > 5")
    speed = CELL.format(2 * 16 + 7)  # word 8 of line 3 of MT
    page.evaluate(f"{speed}.click(); document.getElementById('tables-word').value = 200")
    page.evaluate("document.getElementById('tables-write').requestSubmit()")
    page.wait(f"{speed}.textContent === '200'")
    page.evaluate("live.say('pace free')")
    page.wait(f"/the program has ended/.test({TOLD})")
    page.evaluate("live.say('quit')")
    process.wait(60)
    assert page.errors == []


def opened(browser: Browser, address: str) -> Page:
    target = browser.pipe.ask("Target.createTarget", url=address)["targetId"]
    session = browser.pipe.ask("Target.attachToTarget", targetId=target, flatten=True)["sessionId"]
    page = Page(browser.pipe, session)
    for domain in ("Page", "Runtime", "Log", "Network"):
        page.ask(f"{domain}.enable")
    page.resize(1360, 900)
    return page
