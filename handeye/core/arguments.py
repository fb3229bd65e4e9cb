"""Checks each argument of a user as soon as the program receives it, so that a wrong argument gives one clear
sentence.
"""

import os
from collections.abc import Iterable
from operator import index
from pathlib import Path
from typing import SupportsIndex

from handeye.core.diagnostics import quoted
from handeye.core.errors import BadArgument


def whole(given: object) -> int | None:
    """Convert a whole number to a plain `int`. Returns None for anything else, including True and False."""
    if isinstance(given, bool) or not isinstance(given, SupportsIndex):
        return None
    try:
        return index(given)
    except TypeError:  # an array of more or fewer than one number
        return None


def given_file(given: object, what: str) -> Path:
    """Return the path that a caller gave. Raises BadArgument if the argument cannot be a path; `what` is the beginning
    of the error message.
    """
    if not isinstance(given, (str, os.PathLike)):
        raise BadArgument(f"{what}, not {given!r}")
    name = os.fspath(given)
    if not isinstance(name, str) or not name:
        raise BadArgument(f"{what}, not {given!r}")
    _check_name(name)
    return Path(name)


def _check_name(name: str) -> None:
    """Raise InvalidInput if no file can be called `name`, because the name is too long or contains a NUL character."""
    try:
        os.lstat(name)
    except (FileNotFoundError, NotADirectoryError):
        pass
    except (OSError, ValueError) as error:
        reason = error.strerror if isinstance(error, OSError) else str(error)
        raise BadArgument(f"{quoted(name)} cannot be used as a file: {reason}") from None


def given_names(given: object, what: str) -> tuple[str, ...]:
    """Check the names that a caller gave: a single name, or an iterable of names. Returns the names as a tuple."""
    names = (given,) if isinstance(given, str) or not isinstance(given, Iterable) else tuple(given)
    for name in names:
        if not isinstance(name, str):
            raise BadArgument(f"{what} takes names, not {name!r}")
    return names


def given_count(given: object, what: str) -> int:
    """Check that an argument is a whole number of 1 or more; `what` names the argument in the error."""
    count = whole(given)
    if count is None or count < 1:
        raise BadArgument(f"{what} must be a whole number of 1 or more, not {given!r}")
    return count


def given_place(given: object) -> str:
    """Return, as text, the place in a program that an argument names. A line may be given as a number."""
    if isinstance(given, bool) or not isinstance(given, (str, int)):
        raise BadArgument(f"a place must be a text or a line number, not {given!r}")
    return str(given)
