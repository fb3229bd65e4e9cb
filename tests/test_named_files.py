"""The pages name files and folders that exist."""

import re
from pathlib import Path

import pytest

ROOT = Path(__file__).parent.parent
PACKAGE = ROOT / "handeye"
PAGES = [ROOT / "README.md", ROOT / "scenes/water_pump/README.md", *sorted((ROOT / "docs").rglob("*.md"))]
NAMED = re.compile(r"`((?:[\w.]+/)*[\w.]+\.(?:py|toml|xml|al|json|md|svg)|(?:[\w]+/)+)(?:::\w+)?`")
"""A path in backquotes: a file by its ending, or a folder by its slash."""
EXAMPLES = {"gasket.al", "pins.al", "hole.al", "lib/hole.al", "first.al", "first.toml", "job.al", "job.toml"}
EXAMPLES |= {
    "seven.al",
    "seven.toml",
    "pin.al",
    "pin.toml",
    "NAME.al",
    "example.al",
    "host.json",
    "result.json",
    "plan.json",
}
EXAMPLES |= {"FILE.toml", "languages.toml", "stanford/"}
"""Files that an example, a user or a run makes; and a prefix of names in the scene."""


@pytest.mark.parametrize("page", PAGES, ids=lambda page: str(page.relative_to(ROOT)))
def test_every_file_a_page_names_exists(page: Path) -> None:
    text = re.sub(r"^```.*?^```$", "", page.read_text(encoding="utf-8"), flags=re.MULTILINE | re.DOTALL)
    named = set(NAMED.findall(text)) - EXAMPLES
    places = (ROOT, PACKAGE, page.parent, ROOT / "plans")
    assert {name for name in named if not any((place / name).exists() for place in places)} == set()


@pytest.mark.parametrize("page", PAGES, ids=lambda page: str(page.relative_to(ROOT)))
def test_every_link_of_a_page_leads_to_a_file(page: Path) -> None:
    text = page.read_text(encoding="utf-8")
    links = {link.split("#")[0] for link in re.findall(r"\]\(([^)\s]+)\)", text) if "://" not in link}
    assert {link for link in links if link and not (page.parent / link).exists()} == set()
