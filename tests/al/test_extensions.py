"""`--strict-1973`: what is ours is refused, what is the period's is not."""

from collections import Counter
from pathlib import Path

import pytest
from al_support import LISTING
from test_dialect_of_1977 import LISTING_1977

from handeye import al
from handeye.al.definition import Document
from handeye.al.instructions import EXPLAINED, INSTRUCTIONS
from handeye.cli.scripts import check
from handeye.core.codes import CODES
from handeye.core.source import Source

DOCS = Path(__file__).parents[2] / "docs"


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


def test_words_that_are_known_only_from_memory_are_accepted() -> None:
    text = "PLACE\nFORCE [0 0 -20]\nTOUCH 3\nCHANGE [0 0 -1] 1\nSTOP [0 0 -50] [0 0 9]\nCHANGE [0 0 -1] 1"
    assert al.extensions(Source(name="x.al", text=text)) == []


def test_the_manual_explains_every_origin_and_the_page_of_1973_counts_them() -> None:
    manual, compared = (
        (DOCS / page).read_text(encoding="utf-8") for page in ("language/README.md", "1973.md")
    )
    counts = Counter(each.document for each in EXPLAINED.values())
    assert [one.value for one in Document if f"\n| {one.value} |" not in manual] == []
    assert (
        f"of {counts.total()} instructions, {counts[Document.PAPER_1973]} are from the paper, "
        f"{counts[Document.MANUAL_1973]} from the manual of 1973, {counts[Document.MANUAL_1976]} from a manual "
        f"of 1976, {counts[Document.LISTING_1977]} from the listing of 1977 and {counts[Document.MEMORY]} from "
        f"memory; the eight from the listing and from memory are unverified. {counts[None]} are ours"
    ) in compared


def test_check_refuses_only_when_asked_to(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    script = tmp_path / "job.al"
    script.write_text("LOAD 4\nOPEN 1\n")
    (tmp_path / "job.toml").write_text("")
    assert check(script) == 0
    assert check(script, strict=True) == 2
    assert "error[extension-used]: `LOAD` is not documented before 1978" in capsys.readouterr().err
