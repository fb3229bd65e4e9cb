"""The opening that the language allows is that of the arm's hand."""

from handeye.al.operand_kinds import HAND
from handeye.arm.robots.stanford import STANFORD
from handeye.units import INCH


def test_the_widest_opening_is_that_of_the_stanford_hand_to_a_hundredth_of_an_inch() -> None:
    assert round(STANFORD.hand.gap_max / INCH, 2) == HAND
