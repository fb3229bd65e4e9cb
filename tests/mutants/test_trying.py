"""What comes of a fault follows from which tests fail with it; the tests themselves are played here."""

import threading
from pathlib import Path

import pytest
from mutant_table import Mutant
from trying import ROOT, Copy, Outcome, Session, TryingError, Unmutated, rewrite, tried

HERE, BESIDE = "tests/touch/test_guards.py::test_here", "tests/touch/test_hold.py::test_beside[1]"
FAULT = {
    "area": "touch",
    "name": "a guard sleeps",
    "file": "handeye/touch/guards.py",
    "text": "a",
    "instead": "b",
}
CAUGHT = Mutant(**FAULT, caught_by=HERE)
SPARED = Mutant(**FAULT, survives="nobody looks", tests=("tests/touch",))


class Played(Copy):
    """A copy in which tests come out as they are told to."""

    def __init__(self, **failing: str | None) -> None:
        self.failing, self.late = failing, False

    def session(self, tests: list[str], limit: float | None = None) -> Session:
        return Session(failed=self.failing.get("sound"), seconds={"tests/touch/test_guards.py": 2.0})

    def faulty(self, mutant: Mutant, tests: list[str], limit: float) -> Session:
        (test,) = tests
        return Session(late=self.late, failed=self.failing.get("named" if test == HERE else "wider"))


def outcome(mutant: Mutant, copy: Copy) -> Outcome:
    return tried(mutant, copy, Unmutated())


@pytest.mark.parametrize(
    ("mutant", "failing", "ending", "expected"),
    [
        (CAUGHT, {"named": HERE}, "caught", True),
        (CAUGHT, {"named": f"{HERE}[x]"}, "caught", True),
        (CAUGHT, {"wider": BESIDE}, "caught elsewhere", False),
        (CAUGHT, {}, "survived", False),
        (SPARED, {"wider": BESIDE}, "caught after all", False),
        (SPARED, {}, "survived as told", True),
    ],
)
def test_a_fault_is_caught_by_the_test_that_fails_first(
    mutant: Mutant, failing: dict[str, str], ending: str, expected: bool
) -> None:
    found = outcome(mutant, Played(**failing))
    assert (found.ending, found.expected) == (ending, expected)
    assert found.test == next(iter(failing.values()), None)


def test_a_fault_with_which_tests_do_not_end_is_told_apart() -> None:
    copy = Played()
    copy.late = True
    assert outcome(CAUGHT, copy).ending == "out of time"


def test_nothing_is_said_of_a_fault_whose_test_fails_without_it() -> None:
    with pytest.raises(TryingError, match=r"^tests/touch/test_guards.py::test_here fails without any fault$"):
        outcome(CAUGHT, Played(sound=HERE))


def test_a_copy_has_code_tests_and_all_that_they_read_and_nothing_hidden(tmp_path: Path) -> None:
    root = Copy(tmp_path, threading.Event()).root
    assert (root / CAUGHT.file).read_bytes() == (ROOT / CAUGHT.file).read_bytes()
    needed = ("pyproject.toml", "tests/support", "scenes", "plans", "docs", "run.py")
    assert [name for name in needed if not (root / name).exists()] == []
    assert [*root.rglob(".*"), *root.rglob("__pycache__")] == []


def test_a_changed_file_is_compiled_anew_though_its_size_and_time_are_those_of_before(tmp_path: Path) -> None:
    code = tmp_path / "code.py"
    code.write_text("HELD = 4\n")
    cache = tmp_path / "__pycache__" / "code.cpython-x.pyc"
    cache.parent.mkdir()
    cache.touch()
    rewrite(code, "HELD = 1\n")
    assert (code.read_text(), list(cache.parent.iterdir())) == ("HELD = 1\n", [])
