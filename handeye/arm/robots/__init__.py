"""The arms there are, each a value in a file of its own, by name."""

from typing import Final

from handeye.arm.model import ArmModel
from handeye.arm.robots.stanford import STANFORD
from handeye.diagnostics import quoted
from handeye.errors import InvalidInput

_ROBOTS: Final = {STANFORD.name: STANFORD}


def robot(name: str) -> ArmModel | None:
    """The arm of a name, if there is one."""
    return _ROBOTS.get(name)


def register(arm: ArmModel) -> None:
    """Make an arm known by its name.

    Raises:
        InvalidInput: another arm has that name.
    """
    if _ROBOTS.setdefault(arm.name, arm) is not arm:
        raise InvalidInput(f"there is an arm called {quoted(arm.name)} already")
