"""`handeye docs` and the index of the documentation: every page is found by what one wants to do."""

import re
from pathlib import Path

import pytest
from conftest import Command

from handeye.core.pages import INDEX, pages, sections

DOCS = Path(__file__).parent.parent / "docs"
TEXT = (DOCS / INDEX).read_text(encoding="utf-8")
PAGES = {page.relative_to(DOCS).as_posix() for page in DOCS.rglob("*.md")} - {INDEX}


def test_the_index_names_every_page_once() -> None:
    named = [link.split("#")[0] for link in re.findall(r"\]\(([^)\s]+)\)", TEXT) if link[0] not in "#."]
    assert sorted(named) == sorted(PAGES)


def test_every_page_has_a_topic_of_its_own() -> None:
    assert {page.relative_to(DOCS).as_posix() for page in pages(DOCS).values()} == PAGES


def test_without_a_topic_it_lists_all_pages_but_those_of_instructions(command: Command) -> None:
    code, out, _ = command("docs")
    listed = re.findall(r"^  (\S+)  ", out, re.MULTILINE)
    assert code == 0
    assert sorted(listed) == sorted(
        set(pages(DOCS)) - {page.stem for page in (DOCS / "language/reference").iterdir()}
    )
    assert max(map(len, out.splitlines())) <= 100


@pytest.mark.parametrize(
    ("topic", "page"),
    [
        ("faults", "faults.md"),
        ("SEARCH", "language/reference/search.md"),
        ("language", "language/README.md"),
        ("language/tutorial", "language/tutorial.md"),
        ("docs/trials.md", "trials.md"),
    ],
)
def test_a_topic_prints_its_page(command: Command, topic: str, page: str) -> None:
    code, out, _ = command("docs", topic)
    assert (code, out) == (0, (DOCS / page).read_text(encoding="utf-8"))


@pytest.mark.parametrize(("topic", "linked"), [("agents_bench", "mcp"), ("mcp", "agents_bench"), ("ml", "")])
def test_a_printed_page_says_how_to_open_a_linked_page(command: Command, topic: str, linked: str) -> None:
    err = command("docs", topic)[2]
    assert err.startswith(f"to open a linked page: `handeye docs {linked}")
    opened = re.findall("`handeye docs (.*)`", err)[0]
    assert command("docs", opened)[0] == 0
    assert Path(err.rstrip().rpartition(" relative to ")[2]).samefile(DOCS)


def test_a_path_is_one_that_can_be_opened(command: Command) -> None:
    code, out, _ = command("docs", "faults", "--path")
    assert (code, Path(out.strip()).samefile(DOCS / "faults.md")) == (0, True)


@pytest.mark.parametrize(
    ("topic", "hint"), [("serch", "did you mean search?"), ("../README", "`handeye docs` lists the pages")]
)
def test_a_topic_without_a_page_gets_a_sentence(command: Command, topic: str, hint: str) -> None:
    assert command("docs", topic) == (2, "", f"handeye: there is no page `{topic}`; {hint}\n")


def test_each_topic_is_listed_with_a_sentence() -> None:
    entries = [entry for _, section in sections(TEXT) for entry in section]
    assert [topic for topic, sentence in entries if not sentence.endswith(".")] == []
