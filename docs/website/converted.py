"""Files of the repository as Markdown pages: a source, a notebook, a folder."""

import json
import re
from collections.abc import Iterable
from pathlib import Path
from typing import Any, Final

SOURCES: Final = {
    ".al": "al", ".bucket": "text", ".mal": "text", ".ml": "text", ".py": "python", ".sym": "text", ".toml": "toml",
    ".trig": "text",
}  # fmt: skip
"""Language of a source, for its colours, by the ending of the file."""
ORPHAN: Final = "---\norphan: true\n---\n"
"""Heads a page that is not an entry of the navigation."""


def source_page(text: str, path: str) -> str:
    """The page of a source file."""
    return f"{ORPHAN}# {path}\n\n{code(text, SOURCES[Path(path).suffix])}"


def folder_page(folder: Path, path: str) -> str:
    """The page of a folder, with links to its files from the folder above it."""
    files = sorted(file.name for file in folder.iterdir() if file.is_file() and not file.name.startswith("."))
    return f"{ORPHAN}# {path}\n\n" + "".join(f"- [{name}]({folder.name}/{name})\n" for name in files)


def notebook_page(notebook: bytes) -> str:
    """The page of a notebook: its texts, its code, and the output of its code."""
    return "\n\n".join(part for cell in json.loads(notebook)["cells"] for part in cell_parts(cell)) + "\n"


def cell_parts(cell: dict[str, Any]) -> Iterable[str]:
    source = "".join(cell["source"])
    if cell["cell_type"] == "markdown":
        yield source
        return
    yield code(source, "python")
    for output in cell["outputs"]:
        yield output_part(output)


def output_part(output: dict[str, Any]) -> str:
    """An output of a cell: an error, a picture, a piece of HTML, or else its text."""
    if output["output_type"] == "error":
        return code(f"{output['ename']}: {output['evalue']}", "text")
    if output["output_type"] == "stream":
        return code("".join(output["text"]), "text")
    data = {kind: "".join(content) for kind, content in output["data"].items()}
    for kind in ("image/png", "image/webp"):
        if kind in data:
            picture = re.sub(r"\s", "", data[kind])
            return raw(f'<p><img alt="Output of the code above" src="data:{kind};base64,{picture}"></p>')
    return raw(data["text/html"]) if "text/html" in data else code(data["text/plain"], "text")


def raw(html: str) -> str:
    return f'```{{raw}} html\n<div class="output">{html}</div>\n```'


def code(text: str, language: str) -> str:
    """A block of code, in a fence longer than any in the text."""
    fence = "`" * max(3, 1 + max(map(len, re.findall("`+", text)), default=0))
    return f"{fence}{language}\n{text.rstrip()}\n{fence}\n"
