"""Words of a user about a world: names, numbers, units."""

import pytest

from handeye.core.distributions import Normal
from handeye.core.errors import InvalidInput
from handeye.core.units import DEGREE, INCH, MILLIMETRE
from handeye.core.variation import Quantity, Variation
from handeye.core.world_options import overrides, value_of

LENGTH = Quantity(name="place.x", unit="in", distribution=Normal(0.1), source="")
ANGLE = Quantity(name="place.yaw", unit="deg", distribution=Normal(0.1), source="", limits=(-90.0, 90.0))
SCALE = Quantity(name="mass", unit="%", distribution=Normal(2.0), source="", limits=(-90.0, float("inf")))
TABLE = Variation(LENGTH, ANGLE, SCALE)


@pytest.mark.parametrize(
    ("quantity", "text", "value"),
    [
        (LENGTH, "0.3", 0.3 * INCH), (LENGTH, ".3in", 0.3 * INCH), (LENGTH, "-2 mm", -2 * MILLIMETRE),
        (LENGTH, "1e-3m", 1e-3), (ANGLE, "2deg", 2 * DEGREE), (ANGLE, "+2 Deg", 2 * DEGREE),
        (SCALE, "5%", 0.05), (SCALE, "5", 0.05), (SCALE, "0", 0.0),
    ],
)  # fmt: skip
def test_a_value_is_in_its_unit_or_in_that_of_the_quantity(
    quantity: Quantity, text: str, value: float
) -> None:
    assert value_of(quantity, text) == value


@pytest.mark.parametrize(
    ("setting", "sentence"),
    [
        ("place.x", "`place.x` is not a setting; write NAME=VALUE"),
        ("place.x=wide", "place.x cannot be `wide`, which is not a number"),
        ("place.x=", "place.x cannot be ``, which is not a number"),
        ("place.x=1e999", "place.x cannot be `1e999`"),
        ("place.x=2deg", "place.x is not measured in `deg`; known: `in`, `m`, `mm`"),
        (f"place.x=2{'d' * 41}", f"place.x is not measured in `{'d' * 39}…`; known: `in`, `m`, `mm`"),
        ("place.yaw=2dg", "place.yaw is not measured in `dg`; known: `deg`, `rad`"),
        ("place.yaw=2degs", "place.yaw is not measured in `degs`; did you mean `deg`?"),
        ("place.yaw=91", "place.yaw cannot be `91`; it must be between -90 and 90 deg"),
        ("mass=-95", "mass cannot be `-95`; it must be at least -90 %"),
        ("place.z=1", "the world has no quantity `place.z`; did you mean `place.x`?"),
    ],
)
def test_what_cannot_be_set_is_refused(setting: str, sentence: str) -> None:
    with pytest.raises(InvalidInput) as refused:
        overrides(TABLE, [], [setting])
    assert str(refused.value) == sentence


def test_a_group_is_set_at_once() -> None:
    assert overrides(TABLE, [], ["place=0"]).set == {"place.x": 0.0, "place.yaw": 0.0}


def test_a_group_in_one_unit_is_refused_if_not_all_of_it_has_that() -> None:
    with pytest.raises(InvalidInput, match=r"place\.yaw is not measured in `in`"):
        overrides(TABLE, [], ["place=0.1in"])


def test_of_two_settings_the_later_counts() -> None:
    assert overrides(TABLE, [], ["place=1", "place.x=2"]).set["place.x"] == 2 * INCH


def test_overrides_that_say_the_same_are_equal() -> None:
    assert overrides(TABLE, ["place.x", "place", "mass", "mass"], ["mass=1", "place.x=1in"]) == overrides(
        TABLE, ["mass", "place"], ["place.x=1", "mass=1%"]
    )
