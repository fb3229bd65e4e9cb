"""The table in docs/checks.md names tests that exist."""

import re
from pathlib import Path

import pytest

ROOT = Path(__file__).parent.parent
ROWS = re.findall(r"^\| (\d+) \|.*`(tests/\S+)::(test_\w+)` \|$", (ROOT / "docs/checks.md").read_text(), re.M)


def test_the_table_has_a_row_for_every_check_of_the_first_release() -> None:
    first = {
        *range(1, 6),
        *range(7, 18),
        *range(19, 23),
        24,
        25,
        27,
        28,
        31,
        *range(33, 41),
        *range(46, 54),
        55,
        59,
        60,
    }
    assert first - {int(number) for number, _, _ in ROWS} == set()


@pytest.mark.parametrize(("number", "file", "name"), ROWS)
def test_the_table_names_a_test_that_exists(number: str, file: str, name: str) -> None:
    assert f"\ndef {name}(" in (ROOT / file).read_text()
