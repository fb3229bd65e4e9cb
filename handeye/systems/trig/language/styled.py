"""Styled text: lines in pieces, of which each says what it is, so that a terminal can colour it."""

from collections.abc import Sequence

Style = str
"""What a piece is: `active`, `branch`, `name`, `position`, `hand`, `guarded`, `loop`, `link`, `line`, or nothing."""
Line = list[tuple[Style, str]]
"""Pieces of text from left to right."""


def plain(lines: Sequence[Line]) -> str:
    """The text of lines alone."""
    return "\n".join("".join(text for _, text in line) for line in lines)


def fitted(line: Line, width: int) -> Line:
    """A line cut to a width, without the blanks at its end."""
    room, kept = min(width, len(plain([line]).rstrip())), Line()
    for style, text in line:
        if room > 0:
            kept.append((style, text[:room]))
        room -= len(text)
    return kept
