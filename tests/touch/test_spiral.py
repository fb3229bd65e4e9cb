import numpy as np
import pytest

from handeye.touch.spiral import line, spiral

LISTED = [
    (0, 0), (1, 0), (1, 1), (0, 1), (-1, 1), (-1, 0), (-1, -1), (0, -1), (1, -1), (2, -1), (2, 0), (2, 1),
    (2, 2), (1, 2), (0, 2), (-1, 2), (-2, 2), (-2, 1), (-2, 0), (-2, -1), (-2, -2), (-1, -2), (0, -2),
    (1, -2), (2, -2), (3, -2),
]  # fmt: skip
STEP, CATCH = 0.07, 0.0495


def places(count: int) -> np.ndarray:
    """The first places of a search as offsets from its centre, in the unit of the step."""
    return STEP * np.array([spiral(k) for k in range(count)])


def test_the_spiral_goes_through_the_listed_places() -> None:
    assert [spiral(k) for k in range(26)] == LISTED


def test_the_first_49_places_are_a_square_of_7_by_7() -> None:
    square = {(i, j) for i in range(-3, 4) for j in range(-3, 4)}
    assert {spiral(k) for k in range(49)} == square


def test_each_place_is_one_step_from_the_one_before() -> None:
    steps = np.abs(np.diff([spiral(k) for k in range(500)], axis=0)).sum(axis=1)
    assert (steps == 1).all()


def test_every_point_is_within_the_catch_radius_of_a_place() -> None:
    grid = places(49)
    points = np.random.default_rng(1).uniform(-0.2, 0.2, (2000, 2))
    nearest = np.linalg.norm(points[:, None] - grid, axis=-1).min(axis=1)
    assert nearest.max() <= CATCH
    assert nearest.max() > 0.9 * CATCH


@pytest.mark.parametrize(("error", "tries"), [(0.10, 9), (0.15, 24), (0.20, 47)])
def test_an_error_in_a_disc_takes_at_most_the_computed_number_of_tries(error: float, tries: int) -> None:
    rng = np.random.default_rng(2)
    angle, radius = rng.uniform(0, 2 * np.pi, 20_000), error * np.sqrt(rng.uniform(0, 1, 20_000))
    hole = np.stack([radius * np.cos(angle), radius * np.sin(angle)], axis=1)
    grid = places(60)
    caught = np.linalg.norm(hole[:, None] - grid, axis=-1) <= CATCH
    assert caught.any(axis=1).all()
    assert caught.argmax(axis=1).max() + 1 <= tries


def test_a_line_goes_to_both_sides_in_turn() -> None:
    assert [line(k, 0.0)[0] for k in range(5)] == [0, 1, -1, 2, -2]
    assert all(line(k, 0.0)[1] == 0 for k in range(5))


def test_a_line_goes_in_its_direction() -> None:
    x, y = line(3, np.radians(60))
    assert (x, y) == pytest.approx((1.0, np.sqrt(3)))
