"""Edits a position in the text of a taught file, and leaves the rest of the text unchanged.

The usual forms are supported: `A = { at = [...] }` on one line under `[positions]`, and `at = [...]` under
`[positions.A]`. The new text is parsed again. If other entries have changed, the edit is refused.
"""

import re
import tomllib
from typing import Final

from handeye.core.errors import Refused
from handeye.core.units import DEGREE, INCH
from handeye.program.program import Position

_HEADER: Final = re.compile(r"^[ \t]*\[\s*positions\s*\][ \t]*(?:#.*)?\r?$", re.MULTILINE)
_NEXT: Final = re.compile(r"^[ \t]*\[", re.MULTILINE)
_AT: Final = r"\bat\s*=\s*\[[^\]#\n]*\]"
_OF: Final = r"\bof\s*=\s*(?:\"[^\"\n]*\"|'[^'\n]*')"
_OF_ALONE: Final = rf"[ \t]*,[ \t]*{_OF}|{_OF}[ \t]*,[ \t]*|{_OF}"


def with_position(text: str, name: str, position: Position) -> str:
    """Return the text of a taught file with a position added or replaced. Raises BadFile if other entries would
    change.
    """
    before = tomllib.loads(text)
    entry = {"at": _figures(position), **({} if position.of is None else {"of": position.of})}
    wanted = {**before, "positions": {**before.get("positions", {}), name: entry}}
    edited = (
        _replaced(text, name, position)
        if name in before.get("positions", {})
        else _added(text, name, position)
    )
    try:
        after = tomllib.loads(edited)
    except tomllib.TOMLDecodeError:
        after = None
    if after != wanted:
        raise Refused(
            f"{name} cannot be added automatically; add this line yourself: {_line(name, position)}"
        )
    return edited


def _figures(position: Position) -> list[float]:
    """Return x, y, z (in) rounded to a thousandth, and O, A, T (degrees) rounded to a hundredth."""
    lengths = [round(value / INCH, 3) + 0.0 for value in position.at[:3]]
    return [*lengths, *(round(value / DEGREE, 2) + 0.0 for value in position.at[3:])]


def _fields(position: Position) -> tuple[str, str]:
    at = f"at = [{', '.join(map(repr, _figures(position)))}]"
    return at, "" if position.of is None else f'of = "{position.of}"'


def _line(name: str, position: Position) -> str:
    return f"{name} = {{ {', '.join(filter(None, _fields(position)))} }}"


def _added(text: str, name: str, position: Position) -> str:
    """Return the text with a new line for the position: after the last entry of `[positions]`, or at the end of the
    text.
    """
    header, line_end = _HEADER.search(text), "\r\n" if "\r\n" in text else "\n"
    if header is None:
        gap = "" if not text else line_end if text.endswith("\n") else 2 * line_end
        return f"{text}{gap}[positions]{line_end}{_line(name, position)}{line_end}"
    following = _NEXT.search(text, header.end())
    end = len(text) if following is None else following.start()
    lines = text[:end].splitlines(keepends=True)
    while not lines[-1].strip() or lines[-1].lstrip().startswith("#"):
        lines.pop()  # remarks before the next table belong to that table
    place = len("".join(lines))
    gap = "" if text[:place].endswith("\n") else line_end
    return f"{text[:place]}{gap}{_line(name, position)}{line_end}{text[place:]}"


def _replaced(text: str, name: str, position: Position) -> str:
    """Return the text with the numbers of `position` in place of the old numbers of the entry `name`. The entry is a
    line or a table.
    """
    key = rf"[\"']?{re.escape(name)}[\"']?"
    line = re.compile(rf"^[ \t]*(?:positions\s*\.\s*)?{key}[ \t]*=[ \t]*\{{.*$", re.MULTILINE)
    table = re.compile(rf"^[ \t]*\[\s*positions\s*\.\s*{key}\s*\].*(?:\n(?![ \t]*\[).*)*", re.MULTILINE)
    for pattern, between in ((table, "\n"), (line, ", ")):
        found = pattern.search(text)
        if found is not None:
            return text[: found.start()] + _with_fields(found[0], position, between) + text[found.end() :]
    return text


def _with_fields(entry: str, position: Position, between: str) -> str:
    at, of = _fields(position)
    if of and _outside_remarks(_OF).search(entry):
        return _put(_AT, at, _put(_OF, of, entry))
    return _put(_AT, between.join(filter(None, (at, of))), _put(_OF_ALONE, "", entry))


def _put(pattern: str, fields: str, entry: str) -> str:
    return _outside_remarks(pattern).sub(lambda found: found[1] + fields, entry, count=1)


def _outside_remarks(pattern: str) -> re.Pattern[str]:
    return re.compile(rf"^([^#\n]*?)(?:{pattern})", re.MULTILINE)
