"""What agents read: AGENTS.md and llms.txt."""

import re
import runpy
from pathlib import Path

from handeye.agents.tools import TOOLS

ROOT = Path(__file__).parent.parent.parent
LLMS = (ROOT / "llms.txt").read_text(encoding="utf-8")
AGENTS = (ROOT / "AGENTS.md").read_text(encoding="utf-8")
INDEX = (ROOT / "docs/README.md").read_text(encoding="utf-8")
WRITTEN = runpy.run_path(str(ROOT / "docs/make_llms.py"))["written"]


def test_llms_txt_lists_the_pages_of_the_index() -> None:
    assert WRITTEN(LLMS, INDEX) == LLMS


def test_llms_txt_lists_every_page_but_those_of_instructions() -> None:
    named = set(re.findall(r"\]\(docs/([^)]*)\)", LLMS))
    pages = {page.relative_to(ROOT / "docs").as_posix() for page in (ROOT / "docs").rglob("*.md")}
    assert named == {page for page in pages if not page.startswith("language/reference/")} - {"README.md"}


def test_their_links_lead_to_files() -> None:
    links = re.findall(r"\]\(([^)#]*)", LLMS + AGENTS)
    assert len(links) > 50
    assert [link for link in links if not (ROOT / link).is_file()] == []


def test_the_page_of_the_tools_lists_them_all() -> None:
    page = (ROOT / "docs/mcp.md").read_text(encoding="utf-8")
    assert re.findall(r"^\| `(\w+)` \|", page, re.MULTILINE) == [tool.name for tool in TOOLS]
