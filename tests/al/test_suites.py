"""Every program in the manual and in the suites beside this file comes to what stands below it.

After a deliberate change `pytest tests/al/test_suites.py --update` writes what it comes to now; read the difference.
"""

import re
from pathlib import Path

import pytest
from cells import SIMULATED
from derived import END, REFERENCE, diagnostics, errors, head, index, page
from figures import as_recorded
from suites import MANUAL, SHOWN, SUITES, Case, cases, shown, taught

from handeye import al
from handeye.al.instructions import INSTRUCTIONS
from handeye.al.parser import parse
from handeye.core.codes import CODES
from handeye.core.diagnostics import has_errors
from handeye.editor.samples import SAMPLE


def marks(case: Case) -> list[pytest.MarkDecorator]:
    looks = SIMULATED in case.blocks.get("cell", "") and "LOOK" in case.program
    return [pytest.mark.slow] * ("run" in case.blocks) + [pytest.mark.render] * looks


CASES = [
    pytest.param(file, n, id=case.name, marks=marks(case))
    for file in SUITES
    for n, case in enumerate(cases(file))
]
FIRST = MANUAL / "README.md"
PAGES = [*INSTRUCTIONS, "DEFINE"]
EMPTY = f"{END}\n*Source:* \n\n## Examples\n\n## Mistakes\n\n## See also\n"
"""A page to be written; --update makes one for an instruction that has none."""
ROWS = {1, 2, 3, 7, 8, 9, 10, 11, 20, 21, 29, 30, 39, 40, 43}
"""Of the reference; the others take more than a program to show."""
LEAST = 45
"""Kinds of diagnostic there are to be."""


@pytest.fixture(scope="session")
def update(request: pytest.FixtureRequest) -> bool:
    return bool(request.config.getoption("--update"))


def keep(file: Path, text: str, update: bool) -> None:
    """The file reads like this; with --update it is made to."""
    if update:
        file.write_text(text, encoding="utf-8")
    assert file.read_text(encoding="utf-8") == text


def with_shown(file: Path, case: Case, really: dict[str, str]) -> str:
    """The file with what is really shown in the blocks of a case."""
    text = file.read_text(encoding="utf-8")
    for kind, (start, end) in sorted(case.spans.items(), key=lambda item: -item[1][0]):
        text = text[:start] + really.get(kind, case.blocks[kind]) + text[end:]
    return text


# -- what is derived ----------------------------------------------------------------------------------


def test_every_instruction_has_a_page_and_every_page_an_instruction() -> None:
    assert {file.stem for file in REFERENCE.glob("*.md")} == {op.lower() for op in PAGES}


@pytest.mark.parametrize("op", INSTRUCTIONS)
def test_the_head_of_a_page_is_the_table_of_instructions(op: str, update: bool) -> None:
    if update and not page(op).exists():
        page(op).write_text(EMPTY, encoding="utf-8")
    _, _, prose = page(op).read_text(encoding="utf-8").partition(END)
    keep(page(op), head(INSTRUCTIONS[op]) + prose, update)


def test_the_manual_has_the_tables_of_instructions_and_of_errors(update: bool) -> None:
    text = FIRST.read_text(encoding="utf-8")
    text = re.sub(r"(?ms)^### Motions\n.*?(?=^## )", lambda _: f"{index()}\n", text)
    text = re.sub(r"(?ms)^\| error \|.*?(?=^## )", lambda _: f"{errors()}\n", text)
    assert index() in text
    keep(FIRST, text, update)


def test_the_manual_says_what_is_taught_for_its_examples() -> None:
    (toml,) = re.findall(r"(?ms)^```toml\n(.*?)^```$", FIRST.read_text(encoding="utf-8"))
    assert taught(toml) == SAMPLE


def test_the_page_of_diagnostics_is_the_table_of_codes(update: bool) -> None:
    keep(MANUAL / "diagnostics.md", diagnostics(), update)


# -- every program ------------------------------------------------------------------------------------


@pytest.mark.parametrize(("file", "number"), CASES)
def test_a_program_comes_to_what_stands_below_it(file: Path, number: int, update: bool) -> None:
    case = cases(file)[number]
    really = shown(case)
    if update:
        keep(file, with_shown(file, case, really), update)
        case = cases(file)[number]
    recorded = {kind: case.blocks[kind] for kind in SHOWN if kind in case.blocks}
    if "run" in recorded.keys() & really.keys():
        really["run"] = as_recorded(really["run"], recorded["run"])
    assert recorded == really


@pytest.mark.parametrize("file", SUITES, ids=lambda file: file.stem)
def test_every_program_shows_its_plan_its_run_or_its_diagnostic(file: Path) -> None:
    assert [case.name for case in cases(file) if not set(SHOWN) & set(case.blocks)] == []


@pytest.mark.parametrize("file", SUITES, ids=lambda file: file.stem)
def test_programs_are_laid_out_as_the_formatter_does(file: Path) -> None:
    texts = [text for case in cases(file) for text in (case.program, *case.required.values())]
    programs = [text for text in texts if not has_errors(parse(text)[1])]
    assert [text for text in programs if al.format_text(text) != text] == []


# -- the whole ----------------------------------------------------------------------------------------


@pytest.mark.parametrize("op", PAGES)
def test_a_page_shows_its_instruction_at_work_and_a_mistake(op: str) -> None:
    using = [case for case in cases(page(op)) if re.search(rf"\b{op}\b", case.program)]
    kinds = {kind for case in using for kind in case.blocks}
    assert kinds & {"plan", "run"}
    assert "diagnostic" in kinds


@pytest.mark.parametrize("op", PAGES)
def test_a_page_says_where_its_instruction_comes_from_and_what_to_read_next(op: str) -> None:
    text = page(op).read_text(encoding="utf-8")
    assert re.findall(r"^## (.*)$", text, re.MULTILINE) == ["Meaning", "Examples", "Mistakes", "See also"]
    assert "\n*Source:* " in text


@pytest.mark.parametrize("file", list(MANUAL.rglob("*.md")), ids=lambda f: f.stem)
def test_links_lead_somewhere(file: Path) -> None:
    links = re.findall(r"\]\(([^)#:]+)(?:#[^)]*)?\)", file.read_text(encoding="utf-8"))
    assert [link for link in links if not (file.parent / link).exists()] == []


def test_every_row_of_the_reference_about_the_language_is_an_example() -> None:
    text = (Path(__file__).parent / "spec_rows.md").read_text(encoding="utf-8")
    assert {int(row) for row in re.findall(r"^## Row (\d+): ", text, re.MULTILINE)} == ROWS


def test_every_code_is_shown_with_an_example_that_gets_it() -> None:
    text = "\n".join(file.read_text(encoding="utf-8") for file in SUITES)
    assert set(re.findall(r"^(?:error|warning)\[([a-z-]+)\]: ", text, re.MULTILINE)) == set(CODES)
    assert len(CODES) >= LEAST


ROOT = Path(__file__).parents[2]
PROGRAMS = sorted(
    file.relative_to(ROOT).as_posix()
    for folder in ("plans", "examples", "benches", "tests/exercises/solutions")
    for file in (ROOT / folder).rglob("*.al")
    if not has_errors(parse(file.read_text(encoding="utf-8"))[1])
)


@pytest.mark.parametrize("name", PROGRAMS)
def test_programs_for_users_are_laid_out_as_the_formatter_does(name: str) -> None:
    text = (ROOT / name).read_text(encoding="utf-8")
    assert al.format_text(text) == text
