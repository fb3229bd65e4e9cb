"""Plans of older versions, brought to the present one. What was once written stays loadable for ever.

A change of the format that old plans do not survive raises `VERSION` by one and adds one function here. It takes the
builtin data of a plan of its version and returns that of the next; it knows no types, for those have gone on since.
"""

from collections.abc import Callable
from typing import Any, Final

from handeye.errors import InvalidInput
from handeye.planfile.plan import VERSION

Data = dict[str, Any]


_SAME_ARM: Final = {"6863f8cd01ff": "40fac2bbfe2d"}
"""Digests of an arm's figures as they were taken in version 1, and of the same figures as they are taken since."""


def from_version_1(plan: Data) -> Data:
    """Guards as a list, where version 1 had a stop with a field for each kind; another digest of the same arm."""
    plan["arm_digest"] = _SAME_ARM.get(plan["arm_digest"], plan["arm_digest"])
    for step in plan["program"]["steps"]:
        operation = step["operation"]
        if operation["op"] == "search":
            operation.setdefault("limit", 49)
        stop = operation.pop("stop", None)
        if stop is not None:
            operation["guards"] = _guards(stop)
    return plan


def _guards(stop: Data) -> list[Data]:
    """The guards of a stop of version 1: exactly one, but that a moment could stand beside a force."""
    fields = {
        "force": "force",
        "against": "force",
        "moment": "moment",
        "torque": "torque",
        "touch": "fingers",
    }
    met = {kind: stop[kind] for kind in fields if stop.get(kind) is not None}
    if len(met) != 1 and met.keys() not in ({"force", "moment"}, {"against", "moment"}):
        raise ValueError("a stop has one condition")
    return [{"guard": kind, fields[kind]: value} for kind, value in met.items()]


MIGRATIONS: Final[dict[int, Callable[[Data], Data]]] = {1: from_version_1}
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
            raise InvalidInput(f"{name} is not a sound plan of format version {number}") from None
    return data
