"""The pages name files and folders that exist."""

import re
from pathlib import Path

import pytest

ROOT = Path(__file__).parent.parent
PACKAGE = ROOT / "handeye"
PAGES = [
    *sorted(ROOT.glob("*.md")),
    *sorted((ROOT / "docs").rglob("*.md")),
    ROOT / "editors/vscode/README.md",
    ROOT / "scenes/water_pump/README.md",
]
NAMED = re.compile(
    r"`((?:[\w.-]+/)*[\w.-]+\.(?:py|toml|xml|al|json|md|svg|js|lock|cff|yml|png|webp)|(?:[\w.-]+/)+[\w-]*)(?:::\w+)?`"
)
"""A path in backquotes: a file by its ending, or a path by a slash."""
EXAMPLES = {"gasket.al", "pins.al", "hole.al", "lib/hole.al", "first.al", "first.toml", "job.al", "job.toml"}
EXAMPLES |= {
    "seven.al",
    "see.al",
    "touch.al",
    "touch.toml",
    "find.al",
    "gently.al",
    "honest.al",
    "seven.toml",
    "pin.al",
    "pin.toml",
    "blind.al",
    "NAME.al",
    "example.al",
    "host.json",
    "result.json",
    "plan.json",
}
EXAMPLES |= {"site/"}  # what `python3 run.py docs` builds
EXAMPLES |= {"solution.al", "solution.toml", "brief.md", "task.toml", "feedback.md"}
EXAMPLES |= {"pallet.trig.json", "job.json", ".trig.json", "FILE.toml", "languages.toml", "scene.xml"}
EXAMPLES |= {f"handeye/{job}-v0" for job in ("Pin", "Screw", "GasketAndTop", "Pump", "Resume", "Mend")}
EXAMPLES |= {"handeye/Blocks-v0", "handeye/Chess-v0"}
"""Files that an example, a user or a run makes; and ids of environments, which look like paths."""
ELSEWHERE = (".venv/", "stanford/", "base/")
"""What the first start makes; names in the scene, which look like paths."""


def of_today(page: Path) -> str:
    """The text of a page; of the changelog without the versions that are out, whose files may be gone."""
    return re.split(r"^## \[\d", page.read_text(encoding="utf-8"), flags=re.MULTILINE)[0]


@pytest.mark.parametrize("page", PAGES, ids=lambda page: str(page.relative_to(ROOT)))
def test_every_file_a_page_names_exists(page: Path) -> None:
    text = re.sub(r"^```.*?^```$", "", of_today(page), flags=re.MULTILINE | re.DOTALL)
    named = {name for name in NAMED.findall(text) if not name.startswith(ELSEWHERE)} - EXAMPLES
    places = (ROOT, PACKAGE, page.parent, ROOT / "plans")
    assert {name for name in named if not any((place / name).exists() for place in places)} == set()


@pytest.mark.parametrize("page", PAGES, ids=lambda page: str(page.relative_to(ROOT)))
def test_every_link_of_a_page_leads_to_a_file(page: Path) -> None:
    text = of_today(page)
    links = {link.split("#")[0] for link in re.findall(r"\]\(([^)\s]+)\)", text) if "://" not in link}
    assert {link for link in links if link and not (page.parent / link).exists()} == set()


def headings(page: Path) -> set[str]:
    """The anchors of a page: its headings as GitHub writes them."""
    text = re.sub(r"^```.*?^```$", "", page.read_text(encoding="utf-8"), flags=re.MULTILINE | re.DOTALL)
    titles = re.findall(r"^#+ (.*)$", text, re.MULTILINE)
    plain = [re.sub(r"\[(.*?)\]\(.*?\)", r"\1", title).lower() for title in titles]
    return {re.sub(r"[^\w\- ]", "", title).replace(" ", "-") for title in plain}


@pytest.mark.parametrize("page", PAGES, ids=lambda page: str(page.relative_to(ROOT)))
def test_every_anchor_of_a_page_is_a_heading(page: Path) -> None:
    links = re.findall(r"\]\(((?!https?:)[^)\s#]*)#([^)\s]+)\)", of_today(page))
    pages = [(page.parent / file if file else page, anchor) for file, anchor in links]
    assert [anchor for file, anchor in pages if file.suffix == ".md" and anchor not in headings(file)] == []
