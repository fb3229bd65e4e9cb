"""Sentences for the reasons to doubt a sensor, a motor or a drive. The sentences use inches, degrees and ounces."""

from typing import assert_never

from handeye.core.plain_text import distinct_digits
from handeye.core.units import DEGREE, INCH, OUNCE_FORCE, OUNCE_INCH
from handeye.program.diagnosis import sense_causes as s
from handeye.program.diagnosis.cause_record import JointName

_FINGERS = ("+y", "-y")  # names by the side of the hand, in the order of the switches


def doubt_sentence(cause: s.SenseCause) -> str:
    """Write the reason to doubt a sensor, a motor or a drive, in inches, degrees and ounces."""
    match cause:
        case s.SwitchesClosed():
            return f"{_switches(cause.fingers)} closed although the fingers are open"
        case s.SwitchesOpen():
            held = f"something {inches(cause.gap)} thick holds the fingers apart"
            return f"{_switches(cause.fingers)} open although {held}: {_untouched(cause)}"
        case s.SwitchesCrossed():
            still = (
                f"still closed after the hand moved {inches(cause.moved)} towards the side of this finger, away "
                "from the part"
            )
            return (
                f"{_switches(cause.fingers)} {still}: the two switches are swapped, or the switch of the other "
                "finger stays open"
            )
        case s.SwitchesHard():
            force = f"{cause.force / OUNCE_FORCE:.0f} oz"
            driven = f"the fingers are pressed together with {force}"
            return f"{_switches(cause.fingers)} open although {driven}: {_numb(cause.fingers)}"
        case s.GapJumped():
            before, after = inches_apart(cause.before, cause.gap)
            return f"the gap reading jumped from {before} in to {after} in: {_jump(cause)}"
        case s.GapUnlike():
            gap, thick = inches_apart(cause.gap, cause.thickness)
            times = (
                f"; the reading is {cause.gap / cause.thickness:.2f} times the thickness"
                if cause.thickness
                else ""
            )
            return (
                f"the gap reads {gap} in, but the fingers hold {cause.held}, which is {thick} in thick{times}"
            )
        case s.DrivesUnlike():
            named = zip(cause.joints, cause.factors, strict=False)
            gives = " and ".join(
                f"the drive of the {joint.name} gives {factor:.2f} times as much" for joint, factor in named
            )
            return (
                "to the drives, the weights of the links seem to have changed: either a drive gives more or less "
                f"torque than commanded ({gives}), or the arm no longer stands upright"
            )
        case s.CurrentUnlike():
            told, known = (torque / OUNCE_INCH for torque in (cause.torque, cause.known))
            times = f"; the reading is {told / known:.1f} times this torque" if known else ""
            return (
                f"the sensor shows {told:.1f} oz-in, but the torque of the motor is {known:.1f} oz-in{times}"
            )
        case s.CurrentShort():
            shown, asked = (torque / OUNCE_INCH for torque in (cause.torque, cause.asked))
            short = f"the sensor shows only {shown:.1f} of the commanded {asked:.1f} oz-in while the motor is stalled"
            return f"{short}: the current sensor reads no higher, or the motor is weak"
        case s.MotorSlow():
            return (
                f"the motor stopped speeding up after only {cause.share:.1f} times the usual time, "
                "so it turns too slowly"
            )
        case s.MotorFast():
            return f"the motor was still speeding up after {cause.times:.1f} times the usual time, so it turns too fast"
        case s.ScrewHard():
            takes, allowed = (torque / OUNCE_INCH for torque in (cause.torque, cause.limit))
            return (
                f"the sensor shows {takes:.1f} oz-in while the screw advances; allowed: {allowed:.1f} oz-in; "
                "either the thread is hard to turn, or the current sensor fails"
            )
        case s.GapAstray():
            return f"the gap reads {inches(cause.gap)}; the fingers were driven to {inches(cause.goal)}"
        case s.GapStill():
            driven = f"the fingers were driven {inches(cause.driven)} closer together"
            return f"the gap still reads {inches(cause.gap)}; {driven}"
        case s.ForceInAir():
            return _in_air(cause)
        case s.JointSensesApart():
            pot, tachometer = (_way(cause.joint, way) for way in (cause.potentiometer, cause.tachometer))
            ways = (
                f"{cause.joint.name} has moved {pot} by its potentiometer and {tachometer} by its tachometer"
            )
            return (
                f"{ways}, although its brake is set: a sensor fails, or the brake slips"
                if cause.braked
                else ways
            )
        case s.RateScatters():
            scatter, limit = (_rate(cause.joint, rate) for rate in (cause.scatter, cause.limit))
            return (
                f"the tachometer reading of the {cause.joint.name} scatters by {scatter} while the arm holds still; "
                f"allowed: {limit}; the cause is a failing tachometer, an unsteady drive of the joint, or something "
                "outside that shakes the arm"
            )
        case s.JointAlone():
            return _alone(cause)
        case s.CurrentSilent():
            most = f"{cause.torque / OUNCE_INCH:.1f} oz-in"
            return f"the sensor showed at most {most}, less than the motor needs to start"
        case s.PictureRepeated():
            return f"picture {cause.picture} is the same as {cause.earlier}, pixel by pixel"
        case s.PictureBlank():
            return f"picture {cause.picture} has the same intensity everywhere"
        case s.PictureNoisy():
            noise, most = distinct_digits([cause.noise, cause.most], 1)
            return f"picture {cause.picture} has noise of {noise} levels; allowed: {most}"
    assert_never(cause)


def _jump(cause: s.GapJumped) -> str:
    """Write the possible causes of a jump of the gap. If the fingers touch nothing, only the potentiometer can be
    the cause.
    """
    if not cause.held:
        return "no finger can move so fast"
    moved = "slipped" if cause.gap < cause.before else "been pushed and has forced the fingers apart"
    return f"the held part has {moved}, or the gap's potentiometer fails"


def touching_fingers(fingers: tuple[bool, bool]) -> str:
    """Return a clause that says which fingers touch, such as `both fingers touch`."""
    named = _named(fingers)
    return f"the {named[0]} finger touches" if len(named) == 1 else "both fingers touch"


def _switches(fingers: tuple[bool, bool]) -> str:
    named = _named(fingers)
    if len(named) == 1:
        return f"the switch of the {named[0]} finger is"
    return "the switches of both fingers are"


def _numb(fingers: tuple[bool, bool]) -> str:
    return f"{_failed(fingers)}, or the fingers' motor is weak"


def _untouched(cause: s.SwitchesOpen) -> str:
    """Write why the switches are open. If only one switch is open, the fingers' motor is strong enough, because it
    closed the other switch. A weak motor is then not among the reasons.
    """
    causes = _numb(cause.fingers) if all(cause.fingers) else _failed(cause.fingers)
    return causes if cause.fits else f"{causes}, or something stands between the fingers beside their tips"


def _failed(fingers: tuple[bool, bool]) -> str:
    return f"{'the switches have' if all(fingers) else 'the switch has'} failed"


def _named(fingers: tuple[bool, bool]) -> list[str]:
    return [finger for finger, meant in zip(_FINGERS, fingers, strict=True) if meant]


def _in_air(cause: s.ForceInAir) -> str:
    components = zip("xyz", cause.force, strict=True)
    felt = ", ".join(f"{force / OUNCE_FORCE:z.0f} oz in {axis}" for axis, force in components)
    allowed, load = (f"{force / OUNCE_FORCE:.0f} oz" for force in (cause.limit, cause.load))
    return f"{felt}; allowed: {allowed}; declared load: {load}"


def _alone(cause: s.JointAlone) -> str:
    prismatic = cause.joint.kind == "prismatic"
    unit, name = (OUNCE_FORCE, "oz") if prismatic else (OUNCE_INCH, "oz-in")
    if cause.friction is None:
        return f"{cause.joint.name} does not move with {abs(cause.torque) / unit:.0f} {name}"
    took, takes = distinct_digits([cause.friction / unit, cause.torque / unit], 0)
    tilted = "; perhaps the arm no longer stands upright" if cause.one_way else ""
    return f"{cause.joint.name} takes {takes} {name} to move; at the start it took {took} {name}{tilted}"


def _rate(joint: JointName, rate: float) -> str:
    return f"{rate / INCH:.2f} in/s" if joint.kind == "prismatic" else f"{rate / DEGREE:.1f} degrees/s"


def _way(joint: JointName, way: float) -> str:
    return inches(way) if joint.kind == "prismatic" else f"{way / DEGREE:z.1f} degrees"


def inches(length: float) -> str:
    """Write a length (m) in inches."""
    return f"{length / INCH:z.2f} in"


def inches_apart(*lengths: float, decimals: int = 2) -> list[str]:
    """Write lengths (m) in inches, with more decimals if two lengths would look the same."""
    return distinct_digits([length / INCH for length in lengths], decimals)
