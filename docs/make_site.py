"""Build the site of the documentation in site/.

python3 run.py docs

The site consists of static files, and needs neither a server nor a network. Nothing is simulated: the replays show
recorded runs, from `demo/` and `docs/recordings/`. Exit code 0: built; 1: a link leads nowhere, or Sphinx has warned.
"""

import json
import shutil
import sys
from collections.abc import Iterator
from pathlib import Path
from typing import Final

from sphinx.cmd.build import build_main

ROOT: Final = Path(__file__).parent.parent
sys.path.insert(0, str(ROOT))

from docs.website.built import Page, Section, mend, read_page  # noqa: E402
from docs.website.checks import faults  # noqa: E402
from docs.website.staging import REPLAYS, BrokenLinks, recordings, replay_path, stage  # noqa: E402
from handeye.cli.reports import page_of  # noqa: E402

SITE: Final = ROOT / "site"
WORK: Final = ROOT / "build" / "docs"
INDEX: Final = "search_index.js"
DEFINING: Final = frozenset({"faults.html", "glossary.html", "language/index.html"})
"""Pages whose tables define words: the search finds each row."""
LONGEST: Final = 60
"""Greatest length of a first cell that is a word and not a sentence."""


def main() -> int:
    if SITE.exists() and not (SITE / INDEX).exists():
        say(f"{SITE} exists, but is no site that this command has built; move it away.")
        return 2
    shutil.rmtree(WORK, ignore_errors=True)
    built = WORK / "site"
    try:
        stage(ROOT, WORK / "pages")
    except BrokenLinks as links:
        say(str(links))
        return 1
    write_replays(built)
    if not write_pages(WORK / "pages", built):
        return 1
    pages = pages_of(built)
    (built / INDEX).write_text(search_index(pages), encoding="utf-8")
    found = list(faults(pages, files_of(built)))
    for fault in found:
        say(fault)
    if found:
        return 1
    shutil.rmtree(SITE, ignore_errors=True)
    built.rename(SITE)
    sys.stdout.write(f"{SITE / 'index.html'}\n")
    return 0


def write_pages(staged: Path, built: Path) -> bool:
    """Let Sphinx write the pages. Returns False if it fails or warns."""
    settings = ["-c", str(ROOT / "docs" / "website"), "-d", str(WORK / "doctrees")]
    return (
        build_main(["--quiet", "--fail-on-warning", "--keep-going", *settings, str(staged), str(built)]) == 0
    )


def pages_of(built: Path) -> dict[str, Page]:
    """The pages that Sphinx wrote, mended, by path."""
    paths = sorted(
        path for path in files_of(built) if path.endswith(".html") and not path.startswith(REPLAYS)
    )
    for path in paths:
        mend(built / path)
    return {path: read_page(built / path) for path in paths}


def write_replays(built: Path) -> None:
    """Write the page of each recorded run."""
    for run in recordings(ROOT):
        page = built / replay_path(run.as_posix())
        page.parent.mkdir(parents=True, exist_ok=True)
        page.write_bytes(page_of(run))


def search_index(pages: dict[str, Page]) -> str:
    """The script that gives the search its sections, and the rows of the tables that define words."""
    sections = [
        [path, anchor, *map(one_line, (page.sections[0].heading, part.heading, part.text))]
        for path, page in sorted(pages.items())
        for anchor, part in parts(page, rows=path in DEFINING)
    ]
    return f"const SECTIONS = {json.dumps(sections, ensure_ascii=False, separators=(',', ':'))};\n"


def parts(page: Page, *, rows: bool) -> Iterator[tuple[str, Section]]:
    """The sections of a page, and the rows of its tables, each with the anchor to go to."""
    for number, section in enumerate(page.sections):
        yield section.anchor if number else "", section
    if rows:
        yield from ((row.anchor, row) for row in page.rows if row.text and len(row.heading) <= LONGEST)


def one_line(text: str) -> str:
    return " ".join(text.split())


def files_of(folder: Path) -> set[str]:
    return {file.relative_to(folder).as_posix() for file in folder.rglob("*") if file.is_file()}


def say(sentence: str) -> None:
    sys.stderr.write(f"{sentence}\n")


if __name__ == "__main__":
    sys.exit(main())
