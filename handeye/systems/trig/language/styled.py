"""Styled text: lines as pieces with a style each, for coloured terminals."""

from collections.abc import Sequence

Style = str
"""`active`, `branch`, `name`, `position`, `hand`, `guarded`, `loop`, `link`, `line`, or empty."""
Line = list[tuple[Style, str]]


def plain(lines: Sequence[Line]) -> str:
    """Lines without styles."""
    return "\n".join("".join(text for _, text in line) for line in lines)


def fitted(line: Line, width: int) -> Line:
    """A line cut to a width, without trailing blanks."""
    room, kept = min(width, len(plain([line]).rstrip())), Line()
    for style, text in line:
        if room > 0:
            kept.append((style, text[:room]))
        room -= len(text)
    return kept
