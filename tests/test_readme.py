"""The README: short, and its code does what it shows."""

import json
import re
import runpy
from pathlib import Path

import pytest
from conftest import Command

from handeye import al
from handeye.core import resources

ROOT = Path(__file__).parent.parent
TEXT = (ROOT / "README.md").read_text(encoding="utf-8")
BLOCKS = re.findall(r"^```(\w*)\n(.*?)^```$", TEXT, re.MULTILINE | re.DOTALL)


def shown(language: str) -> tuple[str, str]:
    """The block in a language, and what the block after it says comes of it."""
    number = [name for name, _ in BLOCKS].index(language)
    return BLOCKS[number][1], BLOCKS[number + 1][1]


def test_it_has_at_most_700_words() -> None:
    assert len(TEXT.split()) <= 700


def test_its_first_screen_says_what_it_is_shows_it_and_names_the_commands() -> None:
    head, _, below = TEXT.partition("\n## ")
    assert "MuJoCo" in head.split("\n\n")[1]
    places = [
        head.index(part)
        for part in ("pictures/assembly.webp", "run.py demo", "run.py assemble", "run.py test", "| **")
    ]
    assert places == sorted(places)
    assert len(head.splitlines()) <= 30
    assert below


def test_its_time_for_a_pump_is_that_of_the_recorded_run() -> None:
    minutes, seconds = map(int, re.search(r"\*\*(\d+):(\d\d) min\*\* of simulated time", TEXT).groups())
    recorded = json.loads((resources.demo() / "result.json").read_bytes())["timing"]["working_s"]
    assert 60 * minutes + seconds == pytest.approx(recorded, abs=5)


def test_its_program_gets_the_diagnostic_it_shows(command: Command) -> None:
    program, said = shown("al")
    typed, _, diagnostic = said.partition("\n")
    assert al.format_text(program) == program
    Path("hole.al").write_text(program, encoding="utf-8")
    code, _, err = command(*typed.split()[2:])
    assert (code, err.rstrip("\n")) == (2, diagnostic.rstrip("\n"))


@pytest.mark.slow
def test_its_python_prints_what_it_shows(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    monkeypatch.chdir(tmp_path)
    program, said = shown("python")
    exec(compile(program, "README.md", "exec"), {})  # noqa: S102 - our own page
    assert capsys.readouterr().out == said


@pytest.mark.slow
@pytest.mark.parametrize("name", ["program", "senses"])
def test_its_drawn_pictures_show_what_is_so(name: str) -> None:
    made = runpy.run_path(str(ROOT / "docs" / "make_readme_pictures.py"))
    drawn = (ROOT / "docs" / "pictures" / f"{name}.svg").read_text(encoding="utf-8")
    assert made[name]() == drawn, f"run: python docs/make_readme_pictures.py {name}"
