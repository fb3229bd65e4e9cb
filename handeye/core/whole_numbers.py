"""Whole numbers of any type."""

from operator import index
from typing import SupportsIndex


def whole(given: object) -> int | None:
    """The argument as a plain whole number; None if it is none, as for True and False."""
    if isinstance(given, bool) or not isinstance(given, SupportsIndex):
        return None
    try:
        return index(given)
    except TypeError:  # an array that is not one number alone
        return None
