"""Pages for people who use a keyboard instead of a mouse."""

from handeye.core.markup import lines


def test_the_keyboard_reaches_a_text_whose_long_lines_scroll() -> None:
    assert lines(["MOVE X1 TO 300", "END"]) == '<pre tabindex="0">MOVE X1 TO 300\nEND</pre>'
