"""Small pieces of text for people: what may be shown on a terminal, counts with their nouns, and numbers."""

import textwrap
from collections.abc import Sequence
from typing import Final

_MORE: Final = 6
"""Decimals that are spent on telling numbers apart."""


def printable(text: str) -> str:
    """A text with a sign in the place of each character that would steer a terminal, and not be shown."""
    return "".join(c if c.isprintable() else "\N{REPLACEMENT CHARACTER}" for c in text)


def one_line(text: str) -> str:
    """A statement without the blanks that put it in columns, printable throughout."""
    return printable(" ".join(text.split()))


def counted(number: int, noun: str) -> str:
    """`1 step`, `2 steps`"""
    return f"{number} {noun}{'' if number == 1 else 's'}"


def told_apart(numbers: Sequence[float], decimals: int) -> list[str]:
    """Numbers that are compared, with some decimals, or as many more as it takes to tell different ones apart."""
    for places in range(decimals, decimals + _MORE):
        told = [f"{number:z.{places}f}" for number in numbers]
        if len({*told}) == len({*numbers}):
            break
    return told


def folded(text: str, width: int) -> str:
    """Lines of text, those beyond a width broken between words, with what comes later set in beneath."""
    return "\n".join(_folded(line, width) for line in text.split("\n"))


def _folded(line: str, width: int) -> str:
    if len(line) <= width:
        return line
    beneath = min(len(line) - len(line.lstrip()) + 4, width // 2) * " "
    lines = textwrap.wrap(
        line,
        width,
        subsequent_indent=beneath,
        expand_tabs=False,
        replace_whitespace=False,
        break_long_words=False,
        break_on_hyphens=False,
    )
    return "\n".join(lines)
