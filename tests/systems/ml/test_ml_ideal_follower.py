"""The curve follower of figure 5 on perfect motors: its touches, one by one."""

from collections.abc import Iterator, Sequence
from itertools import islice
from math import atan2, pi, remainder
from typing import Final

import pytest
from run_bench import program

from handeye.systems.ml.machine.surroundings import Point, inside
from handeye.systems.ml.ml_api import Ml
from handeye.systems.ml.realtime.happenings import Froze

SQUARE: Final = [(-3000, -3000), (-3000, 3000), (3000, 3000), (3000, -3000)]
L_SHAPE: Final = [(-4000, -4000), (-4000, 4000), (0, 4000), (0, 0), (4000, 0), (4000, -4000)]
U_SHAPE: Final = [
    (-4000, -4000), (-4000, 4000), (4000, 4000), (4000, 2000), (-1000, 2000), (-1000, -2000), (4000, -2000),
    (4000, -4000),
]  # fmt: skip
OBLIQUE: Final = [(0, -4000), (-4000, 0), (0, 4000), (4000, 0)]
Touch = tuple[int, int, int]  # statement, y and x


def followed(outline: Sequence[Point], x: int) -> tuple[list[Touch], int, int]:
    """Touches, left turns and right turns, until left turns are ahead by four."""
    ml = Ml(program("curve_follower"), outline=outline)
    ml.do(f"MOVE 0 0 8000 {x}")
    ml.begin()
    touches: list[Touch] = []
    turns = {9: 0, 18: 0}
    for number, froze in _statements(ml):
        touches += [(number, event.positions[3], event.positions[4]) for event in froze]
        if number in turns:
            turns[number] += 1
        if turns[9] - turns[18] == 4:
            break
    return touches, turns[9], turns[18]


def _statements(ml: Ml) -> Iterator[tuple[int, list[Froze]]]:
    while True:
        first = len(ml.events)
        ml.step()
        yield ml.read("AR", 1, 3), [event for event in ml.events[first:] if isinstance(event, Froze)]


@pytest.mark.ml_row(35)
def test_the_square_is_touched_24_times_at_the_places_of_the_specification() -> None:
    touches, lefts, rights = followed(SQUARE, -2500)
    assert (lefts, rights, len(touches)) == (4, 0, 24)
    assert {number for number, _, _ in touches} == {4, 7}
    front = [(2921, -2500), *((2976, x) for x in range(-1500, 3000, 1000)), (2976, 2949)]
    side = [(y, 2949) for y in (1976, 976, -24, -1024, -2024)]
    assert [(y, x) for _, y, x in touches[:12]] == [*front, *side]
    assert [y for _, y, x in touches if x in (1949, 949, -51, -1051, -2051, -2972)][:6] == [-2945] * 6


@pytest.mark.ml_row(36)
def test_the_l_is_touched_on_line_16_once_at_its_inner_corner() -> None:
    touches, lefts, rights = followed(L_SHAPE, -3500)
    assert (lefts, rights, len(touches)) == (5, 1, 32)
    assert [(y, x) for number, y, x in touches if number == 16] == [(-24, 949)]


@pytest.mark.slow
@pytest.mark.ml_row(37)
@pytest.mark.parametrize(
    ("outline", "x", "within"),
    [
        (SQUARE, -2500, (0, 0)),
        (L_SHAPE, -3500, (-2000, -2000)),
        (U_SHAPE, -3500, (-2500, 0)),
        (OBLIQUE, 0, (0, 0)),
    ],
)
def test_left_turns_are_ahead_of_right_turns_by_four_for_each_time_round(
    outline: Sequence[Point], x: int, within: Point
) -> None:
    ml = Ml(program("curve_follower"), outline=outline)
    ml.do(f"MOVE 0 0 8000 {x}")
    ml.begin()
    turns = {9: 0, 18: 0}
    angle = around = 0.0
    for number, _ in islice(_statements(ml), 900):
        was, angle = angle, atan2(ml.position(3) - within[0], ml.position(4) - within[1])
        around -= remainder(angle - was, 2 * pi) if was else 0.0
        if number in turns:
            turns[number] += 1
        if number == 9:
            assert abs(turns[9] - turns[18] - 4 * around / (2 * pi)) < 2
    assert around / (2 * pi) > 2


@pytest.mark.ml_row(38)
def test_without_an_object_it_advances_until_a_goal_is_outside_the_travel() -> None:
    ml = Ml(program("curve_follower"))
    ml.do("MOVE 0 0 8000 0")
    ml.do("RUN")
    assert ml.stopped.startswith("M10: motor 3 can go from -10039 to 10039, not to -11000")
    assert (ml.position(3), ml.read("EM", 1, 3)) == (-10_000, 4)


def test_a_point_on_the_outline_is_not_inside() -> None:
    assert inside(SQUARE, (0, 0))
    assert not any(inside(SQUARE, at) for at in ((-3000, 0), (3000, 0), (0, 3000), (0, -3000), (3000, 3000)))
    assert [inside(L_SHAPE, at) for at in ((-1, 1), (1, 1), (1, -1), (0, 2000), (2000, 0))] == [
        True, False, True, False, False
    ]  # fmt: skip
