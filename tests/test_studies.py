"""What code, scenes and pages name as a study can be read in docs/studies.md."""

import re
from pathlib import Path

import pytest

from handeye.core.resources import page

ROOT = Path(__file__).parent.parent
CITING = (*(ROOT / "handeye").rglob("*.py"), *(ROOT / "scenes").rglob("*.*"), *(ROOT / "docs").glob("*.md"))
NUMBER = r"(\d(?:\.\d)?)(?![\d.]*\d)"
CITED = re.compile(
    rf"(layout|assembly|vision)[\s#\"]+study(?:'s)?,?[\s#\"]+(?:sections? )?{NUMBER}(?: and {NUMBER})?", re.I
)
HEADING = re.compile(r"^### (Layout|Assembly|Vision) ([\d.]+):", re.MULTILINE)


def test_every_section_of_a_study_that_is_named_is_there() -> None:
    there = {
        (study.lower(), number)
        for study, number in HEADING.findall((ROOT / "docs/studies.md").read_text("utf-8"))
    }
    named = {
        (study.lower(), number)
        for file in CITING
        if file.suffix in {".py", ".toml", ".xml", ".md"}
        for study, *numbers in CITED.findall(file.read_text("utf-8"))
        for number in filter(None, numbers)
    }
    assert ("layout", "2") in named
    assert named - there == set()


def test_pages_are_named_by_a_path_that_can_be_opened(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.chdir(ROOT)
    assert page("studies.md") == "docs/studies.md"
    monkeypatch.chdir(tmp_path)
    assert Path(page("studies.md")) == ROOT / "docs/studies.md"
    assert page("nothing.md") == "docs/nothing.md"
