"""Pages that a reader can follow from a shell: files to write, commands to type, and what these print.

A block `al NAME` or `toml NAME` is a file. A block without a language holds commands behind `$ `, each with what it
prints; `...` stands for lines left out, and where nothing is shown, all is. Other languages are not looked at.
"""

import re
import shlex
from collections.abc import Callable
from dataclasses import dataclass
from pathlib import Path

from figures import as_recorded
from stepping_walk import pieces, stands

BLOCK = re.compile(r"^```(\w*)(?: (\S+))?\n(.*?)^```$", re.MULTILINE | re.DOTALL)
COMMAND = re.compile(r"^\$ handeye (.*)\n((?:(?!\$ ).*\n)*)", re.MULTILINE)
LEFT_OUT = "..."
Run = Callable[[str], tuple[int, str]]
"""Carries out the words of a command: exit code and standard output."""


@dataclass(frozen=True)
class Typed:
    """A command of a page."""

    words: str
    shown: str
    span: tuple[int, int]  # of what is shown, in the page
    code: int
    printed: str

    @property
    def stands(self) -> bool:
        """What is shown is what was printed."""
        lines = self.printed.splitlines()
        if LEFT_OUT not in self.shown.splitlines():
            return as_recorded(self.printed, self.shown).rstrip() == self.shown.rstrip()
        return all(stands(piece, lines) for piece in pieces(self.shown.splitlines()))

    @property
    def anew(self) -> str:
        """What is to be shown: all that was printed, or from the line on whose beginning stands behind the dots."""
        if not self.shown:
            return ""
        first, *rest = self.shown.splitlines()
        lines = self.printed.rstrip().splitlines()
        if first == LEFT_OUT:
            word = " ".join(rest[0].split()[:2])
            lines = [LEFT_OUT, *lines[next(n for n, line in enumerate(lines) if line.startswith(word)) :]]
        return "".join(f"{line}\n" for line in lines)


def walked(page: str, run: Run) -> list[Typed]:
    """Write the files of a page, and type its commands, in order, in this folder."""
    found = []
    for block in BLOCK.finditer(page):
        language, name, content = block.groups()
        if language in ("al", "toml") and name:
            Path(name).write_text(content, encoding="utf-8")
        elif not language:
            for typed in COMMAND.finditer(content):
                start = block.start(3)
                code, printed = run(typed[1])
                found.append(
                    Typed(typed[1], typed[2], (start + typed.start(2), start + typed.end(2)), code, printed)
                )
    return found


def with_outputs(page: str, typed: list[Typed]) -> str:
    """The page with what its commands print."""
    for each in reversed(typed):
        page = page[: each.span[0]] + each.anew + page[each.span[1] :]
    return page


def words_of(line: str) -> list[str]:
    """The words of a command, as a shell takes them."""
    return shlex.split(line, comments=True)
