"""The symbolic assembler: what it writes is the listing of the program."""

import pytest
from ml_bench import FOLLOWER, PLANS

from handeye.core.source import Source, read_source
from handeye.systems.ml.language.assembler import assembled
from handeye.systems.ml.language.codes import SYMBOLIC
from handeye.systems.ml.language.language import LANGUAGE, SYMBOLIC_LANGUAGE
from handeye.systems.ml.language.parser import parsed
from handeye.systems.ml.ml_api import Ml

SYMBOLIC_FOLLOWER = PLANS / "curve_follower.sym"


def output(text: str) -> list[str]:
    """The lines of ML that come of a symbolic text."""
    written, found = assembled(Source(name="t.sym", text=text))
    assert found == []
    return written.splitlines()


@pytest.mark.ml_row(53)
def test_what_the_assembler_writes_is_listed_as_it_was_written() -> None:
    text, found = assembled(read_source(SYMBOLIC_FOLLOWER))
    assert found == []
    written = [line for line in text.splitlines() if line and not line.startswith("*")]
    assert Ml(text).do("LIST") == written


def test_the_symbolic_follower_is_the_printed_one_with_other_numbers() -> None:
    lines, _ = parsed(read_source(FOLLOWER))
    numbers = {line.number: 5 * at for at, line in enumerate(lines, 1)}
    printed = []
    for line in lines:
        code, *values = str(line.statement).split()
        if code == "BRANCH":
            values = [str(numbers[int(n)]) for n in values[:2]] + values[2:]
        printed.append(" ".join((str(numbers[line.number]), code, *values)))
    text, _ = assembled(read_source(SYMBOLIC_FOLLOWER))
    assert [line for line in text.splitlines() if line and not line.startswith("*")] == printed


def test_names_become_numbers() -> None:
    names = "TOUCH EQU 1\nSPAN EQU 40\nN VAR\nM VAR\nHOME: POINT\n"
    text = "AGAIN: SENSOR TOUCH -1 1\nADD N -SPAN\nPRINT &N -&M &&M\nBRANCH AGAIN HOME -TOUCH"
    assert output(names + text) == [
        "5 POINT", "10 SENSOR 1 -1 1", "15 ADD 1 -40", "20 PRINT &1 -&2 &&2", "25 BRANCH 10 5 -1",
    ]  # fmt: skip


def test_tables_keep_their_names() -> None:
    assert output("V VAR\nGET V MT 3 1") == ["5 GET 1 MT 3 1"]


@pytest.mark.parametrize("code", SYMBOLIC)
def test_the_example_of_a_code_makes_that_mistake_and_says_a_cure(code: str) -> None:
    found = SYMBOLIC_LANGUAGE.check(Source(name="t.sym", text=SYMBOLIC[code].example))
    shown = [each for each in found if each.code == code]
    assert shown
    assert all(each.help for each in shown)
    assert (LANGUAGE.explanation(code) or "").startswith(f"error[{code}]: ")


@pytest.mark.parametrize(
    ("text", "message", "marked"),
    [
        ("X: DMOVE 0 0 STEPP\nSTEP EQU 5", "`STEPP` is not defined", "STEPP"),
        ("X:   MOOVE 1", "`MOOVE` is not a command", "MOOVE 1"),
        ("X: ", "the label `X` has no statement", "X"),
        ("X: PRINT 40000", "`40000` does not fit into 16 bits", "PRINT 40000"),
    ],
)
def test_a_mistake_is_marked_in_the_symbolic_text(text: str, message: str, marked: str) -> None:
    _, (wrong,) = assembled(Source(name="t.sym", text=text))
    assert wrong.message == message
    assert text[wrong.primary.span.start : wrong.primary.span.end] == marked
