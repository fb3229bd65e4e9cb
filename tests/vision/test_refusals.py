"""Vision refuses what is nearly, but not quite, what it looks for."""

import math

import numpy as np
import pytest
from synthetic import HOLE, Canvas, draw_base, part, view

from handeye.core.units import DEGREE, INCH
from handeye.ports.camera import COLUMNS, ROWS
from handeye.program.diagnosis.causes import GasketHoleOff, NoHoles, NoOutline
from handeye.vision.alignment import find_spot
from handeye.vision.base import Failure, GeneralLocation, locate_general, locate_specific
from handeye.vision.beam import BRIGHTER
from handeye.vision.characteriser import Blob, fit_circle, walk
from handeye.vision.gasket import inspect
from handeye.vision.hole_search import Candidate, Pair, classify, hole_places
from handeye.vision.scan import Scan

PART = part()
LARGE, SMALL = PART.holes
BLOB = Blob(u=0.0, v=0.0, width=1.0, height=1.0, bounces=2)
MIDDLE = np.array([44.5, 28.0, 2.75]) * INCH
CLOSE = view(0.050, tuple(MIDDLE))


def test_a_line_two_points_wide_is_no_edge_of_its_full_height():
    picture = np.full((ROWS, COLUMNS), 3, np.uint8)
    picture[:, 120:122] = 11
    assert walk(Scan(picture), (20, 100), (1, 0), BRIGHTER, 6, 200) is None


def pair(large: float = 1.0, small: float = 1.0, distance: float = 1.0, turn: float = 0.0) -> Pair | None:
    """The two holes found on a part as drawn, but for these shares, and turned by so many degrees."""
    angle = PART.at[3] + turn * DEGREE
    away = distance * math.hypot(SMALL.x - LARGE.x, SMALL.y - LARGE.y)
    first = Candidate(BLOB, 1.0, 1.0, large * LARGE.diameter)
    second = Candidate(
        BLOB, 1.0 + away * math.cos(angle), 1.0 + away * math.sin(angle), small * SMALL.diameter
    )
    return classify([first, second], PART)


@pytest.mark.parametrize("as_drawn", [{}, {"large": 1.15, "small": 1.15}, {"distance": 1.12}, {"turn": 45}])
def test_two_holes_that_agree_with_the_part_are_taken_for_its_own(as_drawn: dict[str, float]):
    assert pair(**as_drawn) is not None


@pytest.mark.parametrize(
    "other",
    [{"large": 1.3, "small": 1.3}, {"small": 1.35}, {"distance": 1.25}, {"distance": 0.75}, {"turn": 60}],
)
def test_two_holes_of_another_part_are_refused(other: dict[str, float]):
    assert pair(**other) is None


def test_a_base_whose_screw_holes_are_missing_is_refused():
    pose = (44.5 * INCH, 28 * INCH, 90 * DEGREE)
    wide, close = Canvas(), Canvas()
    aimed = view(0.025, PART.at[:3]), view(0.050, (pose[0], pose[1] + 1.5 * INCH, 2.75 * INCH))
    for canvas, where in zip((wide, close), aimed, strict=True):
        draw_base(canvas, where, PART, pose, screws=False)
    general = locate_general(wide.picture(), aimed[0], PART)
    assert isinstance(general, GeneralLocation)
    found = locate_specific(close.picture(), aimed[1], PART, general)
    assert isinstance(found, Failure)
    assert isinstance(found.cause, NoHoles)


@pytest.mark.parametrize("size", [0.8, 12.0])
def test_a_bright_thing_much_smaller_or_larger_than_the_part_is_refused(size: float):
    where, canvas = view(0.025, PART.at[:3]), Canvas()
    canvas.disc(where, np.array(PART.at[:3]), size * INCH, 12)
    assert locate_general(canvas.picture(), where, PART) == Failure(cause=NoOutline())


def test_a_spot_no_brighter_than_noise_is_no_lamp():
    dark = np.zeros((ROWS, COLUMNS), np.uint8)
    faint = dark.copy()
    faint[100:103, 200:203] = 2
    assert find_spot(dark, faint) is None


def test_points_that_lie_off_a_circle_do_not_move_its_centre():
    angles = np.linspace(0, 2 * np.pi, 24, endpoint=False)
    radius = np.where(np.arange(24) < 5, 0.8, 1.0) * LARGE.diameter / 2
    ring = np.column_stack([radius * np.cos(angles), radius * np.sin(angles), np.zeros(24)])
    centre = fit_circle(CLOSE, CLOSE.project(MIDDLE + ring), float(MIDDLE[2]), LARGE.diameter)
    assert centre == pytest.approx(MIDDLE[:2], abs=1e-5)


@pytest.mark.filterwarnings("error")
def test_border_points_that_coincide_give_no_circle():
    points = CLOSE.project(np.tile(MIDDLE, (24, 1)))
    assert fit_circle(CLOSE, points, float(MIDDLE[2]), LARGE.diameter) is None


def test_a_gasket_hole_whose_centre_alone_is_too_far_off_is_refused():
    """A gasket lighter than the hole beneath shows its own hole whole: the rim bulges less than the centre moves."""
    base, before, after = part(180 * DEGREE), Canvas(), Canvas()
    pose = (base.at[0], base.at[1], base.at[3])
    where = view(0.050, (pose[0] - 1.4 * INCH, pose[1], 2.75 * INCH))
    draw_base(before, where, base, pose)
    draw_base(after, where, base, pose)
    sound = after.fine.copy()
    places, off = hole_places(base, pose), np.array([0.105, 0, 0]) * INCH
    for place, diameter in zip(places, (3.9, 2.3), strict=True):
        after.disc(where, place + off, diameter * INCH, HOLE + 4)
    covered = after.fine.copy()
    for place, hole in zip(places, base.holes, strict=True):
        after.disc(where, place + off, hole.diameter, -1)
    after.fine = np.where(after.fine < 0, sound, covered)
    seen = inspect(before.picture(), after.picture(), where, base, pose)
    assert not seen.ok
    assert {type(fault) for fault in seen.cause.faults} == {GasketHoleOff}
