"""The page of two runs: both views under one slider, what went otherwise, and what each did, step beside step."""

from collections.abc import Iterator
from pathlib import Path
from typing import Final

from handeye.comparison.comparison import Comparison
from handeye.comparison.course import course
from handeye.comparison.page_sections import sections
from handeye.comparison.page_view import SIDES, moments, view
from handeye.comparison.pairing import TwoRuns
from handeye.comparison.wording import THINNED, place_words, run_words, same_words
from handeye.core.files import Kind
from handeye.core.markup import Markup
from handeye.core.plain_text import printable
from handeye.report import player
from handeye.report.animation import Animation
from handeye.report.page.document import head, packed, resource
from handeye.report.page.elements import element, section
from handeye.report.recorded import Recorded

_MARK: Final = "<!doctype html>\n<!-- handeye comparison -->\n"
PAGE: Final = Kind("comparison of handeye", _MARK.encode(), ending=".html")
Animations = tuple[Animation, Animation]


def comparison_page(a: Recorded, b: Recorded, found: Comparison, animated: Animations | str) -> bytes:
    """The page of two runs; the same for the same traces.

    Args:
        animated: what is shown of both to walk round in; or why there is nothing, a sentence.
    """
    way = course(TwoRuns(a, b))
    views, lacking = ((), animated) if isinstance(animated, str) else (animated, "")
    scripts = [*([player.script()] if views else []), _own("page.js")]
    body = element(
        "body",
        _header(found),
        element("main", section("run", "Side by side", *view(way, lacking)), *sections(found, way)),
        moments(way),
        *(each for side, shown in zip(SIDES, views, strict=False) for each in _carried(side[1], shown)),
        *(element("script", Markup(script)) for script in scripts),
    )
    name = printable(f"{a.trace.head.program} and {b.trace.head.program} compared")
    style = resource("page.css") + _own("page.css")
    return (_MARK + element("html", head(name, style, scripts), body, lang="en") + "\n").encode()


def _header(found: Comparison) -> Markup:
    runs = (
        element("p", element("b", letter), " ", run_words(run), class_="name")
        for (letter, _), run in zip(SIDES, (found.a, found.b), strict=True)
    )
    thinned = [element("p", THINNED, class_="name")] if found.thinned else []
    return element("header", element("div", element("h1", _title(found)), *runs, *thinned), class_="compared")


def _title(found: Comparison) -> str:
    if found.same:
        return same_words(found).capitalize()
    if found.parted is None:
        return "Both went the same way."
    return f"Their ways part: {place_words(found.parted.place)}."


def _carried(side: str, shown: Animation) -> Iterator[Markup]:
    yield packed(f"scene-{side}", shown.scene)
    yield packed(f"tracks-{side}", shown.tracks)


def _own(name: str) -> str:
    return Path(__file__).with_name(name).read_text(encoding="utf-8")
