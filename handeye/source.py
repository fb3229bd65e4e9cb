"""Source text and spans of it, for diagnostics and for showing the line that is being executed."""

from bisect import bisect_right
from dataclasses import dataclass
from functools import cached_property
from pathlib import Path
from typing import Final

import msgspec

from handeye.errors import InvalidInput
from handeye.files import read_whole

LARGEST: Final = 1_000_000
"""Bytes of the largest file taken for a text: the longest program there can be, with a hundred for each statement."""


class Span(msgspec.Struct, frozen=True, gc=False, kw_only=True, order=True):
    """Characters `start` (inclusive) to `end` (exclusive) of a source text."""

    start: int
    end: int


@dataclass(frozen=True, kw_only=True)
class Source:
    """A named text. Lines and columns count from 1."""

    name: str
    text: str

    @cached_property
    def _starts(self) -> list[int]:
        starts = [0]
        starts.extend(i + 1 for i, c in enumerate(self.text) if c == "\n")
        return starts

    def position(self, offset: int) -> tuple[int, int]:
        """Line and column of a character offset."""
        line = bisect_right(self._starts, offset)
        return line, offset - self._starts[line - 1] + 1

    def line(self, number: int) -> str:
        """The text of a line, without its end."""
        start = self._starts[number - 1]
        end = self._starts[number] - 1 if number < len(self._starts) else len(self.text)
        return self.text[start:end].rstrip("\r")

    def line_span(self, number: int) -> Span:
        """The statement on a line: from its first to its last visible character."""
        text = self.line(number)
        start = self._starts[number - 1]
        return Span(start=start + len(text) - len(text.lstrip()), end=start + len(text.rstrip()))


def read_source(path: str | Path) -> Source:
    """The text in a file, named as the path was given.

    Raises:
        InvalidInput: no such file, a directory, unreadable, too large, or not UTF-8 (with the byte's offset).
    """
    data = read_whole(path, LARGEST)
    try:
        return Source(name=str(path), text=data.decode("utf-8-sig"))
    except UnicodeDecodeError as error:
        # `utf-8-sig` counts from behind a byte order mark, if there is one.
        byte = error.object[error.start]
        offset = error.start + len(data) - len(error.object)
        raise InvalidInput(f"{path} is not UTF-8 text: byte {offset} is 0x{byte:02x}") from None
