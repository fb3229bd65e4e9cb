"""A taught position goes into the text of its file, and nothing else there changes."""

import tomllib

import pytest
from hypothesis import given
from hypothesis import strategies as st

from handeye.core.errors import InvalidInput
from handeye.core.resources import plans
from handeye.core.units import DEGREE, INCH
from handeye.program.program import Position
from handeye.program.taught_text import with_position

PUMP = (plans() / "water_pump.toml").read_text(encoding="utf-8")


def at(x: float, y: float, z: float, of: str | None = None) -> Position:
    """A hand position that points down (in)."""
    return Position(at=(x * INCH, y * INCH, z * INCH, 90 * DEGREE, 90 * DEGREE, 0.0), of=of)


def changed(before: str, after: str) -> list[str]:
    """The lines that are not in both, with a sign."""
    old, new = before.splitlines(), after.splitlines()
    return [f"-{line}" for line in old if line not in new] + [f"+{line}" for line in new if line not in old]


def test_a_new_position_goes_behind_the_others_and_no_other_line_changes() -> None:
    after = with_position(PUMP, "H6", at(4, 1.5, 5, "PUMP"))
    assert changed(PUMP, after) == ['+H6 = { at = [4.0, 1.5, 5.0, 90.0, 90.0, 0.0], of = "PUMP" }']


def test_a_position_taught_anew_has_other_figures_on_its_line_and_no_other_line_changes() -> None:
    after = with_position(PUMP, "T1", at(1, 2, 3, "PUMP"))
    assert changed(PUMP, after)[1:] == ['+T1 = { at = [1.0, 2.0, 3.0, 90.0, 90.0, 0.0], of = "PUMP" }']


@pytest.mark.parametrize(
    ("before", "after"),
    [
        ("", "[positions]\nA = { at = [1.0, 2.0, 3.0, 90.0, 90.0, 0.0] }\n"),
        ("# mine\n", "# mine\n\n[positions]\nA = { at = [1.0, 2.0, 3.0, 90.0, 90.0, 0.0] }\n"),
        (
            "[positions] # in\n\n# the parts\n[parts]\n",
            "[positions] # in\nA = { at = [1.0, 2.0, 3.0, 90.0, 90.0, 0.0] }\n\n# the parts\n[parts]\n",
        ),
        (
            "[positions]\nA = { of = 'P', at = [0, 0, 0, 0, 0, 0] } # a",
            "[positions]\nA = { at = [1.0, 2.0, 3.0, 90.0, 90.0, 0.0] } # a",
        ),
        (
            "[positions]\nA = { at = [0, 0, 0, 0, 0, 0] } # a, of = 'P'",
            "[positions]\nA = { at = [1.0, 2.0, 3.0, 90.0, 90.0, 0.0] } # a, of = 'P'",
        ),
        ("[positions]\r\n# b\r\n", "[positions]\r\nA = { at = [1.0, 2.0, 3.0, 90.0, 90.0, 0.0] }\r\n# b\r\n"),
        (
            "[positions.A] # a\nat = [0, 0, 0, 0, 0, 0] # b\nof = 'P'\n# c\n[parts.P]\nat = [0, 0, 0, 0]\n",
            "[positions.A] # a\nat = [1.0, 2.0, 3.0, 90.0, 90.0, 0.0] # b\n\n# c\n[parts.P]\nat = [0, 0, 0, 0]\n",
        ),
    ],
)
def test_comments_and_layout_stay(before: str, after: str) -> None:
    assert with_position(before, "A", at(1, 2, 3)) == after


@pytest.mark.parametrize(
    "text",
    [
        "[positions]\nA = { at = [\n0, 0, 0, 0, 0, 0] }\n",
        "positions = { B = { at = [0, 0, 0, 0, 0, 0] } }\n",
        'note = """\n[positions]\n"""\n',
    ],
)
def test_what_cannot_be_edited_alone_is_refused_with_the_line_to_be_put_in(text: str) -> None:
    with pytest.raises(
        InvalidInput, match=r"^A cannot be added automatically; add this line yourself: A = \{ at = "
    ):
        with_position(text, "A", at(1, 2, 3))


NAMES = st.from_regex(r"[A-Za-z_][A-Za-z0-9_]{0,5}", fullmatch=True)
COMMENTS = st.text(st.characters(codec="utf-8", exclude_categories=("C",)), max_size=12)
FIGURES = st.floats(-50, 50).map(lambda x: round(x, 3))


@pytest.mark.slow
@given(
    st.lists(st.tuples(NAMES, FIGURES, st.sampled_from([None, "P"]), COMMENTS), unique_by=lambda e: e[0]),
    NAMES, st.tuples(FIGURES, FIGURES, FIGURES), st.sampled_from([None, "P"]),
)  # fmt: skip
def test_whatever_is_taught_the_file_says_that_and_all_it_said_before(
    entries: list[tuple[str, float, str | None, str]], name: str, place: tuple[float, float, float], of: str
) -> None:
    lines = [
        f"{n} = {{ at = [{x}, 0, 0, 0, 90, 0]{', of = ' + repr(part) if part else ''} }} # {comment}"
        for n, x, part, comment in entries
    ]
    text = "\n".join(["# head", "[positions]", *lines, "", "[parts.P] # tail", "at = [0, 0, 0, 0]", ""])
    after = with_position(text, name, at(*place, of))
    read, was = tomllib.loads(after), tomllib.loads(text)
    assert read["positions"].pop(name)["at"][:3] == pytest.approx(place, abs=1e-3)
    was["positions"].pop(name, None)
    assert read == was
    assert [c for *_, c in entries if f"# {c}" not in after] == []
