"""What an editor asks about a script sewn of several files."""

import pytest

from handeye.al.includes import led_by, sewn_of
from handeye.core.source import Source
from handeye.editor.completion import completions
from handeye.editor.document import Document
from handeye.editor.fixes import fixes
from handeye.editor.hover import hover
from handeye.editor.navigation import Place, definition, references, rename
from handeye.editor.samples import SAMPLE

FILES = {
    "lib/drop.al": "DEFINE DROP\nCHANGE DOWN 1\n\n",
    "names.al": (
        "REQUIRE lib/drop.al\nVECT DOWN [0 0 -50]\nTRANS OVER [26 40 3 0 90 0]\n"
        "DEFINE SAG\nSTOP DOWN\nDROP\n\n"
    ),
}


def pointed(marked: str) -> tuple[Document, int]:
    source = Source(name="main.al", text=marked.replace("|", ""))
    return Document(source=source, taught=SAMPLE, read=FILES.__getitem__), marked.index("|")


def shown(document: Document, found: list[Place]) -> list[str]:
    """Each place as `file:line:column`."""
    texts = {text.key: text for text in document.whole.texts}
    return [f"{f.file}:{':'.join(map(str, texts[f.file].position(f.span.start)))}" for f in found]


@pytest.mark.parametrize(
    ("marked", "places"),
    [
        ("REQUIRE names.al\nSA|G", ["names.al:4:8"]),
        ("REQUIRE names.al\nDR|OP", ["lib/drop.al:1:8"]),
        ("REQUIRE names.al\nMOVE OV|ER", ["names.al:3:7"]),
        ("REQUIRE names.al\nSTOP D|OWN\nPARK", ["names.al:2:6"]),
        ("REQUIRE nam|es.al", ["names.al:1:1"]),
    ],
)
def test_definition_leads_into_the_required_file(marked: str, places: list[str]) -> None:
    document, at = pointed(marked)
    assert shown(document, definition(document, at)) == places


def test_references_are_found_in_every_file() -> None:
    document, at = pointed("REQUIRE names.al\nSTOP D|OWN\nPARK")
    assert shown(document, references(document, at)) == [
        ":2:6",
        "names.al:2:6",
        "names.al:5:6",
        "lib/drop.al:2:8",
    ]


def test_renaming_edits_every_file() -> None:
    document, at = pointed("REQUIRE names.al\nDR|OP")
    assert [(edit.file, edit.text) for edit in rename(document, at, "FALL")] == [
        ("", "FALL"),
        ("names.al", "FALL"),
        ("lib/drop.al", "FALL"),
    ]


def test_names_of_required_files_are_proposed_with_their_place() -> None:
    proposed = {p.text: p.detail for p in completions(*pointed("REQUIRE names.al\n|"))[1]}
    assert (proposed["SAG"], proposed["DROP"]) == ("macro, line names.al:4", "macro, line lib/drop.al:1")


def test_hover_shows_a_macro_of_a_required_file() -> None:
    found = hover(*pointed("REQUIRE names.al\nSA|G"))
    assert found is not None
    assert found.text == "macro `SAG`, line names.al:4\n\n```armal\nDEFINE SAG\nSTOP DOWN\nDROP\n```"


def test_hover_knows_a_position_of_a_required_file() -> None:
    found = hover(*pointed("REQUIRE names.al\nMOVE OV|ER"))
    assert found is not None
    assert "hand at (26, 40, 3) in" in found.text


def test_no_cure_reaches_into_a_required_file() -> None:
    source = Source(name="main.al", text="REQUIRE a.al\nPARK")
    document = Document(source=source, taught=SAMPLE, read={"a.al": "L: OPEN 1 2"}.__getitem__)
    assert [fixes(document, d) for d in document.compiled[1]] == [[]]


def test_what_is_required_by_a_required_file_is_led_to_from_the_text() -> None:
    source = sewn_of(Source(name="main.al", text="PARK\nREQUIRE names.al"), FILES)
    span = led_by(source, "lib/drop.al")
    assert span is not None
    assert source.text[span.start : span.end] == "names.al"
