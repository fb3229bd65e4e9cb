"""The table of faults fits the code and the tests of today; `run.py` carries it out."""

from pathlib import Path

import pytest
from mutant_table import Mutant, TableError, load

ROOT = Path(__file__).parents[2]
MUTANTS = load()
FAULT = {"area": "touch", "name": "a guard sleeps", "file": "handeye/touch/guards.py"}


def test_every_fault_can_be_put_into_the_code() -> None:
    for mutant in MUTANTS:
        code = (ROOT / mutant.file).read_text(encoding="utf-8")
        assert mutant.put_into(code) != code


def test_every_test_that_is_said_to_catch_a_fault_exists() -> None:
    named = [mutant.caught_by.partition("::") for mutant in MUTANTS if mutant.caught_by]
    missing = {
        f"{file}::{test}"
        for file, _, test in named
        if f"def {test}(" not in (ROOT / file).read_text(encoding="utf-8")
    }
    assert missing == set()


def test_the_wider_tests_of_every_fault_exist() -> None:
    assert {place for mutant in MUTANTS for place in mutant.wider if not (ROOT / place).exists()} == set()


def test_there_are_faults_enough_and_hardly_any_survives() -> None:
    survivors = [mutant.name for mutant in MUTANTS if mutant.survives]
    assert len(MUTANTS) >= 60
    assert len(survivors) <= 3


@pytest.mark.parametrize(
    ("text", "code", "told"),
    [
        ("watch()", "sleep()", "its text occurs 0 times in handeye/touch/guards.py, not once"),
        ("watch()", "watch()\nwatch()", "its text occurs 2 times in handeye/touch/guards.py, not once"),
        ("watch()", "watch()", "handeye/touch/guards.py is no Python with it"),
    ],
)
def test_a_fault_that_does_not_fit_the_code_is_refused(text: str, code: str, told: str) -> None:
    mutant = Mutant(**FAULT, text=text, instead="(", caught_by="tests/touch/test_guards.py::test_x")
    with pytest.raises(TableError, match=f"^a guard sleeps: {told}"):
        mutant.put_into(code)


@pytest.mark.parametrize(
    ("entry", "told"),
    [
        ("name = 'a'", "a: `file` is missing"),
        ("name = 'a'\nfiel = 'b'", "a: nothing is called `fiel`"),
        ("name = 'a'\nfile = 'b'\ntext = 'c'\ninstead = 'd'", "a: either `caught_by` or `survives` is said"),
        (
            "name = 'a'\nfile = 'b'\ntext = 'c'\ninstead = 'd'\nsurvives = 'e'",
            "a: `tests` of a fault that survives are missing",
        ),
    ],
)
def test_an_entry_that_lacks_something_is_refused(tmp_path: Path, entry: str, told: str) -> None:
    (tmp_path / "table.toml").write_text(f"[[touch]]\n{entry}\n", encoding="utf-8")
    with pytest.raises(TableError, match=f"^{told}"):
        load(tmp_path / "table.toml")


def test_two_faults_of_one_name_are_refused(tmp_path: Path) -> None:
    entry = "[[touch]]\nname = 'a'\nfile = 'b'\ntext = 'c'\ninstead = 'd'\ncaught_by = 'e'\n"
    (tmp_path / "table.toml").write_text(entry * 2, encoding="utf-8")
    with pytest.raises(TableError, match=r"^two faults have one name: a$"):
        load(tmp_path / "table.toml")
