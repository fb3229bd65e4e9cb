"""Builds the page of a live cell. The page shows the 3D view and the script in the same form as the report. The server
updates the view and the script during the run. The page also has a log of replies and a command line.
"""

from collections.abc import Iterator, Sequence
from dataclasses import dataclass, field
from pathlib import Path
from typing import Any, Final

import numpy as np

from handeye.arm.model import ArmModel
from handeye.core.markup import Markup, PagePart, element, region
from handeye.core.units import DEGREE, INCH
from handeye.report import player
from handeye.report.page.document import head, packed, resource
from handeye.report.page.moments import json_markup
from handeye.report.player import scene, tracks
from handeye.runs.runner import Runner
from handeye.runs.systems import written
from handeye.tasks.interface import AnyTask
from handeye.trace.messages import Poses
from handeye.view.moment import FIGURES, Newest

_MARK: Final = "<!DOCTYPE html>\n"
_POLICY: Final = ("connect-src 'self'", "base-uri 'none'", "form-action 'none'")
"""Directives that the content security policy of a live page has in addition to those of a report. A live page may
communicate with its own server, but with no other server.
"""


@dataclass(frozen=True, slots=True, kw_only=True)
class Face:
    """The parts in which live pages differ, such as the controls and the region beside the cell."""

    title: str
    controls: Sequence[Markup]
    aside: Markup
    listener: str  # noun for the listener: `stepper`
    script: str  # the file with its script
    facts: dict[str, Any] = field(default_factory=dict)  # facts for its script


def live_page(runner: Runner, newest: Newest, face: Face) -> bytes:
    """Return the page of a live cell, as one file that loads no other files. If there is no cell, the page has no
    view.
    """
    model = (
        None if runner.system.cell is None else runner.task.shown(runner.setup.world, written(runner.setup))
    )
    names, live = newest.frames.names, newest.live
    part, shown = (PagePart(Markup("")), ()) if live is None else (live.part, live.channels)
    facts = {
        "bodies": names,
        "figures": FIGURES,
        "joints": len(newest.frames.joints),
        "channels": [(name, unit, name not in shown) for name, unit in newest.parts],
        "axes": _axes(runner),
        "lowest": 0.0 if model is None else scene.lowest(model),
        "tools": []
        if model is None or runner.task.force_axes != AnyTask.force_axes
        else scene.tool_points(model),
        **face.facts,
    }
    scripts = [
        *([] if model is None else [player.script()]),
        _own("live.js"),
        _own(face.script),
        *filter(None, [part.script]),
    ]
    style = resource("page.css") + _own("live.css") + part.style
    view = []
    if model is not None:
        first = _first_tracks(names, newest.moment.poses)
        view = [packed("scene", scene.scene_bytes(model)), packed("tracks", first)]
    television = element("section", id="television", aria_label="television", hidden=True)
    aside = element("div", television, face.aside, class_="aside")
    state = element("p", "connecting", id="state", role="status")
    drive = element("button", "Take control", id="drive", type="button")
    looking = element("p", element("span", id="looking"), drive)
    header = element("header", element("h1", f"Live cell: {face.title}"), state, looking, class_="title")
    body = element(
        "body",
        header,
        element(
            "main", element("div", _viewer(face, seen=model is not None), aside, class_="beside"), part.markup
        ),
        element("script", json_markup(facts), id="facts", type="application/json"),
        *view,
        *(element("script", Markup(script)) for script in scripts),
        class_="live",
    )
    top = head(f"{face.title}: live", style, scripts, *_POLICY)
    return (_MARK + element("html", top, body, lang="en") + "\n").encode()


def buttons(said: Sequence[tuple[str, str]]) -> Iterator[Markup]:
    """Yield buttons. Each button is given by the line that it sends, and by its label."""
    return (element("button", shown, type="button", value=line, class_="say") for line, shown in said)


def source_region(label: str, *content: Markup, id: str | None = None) -> Markup:
    """Return a scrolling region with a script or a taught file, to be shown beside the cell."""
    return region(*content, label=label, id=id, class_="source")


def _viewer(face: Face, *, seen: bool) -> Markup:
    canvas = element(
        "canvas", id="view", tabindex="0", role="img",
        aria_label="the live cell; the arrow keys turn the view, and the keys + and - zoom",
    )  # fmt: skip
    figures = element("p", id="figures", class_="caption")
    axes = element(
        "ul", id="axes", aria_label="positions of the arm's joints between their limits", hidden=True
    )
    views = element("div", id="views", role="group", aria_label="view", class_="views")
    senses = element("canvas", id="senses", class_="senses", aria_hidden="true")
    view = (
        [element("div", canvas, senses, class_="screen"), element("p", id="instead", hidden=True)]
        if seen
        else []
    )
    return element(
        "div",
        *view,
        figures,
        axes,
        *([views] if seen else []),
        *face.controls,
        _talk(face.listener),
        class_="viewer",
    )


def _talk(listener: str) -> Markup:
    told = element("pre", id="told", role="log", aria_label=f"replies of the {listener}", tabindex="0")
    label = f"command for the {listener}"
    line = element("input", id="line", type="text", maxlength="1000", aria_label=label, autocomplete="off")
    say = element("button", "Send", type="submit")
    return element("div", told, element("form", line, say, id="form"), class_="talk")


def _axes(runner: Runner) -> list[tuple[str, str, float, float, float]]:
    """Return, for each joint, its name, its unit, the unit's value in SI units, and the joint's limits in its unit.
    The list is empty if the task does not describe its arm.
    """
    arm = getattr(runner.task, "arm", None)
    if not isinstance(arm, ArmModel):
        return []
    units = {"revolute": ("°", DEGREE), "prismatic": ("in", INCH)}
    return [
        (joint.name, *(unit := units[joint.kind]), joint.lower / unit[1], joint.upper / unit[1])
        for joint in arm.joints
    ]


def _first_tracks(names: tuple[str, ...], poses: Poses) -> bytes:
    """Return the first poses of all bodies. Bodies that do not exist yet are put at the origin; the page moves
    them later."""
    there = np.where(np.isnan(poses), np.array([0, 0, 0, 1, 0, 0, 0], dtype=np.float32), poses)
    rows = {name: pose[None] for name, pose in zip(names, there, strict=True)}
    return tracks.tracks_bytes(rows, times=np.zeros(1), begin=0.0, end=0.0, lowest=-np.inf)


def _own(name: str) -> str:
    return Path(__file__).with_name(name).read_text(encoding="utf-8")
