"""Beam, blob localiser and convex blob characteriser (reference 8, rows 47 to 49)."""

import math
from collections.abc import Callable

import cv2
import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

import handeye
from handeye.ports.camera import COLUMNS, ROWS
from handeye.vision.beam import BRIGHTER, DARKER, Edge, Polarity, beams
from handeye.vision.blob import localise
from handeye.vision.characteriser import characterise, walk
from handeye.vision.scan import Scan

Place = tuple[float, float]
Beam = Callable[..., Edge | None]


def step_picture() -> np.ndarray:
    """Level 3 left of the middle of column 120, level 11 right of it."""
    picture = np.full((ROWS, COLUMNS), 3, np.uint8)
    picture[:, 120:] = 11
    return picture


def ellipse(width: float, height: float, inside: int = 3, outside: int = 11) -> np.ndarray:
    """An ellipse about (160, 120), its axes along the picture's."""
    v, u = np.mgrid[0:ROWS, 0:COLUMNS]
    within = ((u - 160) / (width / 2)) ** 2 + ((v - 120) / (height / 2)) ** 2 <= 1
    return np.where(within, inside, outside).astype(np.uint8)


def one_of_many(scan: Scan, start: Place, direction: Place, *how: float, **more: float) -> Edge | None:
    """A beam sent at once with another, which is outside the picture."""
    starts, directions = np.array([(-9, -9), start]), np.array([(0, 1), direction], float)
    return beams(scan, starts, directions, *how, **more).edge(1)


EITHER = pytest.mark.parametrize("beam", [one_of_many, walk])


@pytest.mark.row(47)
@EITHER
def test_a_beam_meets_a_step_where_it_is(beam: Beam):
    edge = beam(Scan(step_picture()), (20, 100), (1, 0), BRIGHTER, 4, 200)
    assert edge is not None
    assert edge.u == pytest.approx(119.5, abs=0.01)
    assert (edge.before, edge.after) == (3, 11)


@EITHER
@pytest.mark.parametrize("start", [19.6, 20.0, 20.4])
def test_where_in_a_point_a_beam_starts_does_not_move_what_it_meets(beam: Beam, start: float):
    edge = beam(Scan(step_picture()), (start, 100.4), (1, 0), BRIGHTER, 4, 200)
    assert edge is not None
    assert (edge.u, edge.v) == pytest.approx((119.5, 100), abs=0.01)


@pytest.mark.row(47)
@EITHER
def test_a_beam_finds_nothing_below_its_threshold(beam: Beam):
    assert beam(Scan(step_picture()), (20, 100), (1, 0), BRIGHTER, 8.5, 200) is None


@EITHER
def test_a_beam_finds_only_the_polarity_it_is_asked_for(beam: Beam):
    assert beam(Scan(step_picture()), (20, 100), (1, 0), DARKER, 4, 200) is None
    assert beam(Scan(step_picture()), (220, 100), (-1, 0), DARKER, 4, 200) is not None


@EITHER
def test_a_beam_goes_no_farther_than_its_reach(beam: Beam):
    assert beam(Scan(step_picture()), (20, 100), (1, 0), BRIGHTER, 4, 90) is None


@EITHER
def test_a_beam_goes_no_farther_than_its_window(beam: Beam):
    scan = Scan(step_picture())
    scan.limit(np.array([[10, 10], [118, 10], [118, 245], [10, 245]], float))
    assert beam(scan, (20, 100), (1, 0), BRIGHTER, 4, 200) is None


@EITHER
def test_a_beam_that_starts_outside_the_picture_finds_nothing(beam: Beam):
    assert beam(Scan(step_picture()), (-30, 100), (1, 0), BRIGHTER, 4, 200) is None


@EITHER
def test_a_beam_passes_over_a_step_that_leads_to_less_than_it_asks_for(beam: Beam):
    picture = step_picture()
    picture[:, 60:120] = 7
    edge = beam(Scan(picture), (20, 100), (1, 0), BRIGHTER, 3, 200, beyond=9)
    assert edge is not None
    assert edge.u == pytest.approx(119.5, abs=0.5)


def test_a_slanted_beam_meets_the_step_at_its_true_length():
    edge = one_of_many(Scan(step_picture()), (60, 60), (math.sqrt(0.5), math.sqrt(0.5)), BRIGHTER, 4, 150)
    assert edge is not None
    assert edge.length == pytest.approx(59.5 * math.sqrt(2), abs=1)


@EITHER
def test_a_beam_keeps_account_of_the_points_it_reads_and_reads_none_behind_its_step(beam: Beam):
    scan = Scan(step_picture())
    beam(scan, (20, 100), (1, 0), BRIGHTER, 4, 150)
    assert scan.read[100, 20:122].all()
    assert not scan.read[100, 128:].any()
    assert not scan.read[50:100].any()


@EITHER
def test_a_beam_three_points_wide_has_read_three_lines(beam: Beam):
    scan = Scan(step_picture())
    beam(scan, (20, 100), (1, 0), BRIGHTER, 4, 150, wide=True)
    assert scan.read[99:102, 20:122].all()
    assert not scan.read[102:].any()


@settings(max_examples=100, deadline=None)
@given(
    start=st.tuples(st.floats(0, COLUMNS), st.floats(0, ROWS)),
    direction=st.sampled_from([(1, 0), (-1, 0), (0, 1), (0, -1)]),
    polarity=st.sampled_from([BRIGHTER, DARKER]),
    reach=st.integers(0, 90),
    wide=st.booleans(),
    beyond=st.sampled_from([0.0, 8.0]),
)
def test_a_beam_that_walks_meets_reads_and_counts_what_one_of_many_does(
    start: Place, direction: Place, polarity: Polarity, reach: int, wide: bool, beyond: float
):
    noise = np.random.default_rng(0).integers(0, 16, (ROWS, COLUMNS), dtype=np.uint8)
    alone, together = Scan(noise), Scan(noise)
    how = start, direction, polarity, 5.0, reach
    one = walk(alone, *how, wide=wide, beyond=beyond)
    other = beams(
        together, np.array([start]), np.array([direction], float), *how[2:], wide=wide, beyond=beyond
    ).edge(0)
    assert one == other
    assert np.array_equal(alone.read, together.read)


@pytest.mark.row(48)
@settings(max_examples=60, deadline=None)
@given(angle=st.floats(0, 2 * math.pi), share=st.floats(0, 0.75))
def test_bouncing_finds_an_ellipse_from_any_seed_inside(angle: float, share: float):
    seed = 160 + 30 * share * math.cos(angle), 120 + 20 * share * math.sin(angle)
    blob = characterise(Scan(ellipse(60, 40)), seed, 4, 80)
    assert blob is not None
    assert (blob.u, blob.v) == pytest.approx((160, 120), abs=1)
    assert (blob.width, blob.height) == pytest.approx((60, 40), abs=1)
    assert blob.bounces <= 10


def test_bouncing_fails_where_there_is_no_border():
    assert characterise(Scan(np.full((ROWS, COLUMNS), 7, np.uint8)), (160, 120), 4, 80) is None


def test_the_characteriser_works_on_bright_blobs_too():
    blob = characterise(Scan(ellipse(60, 40, 12, 3)), (150, 125), 4, 80, polarity=DARKER)
    assert blob is not None
    assert (blob.u, blob.v) == pytest.approx((160, 120), abs=1)


@pytest.mark.row(49)
@pytest.mark.parametrize("seed", range(8))
def test_the_localiser_puts_a_tight_box_around_a_blob(seed: int):
    rng = np.random.default_rng(seed)
    picture = np.full((ROWS, COLUMNS), 3, np.uint8)
    u, v = int(rng.integers(80, 250)), int(rng.integers(80, 170))
    cv2.ellipse(picture, (u, v), (40, 25), float(rng.uniform(0, 180)), 0, 360, 11, -1)
    rows, columns = np.nonzero(picture == 11)
    window = np.array([[10, 10], [320, 10], [320, 245], [10, 245]], float)
    box = localise(Scan(picture), window, 3)
    true = (columns.min(), rows.min(), columns.max(), rows.max())
    assert box is not None
    assert np.abs(np.subtract(box, true)).max() <= 2


def test_the_localiser_passes_over_blobs_that_do_not_fit():
    picture = np.full((ROWS, COLUMNS), 3, np.uint8)
    picture[40:50, 40:60] = 11
    picture[120:180, 150:230] = 11
    window = np.array([[10, 10], [320, 10], [320, 245], [10, 245]], float)
    box = localise(Scan(picture), window, 3, lambda box: box.width > 50)
    assert box is not None
    assert box.contains(190, 150)


@pytest.mark.parametrize(
    ("piece", "found"),
    [
        (np.s_[97:109, 80:110], (69, 49, 131, 110)),  # beyond a wall in the shade
        (np.s_[97:109, 140:150], None),  # beside nothing of it
        (np.s_[140:152, 80:110], None),  # too far
    ],
)
def test_a_blob_that_a_shadow_has_parted_is_one_where_its_size_asks_for_it(
    piece: tuple[slice, slice], found: tuple[int, ...] | None
):
    picture = np.full((ROWS, COLUMNS), 3, np.uint8)
    picture[50:88, 70:131] = picture[piece] = 11
    window = np.array([[20, 20], [180, 20], [180, 180], [20, 180]])
    assert localise(Scan(picture), window, 3, lambda box: 45 <= box.height <= 80, whole=False) == found
    assert localise(Scan(picture), window, 3, lambda box: 45 <= box.height <= 80) is None


def test_the_localiser_sees_nothing_outside_its_window():
    picture = np.full((ROWS, COLUMNS), 3, np.uint8)
    picture[120:180, 250:300] = 11
    window = np.array([[10, 10], [200, 10], [200, 245], [10, 245]], float)
    assert localise(Scan(picture), window, 3) is None


def test_whoever_tries_them_may_write_points_as_lists():
    scan = handeye.vision.Scan(ellipse(60, 40))
    met = handeye.vision.beams(
        scan, [(160, 120), (160, 120)], [(1, 0), (-1, 0)], handeye.vision.BRIGHTER, 4, 80
    )
    assert met.uv.mean(axis=0) == pytest.approx((160, 120), abs=1)
    corners = [(20, 20), (310, 20), (310, 230), (20, 230)]
    box = handeye.vision.localise(handeye.vision.Scan(ellipse(60, 40, 12, 3)), corners, 4)
    assert (box.width, box.height) == pytest.approx((60, 40), abs=6)
