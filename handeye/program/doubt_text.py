"""Sentences for senses that are not believed: each names the sense, and what it says."""

from typing import assert_never

from handeye.core.units import DEGREE, INCH, OUNCE_FORCE, OUNCE_INCH
from handeye.program import causes as c

_FINGERS = ("+y", "-y")
"""The fingers in the order of their switches, by the side of the hand they are on."""


def doubt_sentence(cause: c.SenseCause) -> str:
    """Why a sense is not believed, for people: inches, degrees, ounces."""
    match cause:
        case c.SwitchesClosed():
            return f"{_switches(cause.fingers)} closed although the fingers are open"
        case c.SwitchesOpen():
            held = f"something {_inches(cause.gap)} thick holds the fingers apart"
            return f"{_switches(cause.fingers)} open although {held}"
        case c.GapAstray():
            return f"the gap reads {_inches(cause.gap)}; the fingers were driven to {_inches(cause.goal)}"
        case c.GapStill():
            driven = f"the fingers were driven together by {_inches(cause.driven)}"
            return f"the gap still reads {_inches(cause.gap)}; {driven}"
        case c.ForceInAir():
            return _in_air(cause)
        case c.JointSensesApart():
            pot, tachometer = (_way(cause.joint, way) for way in (cause.potentiometer, cause.tachometer))
            ways = f"{cause.joint.name} has gone {pot} by its potentiometer, {tachometer} by its tachometer"
            return f"{ways}, under its brake: or the brake slips" if cause.braked else ways
        case c.CurrentSilent():
            return f"it showed {cause.torque / OUNCE_INCH:.1f} oz-in at most, less than it takes to start"
        case c.PictureRepeated():
            return f"picture {cause.picture} is the same as {cause.earlier}, point by point"
        case c.PictureBlank():
            return f"picture {cause.picture} is of one intensity all over"
    assert_never(cause)


def touching_fingers(fingers: tuple[bool, bool]) -> str:
    """Some fingers, with the verb that they touch."""
    named = _named(fingers)
    return f"the {named[0]} finger touches" if len(named) == 1 else "both fingers touch"


def _switches(fingers: tuple[bool, bool]) -> str:
    """The switches of some fingers, with their verb."""
    named = _named(fingers)
    if len(named) == 1:
        return f"the switch of the {named[0]} finger is"
    return "the switches of both fingers are"


def _named(fingers: tuple[bool, bool]) -> list[str]:
    return [finger for finger, meant in zip(_FINGERS, fingers, strict=True) if meant]


def _in_air(cause: c.ForceInAir) -> str:
    components = zip("xyz", cause.force, strict=True)
    felt = ", ".join(f"{force / OUNCE_FORCE:z.0f} oz in {axis}" for axis, force in components)
    allowed, load = (f"{force / OUNCE_FORCE:.0f} oz" for force in (cause.limit, cause.load))
    return f"{felt}; allowed: {allowed}; declared load: {load}"


def _way(joint: c.JointName, way: float) -> str:
    return _inches(way) if joint.kind == "prismatic" else f"{way / DEGREE:z.1f} degrees"


def _inches(length: float) -> str:
    return f"{length / INCH:z.2f} in"
