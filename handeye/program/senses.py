"""Senses and macros that a run can do without, and the assumption in their place."""

from typing import Final, Literal, get_args

from handeye.core import errors

Sense = Literal["vision", "touch", "search", "force", "centring"]
SENSES: Final[tuple[str, ...]] = get_args(Sense)

ASSUMPTIONS: Final[dict[str, str]] = {
    "vision": "each part is taken to be where it was planned, and to lie as it should",
    "touch": "finger switches tell nothing: CENTER closes blind and measures nothing",
    "search": "each search tries one place",
    "force": "no force ends or guides a motion: each is taken to have ended as meant",
    "centring": "CENTER is CLOSE: the hand does not give way",
}


def assumption(name: str) -> str:
    """What a run assumes that goes without a sense, or without a macro of its program."""
    return ASSUMPTIONS.get(name, f"what {name} does is left out")


TESTED: Final[dict[int, Sense]] = {errors.NO_FORCE: "force", errors.NO_TOUCH: "touch"}
"""Errors for what a sense should have felt."""
