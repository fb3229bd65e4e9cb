"""Texts made to take long, or to take room: each ends in few words, and what would take long is not begun."""

from collections.abc import Callable
from pathlib import Path

import pytest
from al_support import codes, diagnose

from handeye import al
from handeye.al import lower
from handeye.al.parser import LONGEST_LINE
from handeye.core import diagnostics
from handeye.core.diagnostics import LIMIT, LONGEST_COMPARED, MOST_COMPARED, render
from handeye.core.errors import InvalidInput
from handeye.core.source import LARGEST, Source, read_source

MANY = 20_000
HARD = {
    "one name": "A" * MANY,
    "one number": "OPEN " + "1" * MANY,
    "half a number": "OPEN 1" + "e+" * MANY,
    "signs": "OPEN " + "+-" * MANY,
    "brackets": "CHANGE " + "[" * MANY,
    "a vector": "CHANGE [" + "0 " * MANY + "] 1",
    "quotes": "WAIT " + '"' * (MANY + 1),
    "commas": "CLOSE " + "," * MANY,
    "colons": ":" * MANY,
    "labels": "L:" * MANY,
    "blanks": "OPEN" + " " * MANY + "1" + "\t" * MANY,
    "NUL bytes": "\0" * MANY,
    "NUL lines": "\0\n" * MANY,
    "unknown words": "".join(f"X{i}\n" for i in range(MANY)),
    "macros never ended": "DEFINE A\n" * MANY,
    "macros in macros": "".join(f"DEFINE M{i}\nM{i + 1}\n\n" for i in range(MANY // 4)) + "M0",
    "macros of macros": "".join(f"DEFINE M{i}\n" + f"M{i + 1}\n" * 50 + "\n" for i in range(18)) + "M0",
    "labels in order": "".join(f"L{i}:\n" for i in range(MANY)) + "PARK",
}


@pytest.mark.parametrize("name", HARD)
def test_a_text_made_to_take_long_gets_few_and_short_words(name: str) -> None:
    source = Source(name="hard.al", text=HARD[name])
    found = diagnose(source.text)
    assert 0 < len(found) <= LIMIT
    assert max(len(render(diagnostic, source)) for diagnostic in found) < 1000


@pytest.mark.parametrize("name", HARD)
def test_a_text_made_to_take_long_is_tidied_once_and_for_all(name: str) -> None:
    tidy = al.format_text(HARD[name])
    assert al.format_text(tidy) == tidy


def test_a_line_is_at_most_a_thousand_characters_long() -> None:
    line = "WAIT " + "X" * (LONGEST_LINE - 5)
    assert codes(line) == []
    (found,) = diagnose(line + "X")
    assert (found.code, found.message) == ("line-too-long", "the line has 1001 characters")
    assert found.help == "a line can have at most 1000 characters"


def test_nothing_more_is_said_of_a_line_that_is_too_long() -> None:
    assert codes(f"STOP [0 0 -9] ;{'-' * LONGEST_LINE}\nOPEN 1\nJUMP L") == ["line-too-long", "unknown-label"]


def test_a_file_is_at_most_a_megabyte_long(tmp_path: Path) -> None:
    file = tmp_path / "long.al"
    file.write_bytes(b" " * (LARGEST + 1))
    with pytest.raises(InvalidInput, match=r"long\.al has 1000001 bytes; the limit is 1000000$"):
        read_source(file)


@pytest.fixture
def calls(monkeypatch: pytest.MonkeyPatch) -> Callable[[object, str], list[int]]:
    """Counts calls of a function of a module."""

    def counted(module: object, name: str) -> list[int]:
        count = [0]
        function = getattr(module, name)

        def counting(*arguments: object) -> object:
            count[0] += 1
            return function(*arguments)

        monkeypatch.setattr(module, name, counting)
        return count

    return counted


@pytest.mark.parametrize(
    "text",
    [
        "".join(f"LABEL{i}:\n" for i in range(MOST_COMPARED + 1)) + "JUMP LABEL\n" * 50,
        f"TRANS {'A' * 900} [1 2 3 0 0 0]\nMOVE {'A' * 899}",
    ],
)
def test_nearest_names_are_not_looked_for_without_end(
    text: str, calls: Callable[[object, str], list[int]]
) -> None:
    compared = calls(diagnostics, "_distance")
    assert {"unknown-label", "unknown-position"} & set(codes(text))
    assert compared == [0]


def test_nearest_names_are_found_in_any_script_of_some_size() -> None:
    labels = "".join(f"{'L' * (LONGEST_COMPARED - 4)}{i}:\n" for i in range(MOST_COMPARED - 1))
    found = diagnose(f"{labels}NEAR:PARK\nJUMP NAER")
    assert found[0].help == "did you mean `NEAR`?"


def test_modifiers_of_a_motion_are_gone_through_once(calls: Callable[[object, str], list[int]]) -> None:
    looked_at = calls(lower, "_word")
    diagnose("STOP 50\n" * 500 + "CHANGE X 1\n")
    assert 500 < looked_at[0] < 500 * 8
