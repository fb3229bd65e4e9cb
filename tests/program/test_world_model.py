"""Planned until seen or felt, measured from then on."""

import math

import pytest

from handeye.core.errors import InvalidInput
from handeye.core.pose import planar
from handeye.program.program import Part, Position
from handeye.program.world_model import WorldModel


def world() -> WorldModel:
    return WorldModel(
        parts={"BASE": Part(at=(1.0, 2.0, 0.0, 0.0))},
        positions={
            "A": Position(at=(0.1, 0.0, 0.3, 0.0, math.pi / 2, 0.0), of="BASE"),
            "T": Position(at=(0.5, 0.6, 0.7, 0.0, math.pi / 2, 0.0)),
        },
    )


def test_a_position_follows_its_part_as_planned() -> None:
    assert world().position("A")[:3, 3] == pytest.approx([1.1, 2.0, 0.3])


def test_a_position_follows_its_part_where_it_was_measured() -> None:
    known = world()
    known.measure("BASE", planar(1.5, 2.5, 0.0, math.pi / 2))
    assert known.position("A")[:3, 3] == pytest.approx([1.5, 2.6, 0.3])
    assert known.planned_position("A")[:3, 3] == pytest.approx([1.1, 2.0, 0.3])


def test_a_position_of_no_part_stays_where_it_is() -> None:
    known = world()
    known.measure("BASE", planar(9.0, 9.0, 0.0, 1.0))
    assert known.position("T")[:3, 3] == pytest.approx([0.5, 0.6, 0.7])


def test_an_unknown_part_is_refused_with_those_there_are() -> None:
    with pytest.raises(InvalidInput, match=r"^there is no part LID; the parts are BASE$"):
        world().measure("LID", planar(0, 0, 0, 0))
