"""Whole numbers, of whatever type they are given as."""

from operator import index
from typing import SupportsIndex


def whole(given: object) -> int | None:
    """A plain whole number that equals the given one; None if that is none, as are True and False."""
    if isinstance(given, bool) or not isinstance(given, SupportsIndex):
        return None
    try:
        return index(given)
    except TypeError:  # an array that is not one number alone
        return None
