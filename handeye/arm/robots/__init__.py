"""All arms by name. Each arm is a value, defined in a separate file."""

from typing import Final

from handeye.arm.model import ArmModel, same_arm
from handeye.arm.robots.stanford import STANFORD
from handeye.core.diagnostics import quoted
from handeye.core.errors import BadArgument

_ROBOTS: Final = {STANFORD.name: STANFORD}


def robot(name: str) -> ArmModel | None:
    """Return the arm called `name`, or None if no arm has this name."""
    return _ROBOTS.get(name)


def register(arm: ArmModel) -> None:
    """Register an arm under its name. Raises BadArgument if the name belongs to an arm with other values."""
    if not isinstance(arm, ArmModel):
        raise BadArgument(f"an arm must be an ArmModel, not {arm!r}")
    if not arm.name:
        raise BadArgument("an arm needs a name")
    if not same_arm(_ROBOTS.setdefault(arm.name, arm), arm):
        raise BadArgument(f"there is already an arm called {quoted(arm.name)}")
