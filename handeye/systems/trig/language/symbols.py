"""Symbols: the signs that a program is drawn with, where a terminal has them and where it has not."""

from dataclasses import dataclass
from typing import Final


@dataclass(frozen=True, slots=True, kw_only=True)
class Symbols:
    """Signs of one character each."""

    cursor: str
    line: str
    corner: str
    """From a line down, to the right end of it."""
    stem: str
    tee: str
    """A line that begins below."""
    turn: str
    """From above to the right."""
    more: str
    """There is more that way."""


UNICODE: Final = Symbols(cursor="▶", line="─", corner="┐", stem="│", tee="┬", turn="└", more="…")
ASCII: Final = Symbols(cursor=">", line="-", corner=".", stem="|", tee="-", turn="`", more="~")


def symbols_for(encoding: str | None) -> Symbols:
    """Signs that can be written in an encoding."""
    try:
        "".join(getattr(UNICODE, name) for name in Symbols.__slots__).encode(encoding or "ascii")
    except (UnicodeEncodeError, LookupError):
        return ASCII
    return UNICODE
