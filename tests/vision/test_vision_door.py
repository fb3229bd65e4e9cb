"""What programs in Python give the primitives is checked; a window is in force for one call; a cut blob is no blob."""

import math
import re

import numpy as np
import pytest

import handeye
from handeye.core.errors import BadArgument
from handeye.vision import BRIGHTER, DARKER, BoundingBox, Scan, beams, characterise, localise

ROWS, COLUMNS = 200, 260
WINDOW = np.array([[8, 8], [250, 8], [250, 190], [8, 190]], float)


def picture(*discs: tuple[float, float, float]) -> np.ndarray:
    """Bright discs (u, v, radius) on a dark ground."""
    v, u = np.mgrid[:ROWS, :COLUMNS]
    bright = np.zeros((ROWS, COLUMNS), bool)
    for middle, row, radius in discs:
        bright |= (u - middle) ** 2 + (v - row) ** 2 < radius**2
    return np.where(bright, 12.0, 2.0)


ONE = picture((130, 100, 30))


@pytest.mark.parametrize(
    ("given", "said"),
    [
        (np.zeros(50), "shape (50,)"),
        (np.zeros((4, 5, 1)), "grey levels"),
        (np.zeros((5, 0)), "shape (5, 0)"),
        (np.full((9, 9), math.inf), "not finite numbers"),
        (np.full((9, 9), 1e300), "not finite numbers"),
        (np.full((9, 9), 1j), "complex"),
        (np.full((9, 9), "a"), "<U1"),
        (np.full((9, 9), None), "object"),
        (((1, 2), (3, 4)), "not tuple"),
        (None, "not NoneType"),
        ("picture.png", "not str"),
    ],
)
def test_what_is_no_picture_is_refused(given: object, said: str) -> None:
    with pytest.raises(BadArgument, match=rf"^[^\n]*{re.escape(said)}[^\n]*$"):
        Scan(given)


@pytest.mark.parametrize(
    "window",
    [
        WINDOW[0], WINDOW[[0, 1, 1, 2]], WINDOW[[0, 2, 3, 1]], np.vstack([WINDOW, WINDOW[0]]), np.zeros((4, 2)),
        [[8, 8], [250, 8], [60, 60], [8, 190]], WINDOW * [1, math.inf], WINDOW * 1e200, "window", None,
        [[1, 2], [3], [4, 5], [6, 7]], [["a", "b"]] * 4,
    ],
)  # fmt: skip
def test_what_is_no_convex_quadrilateral_is_refused(window: object) -> None:
    with pytest.raises(BadArgument, match=r"^[^\n]*window[^\n]*$"):
        localise(Scan(ONE), window, 4)
    with pytest.raises(BadArgument, match=r"^[^\n]*window[^\n]*$"):
        Scan(ONE).limit(window)


NAN = math.nan


@pytest.mark.parametrize(
    "call",
    [
        lambda: localise(ONE, WINDOW, 4),
        lambda: localise(Scan(ONE), WINDOW, -1),
        lambda: localise(Scan(ONE), WINDOW, "4"),
        lambda: localise(Scan(ONE), WINDOW, 4, "big"),
        lambda: localise(Scan(ONE), WINDOW, 4, tries=0),
        lambda: localise(Scan(ONE), WINDOW, 4, tries=2.5),
        lambda: characterise(ONE, (130, 100), 4, 60),
        lambda: characterise(Scan(ONE), 130, 4, 60),
        lambda: characterise(Scan(ONE), (130, 100, 1), 4, 60),
        lambda: characterise(Scan(ONE), ("130", "100"), 4, 60),
        lambda: characterise(Scan(ONE), (1e20, 3), 4, 60),
        lambda: characterise(Scan(ONE), (130, 100), None, 60),
        lambda: characterise(Scan(ONE), (130, 100), [4, 4], 60),
        lambda: characterise(Scan(ONE), (130, 100), 4, 0),
        lambda: characterise(Scan(ONE), (130, 100), 4, math.inf),
        lambda: characterise(Scan(ONE), (130, 100), 4, 60, polarity=2),
        lambda: characterise(Scan(ONE), (130, 100), 4, 60, polarity=True),
        lambda: characterise(Scan(ONE), (130, 100), 4, 60, polarity=np.array([1, -1])),
        lambda: characterise(Scan(ONE), (130, 100), 4, 60, beyond=NAN),
        lambda: beams(ONE, [[20, 100]], [[1, 0]], BRIGHTER, 4, 99),
        lambda: beams(Scan(ONE), [20, 100], [[1, 0]], BRIGHTER, 4, 99),
        lambda: beams(Scan(ONE), [[20, 100], [1, 2]], [[1, 0]], BRIGHTER, 4, 99),
        lambda: beams(Scan(ONE), [[20, 100]], [[0, 0]], BRIGHTER, 4, 99),
        lambda: beams(Scan(ONE), [[20, 100]], [[2, 1]], BRIGHTER, 4, 99),
        lambda: beams(Scan(ONE), [[20, 100]], [[NAN, 1]], BRIGHTER, 4, 99),
        lambda: beams(Scan(ONE), [[20, 1e30]], [[1, 0]], BRIGHTER, 4, 99),
        lambda: beams(Scan(ONE), [[20, 100]], [[1, 0]], BRIGHTER, 4, [9, 9]),
        lambda: beams(Scan(ONE), [[20, 100]], [[1, 0]], BRIGHTER, 4, -5),
        lambda: beams(Scan(ONE), [[20, 100]], [[1, 0]], BRIGHTER, NAN, 99),
        lambda: beams(Scan(ONE), [[20, 100]], [[1, 0]], "brighter", 4, 99),
    ],
)
def test_what_cannot_be_an_argument_is_refused_in_a_sentence(call) -> None:
    with pytest.raises(handeye.InvalidInput, match=r"^[^\n]+$"):
        call()


@pytest.mark.parametrize("kind", [np.uint8, np.uint16, np.int64, np.float64, bool])
def test_pictures_of_any_numbers_are_read(kind: type) -> None:
    seen, step = (ONE > 5).astype(kind), 0.4
    assert localise(Scan(seen), WINDOW.tolist(), step) == localise(Scan(ONE), WINDOW, 4)
    assert characterise(Scan(seen), [130, 100], np.float32(step), 60, polarity=np.int64(DARKER)) is not None


def test_a_window_is_in_force_for_one_look() -> None:
    scan = Scan(picture((50, 50, 12), (130, 100, 15), (200, 150, 20)))
    halves = [WINDOW * (0.37, 1), WINDOW * (0.4, 1) + (70, 0), WINDOW * (0.35, 1) + (155, 0)]
    alone = [localise(Scan(scan.image), half, 4) for half in halves]
    assert None not in alone
    assert [localise(scan, half, 4) for half in halves] == alone
    assert characterise(scan, (50, 50), 4, 40, polarity=DARKER) is not None


def test_a_window_that_is_set_holds_until_the_next_one() -> None:
    scan = Scan(ONE)
    scan.limit(WINDOW * 0.3)
    assert characterise(scan, (130, 100), 4, 60, polarity=DARKER) is None
    localise(scan, WINDOW, 4)
    assert characterise(scan, (130, 100), 4, 60, polarity=DARKER) is None
    scan.limit(WINDOW)
    assert characterise(scan, (130, 100), 4, 60, polarity=DARKER) is not None


def diamond(half: float) -> np.ndarray:
    """A window on its corner about (130, 100)."""
    return np.array([[130 - half, 100], [130, 100 - half], [130 + half, 100], [130, 100 + half]])


@pytest.mark.parametrize(
    "seen", [(3, 100, 20), (130, 2, 25), (253, 100, 12), (130, 195, 30), (12, 12, 14), (250, 188, 9)]
)
def test_a_blob_at_the_border_of_the_picture_is_not_reported(seen: tuple[float, float, float]) -> None:
    whole = np.array([[0, 0], [COLUMNS - 1, 0], [COLUMNS - 1, ROWS - 1], [0, ROWS - 1]])
    assert localise(Scan(picture(seen)), WINDOW, 4) is None
    if min(seen[0], seen[1], COLUMNS - seen[0], ROWS - seen[1]) < seen[2]:
        assert localise(Scan(picture(seen)), whole, 4) is None


@pytest.mark.parametrize(
    "window", [WINDOW * (0.5, 1), WINDOW * (1, 0.5), WINDOW * (1, 0.4) + (0, 105), diamond(34), diamond(41)]
)
def test_a_blob_that_a_window_cuts_is_not_reported(window: np.ndarray) -> None:
    assert localise(Scan(ONE), window, 4) is None


def test_a_blob_that_lies_whole_in_a_window_is_reported_beside_one_that_does_not() -> None:
    both = Scan(picture((20, 100, 30), (160, 100, 20)))
    box = localise(both, WINDOW, 4)
    assert box is not None
    assert box.contains(160, 100)
    assert localise(Scan(ONE), diamond(60), 4) == pytest.approx(BoundingBox(101, 71, 159, 129), abs=2)
