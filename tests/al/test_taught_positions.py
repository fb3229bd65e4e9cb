"""Taught positions and parts come from a TOML file, in inches and degrees; what is unclear is refused."""

from pathlib import Path

import pytest

from handeye.core.errors import InvalidInput
from handeye.core.units import DEGREE, INCH
from handeye.program.program import Hole
from handeye.program.taught import load_taught

GOOD = """
[positions.PIN]
at = [1, 2.5, 3, 0, 90, 0]
of = "HOLDER"
[parts.HOLDER]
at = [18, 44, 0, 180]
face = 1.75
holes = [[0, 0, 2.25], [3, 0, 1.25]]
region = [4, 5]
outline = [-2, -2, 5, 2]
"""


AT = "[positions.A]\nat = [1, 2, 3, 0, 0, 0]\n"


def write(folder: Path, text: str) -> Path:
    path = folder / "taught.toml"
    path.write_text(text, encoding="utf-8")
    return path


def test_positions_and_parts_arrive_in_si(tmp_path: Path) -> None:
    taught = load_taught(write(tmp_path, GOOD))
    pin, holder = taught.positions["PIN"], taught.parts["HOLDER"]
    assert pin.at == pytest.approx((INCH, 2.5 * INCH, 3 * INCH, 0, 90 * DEGREE, 0))
    assert pin.of == "HOLDER"
    assert holder.at == pytest.approx((18 * INCH, 44 * INCH, 0, 180 * DEGREE))
    assert holder.holes[1] == Hole(x=3 * INCH, y=0.0, diameter=1.25 * INCH)
    assert holder.region == pytest.approx((4 * INCH, 5 * INCH))
    assert holder.outline == pytest.approx((-2 * INCH, -2 * INCH, 5 * INCH, 2 * INCH))


def test_fixtures_and_what_is_held_arrive_in_si(tmp_path: Path) -> None:
    text = f"{AT}[fixtures.F]\nat = [1, 2, 3, 90]\nboxes = [[0, 0, 0, 1, 2, 3]]\n"
    taught = load_taught(
        write(tmp_path, f"{text}[held.H]\npositions = ['A']\nboxes = [[-1, -1, -1, 1, 1, 1]]")
    )
    assert taught.fixtures["F"].at == pytest.approx((INCH, 2 * INCH, 3 * INCH, 90 * DEGREE))
    assert taught.fixtures["F"].boxes[0] == pytest.approx((0, 0, 0, INCH, 2 * INCH, 3 * INCH))
    assert taught.held["H"].positions == ("A",)
    assert taught.held["H"].boxes[0] == pytest.approx((-INCH, -INCH, -INCH, INCH, INCH, INCH))


@pytest.mark.parametrize(
    ("text", "message"),
    [
        ("[positions.A]\nat = [1, 2]", r":1: positions\.A: at: 2 entries, but needs 6"),
        (
            "[positions.A]\nat = [1, 2, 3, 0, 0, 0]\nto = 1",
            r":1: positions\.A: `to` is not a known key",
        ),
        ("[positions.A]", r":1: positions\.A: `at` is missing"),
        (
            "[positions.A]\nat = [1, 2, 3, 0, 0, nan]",
            r":1: positions\.A: at contains a number of one million or more",
        ),
        ("[positions.A]\nat = [0,0,0,0,0,0]\nof = 'B'", r":1: positions\.A: there is no part `B`"),
        (
            "[parts.LID]\nat = [0,0,0,0]\n[positions]\nA = {at=[0,0,0,0,0,0], of='LIDS'}",
            r":4: positions\.A: there is no part `LIDS`; did you mean `LID`\?",
        ),
        ("[positions.'A B']\nat = [0,0,0,0,0,0]", r":1: positions\.A B: a name consists of letters, .*"),
        (
            "[parts.B]\nat = [0,0,0,0]\nholes = [[0,0,0]]",
            r":1: parts\.B: the hole at \(0, 0\) has the diameter 0, which must be above 0",
        ),
        ("[parts.B]\nat = 'here'", r":1: parts\.B: at: a text instead of a list"),
        ("[place.A]", r": `place` is not a known key"),
        (
            "[fixtures.F]\nboxes = [[0, 0, 0, 1, 1, 0]]",
            r":1: fixtures\.F: the box from \(0, 0, 0\) to \(1, 1, 0\) is empty",
        ),
        (
            "[fixtures.F]\nboxes = [[0, 0, 0, 1, 1, inf]]",
            r":1: fixtures\.F: boxes contains a number of one million .*",
        ),
        ("[fixtures.F]", r":1: fixtures\.F: `boxes` is missing"),
        (
            "[held.H]\npositions = ['A']\nboxes = []",
            r":1: held\.H: there is no position `A` in this file",
        ),
        (
            f"{AT}[held.G]\npositions = ['A']\nboxes = []\n[held.H]\npositions = ['A']\nboxes = []",
            r":6: held\.H: at A, the hand already holds G",
        ),
        (
            f"[fixtures.F]\nboxes = {[[0, 0, 0, 1, 1, 1]] * 501}",
            r":1: fixtures\.F: with this entry, the file has more than 500 boxes",
        ),
        ("positions = 3", r": positions: a whole number instead of a table"),
    ],
)
def test_mistake_in_a_taught_file_is_named_with_its_key(tmp_path: Path, text: str, message: str) -> None:
    with pytest.raises(InvalidInput, match=rf"taught\.toml{message}$"):
        load_taught(write(tmp_path, text))


def test_a_name_that_stands_twice_is_told_with_its_line(tmp_path: Path) -> None:
    text = "[positions]\nA = {at = [1, 2, 3, 0, 0, 0]}\nA = {at = [1, 2, 3, 0, 0, 0]}\n"
    with pytest.raises(InvalidInput, match=r"not TOML: a key appears twice \(at line 3, column \d+\)$"):
        load_taught(write(tmp_path, text))


def test_what_is_no_toml_is_called_so(tmp_path: Path) -> None:
    with pytest.raises(
        InvalidInput, match=r"taught\.toml is not TOML: expected .*\(at line 1, column \d+\)$"
    ):
        load_taught(write(tmp_path, "positions PIN"))
