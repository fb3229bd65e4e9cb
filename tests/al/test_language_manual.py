"""Markdown files as tests: programs in them compile, or get exactly the diagnostic that follows them."""

import re
from pathlib import Path

import pytest
from al_support import TAUGHT, compiled

from handeye import al
from handeye.al.instructions import INSTRUCTIONS, LENSES
from handeye.codes import CODES
from handeye.diagnostics import render
from handeye.source import Source

HERE = Path(__file__).parent
MANUAL = HERE.parents[1] / "docs" / "language.md"
REQUIRED = re.compile(r"^```al (\S+)\n(.*?)^```$", re.MULTILINE | re.DOTALL)
"""A file that programs below it may require."""
BLOCK = re.compile(r"^```(al|diagnostic)\n(.*?)^```$", re.MULTILINE | re.DOTALL)


def cases(file: Path) -> list[tuple[str, str]]:
    """Programs of a file, each with the rendering that follows it (or nothing)."""
    found: list[tuple[str, str]] = []
    for kind, text in BLOCK.findall(file.read_text(encoding="utf-8")):
        if kind == "al":
            found.append((text, ""))
        else:
            assert found, f"{file.name}: a diagnostic without a program before it"
            assert not found[-1][1], f"{file.name}: two diagnostics for one program"
            found[-1] = (found[-1][0], text)
    return found


FILES = [MANUAL, *sorted(HERE.glob("*.md"))]
REQUIRABLE = dict(found for file in FILES for found in REQUIRED.findall(file.read_text(encoding="utf-8")))
CASES = [
    pytest.param(text, wanted, id=f"{file.stem}-{number}")
    for file in FILES
    for number, (text, wanted) in enumerate(cases(file), 1)
]


@pytest.mark.parametrize(("text", "wanted"), CASES)
def test_program_in_the_manual_gets_what_stands_below_it(text: str, wanted: str) -> None:
    source = al.sewn_of(Source(name="pump.al", text=text), REQUIRABLE)
    diagnostics = al.compile_text(source, TAUGHT)[1]
    assert "\n\n".join(render(d, source) for d in diagnostics) == wanted.rstrip("\n")


@pytest.mark.parametrize(("text", "wanted"), CASES)
def test_program_in_the_manual_is_laid_out_as_the_formatter_does(text: str, wanted: str) -> None:
    assert al.format_text(text) == text


def test_manual_has_the_table_of_instructions() -> None:
    assert al.manual() in MANUAL.read_text(encoding="utf-8")


def test_manual_explains_every_diagnostic() -> None:
    rows = re.findall(
        r"^\| `([a-z-]+)` \| (error|warning) \| (.*) \|$", MANUAL.read_text(encoding="utf-8"), re.MULTILINE
    )
    assert rows == [
        (code, entry.severity, entry.meaning)
        for phase in ("language", "planning")
        for code, entry in sorted(CODES.items())
        if entry.phase == phase
    ]


def test_every_instruction_can_be_carried_out_as_the_manual_shows_it() -> None:
    text = MANUAL.read_text(encoding="utf-8")
    used = {word for block in BLOCK.findall(text) for word in re.findall(r"[A-Z]+", block[1])}
    assert set(INSTRUCTIONS) <= used


def test_lenses_are_those_of_the_turret() -> None:
    assert [len(compiled(f"LENS {mm:g}").steps) for mm in LENSES] == [1, 1]
