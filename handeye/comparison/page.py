"""Builds the page that compares two runs. The page shows both 3D views under one time slider, the differences, and both
runs step by step.
"""

from collections.abc import Callable, Iterator
from pathlib import Path
from typing import Final, TypeVar

from handeye.comparison.comparison import Comparison
from handeye.comparison.findings import Correction, Search, Stop
from handeye.comparison.pairing import Course, Place, TwoRuns, course
from handeye.comparison.text import (
    COURSE,
    THINNED,
    correction_words,
    first_words,
    heading_words,
    moment_words,
    place_words,
    run_words,
    search_words,
    stop_words,
    turning_words,
)
from handeye.core.files import page_kind
from handeye.core.markup import (
    Markup,
    cell,
    element,
    figure_cell,
    figure_heads,
    heads,
    note,
    section,
    table,
    to_moment,
)
from handeye.core.plain_text import printable
from handeye.core.units import INCH
from handeye.report import player
from handeye.report.animation import Animation
from handeye.report.page.document import head, packed, resource
from handeye.report.page.moments import json_markup
from handeye.report.page.overlay import overlay
from handeye.report.recorded import RecordedRun

_MARK: Final = "<!DOCTYPE html>\n<!-- handeye comparison -->\n"
PAGE: Final = page_kind("comparison of handeye", _MARK)
Animations = tuple[Animation, Animation]


def comparison_page(a: RecordedRun, b: RecordedRun, found: Comparison, animated: Animations | str) -> bytes:
    """Make the page for two runs. `animated` has both animations, or the reason why there are none. Equal
    traces give equal bytes.
    """
    way = course(TwoRuns(a, b))
    views, lacking = ((), animated) if isinstance(animated, str) else (animated, "")
    scripts = [*([player.script()] if views else []), _own("page.js")]
    body = element(
        "body",
        _header(found, way),
        element(
            "main",
            section("run", "Side by side", *view(way, lacking, _opening(found, way))),
            *sections(found, way),
        ),
        moments(way),
        *(
            packed(f"{name}-{side}", data)
            for (_, side), shown in zip(SIDES, views, strict=False)
            for name, data in (("scene", shown.scene), ("tracks", shown.tracks))
        ),
        *(overlay(run, f"sensed-{side}") for run, (_, side) in zip((a, b), SIDES, strict=True) if views),
        *(element("script", Markup(script)) for script in scripts),
    )
    name = printable(f"{a.trace.head.program} and {b.trace.head.program} compared")
    style = resource("page.css") + _own("page.css")
    return (_MARK + element("html", head(name, style, scripts), body, lang="en") + "\n").encode()


def _header(found: Comparison, way: Course) -> Markup:
    runs = (
        element("p", element("b", letter), " ", run_words(run), class_="name")
        for (letter, _), run in zip(SIDES, (found.a, found.b), strict=True)
    )
    thinned = [element("p", THINNED, class_="name")] if found.thinned else []
    return element(
        "header",
        element("div", element("h1", heading_words(found)), *_turn(found, way), *runs, *thinned),
        class_="compared",
    )


def _turn(found: Comparison, way: Course) -> Iterator[Markup]:
    """Yield the divergence of the runs: a link to its step, and what each run did next."""
    if found.parted is None:
        return
    turnings = found.parted.a, found.parted.b
    here, there = (None if turning is None else turning.place for turning in turnings)
    yield element("p", "The runs diverge at ", _link(way, here, there, place_words(found.parted.place)), ".")
    for letter, turning in zip(_BOTH, turnings, strict=True):
        yield element("p", element("b", letter), " ", turning_words(turning))


def _opening(found: Comparison, way: Course) -> float:
    """Return the time on the common timeline (s) at which the page opens: just after the divergence, or 0 if the runs
    do not diverge.
    """
    if found.parted is None:
        return 0.0
    turnings = found.parted.a, found.parted.b
    here = [way.at(turning.place, side) for side, turning in enumerate(turnings) if turning and turning.place]
    begins = [*(leg.begin for leg in way.legs), way.end]
    after = next((n for n, begin in enumerate(begins) if begin > max(here, default=0.0)), len(begins) - 1)
    return (begins[after] + begins[min(after + 1, len(begins) - 1)]) / 2


def _own(name: str) -> str:
    return Path(__file__).with_name(name).read_text(encoding="utf-8")


SIDES: Final = (("A", "a"), ("B", "b"))
"""The letter of each run. The page shows the first form; the names of HTML elements contain the second form."""
_SPEEDS: Final = (1, 4, 16, 64)
_USUAL: Final = 4


def view(way: Course, lacking: str, opening: float = 0.0) -> Iterator[Markup]:
    """Yield the views of both runs, with controls. If there are no animations, also yield the reason, `lacking`."""
    if lacking:
        yield element("p", f"There is no 3D view: {lacking}", class_="missing")
    yield element("div", *(_side(letter, name) for letter, name in SIDES), class_="sides")
    yield element("p", id="instead", class_="missing", hidden=True)
    play = element(
        "button", "Play", id="play", type="button", aria_keyshortcuts="Space", title="play, pause: space"
    )
    slider = element(
        "input", id="time", type="range", min="0", max=f"{way.end:.2f}", step="0.01",
        value=f"{opening:.2f}",
        aria_label="time of both runs", aria_keyshortcuts="ArrowLeft ArrowRight",
    )  # fmt: skip
    options = (element("option", f"{speed} ×", value=speed, selected=speed == _USUAL) for speed in _SPEEDS)
    speed = element("select", *options, id="speed", aria_label="speed")
    views = element("div", id="views", role="group", aria_label="view", class_="views")
    yield element("div", play, slider, speed, views, id="controls", class_="controls", hidden=True)
    yield note(
        "The runs are aligned step by step. Where one run took longer over a step, or executed a step that the other "
        "run did not execute, the view of the other run waits."
    )


def _side(letter: str, name: str) -> Markup:
    told = f"the cell of run {letter} at the displayed time; the arrow keys turn the view, and the keys + and - zoom"
    canvas = element("canvas", id=f"view-{name}", hidden=True, tabindex="0", role="img", aria_label=told)
    clock = element("output", id=f"clock-{name}", for_="time")
    line = element("span", id=f"line-{name}")
    caption = element("p", element("b", letter, " ", clock), line, class_="caption")
    senses = element("canvas", id=f"senses-{name}", class_="senses", aria_hidden="true")
    label = element("p", id=f"hand-label-{name}", class_="hand-label", hidden=True)
    return element("div", element("div", canvas, senses, label, class_="screen"), caption)


def moments(way: Course) -> Markup:
    """Return data for the page's script: where both runs are at the beginning of each leg of the timeline."""
    legs = [[leg.begin, leg.a, leg.b, *map(_line, leg.places)] for leg in way.legs]
    return element(
        "script", json_markup([*legs, [way.end, way.a, way.b, "", ""]]), id="moments", type="application/json"
    )


def _line(place: Place | None) -> str:
    return "" if place is None else printable(place_words(place))


_BOTH: Final = ("A", "B")


Found = TypeVar("Found", Search, Stop, Correction)


def sections(found: Comparison, way: Course) -> Iterator[Markup]:
    """Yield all sections of the page. Each finding links to its step."""
    yield section("differences", "First difference", *_differences(found, way))
    searches = [_row(way, each.a, each.b, search_words, alike=each.alike) for each in found.searches]
    stops = [_row(way, each.a, each.b, stop_words, alike=each.alike) for each in found.stops]
    corrections = [
        [
            *_row(way, each.a, each.b, correction_words, alike=each.alike),
            figure_cell("" if each.apart is None else f"{each.apart / INCH:.2f}"),
        ]
        for each in found.corrections
    ]
    for name, heading, rows, more in (
        ("searches", "Searches", searches, []),
        ("felt", "Guarded motions", stops, []),
        ("corrections", "Corrections", corrections, figure_heads("apart, in")),
    ):
        if rows:
            yield section(name, heading, table([*heads("step", *_BOTH), *more], rows, label=heading))
    yield section("seconds", "Seconds by stage", _seconds(found))


def _differences(found: Comparison, way: Course) -> Iterator[Markup]:
    """Yield the first difference between the runs, and a table of the conditions in which the runs differ."""
    if found.first is None:
        yield element("p", "There is none.")
    else:
        yield element("p", _link(way, found.first.a, found.first.b, moment_words(found.first)))
        yield from (element("p", line) for line in first_words(found.first, found.measures))
    if found.first is not None and found.parted is None:
        yield element("p", COURSE)
    rows = [[element("th", each.what, scope="row"), cell(each.a), cell(each.b)] for each in found.conditions]
    if rows:
        yield table(heads("conditions that differ", *_BOTH), rows, label="conditions that differ")


def _row(
    way: Course, a: Found | None, b: Found | None, words: Callable[[Found], str], *, alike: bool
) -> list[Markup]:
    """Return a table row for a step, with the findings of both runs. The row is highlighted if the findings
    differ."""
    here, there = (None if side is None else side.place for side in (a, b))
    link = _link(way, here, there, place_words(here or there))
    place = link if alike else element("b", link)
    return [
        element("th", place, scope="row"),
        *(cell("" if side is None else words(side)) for side in (a, b)),
    ]


def _link(way: Course, a: Place | None, b: Place | None, words: str) -> Markup:
    """Return a link to a step of the first run or, if the first run has no such step, to the step of the second run."""
    if a is not None:
        return to_moment(way.at(a, 0), words)
    return element("span", words) if b is None else to_moment(way.at(b, 1), words)


def _seconds(found: Comparison) -> Markup:
    rows = [
        [
            element("th", stage.name, scope="row"),
            *_figures(*stage.seconds),
        ]
        for stage in found.stages
    ]
    rows.append([element("th", "all", scope="row"), *_figures(found.a.seconds, found.b.seconds)])
    return table([*heads("stage"), *figure_heads(*_BOTH, "B - A")], rows, label="seconds by stage")


def _figures(a: float | None, b: float | None) -> Iterator[Markup]:
    for seconds in (a, b):
        yield figure_cell("" if seconds is None else f"{seconds:.1f}")
    yield figure_cell("" if a is None or b is None else f"{b - a:+z.1f}")
