"""The page that compares four notations quotes the programs as they are."""

import re
from pathlib import Path

import pytest

from handeye.core.resources import plans

PAGE = (Path(__file__).parents[3] / "docs" / "four_notations.md").read_text(encoding="utf-8")
PIECES = re.split(r"^```\n", PAGE, flags=re.MULTILINE)
QUOTED = [
    (re.findall(r"`plans/([\w.]+)`", "".join(PIECES[:number]))[-1], block)
    for number, block in enumerate(PIECES)
    if number % 2 and not block.startswith("$")
]


def test_the_page_quotes_all_four_languages() -> None:
    assert {file for file, _ in QUOTED} == {
        "water_pump.al", "pins.trig", "pins.ml", "pins.mal", "gasket.ml", "top.ml", "top.mal",
    }  # fmt: skip


@pytest.mark.parametrize(("file", "block"), QUOTED)
def test_each_quotation_is_in_its_program(file: str, block: str) -> None:
    assert block in (plans() / file).read_text(encoding="utf-8")
