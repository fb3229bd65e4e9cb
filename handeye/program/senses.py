"""Senses that a program can be made to do without, and what it goes by then."""

from typing import Final, Literal, get_args

from handeye.core import errors

Sense = Literal["vision", "touch", "search", "force", "centring"]
SENSES: Final[tuple[Sense, ...]] = get_args(Sense)

BELIEFS: Final[dict[Sense, str]] = {
    "vision": "each part is taken to be where it was planned, and to lie as it should",
    "touch": "finger switches tell nothing: CENTER closes blind and measures nothing",
    "search": "each search tries one place",
    "force": "no force ends or guides a motion: each is taken to have ended as meant",
    "centring": "CENTER is CLOSE: the hand does not give way",
}
"""What a program believes in the place of what a sense would tell."""
TESTED: Final[dict[int, Sense]] = {errors.NO_FORCE: "force", errors.NO_TOUCH: "touch"}
"""Errors that tell what a sense has not felt, with that sense."""
