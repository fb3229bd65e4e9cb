"""Builds the section with the 3D view of the run. The section also contains the stages, the controls, and the
script.
"""

from collections.abc import Iterator, Sequence
from typing import Final

from handeye.core.markup import Markup, element, joined, region, section, to_moment
from handeye.report.page.figures import clock
from handeye.report.page.source import listing
from handeye.report.photographs import Photograph, shown
from handeye.report.recorded import RecordedRun
from handeye.trace.stages import Stage

SPEEDS: Final = (1, 2, 4, 8, 16, 64)
USUAL: Final = 8
_KEYS: Final = (
    ("space", "play, pause"),
    ("← →", "a step"),
    ("shift ← →", "a stage"),
    ("[ ]", "slower, faster"),
    ("1 2 …", "views"),
    ("s", "show what the hand sensed"),
)


def view_section(run: RecordedRun, strip: Sequence[Photograph]) -> Markup:
    """Return the section with the 3D view."""
    pairs = joined((joined([element("kbd", key), f" {does}"]) for key, does in _KEYS), ", ")
    canvas = element(
        "canvas", id="view", hidden=True, tabindex="0", role="img",
        aria_label="the cell at the displayed time; the arrow keys turn the view, and the keys + and - zoom",
    )  # fmt: skip
    photographs = element("div", *_photographs(strip), id="strip", class_="strip")
    sensed = element("canvas", id="senses", class_="senses", aria_hidden="true")
    told = element("p", id="hand-label", class_="hand-label", hidden=True)
    television = element("div", id="television", class_="television", hidden=True)
    picked = element("p", id="picked", role="status", hidden=True)
    viewer = element(
        "div",
        element("div", canvas, sensed, photographs, told, television, picked, class_="screen"),
        element("p", id="caption", class_="caption", hidden=True),
        _bar(run),
        _controls(run),
        element("p", id="instead", class_="keys", hidden=True),
        element("p", pairs, id="keys", class_="keys", hidden=True),
        class_="viewer",
    )
    script = region(listing(run.program), label="script", id="script", class_="source")
    return section("run", "The run", element("div", viewer, script, class_="beside"))


def _photographs(strip: Sequence[Photograph]) -> Iterator[Markup]:
    missing = next((each.missing for each in strip if each.webp is None), "")
    if missing:
        yield element("p", missing, class_="missing")
    for each in strip:
        if each.webp is not None:
            yield shown(each, data_time=f"{each.time:.2f}")


def _bar(run: RecordedRun) -> Markup:
    """Return the stages as links. The width of a link is proportional to the duration of its stage."""
    links = (_stage(run, number, stage) for number, stage in enumerate(run.trace.stages, 1))
    return element(
        "nav",
        *links,
        id="stages",
        class_="stages",
        aria_label="stages",
        aria_keyshortcuts="Shift+ArrowLeft Shift+ArrowRight",
    )


def _stage(run: RecordedRun, number: int, stage: Stage) -> Markup:
    begin, end = stage.begin, stage.end
    unseen = end <= run.begins
    told = f"{number} {stage.name}, {clock(begin)} to {clock(end)}, {stage.status}{', not recorded' if unseen else ''}"
    return to_moment(
        begin,
        element("span", str(number)),
        class_=f"s{number} {'unseen' if unseen else stage.status.replace(' ', '-')}",
        title=told,
        aria_label=told,
    )


def widths(run: RecordedRun) -> str:
    """Return CSS rules that make the width of each stage proportional to the stage's duration."""
    return "".join(
        f"#stages .s{number}{{flex-grow:{100 * max(stage.end - stage.begin, 0.1):.0f}}}"
        for number, stage in enumerate(run.trace.stages, 1)
    )


def _controls(run: RecordedRun) -> Markup:
    play = element(
        "button", "Play", id="play", type="button", aria_keyshortcuts="Space", title="play, pause: space"
    )
    time = element(
        "input", id="time", type="range", min=f"{run.begins:.2f}", max=f"{run.ends:.2f}", step="0.01",
        value=f"{run.begins:.2f}", aria_label="time", aria_keyshortcuts="ArrowLeft ArrowRight",
    )  # fmt: skip
    now = element("output", clock(run.begins), id="clock", for_="time")
    options = (element("option", f"{speed} ×", value=speed, selected=speed == USUAL) for speed in SPEEDS)
    speed = element("select", *options, id="speed", aria_label="speed", aria_keyshortcuts="[ ]")
    views = element("div", id="views", role="group", aria_label="view", class_="views")
    box = element("input", type="checkbox", id="sensing", checked=True, aria_keyshortcuts="s")
    senses = element(
        "label", box, " senses", title="show searches, pictures, and the force and path of the hand (key S)"
    )
    return element(
        "div", play, time, now, speed, views, senses, id="controls", class_="controls", hidden=True
    )
