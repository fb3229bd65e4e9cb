"""Words for units, which people write behind numbers and the language does not have."""

from typing import Final

_LENGTH, _FORCE = (
    "distances are in inches",
    "forces and weights are in ounces, moments and torques in ounce-inches",
)
_ANGLE, _SPEED = (
    "angles are in degrees",
    "speeds are in inches a second, the screwdriver's in revolutions a minute",
)

UNIT_WORDS: Final = {
    **dict.fromkeys(("in", "inch", "inches", "ft", "mm", "cm", "m"), _LENGTH),
    **dict.fromkeys(("oz", "ounce", "ounces", "lb", "lbs", "g", "kg", "n", "nm", "ozin"), _FORCE),
    **dict.fromkeys(("deg", "degree", "degrees", "rad"), _ANGLE),
    **dict.fromkeys(("ips", "rpm"), _SPEED),
}
"""Help for each, in small letters."""


def no_units(word: str) -> str | None:
    """Help where a word stands that may be meant for a unit; None if it may not."""
    said = UNIT_WORDS.get(word.lower())
    return None if said is None else f"numbers are written without a unit: {said}"
