"""Both runs of a comparison to walk round in, under one slider."""

from collections.abc import Iterator
from typing import Final

from handeye.comparison.course import Course
from handeye.comparison.place import Place
from handeye.comparison.wording import place_words
from handeye.core.markup import Markup
from handeye.core.plain_text import printable
from handeye.report.page.elements import element, note
from handeye.report.page.moments import json_markup

SIDES: Final = (("A", "a"), ("B", "b"))
"""Letters of the runs, as people read them and as the parts of the page are named."""
_SPEEDS: Final = (1, 4, 16, 64)
_USUAL: Final = 4


def view(way: Course, lacking: str) -> Iterator[Markup]:
    """Both views, and the controls of both.

    Args:
        lacking: why there is nothing to walk round in; empty: there is.
    """
    if lacking:
        yield element("p", f"There is nothing to walk round in: {lacking}", class_="missing")
    yield element("div", *(_side(letter, name) for letter, name in SIDES), class_="sides")
    yield element("p", id="instead", class_="missing", hidden=True)
    yield _controls(way)
    yield note(
        "Step stands beside step: where a run took longer over one, or did one that the other did not, the other waits."
    )


def _side(letter: str, name: str) -> Markup:
    told = f"the cell of run {letter} at this moment; arrows walk round it, plus and minus come nearer and go farther"
    canvas = element("canvas", id=f"view-{name}", hidden=True, tabindex="0", role="img", aria_label=told)
    clock = element("output", id=f"clock-{name}", for_="time")
    line = element("span", id=f"line-{name}")
    caption = element("p", element("b", letter, " ", clock), line, class_="caption")
    return element("div", element("div", canvas, class_="screen"), caption)


def _controls(way: Course) -> Markup:
    play = element(
        "button", "Play", id="play", type="button", aria_keyshortcuts="Space", title="play, pause: space"
    )
    slider = element(
        "input", id="time", type="range", min="0", max=f"{way.end:.2f}", step="0.01", value="0",
        aria_label="time of both runs", aria_keyshortcuts="ArrowLeft ArrowRight",
    )  # fmt: skip
    options = (element("option", f"{speed} ×", value=speed, selected=speed == _USUAL) for speed in _SPEEDS)
    speed = element("select", *options, id="speed", aria_label="speed")
    views = element("div", id="views", role="group", aria_label="view", class_="views")
    return element("div", play, slider, speed, views, id="controls", class_="controls", hidden=True)


def moments(way: Course) -> Markup:
    """What the script of the page needs to know: where both runs stand, leg by leg."""
    legs = [[leg.begin, leg.a, leg.b, *map(_line, leg.places)] for leg in way.legs]
    return element(
        "script", json_markup([*legs, [way.end, way.a, way.b, "", ""]]), id="moments", type="application/json"
    )


def _line(place: Place | None) -> str:
    return "" if place is None else printable(place_words(place))
