"""Fingers that close on their way back meet nothing before they are where they were."""

import numpy as np
import pytest

from handeye.execution.undo.retracing import EarlyContact
from handeye.program.diagnosis.causes import MetEarly
from handeye.touch.guards import Reading
from handeye.touch.senses import OFF_MIDDLE

KEPT = 0.03
"""m"""


def meeting(gap: float, *, holding: bool = True) -> EarlyContact:
    return EarlyContact(gap=lambda: gap, kept=KEPT, holding=holding)


def reading(*touch: bool) -> Reading:
    first, second = touch
    return Reading(force=np.zeros(3), direction=np.zeros(3), touch=(first, second))


@pytest.mark.parametrize("touch", [(True, False), (False, True), (True, True)])
def test_a_finger_that_touches_far_from_where_it_was_is_told(touch: tuple[bool, bool]) -> None:
    early = meeting(KEPT + 3 * OFF_MIDDLE, holding=False)
    trip = early.check(reading(*touch))
    assert trip is not None
    assert early.cause(trip) == MetEarly(fingers=touch, gap=KEPT + 3 * OFF_MIDDLE, kept=KEPT, holding=False)


def test_fingers_that_touch_nothing_may_be_anywhere() -> None:
    assert meeting(KEPT + 0.05).check(reading(False, False)) is None


@pytest.mark.parametrize("gap", [KEPT - 0.001, KEPT, KEPT + 1.9 * OFF_MIDDLE])
def test_what_lies_in_the_middle_or_nearly_so_may_be_closed_on(gap: float) -> None:
    assert meeting(gap).check(reading(True, False)) is None
