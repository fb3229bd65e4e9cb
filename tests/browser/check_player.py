"""The player in a browser: it shows what was recorded, answers hands, and draws fast enough where software draws.

Not collected with the tests, for it needs a Chromium: `pytest tests/browser/check_player.py`. `HANDEYE_CHECK_TRACE`
names a trace to look at instead of that of a short run.
"""

import json
import os
import time
from base64 import b64encode
from collections.abc import Iterator
from hashlib import sha256
from pathlib import Path
from typing import Any

import cv2
import numpy as np
import pytest
from chromium import Browser, Page
from numpy.typing import NDArray
from short_runs import begin, traced

import handeye
from handeye.report.player import scene_bytes, script, shown_poses, tracks_bytes
from handeye.trace.trace import Trace

PLACE, TURN = 3e-4, np.radians(0.3)
"""How far a body may be from where it was: m, rad."""
WIDTH, HEIGHT = 870, 652
FRAMES_A_SECOND = 6.0
BEGIN = """
const opened = text => new Response(new Blob([Uint8Array.from(atob(text), c => c.charCodeAt(0))]).stream()
  .pipeThrough(new DecompressionStream("gzip"))).arrayBuffer();
(async () => {
  try {
    window.player = await createPlayer(document.querySelector("canvas"), await opened(SCENE), await opened(TRACKS),
      { still: true, exposures: 8 });
    player.onpick = name => { window.picked = name; };
  } catch (error) { window.refused = error.message; }
})();
"""

PLAY = """
const play = () => {
  if (window.playing) requestAnimationFrame(play);
  player.at(BUSY + performance.now() / 1e3 % 4);
};
play();
"""


@pytest.fixture(scope="module")
def trace(tmp_path_factory: pytest.TempPathFactory) -> Trace:
    """A run in which the arm takes a pin out of its holder."""
    told = os.environ.get("HANDEYE_CHECK_TRACE")
    if told is not None:
        return handeye.open(told)
    return traced(begin(), tmp_path_factory.mktemp("short") / "run")


@pytest.fixture(scope="module")
def file(trace: Trace, tmp_path_factory: pytest.TempPathFactory) -> Path:
    """A page with nothing but the player, as strict as a page can be."""
    scene, tracks = (b64encode(data).decode() for data in (scene_bytes(trace), tracks_bytes(trace)))
    scripts = script(), f'const SCENE = "{scene}", TRACKS = "{tracks}";', BEGIN
    hashes = " ".join(f"'sha256-{b64encode(sha256(part.encode()).digest()).decode()}'" for part in scripts)
    style = f"body {{ margin: 0 }} canvas {{ width: {WIDTH}px; height: {HEIGHT}px; touch-action: none }}"
    style_hash = b64encode(sha256(style.encode()).digest()).decode()
    policy = f"default-src 'none'; script-src {hashes}; style-src 'sha256-{style_hash}'"
    head = f'<meta charset="utf-8"><meta http-equiv="Content-Security-Policy" content="{policy}">'
    body = "".join(f"<script>{part}</script>" for part in scripts)
    path = tmp_path_factory.mktemp("page") / "player.html"
    path.write_text(
        f'<!DOCTYPE html>{head}<style>{style}</style><canvas tabindex="0"></canvas>{body}', encoding="utf-8"
    )
    return path


@pytest.fixture(scope="module")
def page(file: Path, tmp_path_factory: pytest.TempPathFactory) -> Iterator[Page]:
    """The page, opened."""
    with Browser.started(tmp_path_factory.mktemp("profile")) as browser:
        page = browser.page(file, width=WIDTH, height=HEIGHT)
        assert page.wait("window.refused || window.player && 'player'") == "player"
        yield page


def picture(page: Page) -> NDArray[Any]:
    """What is to be seen now, shape (HEIGHT, WIDTH, 3), levels of a screen."""
    levels = cv2.imdecode(np.frombuffer(page.screenshot(), dtype=np.uint8), cv2.IMREAD_COLOR)
    return np.asarray(levels, dtype=float)


def settle(page: Page, view: str = "room", time: float = 0.0) -> None:
    """Go to a view and a moment, and wait for the averaged picture."""
    page.evaluate(f"player.view({json.dumps(view)}); player.at({time}); player.settled()")


def sight(page: Page) -> dict[str, Any]:
    """Where the camera is."""
    told = page.evaluate("(({ at, far, yaw, pitch }) => ({ at, far, yaw, pitch }))(player.camera)")
    return dict(told)


def test_a_page_with_a_strict_policy_shows_it_and_asks_for_nothing(page: Page, file: Path) -> None:
    settle(page)
    assert page.errors == []
    assert page.requests == [file.as_uri()]


def test_the_whole_run_can_be_shown(page: Page, trace: Trace) -> None:
    begin, end = trace.covers
    assert page.evaluate("[player.begin, player.end, player.duration]") == pytest.approx(
        [begin, end, end - begin]
    )


def test_every_body_is_where_it_was_and_hidden_where_it_was_not(page: Page, trace: Trace) -> None:
    rows, shown = np.linspace(0, len(trace.times) - 1, 20).astype(int), shown_poses(trace)
    times = trace.times[rows].tolist()
    told = page.evaluate(
        f"{times}.map(t => Object.fromEntries(player.names.map(n => [n, player.pose(n, t)])))"
    )
    for row, poses in zip(rows, told, strict=True):
        for name, pose in poses.items():
            true = shown[name][row]
            there = bool(true[2] > -1.0)
            assert (pose is not None) == there, (name, row)
            if there:
                chord = min(np.linalg.norm(pose[3:] - sign * true[3:]) for sign in (1, -1))
                assert np.linalg.norm(pose[:3] - true[:3]) < PLACE, (name, row)
                assert 4 * np.arcsin(chord / 2) < TURN, (name, row)
    assert len(told[0]) >= 30


@pytest.mark.parametrize("view", ["room", "hand", "pump", "work", "belt", "tv"])
def test_every_view_shows_something(page: Page, view: str) -> None:
    assert view in page.evaluate("player.views")
    settle(page, view)
    levels = picture(page)
    assert 40 < levels.mean() < 160
    assert levels.std() > 25


def test_what_is_kept_of_a_picture_looks_as_if_it_were_drawn_anew(page: Page) -> None:
    """While the camera stands, what stands still is kept; a draft from that is the draft that is drawn whole."""
    settle(page, "pump")
    page.evaluate("player.exposures = 0; player.lost = true")  # nothing else draws meanwhile
    draft = "player.picture.draft(player.camera, ...player.size(1))"
    page.evaluate(f"player.picture.last = null; {draft}")
    anew = picture(page)
    page.evaluate(f"{draft}; {draft}")
    kept = picture(page)
    page.evaluate("player.exposures = 8; player.lost = false")
    assert np.abs(anew - kept).mean() < 1.0


def test_nothing_is_drawn_while_nothing_changes(page: Page) -> None:
    settle(page, "belt")
    drawn = page.evaluate("player.frames")
    page.evaluate("new Promise(done => setTimeout(done, 1000))")
    assert page.evaluate("player.frames") == drawn


def test_a_click_names_a_part_and_a_drag_goes_round(page: Page) -> None:
    settle(page, "belt")
    page.evaluate("window.picked = undefined")
    page.press(WIDTH / 2, HEIGHT * 0.75)
    assert page.evaluate("picked") == "belt"
    before = sight(page)
    page.evaluate("window.picked = undefined")
    page.press(300, 300, (340, 300), (380, 310))
    after = sight(page)
    assert after["yaw"] < before["yaw"]
    assert after["pitch"] > before["pitch"]
    assert page.evaluate("picked") is None


def test_the_right_button_shifts_and_a_pinch_comes_nearer(page: Page) -> None:
    settle(page, "pump")
    before = sight(page)
    page.press(300, 300, (340, 300), (380, 310), button="right")
    shifted = sight(page)
    assert (shifted["yaw"], shifted["far"]) == (before["yaw"], before["far"])
    assert shifted["at"] != before["at"]
    page.touch("touchStart", (300, 300), (500, 300))
    page.touch("touchMove", (250, 300), (550, 300))
    page.touch("touchEnd")
    assert sight(page)["far"] == pytest.approx(before["far"] * 2 / 3, rel=0.05)


def test_keys_go_round_shift_and_come_nearer(page: Page) -> None:
    settle(page, "pump")
    page.evaluate("document.querySelector('canvas').focus()")
    before = sight(page)
    page.key("ArrowRight")
    page.key("+")
    page.key("ArrowUp", shift=True)
    after = sight(page)
    assert after["yaw"] > before["yaw"]
    assert after["far"] < before["far"]
    assert after["at"][2] < before["at"][2]


def test_the_wheel_is_the_pages_until_a_hand_has_taken_hold(page: Page) -> None:
    settle(page, "pump")
    page.evaluate("document.activeElement.blur()")
    before = sight(page)["far"]
    page.wheel(300, 300, -100)
    assert sight(page)["far"] == before
    page.evaluate("document.querySelector('canvas').focus()")
    page.wheel(300, 300, -100)
    assert sight(page)["far"] < before


def test_the_view_of_the_hand_goes_with_it(page: Page, trace: Trace) -> None:
    settle(page, "hand")
    first = page.evaluate("player.camera.eye")
    moved = np.abs(trace.poses["stanford/link6"] - trace.poses["stanford/link6"][0]).sum(axis=1).argmax()
    settle(page, "hand", float(trace.times[moved]))
    went = trace.poses["stanford/link6"][moved, :3] - trace.poses["stanford/link6"][0, :3]
    assert np.subtract(page.evaluate("player.camera.eye"), first) == pytest.approx(went, abs=2e-3)


def test_a_lost_graphics_card_is_made_good(page: Page) -> None:
    settle(page, "pump")
    before = picture(page)
    page.evaluate("window.lose = player.graphics.gl.getExtension('WEBGL_lose_context'); lose.loseContext()")
    page.wait("player.lost")
    page.evaluate("lose.restoreContext()")
    page.wait("!player.lost")
    settle(page, "pump")
    assert np.abs(picture(page) - before).mean() < 1.0


def busy(trace: Trace) -> float:
    """When four seconds begin in which the hand goes nearly all the time."""
    moves = np.abs(np.diff(trace.poses["stanford/link6"], axis=0)).max(axis=1) > 1e-4
    found = np.convolve(moves, np.ones(240), mode="valid").argmax()
    return float(trace.times[found])


def test_it_plays_smoothly_where_software_draws(page: Page, trace: Trace) -> None:
    page.evaluate(f"player.view('room'); window.playing = true; {PLAY.replace('BUSY', str(busy(trace)))}")
    page.evaluate("new Promise(done => setTimeout(done, 3000))")  # it learns how fast it can draw
    before, begun = page.evaluate("player.frames"), time.perf_counter()
    page.evaluate("new Promise(done => setTimeout(done, 4000))")
    rate = (page.evaluate("player.frames") - before) / (time.perf_counter() - begun)
    page.evaluate("window.playing = false")
    print(f"{rate:.1f} frames a second")  # noqa: T201
    assert rate >= FRAMES_A_SECOND


def test_it_says_so_where_there_is_no_webgl(file: Path, tmp_path: Path) -> None:
    with Browser.started(tmp_path, "--disable-3d-apis") as browser:
        page = browser.page(file)
        assert page.wait("window.refused") == "This browser offers no WebGL 2."
