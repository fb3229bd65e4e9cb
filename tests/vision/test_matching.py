"""A part that has moved between two pictures is told from one that stands, whatever it looks like."""

import numpy as np
import pytest
from synthetic import FINE, Canvas, draw_base, part, view

from handeye.core.units import DEGREE, INCH
from handeye.program.diagnosis.causes import FaintPicture, OutsidePicture, PartAstray
from handeye.vision.base import Failure, PartMatch
from handeye.vision.matching import FAINT, MOVED, match

PART = part(180 * DEGREE)
POSE = (PART.at[0], PART.at[1], PART.at[3])
WHERE = view(0.050, (POSE[0] - 1.4 * INCH, POSE[1], 2.75 * INCH))
NOISE = 1.0
"""Levels, as of the vidicon."""


def picture(
    seed: int,
    by: tuple[float, float] | None = (0.0, 0.0),
    turn: float = 0.0,
    dark: bool = False,
    head: float = 0.0,
) -> np.ndarray:
    """A base moved by so much (in) and turned (rad), or none, on a belt with the edge of something else.

    A screw head on it, 7 points wide, is brighter than the base by `head` levels.
    """
    rng = np.random.default_rng(seed)
    canvas = Canvas()
    canvas.fine[:, :160] = 8
    canvas.fine[:60] = 10
    if by is not None:
        there = (POSE[0] + by[0] * INCH, POSE[1] + by[1] * INCH, POSE[2] + turn)
        draw_base(canvas, WHERE, PART, there)
    u, v = np.rint(WHERE.project(np.array([[POSE[0], POSE[1], PART.at[2] + PART.face]]))[0] * FINE).astype(
        int
    )
    canvas.fine[v - 3 * FINE : v + 4 * FINE, u - 3 * FINE : u + 4 * FINE] += head
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


def test_a_part_that_is_not_wholly_in_the_picture_cannot_be_matched() -> None:
    elsewhere = (POSE[0] + 6 * INCH, POSE[1], POSE[2])
    assert match(picture(1), picture(2), WHERE, PART, elsewhere) == Failure(cause=OutsidePicture())


def test_the_outline_is_where_the_part_should_be_in_the_second_picture() -> None:
    still, drifted = (np.array(matched(picture(2), drift).outline) for drift in ((0, 0), (2, -1)))
    assert drifted - still == pytest.approx(np.tile([-1, 2], (len(still), 1)), abs=0.1)
