"""The arms there are, each a value in a file of its own, by name."""

from typing import Final

from handeye.arm.model import ArmModel
from handeye.arm.robots.stanford import STANFORD

_ROBOTS: Final = {STANFORD.name: STANFORD}


def robot(name: str) -> ArmModel | None:
    """The arm of a name, if there is one."""
    return _ROBOTS.get(name)


def register(arm: ArmModel) -> None:
    """Make an arm known by its name.

    Raises:
        ValueError: another arm has that name.
    """
    if _ROBOTS.setdefault(arm.name, arm) is not arm:
        raise ValueError(f"there is an arm {arm.name!r} already")
