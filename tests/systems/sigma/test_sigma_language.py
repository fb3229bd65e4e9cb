"""MAL's form and its mistakes: names of any length, no arrays, every code with its example."""

from pathlib import Path

import pytest
from mal_bench import PLANS, carried_out, codes

from handeye.core.codes import CODES as OTHER_CODES
from handeye.core.source import Source
from handeye.systems.sigma.mal.check import checked
from handeye.systems.sigma.mal.codes import CODES
from handeye.systems.sigma.mal.language import LANGUAGE
from handeye.systems.sigma.mal.words import MAL_DEVICES, RESERVED, WORDS
from handeye.systems.sigma.protocol import LINE_AXES

LONG = "A" * 29


@pytest.mark.sigma_row(31)
def test_names_that_differ_in_the_thirtieth_letter_only_are_different_variables() -> None:
    assert carried_out(f"10 {LONG}B = 1\n20 {LONG}C = 2\n30 PRINT {LONG}B; {LONG}C").printed == ["12"]


@pytest.mark.sigma_row(31)
@pytest.mark.parametrize("line", ["10 DIM A(5)", "10 A(1) = 5", "10 LET A = B(1)", "10 PRINT HEIGHTS(2)"])
def test_arrays_are_refused_where_they_stand(line: str) -> None:
    assert codes(line) == ["arrays-dropped"]


def test_case_means_nothing_outside_of_texts() -> None:
    assert carried_out('10 let Height = 5\n20 print "Height"; hEIGHT').printed == ["Height5"]


@pytest.mark.parametrize("code", CODES)
def test_the_example_of_a_code_makes_that_mistake_and_a_cure_is_told(code: str) -> None:
    found = checked(Source(name="example.mal", text=CODES[code].example))[1]
    shown = [each for each in found if each.code == code]
    assert shown
    assert all(each.help for each in shown)
    assert code not in OTHER_CODES
    assert (LANGUAGE.explanation(code) or "").startswith(f"{CODES[code].severity}[{code}]: ")


HANDED_ON = {"top": ["variable-never-set"]}
"""What the checker finds in a leg of a relay: a variable that the relay sets before the leg begins."""


@pytest.mark.parametrize("file", sorted(PLANS.glob("*.mal")), ids=lambda file: file.stem)
def test_our_programs_have_no_mistake(file: Path) -> None:
    assert codes(file.read_text(encoding="utf-8")) == HANDED_ON.get(file.stem, [])


@pytest.mark.parametrize("word", [name for name, word in WORDS.items() if word.example])
def test_the_example_of_a_word_is_well_formed_and_explained(word: str) -> None:
    assert not {*codes(WORDS[word].example)} & {"syntax", "unknown-statement", "reserved-word"}
    assert WORDS[word].usage in (LANGUAGE.explanation(word) or "")


def test_no_flag_is_called_as_a_word_is() -> None:
    assert {word for word in RESERVED if codes(f"10 SET {word}") != ["reserved-word"]} == set()


@pytest.mark.parametrize(
    ("text", "told"),
    [
        ("10 LIMIT X5, 10", "X5 has no wrist that feels forces"),
        ("10 PRINT FORCE(X6)", "X6 has no wrist that feels forces"),
        ("10 MOVE X5 TO 5\n20 PRINT BEAM(7)", "there is no light beam 7, only 1 to 6"),
        ("10 MOVE X7 TO 5", f"an axis ({', '.join(LINE_AXES)}) is expected here, but there is `X7`"),
        ("10 MOVE X1 TO", "a number, a variable or a function is expected here, but the line ends"),
        ("10 GOTO 30\n20 END", "there is no line 30"),
        ("5 GOTO 10 20\n10 END", "the end of the line is expected here, but there is `20`"),
        ("10 ACTUATE HAND5", f"a device ({', '.join(MAL_DEVICES)}) is expected here, but there is `HAND5`"),
        ("10 IF A THEN 10", "`=` or `<>` or `<` or `>` or `<=` or `>=` is expected here, but there is `THEN`"),
        ("10 Ä = 5", "`Ä` is not a character of MAL"),
    ],
)  # fmt: skip
def test_a_mistake_is_told_in_a_sentence(text: str, told: str) -> None:
    assert told in [each.message for each in checked(Source(name="t.mal", text=text))[1]]


def test_lines_may_stand_in_any_order() -> None:
    assert carried_out("20 PRINT 2\n10 PRINT 1").printed == ["1", "2"]


def test_a_program_is_formatted_by_the_numbers_of_its_lines() -> None:
    tidy = LANGUAGE.formatted('20 print  "Two"  \n10 rem keep This\n')
    assert tidy == '10 REM keep This\n20 PRINT "Two"\n'
    assert LANGUAGE.formatted(tidy) == tidy


@pytest.mark.parametrize(
    ("typed", "wanted"),
    [
        ("10 MO", "MOVE"), ("10 MOVE ", "X1"), ("10 GOTO ", "900"), ("10 START ", "FEEDER"), ("10 WAIT ", "READY"),
        ("10 ACTUATE ", "HAND1"), ("10 A = ", "HEIGHT"), ("10 IF A = 1 THEN ", "GOTO"),
    ],
)  # fmt: skip
def test_completion_offers_what_fits_behind_a_word(typed: str, wanted: str) -> None:
    text = f"{typed}\n800 HEIGHT = 5\n810 SET READY\n900 TASK FEEDER\n910 END\n"
    offered = [word for word, _ in LANGUAGE.words(Source(name="t.mal", text=text), len(typed))]
    assert wanted in offered
