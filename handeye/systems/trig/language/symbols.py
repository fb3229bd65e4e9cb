"""Drawing characters, with a fallback for terminals without them."""

from dataclasses import dataclass
from typing import Final


@dataclass(frozen=True, slots=True, kw_only=True)
class Symbols:
    """Drawing characters: `corner` joins left and below, `turn` above and right, `tee` begins a line below."""

    cursor: str
    line: str
    corner: str
    stem: str
    tee: str
    turn: str
    more: str  # continues that way


UNICODE: Final = Symbols(cursor="▶", line="─", corner="┐", stem="│", tee="┬", turn="└", more="…")
ASCII: Final = Symbols(cursor=">", line="-", corner=".", stem="|", tee="-", turn="`", more="~")


def symbols_for(encoding: str | None) -> Symbols:
    """Characters that an encoding can represent."""
    try:
        "".join(getattr(UNICODE, name) for name in Symbols.__slots__).encode(encoding or "ascii")
    except (UnicodeEncodeError, LookupError):
        return ASCII
    return UNICODE
