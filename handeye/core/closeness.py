"""Compares values without regard to the last digits of computed numbers, which depend on the kind of processor."""

from collections.abc import Mapping
from typing import Any, Final

LAST_PLACES: Final = 1e-9  # relative for numbers above 1, absolute for others; SI


def alike(a: Any, b: Any, places: float = LAST_PLACES) -> bool:
    """Return True if two values are equal apart from the last digits of fractions. The values consist of
    dictionaries, lists, texts and numbers.

    `places` is the greatest difference allowed between two fractions.
    """
    if isinstance(a, float) and isinstance(b, float):
        return a == b or abs(a - b) <= places * max(1.0, abs(a), abs(b))
    if isinstance(a, Mapping) and isinstance(b, Mapping):
        return a.keys() == b.keys() and all(alike(value, b[key], places) for key, value in a.items())
    if isinstance(a, list | tuple) and isinstance(b, list | tuple):
        return len(a) == len(b) and all(alike(one, other, places) for one, other in zip(a, b, strict=True))
    return type(a) is type(b) and bool(a == b)
