"""Styled text for terminals with colours, and drawing characters. If a terminal cannot show the drawing characters,
ASCII characters replace them.
"""

from collections.abc import Sequence
from dataclasses import dataclass
from typing import Final


@dataclass(frozen=True, slots=True, kw_only=True)
class Symbols:
    """Drawing characters. At `corner`, a line that comes from the left turns downwards. At `turn`, a line that comes
    from above turns to the right. At `tee`, a second line branches off downwards.
    """

    cursor: str
    line: str
    corner: str
    stem: str
    tee: str
    turn: str
    more: str  # at an edge: the program continues beyond it


UNICODE: Final = Symbols(cursor="▶", line="─", corner="┐", stem="│", tee="┬", turn="└", more="…")
ASCII: Final = Symbols(cursor=">", line="-", corner=".", stem="|", tee="-", turn="`", more="~")


def symbols_for(encoding: str | None) -> Symbols:
    """Return drawing characters that an encoding can represent."""
    try:
        "".join(getattr(UNICODE, name) for name in Symbols.__slots__).encode(encoding or "ascii")
    except (UnicodeEncodeError, LookupError):
        return ASCII
    return UNICODE


Style = str  # `active`, `branch`, `name`, `position`, `hand`, `guarded`, `loop`, `link`, `line`, or empty
Line = list[tuple[Style, str]]


def plain(lines: Sequence[Line]) -> str:
    return "\n".join("".join(text for _, text in line) for line in lines)


def fitted(line: Line, width: int) -> Line:
    """Return a line cut to a width, without trailing blanks."""
    room, kept = min(width, len(plain([line]).rstrip())), Line()
    for style, text in line:
        if room > 0:
            kept.append((style, text[:room]))
        room -= len(text)
    return kept
