"""Writes text for users: printable characters, counts with their nouns (`2 steps`), and numbers with as many digits as
a reader needs.
"""

import math
import re
import textwrap
from collections.abc import Sequence
from typing import Final

_EXTRA_DECIMALS: Final = 6
_SAME_DIGITS: Final = 1e-6  # share of the last digit: a smaller rounding error does not round a number up


def printable(text: str) -> str:
    """Replace unusual blanks and control characters in a text by visible symbols."""
    return "".join(map(shown, text))


def shown(character: str) -> str:
    """Return a symbol, one column wide, that a terminal can show in place of a character."""
    if character.isprintable():
        return character
    return "␣" if character.isspace() and character > "\x9f" else "\N{REPLACEMENT CHARACTER}"


def one_line(text: str) -> str:
    """Write a statement in one line, with single blanks and printable characters."""
    return printable(" ".join(text.split()))


def counted(number: int, noun: str) -> str:
    """Write a number with its noun, singular or plural: `1 step`, `2 steps`, `3 tries`, `4 branches`."""
    if number == 1:
        return f"1 {noun}"
    if re.search("[^aeiou]y$", noun):
        return f"{number} {noun[:-1]}ies"
    return f"{number} {noun}{'es' if noun.endswith(('s', 'x', 'ch', 'sh')) else 's'}"


def size(number: int) -> str:
    """Write a number of bytes with its unit.

    >>> size(812), size(47_300), size(2_340_000)
    ('812 bytes', '47 kB', '2.3 MB')
    """
    if number < 1000:
        return counted(number, "byte")
    return f"{number / 1e3:.0f} kB" if number < 1_000_000 else f"{number / 1e6:.1f} MB"


def distinct_digits(numbers: Sequence[float], decimals: int) -> list[str]:
    """Write numbers with `decimals` digits after the point, and with more if different numbers would look the same."""
    for places in range(decimals, decimals + _EXTRA_DECIMALS):
        texts = [f"{number:z.{places}f}" for number in numbers]
        if len({*texts}) == len({*numbers}):
            break
    return texts


def enough_digits(number: float, decimals: int, *, up: bool = False) -> str:
    """Write a positive number with `decimals` digits after the point. A small number gets more digits, so that two of
    them are significant: .0041 is written `0.0041` even if `decimals` is 2.

    If `up` is True, the number is rounded up, so that the written number is never too small.
    """
    places = max(decimals, 1 - math.floor(math.log10(number))) if number > 0 else decimals
    if up:
        number = math.ceil(number * 10**places - _SAME_DIGITS) / 10**places
    text = f"{number:.{places}f}"
    return text.removesuffix("0") if places > decimals else text


def folded(text: str, width: int) -> str:
    """Wrap a text between words to `width` columns and indent the continuation lines."""
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
