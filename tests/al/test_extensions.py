"""`--strict-1973`: what is ours is refused, what is the period's is not."""

from pathlib import Path

import pytest
from al_support import LISTING
from test_dialect_of_1977 import LISTING_1977

from handeye import al
from handeye.al.instructions import INSTRUCTIONS
from handeye.cli.scripts import check
from handeye.core.codes import CODES
from handeye.core.source import Source


@pytest.mark.parametrize("listing", [LISTING, LISTING_1977])
def test_listings_of_the_period_use_nothing_of_ours(listing: str) -> None:
    assert al.extensions(Source(name="x.al", text=listing)) == []


def test_example_of_the_code_gets_it() -> None:
    source = Source(name="x.al", text=CODES["extension-used"].example)
    assert [d.code for d in al.extensions(source)] == ["extension-used"]


def test_what_is_ours_in_a_required_file_is_found() -> None:
    source = al.sewn_of(Source(name="x.al", text="REQUIRE a.al\nPARK"), {"a.al": "OPEN 1\nLOAD 4"})
    (diagnostic,) = al.extensions(source)
    text, at = source.find(diagnostic.primary.span.start)
    assert (text.key, text.position(at)) == ("a.al", (2, 1))


@pytest.mark.parametrize(
    ("text", "message", "at"),
    [
        ("LOAD 4", "`LOAD` is not documented before 1978", "LOAD"),
        ("MOVE T DIRECT", "`DIRECT` of `MOVE` is an extension of handeye", "DIRECT"),
        ("CHANGE [0 0 1] 1 .5", "`speed` of `CHANGE` is an extension of handeye", ".5"),
        ("CLOSE .1 .2", "`maximum` of `CLOSE` is an extension of handeye", ".2"),
        ("TRANS A [1 2 3 0 0 0] OF BASE", "`OF part` of `TRANS` is an extension of handeye", "BASE"),
        ("STOP 50\nPARK", "`STOP` with a number is an extension of handeye", "50"),
    ],
)
def test_what_is_ours_is_pointed_at(text: str, message: str, at: str) -> None:
    (diagnostic,) = al.extensions(Source(name="x.al", text=text))
    span = diagnostic.primary.span
    assert (diagnostic.message, text[span.start : span.end]) == (message, at)


def test_every_word_of_ours_is_refused() -> None:
    assert {op for op, i in INSTRUCTIONS.items() if i.ours} >= {
        "TURN",
        "TORQUE",
        "TRAVEL",
        "TOOL",
        "LENS",
        "STAGE",
    }


def test_check_refuses_only_when_asked_to(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    script = tmp_path / "job.al"
    script.write_text("LOAD 4\nOPEN 1\n")
    (tmp_path / "job.toml").write_text("")
    assert check(script) == 0
    assert check(script, strict=True) == 2
    assert "error[extension-used]: `LOAD` is not documented before 1978" in capsys.readouterr().err
