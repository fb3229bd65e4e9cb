"""Touches for many periods, bandwidths and speeds, and a page on which a user chooses a period, a bandwidth and a
speed.
"""

from collections.abc import Sequence
from pathlib import Path
from typing import Any, Final

from handeye.core.files import page_kind
from handeye.core.markup import Markup, element, note
from handeye.report.page.document import head, resource
from handeye.report.page.moments import json_markup
from handeye.systems.ml.bench.touch import LIMIT, Touch, worst

PERIODS: Final = (2, 5, 10, 20, 50)  # ms
BANDWIDTHS: Final = (10.0, 20.0, 50.0, 100.0)  # Hz
SPEEDS: Final = (5.0, 10.0, 25.0, 50.0, 100.0, 200.0)  # mm/s
SPEED: Final = 50.0  # the speed that the page shows at first
FORCE: Final = 20.0  # N: force that a touch may reach at the fastest allowed speed
MARK: Final = "<!DOCTYPE html>\n<!-- handeye touches -->\n"
PAGE: Final = page_kind("page of touches", MARK)
_CAPTIONS: Final = {
    "place": (
        "How far (in mm) the slide is below the place of contact, over time. The thin line is the set-point of the "
        "slide. Red marks show when the sensors are read; the long red line is the first reading beyond the limit."
    ),
    "force": "The force (in N) of both fingers together on the block, over time.",
    "ways": (
        "How far (in mm) the slide moves on after the contact, for each speed (in mm/s). There is a curve for each "
        "period of the sensors."
    ),
    "forces": (
        "The greatest force (in N), for each speed (in mm/s). There is a curve for each period of the sensors. A "
        "hollow point means that the jolt at the start of the motion already trips the guard, while the hand is "
        "still in the air."
    ),
}
_EXACT: Final = 0.5  # mm/s


def swept(limit: int = LIMIT) -> list[Touch]:
    """Return the worst touch for each period, bandwidth and speed."""
    return [worst(p, f, v, limit) for p in PERIODS for f in BANDWIDTHS for v in SPEEDS]


def fastest(period: int, bandwidth: float, force: float = FORCE, limit: int = LIMIT) -> float:
    """Return the greatest speed for a guarded touch (mm/s, to within .5 mm/s); 0 if no speed is suitable. At a
    suitable speed, the force of the touch stays within `force` (N), and the start of the motion does not trip the
    guard.
    """

    def right(speed: float) -> bool:
        found = worst(period, bandwidth, speed, limit)
        return found.force <= force and not found.trips

    low, high = 0.0, SPEEDS[-1]
    if right(high):
        return high
    while high - low > _EXACT:
        middle = (low + high) / 2
        low, high = (middle, high) if middle >= 1 and right(middle) else (low, middle)
    return low


def touches_page(touches: Sequence[Touch]) -> bytes:
    """Return a page on which the period, the bandwidth and the speed of a touch can be chosen."""
    script, style = _own("touches.js"), resource("page.css") + _own("touches.css")
    title = "What ten milliseconds are"
    body = element(
        "body",
        element("header", element("h1", title)),
        element(
            "main",
            note(
                f"The hand of the rectilinear arm descends on a block. A reading of more than {touches[0].limit} g "
                "on a strain gauge in a finger ends the motion. The sensors are read once per period. When a "
                "reading is beyond this limit, the present position of the slide becomes the goal of the slide. "
                "For each period, bandwidth and speed, contacts at four phases of the period were simulated; the "
                "page shows the contact with the greatest force."
            ),
            _controls(),
            element("p", id="said", role="status"),
            element(
                "div",
                *(_figure(name, caption) for name, caption in _CAPTIONS.items()),
                class_="charts",
            ),
        ),
        element("script", json_markup(_data(touches)), id="touches", type="application/json"),
        element("script", Markup(script)),
    )
    return f"{MARK}{element('html', head(title, style, [script]), body, lang='en')}\n".encode()


def _controls() -> Markup:
    choices: list[tuple[str, str, Sequence[float], float, str]] = [
        ("period", "period", PERIODS, 10, "ms"),
        ("bandwidth", "bandwidth of the servo", BANDWIDTHS, 50.0, "Hz"),
        ("speed", "speed", SPEEDS, SPEED, "mm/s"),
    ]
    return element(
        "div",
        *(
            element(
                "label",
                element("span", f"{label}: ", element("output", id=f"{name}-shown"), f" {unit}"),
                element(
                    "input", id=name, type="range", min="0", max=str(len(values) - 1), step="1",
                    value=str([*values].index(usual)),
                ),
            )
            for name, label, values, usual, unit in choices
        ),
        class_="choices",
    )  # fmt: skip


def _figure(name: str, caption: str) -> Markup:
    drawing = element("svg", id=name, role="img", aria_label=caption, viewBox="0 0 560 240")
    return element("figure", drawing, element("figcaption", caption))


def _data(touches: Sequence[Touch]) -> dict[str, Any]:
    return {
        "period": PERIODS, "bandwidth": BANDWIDTHS, "speed": SPEEDS, "limit": touches[0].limit,
        "touches": [
            {
                "jolt": each.jolt, "trips": each.trips, "noticed": each.noticed, "way": each.way, "force": each.force,
                "begin": each.times[0], "places": each.places, "goals": each.goals, "forces": each.forces,
                "reading": each.readings[0],
            }
            for each in touches
        ],
    }  # fmt: skip


def _own(name: str) -> str:
    return Path(__file__).with_name(name).read_text(encoding="utf-8")
