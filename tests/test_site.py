"""The site of the documentation: each page has its place, and every broken link is found before the site is built."""

import json
from pathlib import Path

import pytest

from docs.website.built import Page, Section, mend, read_page
from docs.website.checks import MUST_FIND, faults
from docs.website.converted import code, notebook_page
from docs.website.navigation import groups, index_page
from docs.website.staging import BrokenLinks, stage

ROOT = Path(__file__).parent.parent
DOCS = ROOT / "docs"
INDEX = (DOCS / "README.md").read_text(encoding="utf-8")
LOCK = (ROOT / "requirements-docs.lock").read_text(encoding="utf-8")


def pages_with(texts: dict[str, str], folder: Path) -> Path:
    """A repository of these files."""
    for name, text in {
        "docs/README.md": "# Docs\n",
        "CHANGELOG.md": "",
        "CONTRIBUTING.md": "",
        **texts,
    }.items():
        (folder / name).parent.mkdir(parents=True, exist_ok=True)
        (folder / name).write_text(text, encoding="utf-8")
    return folder


def found_in(pages: dict[str, str], tmp_path: Path) -> list[str]:
    """What the checks find wrong with the pages of a site that has nothing else."""
    for name, text in pages.items():
        (tmp_path / name).write_text(text, encoding="utf-8")
    read = {name: read_page(tmp_path / name) for name in pages}
    words = Page(sections=[Section("all", "", " ".join(MUST_FIND))])
    return list(faults({**read, "words.html": words}, set(pages)))


def test_every_page_is_in_the_navigation() -> None:
    entries = {path for group in groups(INDEX).values() for _, path in group}
    instructions = {f"language/reference/{page.name}" for page in (DOCS / "language" / "reference").iterdir()}
    pages = {page.relative_to(DOCS).as_posix() for page in DOCS.rglob("*.md")} - {"README.md"}
    assert pages - entries - instructions == set()


def test_a_page_is_only_in_the_first_group_that_names_it() -> None:
    index = "# Docs\n## First\n[A](a.md)\n## Second\n[A](a.md) [B](b.md) [C](#first)\n"
    assert groups(index) == {"First": [("A", "a.md")], "Second": [("B", "b.md")]}
    assert ":caption: Second\n\nB <b.md>\n" in index_page(index, str)


@pytest.mark.slow
def test_no_page_of_the_site_links_to_a_missing_file(tmp_path: Path) -> None:
    stage(ROOT, tmp_path)
    assert (tmp_path / "index.md").exists()
    assert (tmp_path / "notebooks" / "1_the_first_pump.md").exists()
    assert '<a href="replays/chess.html">' in (tmp_path / "gallery.md").read_text(encoding="utf-8")


def test_each_missing_file_is_named(tmp_path: Path) -> None:
    root = pages_with({"docs/a.md": "[b](b.md) `[c](c.md)`\n```\n[d](d.md)\n```\n[e](../e.al#f)\n"}, tmp_path)
    with pytest.raises(
        BrokenLinks, match=r"^docs/a.md: docs/b.md does not exist\ndocs/a.md: e.al does not exist$"
    ):
        stage(root, tmp_path / "staged")


def test_links_lead_to_the_pages_of_the_site(tmp_path: Path) -> None:
    texts = {
        "docs/language/README.md": "[a](../../plans/a.al) [b](../README.md#docs) [c](../../demo)\n",
        "plans/a.al": "PARK\n",
        "demo/result.json": "",
    }
    stage(pages_with(texts, tmp_path), tmp_path / "staged")
    page = (tmp_path / "staged/language/index.md").read_text()
    assert page.startswith(
        '[a](../plans/a.al.md) [b](../index.md#docs) <a href="../replays/demo.html">c</a>\n'
    )
    assert (tmp_path / "staged/plans/a.al.md").read_text().endswith("# plans/a.al\n\n```al\nPARK\n```\n")


def test_a_link_without_a_target_is_found(tmp_path: Path) -> None:
    page = '<a href="b.html">b</a> <a href="a.html#no">c</a> <a href="#yes">d</a> <h1 id="yes">e</h1>'
    assert found_in({"a.html": page}, tmp_path) == [
        "a.html: the link b.html leads nowhere",
        "a.html: the link a.html#no leads nowhere",
    ]


def test_what_is_loaded_from_elsewhere_is_found(tmp_path: Path) -> None:
    page = '<a href="https://example.com">a</a><script src="https://example.com/a.js"></script>'
    page += '<link href="//example.com/a.css"><img src="data:image/png;base64,">'
    assert found_in({"a.html": page}, tmp_path) == [
        "a.html: the page loads https://example.com/a.js from elsewhere",
        "a.html: the page loads //example.com/a.css from elsewhere",
    ]


def test_words_that_the_search_cannot_find_are_reported() -> None:
    page = Page(sections=[Section("", "", "a screw is cross-threaded; a seed; a deadlock")])
    assert list(faults({"a.html": page}, set())) == ["the search does not find error 23"]


def test_a_section_has_the_text_up_to_the_next_heading(tmp_path: Path) -> None:
    file = tmp_path / "a.html"
    file.write_text(
        'menu<article><section id="a"><h1>A<a class="headerlink" href="#a">#</a></h1><p>one</p>'
        '<section id="b"><h2>B</h2><td>two</td><td>three</td></section></section></article>end'
    )
    sections = read_page(file).sections
    assert [(each.anchor, each.heading.split(), each.text.split()) for each in sections] == [
        ("a", ["A"], ["one"]),
        ("b", ["B"], ["two", "three"]),
    ]


def test_a_row_of_a_table_has_its_first_cell_as_heading_and_the_anchor_of_its_section(tmp_path: Path) -> None:
    file = tmp_path / "a.html"
    file.write_text(
        '<article><section id="a"><h1>A</h1><table><tr><th>term</th><th>is</th></tr>'
        "<tr><td>one</td><td>two</td><td>three</td></tr></table><p>four</p></section></article>"
    )
    page = read_page(file)
    rows = [(each.anchor, each.heading.split(), each.text.split()) for each in page.rows if each.text]
    assert rows == [("a", ["one"], ["two", "three"])]
    assert page.sections[0].text.split() == ["term", "is", "one", "two", "three", "four"]


def test_a_mended_page_has_no_empty_heading_of_a_column(tmp_path: Path) -> None:
    file = tmp_path / "a.html"
    file.write_text('<th class="head"><p></p></th><th>a</th>')
    mend(file)
    assert file.read_text() == '<td class="head"></td><th>a</th>'


def test_a_notebook_becomes_a_page_with_its_output() -> None:
    output = {"output_type": "execute_result", "data": {"text/plain": ["2"]}}
    cells = [
        {"cell_type": "markdown", "source": ["# Add\n", "numbers"]},
        {"cell_type": "code", "source": ["1 + 1"], "outputs": [output]},
    ]
    page = notebook_page(json.dumps({"cells": cells}).encode())
    assert page == "# Add\nnumbers\n\n```python\n1 + 1\n```\n\n\n```text\n2\n```\n\n"


def test_a_fence_is_longer_than_those_in_its_text() -> None:
    assert code("```\n", "text") == "````text\n```\n````\n"


@pytest.mark.parametrize("package", ["sphinx", "myst-parser", "furo"])
def test_the_lock_of_the_site_has_the_generator_with_its_hashes(package: str) -> None:
    entry = LOCK.partition(f"\n{package}==")[2].partition("\n")[2]
    assert entry.lstrip().startswith("--hash=sha256:")
