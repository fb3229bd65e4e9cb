"""What a build makes of this folder: a README whose links lead somewhere from everywhere, and the docs in the wheel."""

import re
from pathlib import Path
from typing import Any

from hatchling.builders.hooks.plugin.interface import BuildHookInterface
from hatchling.metadata.plugin.interface import MetadataHookInterface

CODE = re.compile(r"(^```.*?^```$)", re.MULTILINE | re.DOTALL)
PICTURE = re.compile(r"!\[([^]]*)\]\((?!https?://)([^)\s]+)\)")
LINK = re.compile(r"(?<!!)\[((?:!\[[^]]*\]\([^)\s]+\)|[^]])*)\]\((?!https?://|#)([^)\s]+)\)")
EMPTY_ROW = re.compile(r"^\|[|\s]*\|\n", re.MULTILINE)
DOCS = ("*.md", "*.json", "language/**/*.md", "pictures/*")


class Readme(MetadataHookInterface):
    """Writes README.md and the project's addresses with the one base address that pyproject.toml names."""

    def update(self, metadata: dict[str, Any]) -> None:
        base = self.config["base"].rstrip("/")
        text = (Path(self.root) / "README.md").read_text(encoding="utf-8")
        metadata["readme"] = {"content-type": "text/markdown", "text": anywhere(text, base)}
        own = {
            "Repository": base,
            **{name: f"{base}/blob/HEAD/{path}" for name, path in self.config["pages"].items()},
        }
        metadata["urls"] = {**(own if base else {}), **self.config["urls"]}


class Docs(BuildHookInterface):
    """Puts the pages of the documentation and their pictures into the wheel."""

    def initialize(self, version: str, build_data: dict[str, Any]) -> None:
        if version == "editable":  # reads them where they lie
            return
        root = Path(self.root)
        for page in (page for kind in DOCS for page in (root / "docs").glob(kind)):
            build_data["force_include"][str(page)] = f"handeye/_data/{page.relative_to(root).as_posix()}"


def anywhere(text: str, base: str) -> str:
    """A page without relative links: they begin with the base address, or are left out where there is none."""
    written = [part if part.startswith("```") else _part(part, base) for part in CODE.split(text)]
    return re.sub(r"\n{3,}", "\n\n", "".join(written))


def _part(text: str, base: str) -> str:
    if not base:
        return EMPTY_ROW.sub("", LINK.sub(r"\1", PICTURE.sub("", text)))
    return LINK.sub(rf"[\1]({base}/blob/HEAD/\2)", PICTURE.sub(rf"![\1]({base}/raw/HEAD/\2)", text))
