"""The table of faults, and a fault put into the text of its file."""

import ast
import tomllib
from dataclasses import dataclass, fields
from pathlib import Path
from typing import Final

TABLE: Final = Path(__file__).with_name("mutants.toml")


class TableError(Exception):
    """The table, or an entry of it, does not fit the code."""


@dataclass(frozen=True, slots=True, kw_only=True)
class Mutant:
    """A deliberate fault: a piece of a file, and what stands there instead."""

    area: str
    name: str
    """The fault, as a claim about the product that would then be true."""
    file: str
    """Path from the root of the project, as all paths here."""
    text: str
    """Occurs once in the file."""
    instead: str
    caught_by: str = ""
    """The test that fails with the fault, as `tests/x/test_y.py::test_z`; none if it survives."""
    survives: str = ""
    """Why no test can tell it from the code as it is; none if it is caught."""
    tests: tuple[str, ...] = ()
    """Files and folders of tests that are run if that test does not catch it; by default its folder."""

    def __post_init__(self) -> None:
        if bool(self.caught_by) == bool(self.survives):
            raise TableError(f"{self.name}: either `caught_by` or `survives` is said of a fault")
        if self.survives and not self.tests:
            raise TableError(f"{self.name}: `tests` of a fault that survives are missing")

    @property
    def wider(self) -> tuple[str, ...]:
        """Tests to run where the one that should catch it does not."""
        return self.tests or (str(Path(self.caught_by.partition("::")[0]).parent),)

    def put_into(self, code: str) -> str:
        """The text of the file with the fault in it.

        Raises:
            TableError: the replaced text does not occur exactly once, or what comes out is no Python.
        """
        count = code.count(self.text)
        if count != 1:
            raise TableError(f"{self.name}: its text occurs {count} times in {self.file}, not once")
        faulty = code.replace(self.text, self.instead)
        try:
            ast.parse(faulty)
        except SyntaxError as error:
            raise TableError(f"{self.name}: {self.file} is no Python with it: {error}") from None
        return faulty


def load(path: Path = TABLE) -> tuple[Mutant, ...]:
    """All faults, in the order of the table.

    Raises:
        TableError: an entry lacks something, has something that is not known, or has the name of another one.
    """
    areas = tomllib.loads(path.read_text(encoding="utf-8"))
    found = tuple(_mutant(area, entry) for area, entries in areas.items() for entry in entries)
    names = [mutant.name for mutant in found]
    doubled = sorted({name for name in names if names.count(name) > 1})
    if doubled:
        raise TableError(f"two faults have one name: {doubled[0]}")
    return found


def _mutant(area: str, entry: dict[str, object]) -> Mutant:
    known = {field.name for field in fields(Mutant)} - {"area"}
    name = entry.get("name", f"a fault of `{area}`")
    if strange := sorted(entry.keys() - known):
        raise TableError(f"{name}: nothing is called `{strange[0]}`")
    if missing := sorted({"name", "file", "text", "instead"} - entry.keys()):
        raise TableError(f"{name}: `{missing[0]}` is missing")
    tests = tuple(entry.pop("tests", ()))
    return Mutant(area=area, tests=tests, **entry)
