"""The page of a live run: the report's view and script, fed by the server, and what drives the stepper."""

from pathlib import Path
from typing import Any, Final

import numpy as np

from handeye.markup import Markup
from handeye.program.program import Program
from handeye.runs.runner import Runner
from handeye.see import player
from handeye.see.page.document import head, packed, resource
from handeye.see.page.elements import element
from handeye.see.page.moments import json_markup
from handeye.see.page.source import listing
from handeye.see.player import scene, tracks
from handeye.trace.messages import Poses
from handeye.view.moment import FIGURES, Newest

_MARK: Final = "<!doctype html>\n"
_POLICY: Final = ("connect-src 'self'", "base-uri 'none'", "form-action 'none'")
"""What the page may do beside the report's: talk with its server, and no more."""
_BUTTONS: Final = (
    ("continue", "Run"),
    ("pause", "Pause"),
    ("step", "Step"),
    ("stage", "Next stage"),
    ("back", "Back"),
    ("back stage", "Back a stage"),
)
_ANSWERS: Final = (("proceed", "Proceed"), ("retry", "Retry"), ("skip", "Skip"), ("abort", "Abort"))
_PACES: Final = (("1x", "1 ×"), ("4x", "4 ×"), ("free", "as fast as it goes"))


def live_page(runner: Runner, newest: Newest) -> bytes:
    """The page of a run in a cell, as one file that fetches nothing.

    Raises:
        InvalidInput: the task shows no scene.
    """
    program: Any = runner.listing
    model = runner.task.scene(runner.setup.world)
    names = newest.frames.names
    facts = {
        "bodies": names,
        "figures": FIGURES,
        "joints": len(newest.frames.joints),
        "lowest": scene.lowest(model),
        "files": ["", *program.required],
        "begun": newest.moment.time,
    }
    scripts = [player.script(), _own("live.js")]
    style = resource("page.css") + _own("live.css")
    body = element(
        "body",
        _header(program),
        element("main", element("div", _viewer(), _aside(program), class_="beside")),
        element("script", json_markup(facts), id="facts", type="application/json"),
        packed("scene", scene.scene_bytes(model)),
        packed("tracks", _first_tracks(names, newest.moment.poses)),
        *(element("script", Markup(script)) for script in scripts),
        class_="live",
    )
    return (
        _MARK
        + element("html", head(f"{program.name}: live", style, scripts, *_POLICY), body, lang="en")
        + "\n"
    ).encode()


def _header(program: Program) -> Markup:
    state = element("p", "connecting", id="state", role="status")
    drive = element("button", "Take the drive", id="drive", type="button")
    looking = element("span", id="looking")
    return element("div", element("h1", program.name), state, element("p", looking, drive), class_="title")


def _viewer() -> Markup:
    canvas = element(
        "canvas", id="view", tabindex="0", role="img",
        aria_label="the cell as it now is; arrows walk round it, plus and minus come nearer and go farther",
    )  # fmt: skip
    figures = element("p", id="figures", class_="caption")
    views = element("div", id="views", role="group", aria_label="view", class_="views")
    return element(
        "div", element("div", canvas, class_="screen"), element("p", id="instead", hidden=True), figures, views,
        _controls(), _talk(), class_="viewer",
    )  # fmt: skip


def _controls() -> Markup:
    buttons = (element("button", shown, type="button", value=said, class_="say") for said, shown in _BUTTONS)
    answers = (element("button", shown, type="button", value=said, class_="say") for said, shown in _ANSWERS)
    paces = (element("option", shown, value=said, selected=said == "free") for said, shown in _PACES)
    pace = element("select", *paces, id="pace", aria_label="pace")
    panic = element("button", "Panic", id="panic", type="button")
    called = element(
        "div", *answers, id="answers", role="group", aria_label="answers for the operator", hidden=True
    )
    return element("div", *buttons, pace, panic, called, class_="controls")


def _talk() -> Markup:
    told = element("pre", id="told", role="log", aria_label="what the stepper tells", tabindex="0")
    line = element(
        "input",
        id="line",
        type="text",
        maxlength="1000",
        aria_label="command of the stepper",
        autocomplete="off",
    )
    return element("div", told, element("form", line, id="form"), class_="talk")


def _aside(program: Program) -> Markup:
    """What stands beside the cell: the television, once there is a picture, and the script."""
    television = element("div", id="television", role="region", aria_label="television", hidden=True)
    script = element(
        "div",
        listing(program),
        id="script",
        class_="source",
        tabindex="0",
        role="region",
        aria_label="script",
    )
    return element("div", television, script, class_="aside")


def _first_tracks(names: tuple[str, ...], poses: Poses) -> bytes:
    """Where all bodies are at first, those too that are not there yet: the page puts them where they are."""
    there = np.where(np.isnan(poses), np.array([0, 0, 0, 1, 0, 0, 0], dtype=np.float32), poses)
    rows = {name: pose[None] for name, pose in zip(names, there, strict=True)}
    return tracks.tracks_bytes(rows, times=np.zeros(1), begin=0.0, end=0.0, lowest=-np.inf)


def _own(name: str) -> str:
    return Path(__file__).with_name(name).read_text(encoding="utf-8")
