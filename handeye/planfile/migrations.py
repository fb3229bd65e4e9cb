"""Plans of older versions, brought to the present one. What was once written stays loadable for ever.

A change of the format that old plans do not survive raises `VERSION` by one and adds one function here. It takes the
builtin data of a plan of its version and returns that of the next; it knows no types, for those have gone on since.
"""

from collections.abc import Callable
from typing import Final

from handeye.core.errors import BadFile
from handeye.planfile.plan import VERSION
from handeye.planfile.version_1 import Data, to_version_2

MIGRATIONS: Final[dict[int, Callable[[Data], Data]]] = {1: to_version_2}
"""From each older version to the one after it."""


def oldest() -> int:
    """The oldest version that can be read."""
    return min(MIGRATIONS, default=VERSION)


def migrated(data: Data, version: int, name: str) -> Data:
    """The data of a plan of `version`, in the present version.

    Raises:
        InvalidInput: it is not what plans of that version were.
    """
    for number in range(version, VERSION):
        try:
            data = MIGRATIONS[number](data) | {"version": number + 1}
        except (LookupError, TypeError, ValueError, AttributeError):
            raise BadFile(f"{name} is not a sound plan of format version {number}") from None
    return data
