"""The report of a run in a browser: it fits, fetches nothing, answers keys and addresses, and tells the truth.

Not collected with the tests, for it needs a Chromium: `python3 run.py test browser`. A short run is looked at, and the
run of `report --demo`; `HANDEYE_CHECK_TRACE` names a trace, or the folder of a run, to be looked at instead.
"""

import os
from collections.abc import Iterator
from pathlib import Path

import numpy as np
import pytest
from chromium import Browser, Page
from report_pages import renamed
from short_runs import begin, traced

from handeye.cli.reports import read_recorded
from handeye.core import resources
from handeye.report.animation import animation
from handeye.report.page.document import report_page
from handeye.report.photographs import album
from handeye.report.player import shown_poses
from handeye.report.recorded import RecordedRun

EVIL = "</script><img src=x onerror=alert(1)>"
PLACE, TURN = 3e-4, np.radians(0.3)
"""How far a body may be from where it was: m, rad."""
LIT = "document.querySelector('#script .on')?.id"
POSES = "Object.fromEntries(view.player.names.map(name => [name, view.player.pose(name, {seconds})]))"
CONTRASTS = """
(() => {
  const parts = text => {
    const [, kind, inner] = /^(rgba?|color)\\((?:srgb )?([^)]*)\\)$/.exec(text);
    const [r, g, b, a = 1] = inner.split(/[ ,/]+/).map(Number);
    return kind === "color" ? [r, g, b, a] : [r / 255, g / 255, b / 255, a];
  };
  const over = ([r, g, b, a], under) => [r, g, b].map((c, k) => a * c + (1 - a) * under[k]);
  const ground = node => {
    if (!node) return [1, 1, 1];
    const [r, g, b, a] = parts(getComputedStyle(node).backgroundColor);
    return a === 1 ? [r, g, b] : over([r, g, b, a], ground(node.parentElement));
  };
  const light = colour => colour.map(c => (c <= .04045 ? c / 12.92 : ((c + .055) / 1.055) ** 2.4))
    .reduce((sum, c, k) => sum + c * [.2126, .7152, .0722][k], 0);
  const found = [], walk = document.createTreeWalker(document.body, NodeFilter.SHOW_TEXT);
  while (walk.nextNode()) {
    const node = walk.currentNode.parentElement;
    if (!walk.currentNode.data.trim() || !node.checkVisibility({ visibilityProperty: true })) continue;
    const style = getComputedStyle(node), under = ground(node);
    const ink = over(parts(node instanceof SVGElement ? style.fill : style.color), under);
    const [low, high] = [light(ink), light(under)].sort((a, b) => a - b);
    found.push([(high + .05) / (low + .05), walk.currentNode.data.trim().slice(0, 40)]);
  }
  return found.sort((a, b) => a[0] - b[0]).slice(0, 3);
})()
"""
"""The words that stand out least from what is under them, and how much."""
CONTROLS = {"button", "slider", "combobox", "checkbox", "link", "DisclosureTriangle"}
TOLD = os.environ.get("HANDEYE_CHECK_TRACE")


@pytest.fixture(scope="module", params=["short", "demo"] if TOLD is None else [TOLD])
def run(request: pytest.FixtureRequest, tmp_path_factory: pytest.TempPathFactory) -> RecordedRun:
    """A run in which the arm takes a pin out of its holder, or a whole one."""
    if request.param != "short":
        return read_recorded(resources.demo() if request.param == "demo" else Path(request.param))
    return RecordedRun(trace=traced(begin(), tmp_path_factory.mktemp("short") / "run"))


def written(run: RecordedRun, folder: Path) -> Path:
    """The file of its report."""
    (folder / "report.html").write_bytes(report_page(run, album(run), animation(run)))
    return folder / "report.html"


@pytest.fixture(scope="module")
def file(run: RecordedRun, tmp_path_factory: pytest.TempPathFactory) -> Path:
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
    ((least, words), *_) = page.evaluate(CONTRASTS)
    assert least >= 4.5, words


def test_it_is_less_than_three_megabytes(file: Path) -> None:
    assert file.stat().st_size < 3_000_000


def test_every_control_has_a_role_and_a_name(page: Page) -> None:
    page.ask("Accessibility.enable")
    nodes = page.ask("Accessibility.getFullAXTree")["nodes"]
    controls = [node for node in nodes if not node["ignored"] and node["role"]["value"] in CONTROLS]
    assert {node["role"]["value"] for node in controls} >= {"button", "slider", "combobox", "link"}
    assert [node["role"]["value"] for node in controls if not node["name"]["value"].strip()] == []


def test_every_control_that_is_no_link_has_a_key(page: Page) -> None:
    keyless = "node => !node.getAttribute('aria-keyshortcuts')"
    controls = "[...document.querySelectorAll('button, input, select')]"
    assert page.evaluate(f"{controls}.filter({keyless}).map(node => node.outerHTML)") == []


def test_the_line_that_is_lit_is_the_one_under_way(run: RecordedRun, page: Page) -> None:
    begin, end = run.trace.covers
    for clock in (
        np.linspace(begin + 0.1, end - 0.1, 20) * 60
    ).round() / 60 + 1 / 120:  # steps begin with periods
        sought(page, clock)
        step = run.trace.at(float(f"{clock:.4f}")).step
        assert page.evaluate(LIT) == (None if step is None else f"line-0-{step.line}")


def test_every_body_is_where_it_was(run: RecordedRun, page: Page) -> None:
    rows, shown = np.linspace(0, len(run.trace.times) - 1, 20).astype(int), shown_poses(run.trace)
    for row in rows:
        seconds = run.trace.times[row]
        told = page.evaluate(POSES.format(seconds=seconds))
        for name, pose in told.items():
            true = shown[name][row]
            if true[2] > -1.0:
                chord = min(np.linalg.norm(pose[3:] - sign * true[3:]) for sign in (1, -1))
                assert np.linalg.norm(pose[:3] - true[:3]) < PLACE, (name, row)
                assert 4 * np.arcsin(chord / 2) < TURN, (name, row)
            else:
                assert pose is None, (name, row)


def test_what_becomes_another_body_goes_as_that_one_comes(run: RecordedRun, page: Page) -> None:
    """A screw in its thread is another body, which is hidden before."""
    for name, poses in run.trace.poses.items():
        there = poses[:, 2] > -1.0
        for row in np.flatnonzero(there[1:] != there[:-1]):
            shown = [
                page.evaluate(f"view.player.pose('{name}', {run.trace.times[at]})") is not None
                for at in (row, row + 1)
            ]
            assert shown == [there[row], there[row + 1]], (name, row)


def test_keys_play_and_go_by_steps_and_stages(run: RecordedRun, page: Page) -> None:
    begins = (stage.begin for stage in run.trace.stages)
    second = next(begin for begin in begins if begin > run.begins + 0.01)
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


def test_whatever_a_stage_is_called_nothing_runs(run: RecordedRun, browser: Browser, tmp_path: Path) -> None:
    page = opened(browser, written(renamed(run, stage=EVIL), tmp_path))
    page.evaluate("location.hash = '#t=1'")
    assert page.evaluate("document.querySelectorAll('img[src=x]').length") == 0
    assert page.evaluate("document.getElementById('caption').textContent").startswith(EVIL)
    assert page.errors == []


def test_without_webgl_it_says_so_and_shows_photographs(file: Path, tmp_path: Path) -> None:
    with Browser.started(tmp_path, "--disable-3d-apis") as browser:
        page = browser.page(file, width=1360, height=860)
        told = page.wait("document.getElementById('instead')?.textContent")
        assert told == "This browser offers no WebGL 2. Photographs replace the view."
        assert page.evaluate("document.querySelectorAll('#strip figure.on').length") == 1


def test_without_scripts_everything_but_the_view_is_there(
    browser: Browser, file: Path, run: RecordedRun
) -> None:
    page = browser.page(Path("/dev/null"))
    page.ask("Emulation.setScriptExecutionDisabled", value=True)
    page.ask("Page.navigate", url=file.as_uri())
    page.wait("document.querySelectorAll('#record').length")
    assert page.evaluate("document.getElementById('controls').hidden")
    recorded = [stage for stage in run.trace.stages if stage.end > run.begins]
    assert page.evaluate("document.querySelectorAll('#strip img').length") == len(recorded)
