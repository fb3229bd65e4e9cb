"""The notebooks run from beginning to end, are what their scripts are, and keep to what they may use."""

import ast
from collections.abc import Iterator
from pathlib import Path
from types import ModuleType

import nbformat
import pytest
from jupyter_client import AsyncKernelManager
from nbformat import NotebookNode
from running_notebooks import SCRIPTS, kernel, notebook_maker, runs_to_its_end

LARGEST = 1_500_000
"""Bytes of all notebooks together."""
DEFINES = (ast.FunctionDef, ast.AsyncFunctionDef, ast.ClassDef, ast.For, ast.While)

each = pytest.mark.parametrize("script", SCRIPTS, ids=lambda path: path.stem)


@pytest.fixture(scope="module")
def maker() -> ModuleType:
    return notebook_maker()


@pytest.fixture(scope="module")
def emptied() -> Iterator[AsyncKernelManager]:
    """A kernel that forgets all names before each notebook."""
    with kernel() as manager:
        yield manager


def stored(script: Path) -> NotebookNode:
    """The notebook beside a script."""
    return nbformat.read(script.with_suffix(".ipynb"), as_version=4)


def sources(notebook: NotebookNode) -> list[tuple[str, str, list[str]]]:
    """What its cells are, without what they show."""
    return [(cell.cell_type, cell.source, cell.metadata.get("tags", [])) for cell in notebook.cells]


@pytest.mark.slow
@pytest.mark.render
@pytest.mark.parametrize("script", SCRIPTS[1:], ids=lambda path: path.stem)
def test_it_runs_from_beginning_to_end(script: Path, tmp_path: Path, emptied: AsyncKernelManager) -> None:
    """That the first does is shown where its pump is looked at, in `execution/test_whole_run.py`."""
    runs_to_its_end(script, tmp_path, emptied)


@each
def test_the_stored_notebook_is_that_of_its_script(maker: ModuleType, script: Path) -> None:
    made, found = maker.notebook(script), stored(script)
    assert sources(found) == sources(made), f"run: python docs/make_notebooks.py {script.stem}"


@each
def test_it_can_be_read_without_being_run(script: Path) -> None:
    cells = [cell for cell in stored(script).cells if cell.cell_type == "code"]
    assert [cell.execution_count for cell in cells] == list(range(1, len(cells) + 1))
    assert not any("execution" in cell.metadata for cell in cells)


@each
def test_it_begins_with_what_one_will_understand(script: Path) -> None:
    first, *_ = stored(script).cells
    assert first.cell_type == "markdown"
    assert "At the end you will" in first.source


@each
def test_it_imports_handeye_and_draws_and_defines_nothing(script: Path) -> None:
    tree = list(ast.walk(ast.parse(script.read_text(encoding="utf-8"))))
    imported = {
        name.name.split(".")[0] for node in tree if isinstance(node, ast.Import) for name in node.names
    }
    assert imported <= {"handeye", "matplotlib"}
    assert not any(isinstance(node, (ast.ImportFrom, *DEFINES)) for node in tree)


def test_what_they_show_is_small() -> None:
    assert sum(script.with_suffix(".ipynb").stat().st_size for script in SCRIPTS) < LARGEST
