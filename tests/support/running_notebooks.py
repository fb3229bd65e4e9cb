"""Runs the notebooks as docs/make_notebooks.py does."""

import importlib.util
from pathlib import Path
from types import ModuleType

ROOT = Path(__file__).parents[2]
SCRIPTS = sorted((ROOT / "notebooks").glob("*.py"))


def notebook_maker() -> ModuleType:
    """The program that makes the notebooks."""
    spec = importlib.util.spec_from_file_location("make_notebooks", ROOT / "docs" / "make_notebooks.py")
    module = importlib.util.module_from_spec(spec)
    spec.loader.exec_module(module)
    return module


def runs_to_its_end(script: Path, folder: Path) -> None:
    """Run a notebook in a folder. A cell may fail only if it shows an error of a script, and no cell may warn."""
    maker = notebook_maker()
    made = maker.carried_out(maker.notebook(script), folder)
    shown = [output for cell in made.cells for output in cell.get("outputs", [])]
    assert [
        output.text for output in shown if output.output_type == "stream" and output.name == "stderr"
    ] == []
    assert {output.ename for output in shown if output.output_type == "error"} <= {"ScriptError"}
