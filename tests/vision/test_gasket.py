"""Inspecting the gasket by the difference of two pictures (reference 8, rows 51 to 53)."""

import dataclasses
import math

import cv2
import msgspec
import numpy as np
import pytest
from synthetic import FACE, GASKET, Canvas, draw_base, part, view

from handeye.core.units import DEGREE, INCH
from handeye.program.diagnosis.causes import (
    BaseHoleUnseen,
    GasketHoleOff,
    GasketHoleUnseen,
    GasketTorn,
    GasketWrong,
    NoGasket,
)
from handeye.vision import gasket
from handeye.vision.characteriser import Blob, characterise
from handeye.vision.drawing import annotate
from handeye.vision.gasket import GasketInspection, difference, inspect
from handeye.vision.hole_search import hole_places
from handeye.vision.marks import GREEN, RED, marks
from handeye.vision.scan import Scan

PART = part(180 * DEGREE)
POSE = (PART.at[0], PART.at[1], PART.at[3])
WHERE = view(0.050, (POSE[0] - 1.4 * INCH, POSE[1], 2.75 * INCH))


def pictures(
    shift: tuple[float, float] | None,
    seed: int = 0,
    noise: float = 1.0,
    torn: tuple[float, float, float] | None = None,
) -> tuple[np.ndarray, np.ndarray]:
    """Before, and after a gasket was put on, off by `shift` (in); None: no gasket. A disc of it is missing: `torn`
    holds the centre and the diameter of the disc (in, in the frame of the part)."""
    rng = np.random.default_rng(seed)
    before, after = Canvas(), Canvas()
    draw_base(before, WHERE, PART, POSE)
    draw_base(after, WHERE, PART, POSE)
    if shift is not None:
        move = np.array([*shift, 0]) * INCH
        keep = after.fine.copy()
        turns = np.linspace(0, 2 * np.pi, 90, endpoint=False)
        circle = np.column_stack([np.cos(turns), np.sin(turns), np.zeros(90)]) * INCH / 2
        discs = [p + move + w * circle for p, w in zip(hole_places(PART, POSE), (3.9, 2.3), strict=True)]
        sheet = WHERE.project(np.concatenate(discs)).astype(np.float32)
        after.polygon(cv2.convexHull(sheet).reshape(-1, 2), GASKET)
        gasket = after.fine.copy()
        for place, hole in zip(hole_places(PART, POSE), PART.holes, strict=True):
            after.disc(WHERE, place + move, hole.diameter + 0.05 * INCH, -1)
        if torn is not None:
            x, y, wide = torn  # the part is turned by half a turn
            after.disc(WHERE, hole_places(PART, POSE)[0] - np.array([x, y, 0]) * INCH, wide * INCH, -1)
        after.fine = np.where(after.fine < 0, keep, gasket)
    return before.picture(rng, noise), after.picture(rng, noise)


def inspected(shift: tuple[float, float] | None, **how: object) -> GasketInspection:
    return inspect(*pictures(shift, **how), WHERE, PART, POSE)


def test_the_difference_of_a_picture_with_itself_is_nothing():
    before, _ = pictures(None)
    assert not difference(before, before).any()


@pytest.mark.parametrize("direction", range(0, 360, 90))
def test_a_picture_that_lies_two_points_off_shows_the_same_gasket(direction: int):
    before, after = pictures((0.3, 0.0))
    rolled = np.roll(
        after, (round(2 * math.sin(direction * DEGREE)), round(2 * math.cos(direction * DEGREE))), (0, 1)
    )
    seen = inspect(before, rolled, WHERE, PART, POSE)
    assert seen.shift == pytest.approx(inspect(before, after, WHERE, PART, POSE).shift, abs=0.03 * INCH)


@pytest.mark.row(51)
@pytest.mark.parametrize("noise", [1.0, 1.5, 2.0])
def test_a_gasket_in_its_place_is_accepted_in_noise(noise: float):
    seen = inspected((0.01, -0.01), noise=noise)
    assert seen.ok, seen.cause


@pytest.mark.parametrize("way", [(0.6, 0.0), (-0.6, 0.0), (0.0, 0.6), (0.0, -0.6)])
@pytest.mark.parametrize("shift", [(0.01, -0.01), (0.3, 0.0), None])
def test_a_mount_that_stands_half_a_degree_beside_its_potentiometers_changes_no_verdict(
    way: tuple[float, float], shift: tuple[float, float] | None
):
    before, after = pictures(shift)
    believed = dataclasses.replace(WHERE, pan=WHERE.pan + way[0] * DEGREE, tilt=WHERE.tilt + way[1] * DEGREE)
    seen, straight = inspect(before, after, believed, PART, POSE), inspected(shift)
    assert (seen.ok, type(seen.cause)) == (straight.ok, type(straight.cause))


@pytest.mark.parametrize("scale", [0.95, 1.05])
@pytest.mark.parametrize("shift", [(0.01, -0.01), (0.3, 0.0), None])
def test_a_camera_whose_scale_is_a_twentieth_off_changes_no_verdict(
    scale: float, shift: tuple[float, float] | None
):
    before, after = pictures(shift)
    lens = dataclasses.replace(WHERE.lens, scale=WHERE.lens.scale * scale)
    seen = inspect(before, after, dataclasses.replace(WHERE, lens=lens), PART, POSE)
    straight = inspected(shift)
    assert (seen.ok, type(seen.cause)) == (straight.ok, type(straight.cause))


@pytest.mark.row(52)
@pytest.mark.parametrize("direction", range(0, 360, 45))
def test_a_gasket_off_by_three_tenths_of_an_inch_is_rejected(direction: int):
    angle = direction * DEGREE
    seen = inspected((0.3 * math.cos(angle), 0.3 * math.sin(angle)))
    assert not seen.ok
    assert isinstance(seen.cause, GasketWrong)
    assert {type(fault) for fault in seen.cause.faults} <= {GasketHoleOff, GasketHoleUnseen, BaseHoleUnseen}


def test_the_characteriser_that_finds_the_base_looks_at_the_expected_centres_in_both_pictures(monkeypatch):
    asked = []

    def noted(scan: Scan, seed: tuple[float, float], *how: float, **more: float) -> Blob | None:
        asked.append((seed, characterise(scan, seed, *how, **more)))
        return asked[-1][1]

    monkeypatch.setattr(gasket, "characterise", noted)
    seen = inspected((0.01, -0.01))
    seeds, blobs = zip(*asked[gasket.ROUNDS :], strict=True)
    assert np.array(seeds) == pytest.approx(np.repeat(seen.expected, 2, axis=0), abs=1.0)
    assert all(blobs)
    centres = np.array([(blob.u, blob.v) for blob in blobs[1::2]])
    assert centres == pytest.approx(np.array(seen.found), abs=1.0)


def test_the_shift_of_a_gasket_is_measured_on_its_rim():
    seen = inspected((0.2, 0.0))
    assert seen.shift == pytest.approx(0.2 * INCH, abs=0.06 * INCH)


MISSING = {"at a screw hole": (1.03, 1.23, 0.6), "between the large holes": (1.75, 0.0, 0.4)}


@pytest.mark.parametrize("noise", [1.0, 1.5])
@pytest.mark.parametrize("torn", MISSING.values(), ids=MISSING)
def test_a_gasket_in_its_place_with_a_piece_missing_is_rejected(
    torn: tuple[float, float, float], noise: float
):
    seen = inspected((0.01, -0.01), noise=noise, torn=torn)
    assert isinstance(seen.cause, GasketWrong)
    assert [type(fault) for fault in seen.cause.faults] == [GasketTorn]


def test_the_bare_area_of_a_hole_in_the_sheet_is_measured():
    seen = inspected((0.0, 0.0), torn=(1.75, 0.0, 0.4))
    assert isinstance(seen.cause, GasketWrong)
    assert seen.cause.faults[0].bare == pytest.approx(math.pi * (0.2 * INCH) ** 2, rel=0.15)


def test_a_part_without_screw_holes_is_not_examined_for_a_torn_gasket():
    unknown = msgspec.structs.replace(PART, screw_holes=())
    assert inspect(*pictures((0.0, 0.0), torn=(1.75, 0.0, 0.4)), WHERE, unknown, POSE).ok


@pytest.mark.row(53)
def test_an_absent_gasket_is_rejected():
    seen = inspected(None)
    assert not seen.ok
    assert seen.cause == NoGasket()
    assert seen.found == (None, None)


def test_a_gasket_whose_hole_is_not_in_the_picture_is_not_accepted_and_the_hole_is_named():
    elsewhere = view(0.050, (POSE[0] + 5 * INCH, POSE[1], 2.75 * INCH))  # the second hole is at its edge
    before, after = pictures((0.0, 0.0))
    seen = inspect(before, after, elsewhere, PART, POSE)
    assert seen.cause == GasketWrong(faults=(BaseHoleUnseen(hole="second"),))


@pytest.mark.row(52)
def test_expected_crosses_and_found_dots_are_drawn():
    before, after = pictures((0.3, 0.0))
    seen = inspect(before, after, WHERE, PART, POSE)
    image = annotate(after, marks(inspection=seen), scale=3)
    u, v = seen.expected[0]
    assert image.shape == (768, 999, 3)
    assert tuple(image[round((v + 0.5) * 3), round((u + 0.5) * 3) + 10]) == RED[::-1]


@pytest.mark.row(51)
@pytest.mark.row(52)
@pytest.mark.parametrize(("shift", "colour"), [((0.0, 0.0), GREEN), ((0.3, 0.0), RED)])
def test_the_dot_of_a_centre_that_was_found_is_green_only_if_the_gasket_is_right(
    shift: tuple[float, float], colour: tuple[int, int, int]
):
    before, after = pictures(shift)
    seen = inspect(before, after, WHERE, PART, POSE)
    image = annotate(after, marks(inspection=seen), scale=3)
    dots = [found for found in seen.found if found is not None]
    assert dots
    assert {tuple(image[round((v + 0.5) * 3), round((u + 0.5) * 3)]) for u, v in dots} == {colour[::-1]}


def test_a_gasket_needs_a_face_brighter_than_itself():
    assert FACE > GASKET
