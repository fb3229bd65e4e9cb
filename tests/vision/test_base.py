"""Locating the base by its outline and by its holes (reference 8, rows 46 and 54)."""

import math
from dataclasses import replace

import cv2
import numpy as np
import pytest
from synthetic import FINE, Canvas, draw_base, part, view

from handeye.core.errors import InvalidInput
from handeye.core.units import DEGREE, INCH
from handeye.ports.camera import COLUMNS, ROWS
from handeye.program.diagnosis.causes import NoHoles, NoOutline, OutsidePicture
from handeye.vision.base import Failure, GeneralLocation, SpecificLocation, locate_general, locate_specific

PART = part()
POSES = [
    (44.5 * INCH, 28 * INCH, 90 * DEGREE),
    (42.0 * INCH, 24 * INCH, 65 * DEGREE),
    (47.0 * INCH, 32 * INCH, 118 * DEGREE),
    (46.0 * INCH, 25 * INCH, 101 * DEGREE),
]


def wide(pose: tuple[float, float, float], seed: int = 0) -> tuple[np.ndarray, object]:
    """The base in the 25 mm picture of the belt."""
    where = view(0.025, PART.at[:3])
    canvas = Canvas()
    draw_base(canvas, where, PART, pose)
    return canvas.picture(np.random.default_rng(seed), noise=1.0, blur=0.6), where


def close(
    pose: tuple[float, float, float], *, holes: int = 2, blur: float = 0.6
) -> tuple[np.ndarray, object]:
    """The base in the 50 mm picture, aimed at it roughly."""
    where = view(0.050, (pose[0], pose[1] + 1.5 * INCH, 2.75 * INCH))
    canvas = Canvas()
    draw_base(canvas, where, PART, pose, holes=holes)
    return canvas.picture(np.random.default_rng(1), noise=1.0, blur=blur), where


def located(pose: tuple[float, float, float], **how: float) -> SpecificLocation | Failure:
    general = locate_general(*wide(pose), PART)
    assert isinstance(general, GeneralLocation)
    return locate_specific(*close(pose, **how), PART, general)


@pytest.mark.parametrize("pose", POSES)
def test_general_location_comes_within_two_inches(pose):
    found = locate_general(*wide(pose), PART)
    assert isinstance(found, GeneralLocation)
    assert math.hypot(found.x - pose[0], found.y - pose[1]) < 2 * INCH


@pytest.mark.parametrize("pose", POSES)
def test_specific_location_comes_within_a_fiftieth_of_an_inch_if_the_camera_is_known(pose):
    found = located(pose)
    assert isinstance(found, SpecificLocation)
    assert found.pose[:2] == pytest.approx(pose[:2], abs=0.02 * INCH)
    assert found.pose[2] == pytest.approx(pose[2], abs=0.6 * DEGREE)
    assert found.bounce_pose[:2] == pytest.approx(pose[:2], abs=0.06 * INCH)


def test_specific_location_reports_the_two_holes_in_the_picture():
    picture, where = close(POSES[1])
    general = locate_general(*wide(POSES[1]), PART)
    found = locate_specific(picture, where, PART, general)
    first = where.project(np.array([*POSES[1][:2], 2.75 * INCH]))[0]
    assert (found.holes[0].u, found.holes[0].v) == pytest.approx(first, abs=0.5)
    assert found.holes[0].width > found.holes[1].width


@pytest.mark.parametrize("seed", range(4))
def test_the_holes_are_where_threshold_and_contours_find_them(seed: int):
    x, y, yaw = np.random.default_rng(seed).uniform((1.08, 0.62, 1.2), (1.18, 0.8, 1.9))
    picture, _ = close((x, y, yaw))
    found = located((x, y, yaw))
    smooth = cv2.GaussianBlur(picture, (0, 0), 1.5)
    contours, _ = cv2.findContours((smooth < 8).astype(np.uint8), cv2.RETR_CCOMP, cv2.CHAIN_APPROX_NONE)
    moments = [cv2.moments(c) for c in contours]
    centres = np.array([(m["m10"] / m["m00"], m["m01"] / m["m00"]) for m in moments if 250 < m["m00"] < 2500])
    for hole in found.holes:
        assert np.hypot(*(centres - (hole.u, hole.v)).T).min() < 0.5


@pytest.mark.parametrize("pose", POSES)
def test_holes_are_found_where_they_are_expected_by_reading_a_twentieth_of_the_picture(pose):
    assert located(pose).points < COLUMNS * ROWS / 20


def test_holes_that_are_not_where_they_are_expected_are_found_all_the_same():
    general = locate_general(*wide(POSES[0]), PART)
    elsewhere = replace(general, x=general.x + 3 * INCH)
    found = locate_specific(*close(POSES[0]), PART, elsewhere)
    assert found.pose[:2] == pytest.approx(POSES[0][:2], abs=0.02 * INCH)
    assert found.points > located(POSES[0]).points


def test_a_shadow_across_the_border_of_the_largest_hole_does_not_hide_it():
    where, canvas = view(0.050, (POSES[0][0], POSES[0][1] + 1.5 * INCH, 2.75 * INCH)), Canvas()
    draw_base(canvas, where, PART, POSES[0])
    u, v = (where.project(np.array([*POSES[0][:2], 2.75 * INCH]))[0] * FINE).astype(int)
    canvas.fine[v - 8 * FINE : v + 8 * FINE, u + 14 * FINE :] *= 0.25
    picture = canvas.picture(np.random.default_rng(1), noise=1.0, blur=0.6)
    found = locate_specific(picture, where, PART, locate_general(*wide(POSES[0]), PART))
    assert isinstance(found, SpecificLocation)
    assert found.pose[:2] == pytest.approx(POSES[0][:2], abs=0.03 * INCH)


def in_a_shadow(pose: tuple[float, float, float] | None) -> GeneralLocation | Failure:
    """What is found in the wide picture if half of the light falls on the base and on the belt around it, so that the
    face is hardly brighter than the belt beside the shadow.
    """
    where, canvas = view(0.025, PART.at[:3]), Canvas(level=5.0)
    if pose is not None:
        draw_base(canvas, where, PART, pose)
    u, _ = (where.project(np.array([*POSES[0][:2], 2.75 * INCH]))[0] * FINE).astype(int)
    canvas.fine[:, u - 60 * FINE : u + 60 * FINE] *= 0.5
    return locate_general(canvas.picture(np.random.default_rng(2), noise=1.0, blur=0.6), where, PART)


def test_a_base_whose_outline_does_not_stand_out_in_a_shadow_is_found_by_its_holes():
    found = in_a_shadow(POSES[0])
    assert isinstance(found, GeneralLocation)
    assert math.dist((found.x, found.y), POSES[0][:2]) < 0.5 * INCH


def test_a_shadow_on_an_empty_belt_is_not_taken_for_the_base():
    assert in_a_shadow(None) == Failure(cause=NoOutline())


@pytest.mark.row(54)
def test_a_part_whose_largest_hole_is_hidden_is_not_guessed():
    found = located(POSES[0], holes=1)
    assert found == Failure(cause=NoHoles(blobs=1))


def test_a_picture_out_of_focus_gives_no_location_and_says_so():
    found = located(POSES[0], blur=9.0)
    assert found == Failure(cause=NoHoles(blobs=0))


def test_an_empty_belt_gives_no_general_location():
    picture = Canvas().picture(np.random.default_rng(5), noise=1.0)
    found = locate_general(picture, view(0.025, PART.at[:3]), PART)
    assert isinstance(found, Failure)
    assert found.cause == NoOutline()


def test_a_camera_that_looks_elsewhere_gives_no_specific_location():
    general = locate_general(*wide(POSES[0]), PART)
    elsewhere = view(0.050, (0.3, 0.9, 0.0))
    found = locate_specific(Canvas().picture(), elsewhere, PART, general)
    assert isinstance(found, Failure)
    assert found.cause == OutsidePicture()


def test_a_part_without_region_cannot_be_looked_for():
    unknown = type(PART)(at=PART.at, face=PART.face, holes=PART.holes)
    with pytest.raises(InvalidInput, match=r"^vision needs the region and the outline"):
        locate_general(*wide(POSES[0]), unknown)


def test_a_part_with_one_hole_cannot_be_located():
    general = locate_general(*wide(POSES[0]), PART)
    single = type(PART)(at=PART.at, holes=PART.holes[:1])
    with pytest.raises(InvalidInput, match=r"^two holes are needed to locate a part"):
        locate_specific(*close(POSES[0]), single, general)


def test_a_camera_off_by_a_fifth_of_a_degree_puts_the_base_off_by_less_than_a_third_of_an_inch():
    picture, where = close(POSES[0])
    general = locate_general(*wide(POSES[0]), PART)
    found = locate_specific(picture, replace(where, pan=where.pan + 0.2 * DEGREE), PART, general)
    assert 0.1 * INCH < abs(found.pose[0] - POSES[0][0]) < INCH / 3
