from handeye.touch.hold import at_least, within
from handeye.units import INCH


def test_a_gap_of_24_hundredths_holds_something_of_a_tenth_and_5_hundredths_do_not() -> None:
    assert at_least(0.24 * INCH, 0.1 * INCH)
    assert not at_least(0.05 * INCH, 0.1 * INCH)


def test_a_range_accepts_what_lies_in_it_and_rejects_both_sides() -> None:
    assert within(0.24 * INCH, 0.2 * INCH, 0.3 * INCH)
    assert not within(0.35 * INCH, 0.2 * INCH, 0.3 * INCH)
    assert not within(0.1 * INCH, 0.2 * INCH, 0.3 * INCH)
