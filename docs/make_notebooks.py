"""Make the notebooks: next to each percent script in `notebooks/`, its .ipynb with the output of its cells.

python docs/make_notebooks.py [NAME ...]

NAME is a piece of the name of a notebook; without one, the command makes all. It needs OpenGL and the extra
`notebooks`.
"""

import os
import sys
import tempfile
from base64 import b64decode, b64encode
from io import BytesIO
from pathlib import Path

import jupytext
import nbformat
from jupyter_client import AsyncKernelManager
from nbclient import NotebookClient
from nbformat import NotebookNode
from PIL import Image

ROOT = Path(__file__).parent.parent
NOTEBOOKS = ROOT / "notebooks"
PATIENCE = 600
"""Greatest time for a cell (s)."""
COLOURS = 256
"""Number of colours of a stored picture."""


def scripts() -> list[Path]:
    """The percent scripts, in order."""
    return sorted(NOTEBOOKS.glob("*.py"), key=lambda path: int(path.name.split("_")[0]))


def notebook(script: Path) -> NotebookNode:
    """The notebook of a script, before its cells have run; it is the same each time."""
    made = jupytext.read(script)
    made.metadata = {"kernelspec": made.metadata["kernelspec"], "language_info": {"name": "python"}}
    for number, cell in enumerate(made.cells):
        cell.id = f"cell-{number}"
    return made


def environment() -> dict[str, str]:
    """What a kernel finds in its environment: it imports handeye from here."""
    return {
        **os.environ,
        "PYTHONPATH": os.pathsep.join(filter(None, [str(ROOT), os.environ.get("PYTHONPATH")])),
    }


def carried_out(made: NotebookNode, folder: Path, kernel: AsyncKernelManager | None = None) -> NotebookNode:
    """The notebook with the output of its cells; its runs stay in the folder.

    Args:
        kernel: executes the cells, in the folder where it was started; without it, a new one does, in `folder`.

    Raises:
        CellExecutionError: a cell fails that is not marked as failing.
    """
    client = NotebookClient(
        made, kernel, timeout=PATIENCE, record_timing=False, resources={"metadata": {"path": str(folder)}}
    )
    client.execute(env=environment())
    if kernel is not None:
        client.kc.stop_channels()  # those of a kernel of its own are closed with it
    made.metadata["language_info"] = {"name": "python"}  # without its version, which would change the file
    return made


def made_small(made: NotebookNode) -> NotebookNode:
    """The notebook with pictures in few colours: a third of the bytes, without visible loss."""
    for data in (
        output.data for cell in made.cells for output in cell.get("outputs", []) if "data" in output
    ):
        if "image/png" in data:
            picture, small = Image.open(BytesIO(b64decode(data["image/png"]))), BytesIO()
            few = picture.convert("RGB").quantize(
                COLOURS, Image.Quantize.MAXCOVERAGE, kmeans=3, dither=Image.Dither.NONE
            )
            few.save(small, "png", optimize=True)
            data["image/png"] = b64encode(small.getvalue()).decode()
    return made


def make(script: Path) -> Path:
    """Run a notebook and write it; return its file."""
    with tempfile.TemporaryDirectory() as folder:
        made = made_small(carried_out(notebook(script), Path(folder)))
    file = script.with_suffix(".ipynb")
    nbformat.write(made, file)
    return file


if __name__ == "__main__":
    for script in scripts():
        if not sys.argv[1:] or any(name in script.stem for name in sys.argv[1:]):
            sys.stdout.write(f"{make(script).relative_to(ROOT)}\n")
