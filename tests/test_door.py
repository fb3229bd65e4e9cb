"""The public door: its names load what they need when they are used, and stay what they are whatever is imported."""

import ast
import importlib
import pkgutil
import subprocess
import sys
import tomllib
from pathlib import Path

import pytest

import handeye
from handeye.core.errors import InvalidInput

ROOT = Path(__file__).parent.parent
SOURCE = Path(handeye.__file__).read_text(encoding="utf-8")
HEAVY = ("numpy", "scipy", "cv2", "mujoco", "msgspec", "rich")


def in_a_fresh_interpreter(code: str) -> str:
    """What a program prints."""
    done = subprocess.run([sys.executable, "-c", code], capture_output=True, text=True, check=True)
    return done.stdout.strip()


def seen_by_type_checkers() -> set[str]:
    """Names that the door imports for type checkers."""
    block = next(node for node in ast.parse(SOURCE).body if isinstance(node, ast.If))
    imported = [node for node in block.body if isinstance(node, ast.ImportFrom)]
    declared = [node.target.id for node in block.body if isinstance(node, ast.AnnAssign)]
    return {*declared, *(alias.asname or alias.name for node in imported for alias in node.names)}


def named(name: str) -> object:
    """What type checkers take a name of the door for."""
    block = next(node for node in ast.parse(SOURCE).body if isinstance(node, ast.If))
    imports = [node for node in block.body if isinstance(node, ast.ImportFrom)]
    origin = next(node.module for node in imports if name in {alias.name for alias in node.names})
    return getattr(importlib.import_module(origin), name)


def test_the_import_loads_nothing_until_a_name_needs_it() -> None:
    code = f"import sys, handeye; print([m for m in sys.modules if m.split('.')[0] in {HEAVY} or 'handeye.' in m])"
    assert in_a_fresh_interpreter(code) == "[]"


def test_a_plan_is_made_without_a_simulator() -> None:
    code = "import sys, handeye; handeye.plan('OPEN 1\\n'); print({'mujoco', 'cv2'} & {*sys.modules})"
    assert in_a_fresh_interpreter(code) == "set()"


def test_type_checkers_see_every_name() -> None:
    assert seen_by_type_checkers() == {*handeye.__all__}


def test_a_name_is_loaded_from_where_type_checkers_see_it() -> None:
    names = {*handeye.__all__} - {"__version__"}
    assert {name for name in names if getattr(handeye, name) is not named(name)} == set()


def test_the_names_are_listed_in_their_order_and_all_of_them_are_there() -> None:
    assert handeye.__all__ == sorted(handeye.__all__)
    assert {*handeye.__all__} <= {*dir(handeye)}
    assert all(getattr(handeye, name) is not None for name in handeye.__all__)


def test_a_name_that_is_not_there_is_an_attribute_error() -> None:
    with pytest.raises(AttributeError, match=r"^module 'handeye' has no attribute 'asemble'"):
        handeye.asemble  # noqa: B018


@pytest.mark.slow
def test_no_submodule_takes_the_place_of_a_name() -> None:
    before = {name: getattr(handeye, name) for name in handeye.__all__}
    for found in pkgutil.walk_packages(handeye.__path__, "handeye."):
        if not found.name.endswith("__main__"):
            importlib.import_module(found.name)
    assert {name: getattr(handeye, name) for name in handeye.__all__} == before


def test_the_version_is_that_of_the_package() -> None:
    project = tomllib.loads((ROOT / "pyproject.toml").read_text(encoding="utf-8"))["project"]
    assert handeye.__version__ == project["version"]


def test_the_package_says_that_it_has_types() -> None:
    assert (ROOT / "handeye" / "py.typed").is_file()


@pytest.mark.parametrize("wrong", [None, 3, "", b"run"])
def test_what_is_no_trace_is_refused_in_one_sentence(wrong: object) -> None:
    with pytest.raises(InvalidInput, match=r"^a trace must be a file or the folder of a run, not "):
        handeye.open(wrong)


def test_a_file_that_is_no_trace_is_refused(tmp_path: Path) -> None:
    (tmp_path / "short.al").write_text("OPEN 1\n", encoding="utf-8")
    with pytest.raises(InvalidInput, match="is not a trace"):
        handeye.open(tmp_path / "short.al")
