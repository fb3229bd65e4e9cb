"""A part that has moved between two pictures is told from one that stands, whatever it looks like."""

import numpy as np
import pytest
from msgspec import structs
from synthetic import FINE, HOLE, PLATE, Canvas, draw_base, part, view

from handeye.core.units import DEGREE, INCH
from handeye.program.diagnosis.causes import DarkPart, FaintPicture, OutsidePicture, PartAstray
from handeye.vision.base import Failure, PartMatch
from handeye.vision.hole_search import hole_places
from handeye.vision.matching import DARK, FAINT, MOVED, match

PART = part(180 * DEGREE)
POSE = (PART.at[0], PART.at[1], PART.at[3])
WHERE = view(0.050, (POSE[0] - 1.4 * INCH, POSE[1], 2.75 * INCH))
LIT, DULL = 10, 5  # levels
NOISE = 1.0
"""Levels, as of the vidicon."""


def picture(
    seed: int,
    by: tuple[float, float] | None = (0.0, 0.0),
    turn: float = 0.0,
    dark: bool = False,
    head: float = 0.0,
    shade: float = 1.0,
    backlit: bool = False,
) -> np.ndarray:
    """A base moved by so much (in) and turned (rad), or none, on a belt with the edge of something else.

    A screw head on it, 7 points wide, is brighter than the base by `head` levels. From the screw head to the left, a
    shadow leaves the fraction `shade` of the light. If the lamp is behind the base
    (`backlit`), only a block on the base is dark.
    """
    rng = np.random.default_rng(seed)
    canvas = Canvas(LIT - 1) if backlit else Canvas()
    canvas.fine[:, :160] = 13 if backlit else 8
    canvas.fine[:60] = DULL if backlit else 10
    if by is not None:
        there = (POSE[0] + by[0] * INCH, POSE[1] + by[1] * INCH, POSE[2] + turn)
        draw_base(canvas, WHERE, PART, there)
    u, v = np.rint(WHERE.project(np.array([[POSE[0], POSE[1], PART.at[2] + PART.face]]))[0] * FINE).astype(
        int
    )
    canvas.fine[canvas.fine == PLATE] = LIT  # as bright as the plate of a pump that the lamp lights
    if backlit:
        canvas.fine[canvas.fine == HOLE] = LIT - 1
        canvas.fine[v - 6 * FINE : v + 6 * FINE, u - 70 * FINE : u - 30 * FINE] = DULL
    canvas.fine[v - 3 * FINE : v + 4 * FINE, u - 3 * FINE : u + 4 * FINE] += head
    canvas.fine[:, : u + 20 * FINE] *= shade
    if dark:
        canvas.fine /= 4
    return canvas.picture(rng, NOISE)


def matched(after: np.ndarray, drift: tuple[int, int] = (0, 0)) -> PartMatch:
    """Whether the base stands where it stood, in a picture that lies so many points (lines, columns) off."""
    found = match(picture(1), np.roll(after, drift, (0, 1)), WHERE, PART, POSE)
    assert isinstance(found, PartMatch)
    return found


@pytest.mark.parametrize("drift", [(0, 0), (2, -1), (-3, 3)])
def test_a_part_that_stands_is_matched_wherever_the_picture_lies(drift: tuple[int, int]) -> None:
    found = matched(picture(2), drift)
    assert (found.ok, found.cause) == (True, None)
    assert found.shift < MOVED / 3


@pytest.mark.parametrize("drift", [(0, 0), (2, -1)])
@pytest.mark.parametrize("far", [0.05, 0.15])
@pytest.mark.parametrize("way", [(1, 0), (-1, 0), (0, 1), (0, -1)])
def test_a_move_is_measured_against_what_is_around_the_part(
    far: float, way: tuple[int, int], drift: tuple[int, int]
) -> None:
    found = matched(picture(3, (far * way[0], far * way[1])), drift)
    assert isinstance(found.cause, PartAstray)
    assert found.cause.off / INCH == pytest.approx(far, rel=0.2)


@pytest.mark.parametrize("far", [0.3, 0.6, 1.0])
@pytest.mark.parametrize("way", [(1, 0), (-1, 0), (0, 1), (0, -1)])
def test_a_part_that_has_moved_farther_than_pictures_lie_apart_does_not_match(
    far: float, way: tuple[int, int]
) -> None:
    assert not matched(picture(3, (far * way[0], far * way[1]))).ok


def test_a_part_that_was_taken_away_looks_otherwise() -> None:
    assert matched(picture(4, None)).unlike > 0.3


def test_a_screw_head_that_has_gone_does_not_match() -> None:
    found = match(picture(1, head=4), picture(7), WHERE, PART, POSE)
    assert isinstance(found, PartMatch)
    assert found.shift < MOVED / 3
    assert isinstance(found.cause, PartAstray)
    assert 0 < found.unlike < 0.02


def test_a_part_that_is_turned_where_it_stands_does_not_match() -> None:
    assert not matched(picture(5, turn=4 * DEGREE)).ok


def test_a_light_that_has_gone_out_does_not_match() -> None:
    assert matched(picture(6, dark=True)).unlike > 0.3


def test_an_earlier_picture_too_faint_to_show_a_missing_head_is_no_match() -> None:
    before = picture(1, head=4, dark=True)
    for after in picture(7, dark=True), picture(7):
        found = match(before, after, WHERE, PART, POSE)
        assert isinstance(found, Failure)
        assert isinstance(found.cause, FaintPicture)
        assert found.cause.contrast < found.cause.least == FAINT


def test_under_a_lamp_behind_the_part_a_missing_head_is_noticed() -> None:
    whole, without = picture(1, head=2.5, backlit=True), picture(7, backlit=True)
    assert isinstance(found := match(whole, picture(2, head=2.5, backlit=True), WHERE, PART, POSE), PartMatch)
    assert found.ok
    assert isinstance(found := match(whole, without, WHERE, PART, POSE), PartMatch)
    assert isinstance(found.cause, PartAstray)


def test_a_part_in_a_shadow_too_deep_to_show_a_missing_head_is_no_match() -> None:
    before, after = picture(1, head=4, shade=0.4), picture(7, shade=0.4)
    assert isinstance(
        seen := match(before, after, WHERE, PART, POSE), Failure
    )  # though the pictures look alike
    assert isinstance(seen.cause, DarkPart)
    assert seen.cause.brightness < seen.cause.least == DARK


def test_dark_sides_do_not_count_if_the_screw_holes_are_known() -> None:
    holes = WHERE.project(hole_places(PART, POSE, screws=True))
    (left, top), (right, bottom) = (holes.min(axis=0) - 4).astype(int), (holes.max(axis=0) + 5).astype(int)
    face = np.s_[top:bottom, left:right]
    before, after = np.array(picture(1, head=4) * 0.4, np.uint8), np.array(picture(2, head=4) * 0.4, np.uint8)
    before[face], after[face] = picture(1, head=4)[face], picture(2, head=4)[face]
    assert isinstance(found := match(before, after, WHERE, PART, POSE), PartMatch)
    assert found.ok
    plain = structs.replace(PART, screw_holes=())
    assert isinstance(seen := match(before, after, WHERE, plain, POSE), Failure)
    assert isinstance(seen.cause, DarkPart)


def test_a_part_that_is_not_wholly_in_the_picture_cannot_be_matched() -> None:
    elsewhere = (POSE[0] + 6 * INCH, POSE[1], POSE[2])
    assert match(picture(1), picture(2), WHERE, PART, elsewhere) == Failure(cause=OutsidePicture())


def test_the_outline_is_where_the_part_should_be_in_the_second_picture() -> None:
    still, drifted = (np.array(matched(picture(2), drift).outline) for drift in ((0, 0), (2, -1)))
    assert drifted - still == pytest.approx(np.tile([-1, 2], (len(still), 1)), abs=0.1)
