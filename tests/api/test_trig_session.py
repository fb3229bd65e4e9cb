"""TRIG from Python: what is typed happens, is told, and is shown."""

import pytest

import handeye

TAUGHT = """
* STACK 1 X 60 Y 0
M OVER
    X 60 Y 0 Z 80 RECORD
M DOWN
    Z 6 RECORD
GRASP
"""


def test_what_is_typed_is_told_done_and_shown() -> None:
    session = handeye.TrigSession()
    assert session.type(TAUGHT) == ("blocks on the table: 1",)
    assert session.hand == pytest.approx((60, 0, 6))
    assert repr(session).splitlines()[-1] == "▶  ***  (grasp)"
    assert "o─o[c]" in session._repr_html_()
    assert session.type("RUN -2") == ("2 steps undone",)
    assert session.hand == pytest.approx((60, 0, 80))


def test_a_line_that_is_refused_is_told_with_its_number_and_those_before_it_are_done() -> None:
    session = handeye.TrigSession()
    with pytest.raises(handeye.InvalidInput, match="what was typed, line 8: there is no position `NOWHERE`"):
        session.type(TAUGHT + "GOPOS NOWHERE")
    assert "(grasp)" in repr(session)


def test_one_who_has_left_can_go_on() -> None:
    session = handeye.TrigSession()
    session.type(TAUGHT + "Q")
    assert session.type("RUN -1000") == ("3 steps undone; no earlier steps can be undone",)


def test_what_cannot_be_had_is_refused_in_a_sentence() -> None:
    with pytest.raises(handeye.InvalidInput, match="there is no arm `kuka`"):
        handeye.TrigSession("kuka")
    with pytest.raises(handeye.InvalidInput, match="an arm without physics cannot be shown"):
        handeye.TrigSession().photograph()
    with pytest.raises(handeye.InvalidInput, match="a picture of 0 x 480 is not possible"):
        handeye.TrigSession("purbrick").photograph(width=0)
