"""All arms by name, each defined as a value in a separate file."""

from typing import Final

from handeye.arm.model import ArmModel, same_arm
from handeye.arm.robots.stanford import STANFORD
from handeye.core.diagnostics import quoted
from handeye.core.errors import BadArgument

_ROBOTS: Final = {STANFORD.name: STANFORD}


def robot(name: str) -> ArmModel | None:
    """The arm with a name, or None."""
    return _ROBOTS.get(name)


def register(arm: ArmModel) -> None:
    """Register an arm under its name; raises BadArgument if the name is taken by an arm with other figures."""
    if not isinstance(arm, ArmModel):
        raise BadArgument(f"an arm is an ArmModel, not {arm!r}")
    if not arm.name:
        raise BadArgument("an arm needs a name")
    if not same_arm(_ROBOTS.setdefault(arm.name, arm), arm):
        raise BadArgument(f"there is an arm called {quoted(arm.name)} already")
