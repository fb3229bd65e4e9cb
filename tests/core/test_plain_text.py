"""Text for people: nothing in it steers a terminal, and nouns agree with their counts."""

from handeye.core.plain_text import counted, distinct_digits, one_line, printable


def test_a_character_that_would_steer_a_terminal_is_shown_as_a_sign() -> None:
    assert printable("a\x1b[31mb\u202ec é") == "a\N{REPLACEMENT CHARACTER}[31mb\N{REPLACEMENT CHARACTER}c é"


def test_a_blank_that_is_not_an_ordinary_one_is_shown_as_a_sign_for_a_blank() -> None:
    assert printable("OPEN\u00a01 \u20032") == "OPEN␣1 ␣2"


def test_a_statement_loses_the_blanks_of_its_columns() -> None:
    assert one_line("\tMOVE\t T  \x1b ") == "MOVE T \N{REPLACEMENT CHARACTER}"


def test_a_noun_agrees_with_its_count() -> None:
    assert [counted(n, "step") for n in (0, 1, 2)] == ["0 steps", "1 step", "2 steps"]


def test_numbers_that_differ_are_told_apart() -> None:
    assert distinct_digits([0.1, 0.2, 0.2], 2) == ["0.10", "0.20", "0.20"]
    assert distinct_digits([-0.002, 0.0], 2) == ["-0.002", "0.000"]
    assert distinct_digits([1.0, 1.0 + 1e-15], 1) == ["1.000000", "1.000000"]
