"""Pages that a reader can follow from a shell: files to write, commands to type, and what these print.

A block `al NAME` is a file, and so are those of `toml`, `mal`, `ml` and `sym`. A block without a language contains
commands after `$ `, each with what it prints. `...` stands for lines left out; if nothing is shown, everything is left
out. A command with `--step` begins a session. Its commands follow `handeye> `, in this block and in later ones. Lines
typed at the terminal of ML follow `READY `. Blocks of other languages are ignored.
"""

import re
from collections.abc import Callable
from dataclasses import dataclass
from pathlib import Path

from figures import as_recorded

BLOCK = re.compile(r"^```(\w*)(?: (\S+))?\n(.*?)^```$", re.MULTILINE | re.DOTALL)
PROMPTS = r"\$ |handeye> |READY "
TYPED = re.compile(rf"^({PROMPTS})(.*)\n((?:(?!{PROMPTS}).*\n)*)", re.MULTILINE)
LEFT_OUT = "..."
Answer = Callable[[str], tuple[int, str]]
"""Function that executes a line, and returns its exit code and what it prints."""


@dataclass(frozen=True)
class Typed:
    """A line that the reader types."""

    line: str
    shown: str
    span: tuple[int, int]  # of what is shown, in the page
    code: int
    printed: str

    @property
    def stands(self) -> bool:
        """True if the page shows what was printed."""
        lines = self.printed.splitlines()
        if LEFT_OUT not in self.shown.splitlines():
            return as_recorded(self.printed, self.shown).rstrip() == self.shown.rstrip()
        return all(stands(piece, lines) for piece in pieces(self.shown.splitlines()))

    @property
    def anew(self) -> str:
        """The text that the page should show: everything that was printed or, after dots, what follows from the line
        that begins as shown.
        """
        if not self.shown:
            return ""
        first, *rest = self.shown.splitlines()
        lines = self.printed.rstrip().splitlines()
        if first == LEFT_OUT:
            word = " ".join(rest[0].split()[:2])
            lines = [LEFT_OUT, *lines[next(n for n, line in enumerate(lines) if line.startswith(word)) :]]
        return "".join(f"{line}\n" for line in lines)


def walked(page: str, command: Answer, said: Answer | None = None) -> list[Typed]:
    """Write the files of a page and type its lines, in order, in this folder; `said` answers those of a session.

    Lines for other programs of the shell are left out.
    """
    found = []
    for block in BLOCK.finditer(page):
        language, name, content = block.groups()
        if language in ("al", "toml", "mal", "ml", "sym") and name:
            Path(name).write_text(content, encoding="utf-8")
        for typed in TYPED.finditer(content) if not language else ():
            prompt, line, shown = typed.groups()
            if prompt != "$ ":
                assert said is not None
                code, printed = said(line)
            elif line.startswith("handeye "):
                code, printed = command(line.removeprefix("handeye "))
            else:
                continue
            start = block.start(3)
            found.append(Typed(line, shown, (start + typed.start(3), start + typed.end(3)), code, printed))
    return found


def with_outputs(page: str, typed: list[Typed]) -> str:
    """The page with what its lines print."""
    for each in reversed(typed):
        page = page[: each.span[0]] + each.anew + page[each.span[1] :]
    return page


def pieces(lines: list[str]) -> list[list[str]]:
    """Return the shown pieces between the dots, which stand for lines left out."""
    found: list[list[str]] = [[]]
    for line in lines:
        if line.strip() == LEFT_OUT:
            found.append([])
        else:
            found[-1].append(line)
    return [piece for piece in found if piece]


def stands(piece: list[str], lines: list[str]) -> bool:
    """Return True if the lines of a piece follow each other somewhere in `lines`."""
    recorded = "\n".join(piece)
    ways = ["\n".join(lines[start : start + len(piece)]) for start in range(len(lines))]
    return any(as_recorded(way, recorded) == recorded for way in ways)
