"""Makes the notebooks anew: the .ipynb beside each percent script in `notebooks/`, with what its cells show.

python docs/make_notebooks.py [NAME ...]

NAME is a piece of the name of a notebook; without one, all are made. It takes OpenGL, and the extra `notebooks`.
"""

import os
import sys
import tempfile
from pathlib import Path

import jupytext
import nbformat
from nbclient import NotebookClient
from nbformat import NotebookNode

ROOT = Path(__file__).parent.parent
NOTEBOOKS = ROOT / "notebooks"
PATIENCE = 600
"""s for a cell."""


def scripts() -> list[Path]:
    """The percent scripts, in their order."""
    return sorted(NOTEBOOKS.glob("*.py"))


def notebook(script: Path) -> NotebookNode:
    """The notebook of a script, not yet carried out; the same each time."""
    made = jupytext.read(script)
    made.metadata = {"kernelspec": made.metadata["kernelspec"], "language_info": {"name": "python"}}
    for number, cell in enumerate(made.cells):
        cell.id = f"cell-{number}"
    return made


def carried_out(made: NotebookNode, folder: Path) -> NotebookNode:
    """The notebook with what its cells show; runs are left in the folder.

    Raises:
        CellExecutionError: a cell fails that is not marked to.
    """
    path = os.pathsep.join(filter(None, [str(ROOT), os.environ.get("PYTHONPATH")]))
    client = NotebookClient(
        made, timeout=PATIENCE, record_timing=False, resources={"metadata": {"path": str(folder)}}
    )
    client.execute(env={**os.environ, "PYTHONPATH": path})
    made.metadata["language_info"] = {"name": "python"}  # and not of which version
    return made


def make(script: Path) -> Path:
    """Carry a notebook out, and write it; its file."""
    with tempfile.TemporaryDirectory() as folder:
        made = carried_out(notebook(script), Path(folder))
    file = script.with_suffix(".ipynb")
    nbformat.write(made, file)
    return file


if __name__ == "__main__":
    for script in scripts():
        if not sys.argv[1:] or any(name in script.stem for name in sys.argv[1:]):
            sys.stdout.write(f"{make(script).relative_to(ROOT)}\n")
