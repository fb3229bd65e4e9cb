"""Defines source texts, and spans of characters in these texts."""

import re
from bisect import bisect_right
from dataclasses import dataclass
from functools import cached_property
from itertools import accumulate
from pathlib import Path
from typing import Final

import msgspec

from handeye.core.errors import BadFile
from handeye.core.files import read_whole
from handeye.core.plain_text import printable

LARGEST: Final = 1_000_000  # bytes of a text file: the longest program, at a hundred bytes a statement


class Span(msgspec.Struct, frozen=True, gc=False, kw_only=True, order=True):
    """The characters of a source text from offset `start` (inclusive) to `end` (exclusive)."""

    start: int
    end: int


class Located(msgspec.Struct, frozen=True, gc=False):
    """A part of a source text, from offset `start` to `end`."""

    start: int
    end: int

    @property
    def span(self) -> Span:
        return Span(start=self.start, end=self.end)


@dataclass(frozen=True, kw_only=True)
class Source:
    """A named text together with the texts that it requires. Lines and columns count from 1, within each text."""

    name: str
    text: str
    key: str = ""  # path of a required text from the main text's folder; empty for the main text
    problem: str = ""  # why a required text could not be read
    required: "tuple[Source, ...]" = ()  # offsets continue through these, one character after each

    @property
    def texts(self) -> "tuple[Source, ...]":
        """The text itself, followed by the texts that it requires."""
        return self, *self.required

    def find(self, offset: int) -> "tuple[Source, int]":
        """Find the text in which an offset lies. Offsets run through this text and then through the texts that it
        requires. Returns the text, and the offset within that text.
        """
        if not self.required:
            return self, offset
        number = bisect_right(self._begins, offset) - 1
        return self.texts[number], offset - self._begins[number]

    def marked(self, span: Span) -> str:
        """Return the characters in a span. As in `find`, the offsets of the span run through this text and then
        through the texts that it requires. The span must lie within one text.
        """
        text, start = self.find(span.start)
        return text.text[start : start + span.end - span.start]

    @cached_property
    def begins(self) -> dict[str, int]:
        """The offset at which each text begins, counted as in `find`. Texts are named by their keys."""
        return {text.key: begin for text, begin in zip(self.texts, self._begins, strict=True)}

    @cached_property
    def _begins(self) -> list[int]:
        return [0, *accumulate(len(text.text) + 1 for text in self.texts[:-1])]

    @cached_property
    def _starts(self) -> list[int]:
        return [0, *(found.end() for found in re.finditer("\n", self.text))]

    def position(self, offset: int) -> tuple[int, int]:
        """Return the line and the column, from 1, of an offset in this text."""
        line = bisect_right(self._starts, offset)
        return line, offset - self._starts[line - 1] + 1

    def line(self, number: int) -> str:
        """Return the line with the number `number` (from 1), without its line end."""
        start = self._starts[number - 1]
        end = self._starts[number] - 1 if number < len(self._starts) else len(self.text)
        return self.text[start:end].rstrip("\r")

    def column(self, offset: int) -> int:
        """Return the column, from 0, of an offset in this text."""
        return offset - self.text.rfind("\n", 0, offset) - 1

    def span(self, key: str, line: int, columns: tuple[int, int]) -> Span:
        """Return the span that covers `columns` of a line in the text with key `key`. The offsets of the span are
        counted as in `find`.
        """
        text = next(text for text in self.texts if text.key == key)
        start = self.begins[key] + text._starts[line - 1]
        return Span(start=start + columns[0], end=start + columns[1])


def line_name(line: int, file: str = "") -> str:
    """Return the name of a line: its number, such as `12`; or, in a required file, a text such as `pins.al:12`."""
    return f"{printable(file)}:{line}" if file else f"{line}"


def with_line_ends(text: str) -> str:
    """Convert a text to Unix line ends if its lines end with a carriage return alone, as on early Macintosh
    computers.
    """
    return text if "\n" in text else text.replace("\r", "\n")


def read_source(path: str | Path) -> Source:
    """Read a text from a file. Raises BadFile if the file is unreadable, too large, or not UTF-8."""
    data = read_whole(path, LARGEST)
    try:
        return Source(name=str(path), text=with_line_ends(data.decode("utf-8-sig")))
    except UnicodeDecodeError as error:
        # `utf-8-sig` counts offsets from the end of a byte order mark, if there is one.
        byte = error.object[error.start]
        offset = error.start + len(data) - len(error.object)
        raise BadFile(f"{path} is not UTF-8 text: byte {offset} is 0x{byte:02x}") from None
