"""Builds the report page of a follower: the outline that was felt, drawn over the true outline, and the findings."""

from collections.abc import Iterator, Mapping, Sequence
from math import hypot
from pathlib import Path
from typing import Final

import msgspec
import numpy as np

from handeye.core.errors import BadFile
from handeye.core.files import read_whole
from handeye.core.markup import Markup, PagePart, element, note, section
from handeye.core.plain_text import counted, printable
from handeye.core.pose import Array
from handeye.core.record import Record
from handeye.core.units import MILLIMETRE
from handeye.report.page.document import MARK, head, resource
from handeye.report.page.plots import Scale, bar, dot, drawing, rule, words
from handeye.report.page.referee import findings_table
from handeye.results.result import Check, restore_figures
from handeye.systems.ml.follow.circuit import Felt
from handeye.systems.ml.follow.names import OutlineName
from handeye.systems.ml.follow.referee import FELT, RADIUS, distance
from handeye.systems.ml.machine.spec import LINEAR

FOLLOWED: Final = "follow.json"
_LARGEST: Final = 1_000_000  # bytes
_MAX_PLACE: Final = 1e5  # units
_MM: Final = LINEAR / MILLIMETRE
_WIDE, _HIGH = 960.0, 520.0
_PLAN: Final = (20.0, 500.0)  # left and right ends of the drawing that shows the plate from above
_BARS: Final = (560.0, 940.0)
_LEVEL: Final = 260.0  # y in the chart where the wand's surface is on the outline
_DEEP: Final = 60.0  # length of the bar that stands for one millimetre
_FAR: Final = 200.0  # units: distance of the points from which the direction away from the plate is computed


class FollowReport(Record, frozen=True, kw_only=True):
    """The touches that a follower has felt, and the true outline of the plate."""

    outline: OutlineName
    world: str
    end: str  # the end of the run in words
    exit_code: int
    felt: Felt
    true: tuple[tuple[float, float], ...]  # corners of the plate, x and y in units of the slides
    checks: Mapping[str, Check] = {}


def follow_page(done: FollowReport, parts: Sequence[PagePart] = ()) -> bytes:
    """Return the page of a report. It ends with `parts`."""
    title = f"Follow, {done.outline}: {_VERDICTS.get(done.exit_code, 'stopped')}"
    felt = done.felt
    facts = (
        f"MOS and ML, on the rectilinear arm in the world of {done.world}; {counted(len(felt.touches), 'touch')}, "
        f"{counted(felt.left, 'left turn')}, {counted(felt.right, 'right turn')}, {counted(felt.idle, 'square')} "
        f"(sides of one step) without a touch, in {counted(felt.statements, 'statement')}."
    )
    body = element(
        "body",
        element("header", element("h1", title), class_="failed" if done.exit_code else None),
        element(
            "main",
            note(facts),
            element("p", f"{printable(done.end[:1].upper() + done.end[1:])}."),
            *_sections(done),
            *(part.markup for part in parts),
        ),
        *(element("script", Markup(part.script)) for part in parts),
    )
    style = resource("page.css") + "".join(part.style for part in parts)
    page = element("html", head(title, style, [part.script for part in parts]), body, lang="en")
    return f"{MARK}{page}\n".encode()


_VERDICTS: Final = {0: "right", 3: "done, but the referee disagrees"}


def _sections(done: FollowReport) -> Iterator[Markup]:
    yield section("outline", "The outline", *_outline(done))
    if done.checks:
        yield section("found", "Measurements of the referee", findings_table(done.checks.values()))


def _outline(done: FollowReport) -> Iterator[Markup]:
    yield note(
        "Left: the plate as it truly lies, seen from above, and the places at which the wand touched, numbered in "
        "order. The base of the arm is at the top. Right: the distance of the wand's surface from the true outline at "
        "each touch. Where a bar points down, the computed place is inside the plate, because the wand has bent."
    )
    yield element("figure", _drawn(done), class_="chart")


def _drawn(done: FollowReport) -> Markup:
    true, touches = np.array(done.true), np.array(done.felt.touches).reshape(-1, 2)
    return drawing(
        *_plan(true, touches),
        *_depths(true, touches),
        wide=_WIDE,
        high=_HIGH,
        label="The outline that the wand felt, drawn over the true outline, and the errors of the touches",
    )


def _plan(true: Array, touches: Array) -> Iterator[Markup]:
    points = np.concatenate((true, touches))
    middle, half = (points.max(axis=0) + points.min(axis=0)) / 2, float(np.ptp(points, axis=0).max()) * 0.54
    xs = Scale(middle[0] - half, middle[0] + half, *_PLAN)
    ys = Scale(middle[1] - half, middle[1] + half, *_PLAN)
    yield element("polygon", points=_points(xs, ys, true), class_="block")
    yield element("polyline", points=_points(xs, ys, touches), class_="outline")
    for number, (x, y) in enumerate(touches.tolist(), 1):
        yield dot(xs(x), ys(y), 2.5, class_="moved")
        aside = _outwards(np.array([x, y]), true)
        yield words(xs(x) + aside[0], ys(y) + aside[1] + 3.5, str(number), anchor="middle")
    inch = xs(1000) - xs(0)
    yield rule(_PLAN[0], _HIGH - 6, _PLAN[0] + inch, _HIGH - 6, class_="axis")
    yield words(_PLAN[0] + inch + 6, _HIGH - 2, "one step: 1000 units, or one inch")


def _outwards(at: Array, true: Array) -> Array:
    """Return the offset (in units of the drawing) from a touch to its number in the drawing. The offset points away
    from the plate.
    """
    slope = [distance(at + step, true) - distance(at - step, true) for step in np.eye(2) * _FAR]
    return 11 * np.array(slope) / max(hypot(*slope), 1.0)


def _depths(true: Array, touches: Array) -> Iterator[Markup]:
    """Draw the distance of the wand's surface from the plate at each touch."""
    off = [distance(touch, true) * _MM - RADIUS for touch in touches]
    width = (_BARS[1] - _BARS[0]) / max(len(off), 1)
    yield rule(_BARS[0], _LEVEL, _BARS[1], _LEVEL, class_="axis")
    for limit in (-FELT, FELT):
        yield rule(_BARS[0], _LEVEL - limit * _DEEP, _BARS[1], _LEVEL - limit * _DEEP, class_="boundary")
        yield words(_BARS[1], _LEVEL - limit * _DEEP - 4, f"{limit:+g} mm", anchor="end")
    for number, each in enumerate(off):
        high = min(abs(each), 4.0) * _DEEP
        top = _LEVEL if each < 0 else _LEVEL - high
        yield bar(_BARS[0] + number * width + 1, top, width - 2, high, class_="block")
    if off:
        worst = max(off, key=abs)
        yield words(
            _BARS[0], 20, f"{counted(len(off), 'touch')}; the largest distance is {abs(worst):.2f} mm"
        )


def _points(xs: Scale, ys: Scale, points: Array) -> str:
    return " ".join(f"{xs(x):.1f},{ys(y):.1f}" for x, y in points.tolist())


def follow_files(done: FollowReport, report: str, parts: Sequence[PagePart]) -> dict[str, bytes]:
    """Return the files of a finished run; `report` is the name of the page."""
    written = msgspec.json.format(msgspec.json.encode(done), indent=1) + b"\n"
    return {
        FOLLOWED: written,
        report: follow_page(_read(written, FOLLOWED), parts),
    }  # the same page as that of `kept_page`


def kept_page(folder: Path, parts: Sequence[PagePart]) -> bytes | None:
    """Build the report page again from the folder of a run. Returns None if the folder has no record of a follower."""
    path = folder / FOLLOWED
    return follow_page(_read(read_whole(path, _LARGEST), str(path)), parts) if path.is_file() else None


def _read(data: bytes, name: str) -> FollowReport:
    try:
        written = msgspec.json.decode(data)
        if isinstance(written, dict):
            restore_figures(written.get("checks"))
        done = msgspec.convert(written, FollowReport)
    except (msgspec.DecodeError, msgspec.ValidationError, UnicodeDecodeError, RecursionError) as error:
        raise BadFile(f"{name} is not a record of a follower: {error}") from None
    places = [place for point in (*done.true, *done.felt.touches) for place in point]
    if not done.true or any(abs(place) > _MAX_PLACE for place in places):
        raise BadFile(f"{name} is not a record of a follower: a place is impossibly far away")
    return done
