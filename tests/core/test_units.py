"""The units of the period, by their definitions."""

import math

import pytest

from handeye.core import units
from handeye.core.units import UNITS, split_value, unit_named

POUND = 0.45359237
"""kg, by definition."""
GRAVITY = 9.80665
"""m/s2, the standard."""


def test_an_inch_is_twenty_five_and_four_tenths_millimetres() -> None:
    assert units.INCH == 25.4 * units.MILLIMETRE


def test_an_ounce_of_force_is_a_sixteenth_of_a_pound_under_standard_gravity() -> None:
    assert pytest.approx(POUND / 16 * GRAVITY, rel=1e-15) == units.OUNCE_FORCE


@pytest.mark.parametrize(
    ("written", "size"),
    [
        ("1 oz in", POUND / 16 * GRAVITY * 0.0254),
        ("180 deg/s", math.pi),
        ("-2.5e1 mm", -0.025),
        (".5in/s", 0.0127),
        ("3 %", 0.03),
        ("7", 7.0),
    ],
)
def test_a_value_as_people_write_it_has_its_size_in_si(written: str, size: float) -> None:
    number, word = split_value(written)
    assert number * unit_named(word).size == pytest.approx(size)


@pytest.mark.parametrize("written", ["٣", "٣ mm", "1e٣", "", "mm", "nan"])
def test_a_value_begins_with_a_number_in_ascii_digits(written: str) -> None:
    found = split_value(written)
    assert found is None or unit_named(found[1]) is None


def test_a_turn_a_minute_is_a_sixtieth_of_a_turn_a_second() -> None:
    assert pytest.approx(2 * math.pi) == 60 * units.RPM


def test_the_servo_of_1973_has_sixty_periods_a_second() -> None:
    assert 1 / units.JIFFY == 60


def test_every_unit_is_found_by_its_name_however_it_is_spaced() -> None:
    assert {name: unit_named(name.upper().replace(" ", "")) for name in UNITS} == UNITS
