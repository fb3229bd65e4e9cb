"""Occurrences of names in the taught file.

TOML readers do not tell places. This finds what people and the teacher write: `[positions.A]`, `A = {...}` under
`[positions]`, `of = "PART"`, and `positions = ["A"]` on one line. What it does not find, an editor cannot go to.
"""

import re
from collections.abc import Iterator
from typing import Final

from handeye.core.source import Span
from handeye.editor.occurrences import PART, POSITION, Occurrence

_KINDS: Final = {"positions": POSITION, "parts": PART}
_NAME = r"\"?([A-Za-z_]\w*)\"?"
_HEADER: Final = re.compile(rf"\s*\[\s*(positions|parts)\s*(?:\.\s*{_NAME}\s*)?\]", re.ASCII)
_OTHER: Final = re.compile(r"\s*\[[^\]]*\]\s*(?:#.*)?$")
_KEY: Final = re.compile(rf"\s*{_NAME}\s*=\s*\{{", re.ASCII)
_DOTTED: Final = re.compile(rf"\s*(positions|parts)\s*\.\s*{_NAME}", re.ASCII)
_OF: Final = re.compile(r"(?<![\w.\"'])of\s*=\s*[\"']([A-Za-z_]\w*)[\"']", re.ASCII)
_HELD: Final = re.compile(r"(?<![\w.])positions\s*=\s*\[[^\]]*\]", re.ASCII)
_QUOTED: Final = re.compile(r"[\"']([A-Za-z_]\w*)[\"']", re.ASCII)


def taught_occurrences(text: str) -> list[Occurrence]:
    """Every name in the text of a taught file that is found."""
    return list(_walk(text))


def _walk(text: str) -> Iterator[Occurrence]:
    table, start = "", 0
    for line in text.split("\n"):
        code = line.split("#", 1)[0]
        if header := _HEADER.match(code):
            table = header[1] if header[2] is None else ""
            if header[2] is not None:
                yield _made(header[1], header, 2, start)
        elif _OTHER.match(code):
            table = ""
        elif table and (key := _KEY.match(code)):
            yield _made(table, key, 1, start)
        elif dotted := _DOTTED.match(code):
            yield _made(dotted[1], dotted, 2, start)
        for of in _OF.finditer(code):
            yield Occurrence(kind=PART, name=of[1], span=_span(of, 1, start), makes=False)
        for held in _HELD.finditer(code):
            for at in _QUOTED.finditer(code, held.start(), held.end()):
                yield Occurrence(kind=POSITION, name=at[1], span=_span(at, 1, start), makes=False)
        start += len(line) + 1


def _made(table: str, match: re.Match[str], group: int, start: int) -> Occurrence:
    return Occurrence(kind=_KINDS[table], name=match[group], span=_span(match, group, start), makes=True)


def _span(match: re.Match[str], group: int, start: int) -> Span:
    return Span(start=start + match.start(group), end=start + match.end(group))
