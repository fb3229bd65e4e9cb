"""Runs the notebooks as docs/make_notebooks.py does."""

import importlib.util
from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path
from types import ModuleType

from jupyter_client import AsyncKernelManager
from jupyter_core.utils import run_sync
from nbformat.v4 import new_code_cell

ROOT = Path(__file__).parents[2]
SCRIPTS = sorted((ROOT / "notebooks").glob("*.py"), key=lambda path: int(path.name.split("_")[0]))


def notebook_maker() -> ModuleType:
    """The program that makes the notebooks."""
    spec = importlib.util.spec_from_file_location("make_notebooks", ROOT / "docs" / "make_notebooks.py")
    module = importlib.util.module_from_spec(spec)
    spec.loader.exec_module(module)
    return module


@contextmanager
def kernel() -> Iterator[AsyncKernelManager]:
    """A kernel that runs notebooks one after the other, and imports handeye and matplotlib only once."""
    manager = AsyncKernelManager()
    run_sync(manager.start_kernel)(
        env=notebook_maker().environment(), extra_arguments=["--HistoryManager.hist_file=:memory:"]
    )
    yield manager
    run_sync(manager.shutdown_kernel)(now=True)


def runs_to_its_end(script: Path, folder: Path, kernel: AsyncKernelManager | None = None) -> None:
    """Run a notebook in a folder. A cell may fail only if it shows an error of a script, and no cell may warn.

    A kernel that has run another notebook forgets all names first.
    """
    maker = notebook_maker()
    made = maker.notebook(script)
    if kernel is not None:
        made.cells.insert(0, new_code_cell(f"%reset -f\n%cd -q {folder}", id="emptied"))
    maker.carried_out(made, folder, kernel)
    shown = [output for cell in made.cells for output in cell.get("outputs", [])]
    assert [
        output.text for output in shown if output.output_type == "stream" and output.name == "stderr"
    ] == []
    assert {output.ename for output in shown if output.output_type == "error"} <= {"ScriptError"}
