"""Senses and macros that can be switched off in a run, and the assumption that replaces each of them."""

from typing import Final, Literal, get_args

from handeye.core import errors

Sense = Literal["vision", "touch", "search", "force", "centring"]
SENSES: Final[tuple[str, ...]] = get_args(Sense)

ASSUMPTIONS: Final[dict[str, str]] = {
    "vision": "every part is assumed to be at its planned pose",
    "touch": "finger switches report nothing: CENTER closes blindly and measures nothing",
    "search": "every search tries only its first place",
    "force": "no force ends or guides a motion: every motion is assumed to have ended as planned",
    "centring": "CENTER acts like CLOSE: the hand does not yield",
}


def assumption(name: str) -> str:
    """Write the assumption that a run makes if a sense, or a macro of the program, is switched off."""
    return ASSUMPTIONS.get(name, f"{name} is skipped")


TESTED: Final[dict[int, Sense]] = {errors.NO_FORCE: "force", errors.NO_TOUCH: "touch"}
"""For each error that reports missing contact, the sense that should have sensed the contact."""
