"""Write the list of pages in llms.txt from the index of the documentation; the text above the list is written by hand.

python docs/make_llms.py
"""

import re
from pathlib import Path
from typing import Final

ROOT: Final = Path(__file__).parent.parent
PAGE: Final = ROOT / "llms.txt"
_SECTION: Final = re.compile(r"^## ", re.MULTILINE)
_ENTRY: Final = re.compile(r"^- \[(.*?)\]\(([\w/.-]+\.md)\): (.*)$", re.MULTILINE)


def written(page: str, index: str) -> str:
    """The text of llms.txt with the pages of the index, in its sections. Links lead from the repository's root."""
    lines = [_SECTION.split(page)[0].rstrip()]
    for section in _SECTION.split(index)[1:]:
        if entries := _ENTRY.findall(section):
            lines += ["", f"## {section.partition(chr(10))[0]}", ""]
            lines += [f"- [{title}](docs/{path}): {_plain(said)}" for title, path, said in entries]
    return "\n".join(lines) + "\n"


def _plain(sentence: str) -> str:
    return re.sub(r"\[(.*?)\]\(.*?\)", r"\1", sentence)


if __name__ == "__main__":
    PAGE.write_text(written(PAGE.read_text("utf-8"), (ROOT / "docs/README.md").read_text("utf-8")), "utf-8")
