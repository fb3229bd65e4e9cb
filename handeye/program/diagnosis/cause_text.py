"""Sentences for causes, in inches, degrees and ounces."""

from typing import assert_never

from handeye.core.errors import ERRORS
from handeye.core.plain_text import counted, distinct_digits
from handeye.core.units import DEGREE, INCH, OUNCE_FORCE, OUNCE_INCH
from handeye.program.diagnosis import causes as c
from handeye.program.diagnosis.causes import Cause
from handeye.program.diagnosis.reach import reach_sentence
from handeye.program.guards import GuardKind


def error_sentence(number: int, cause: Cause | None) -> str:
    """Write the meaning of an error, with its cause in brackets."""
    meaning = ERRORS.get(number, "an error")
    if isinstance(cause, c.JointBehind | c.HandAstray | c.GapTooSmall) and cause.of:
        meaning += f", or {cause.of} has moved"
    words = "" if cause is None else cause_sentence(cause)
    return f"{meaning} ({words})" if words else meaning


def call_sentence(message: str, error: int | None, cause: Cause | None) -> str:
    """Write the sentence of a call of the operator: the program's own message, the error, or the cause."""
    if message:
        return message
    if error is not None:
        return error_sentence(error, cause)
    return "" if cause is None else cause_sentence(cause)


def cause_sentence(cause: Cause) -> str:
    """Write the sentence of a cause. The sentence is empty if the meaning of the error says it all."""
    match cause:
        case c.BeyondArm():
            goal = f"{cause.goal}: " if cause.goal else ""
            return goal + reach_sentence(cause.arm, cause.reason)
        case c.JointBehind():
            return f"{cause.joint} {_SWINGS if cause.swings else 'lags behind its set-point'}"
        case c.HandAstray():
            lags = f"; {cause.joint} {_SWINGS if cause.swings else 'lags most'}" if cause.joint else ""
            return f"the hand is {_inches(cause.distance)} from its set-point{lags}"
        case c.HandStuck():
            return f"the hand stopped after {_inches(cause.moved)}"
        case c.GuardsUnmet():
            return "or the moment" if GuardKind.MOMENT in cause.guards else ""
        case c.TravelOutside():
            went, least, most = _apart(cause.travel, cause.minimum, cause.maximum)
            return f"the hand moved {went} in; allowed: {least} to {most} in"
        case c.HeightOutside():
            height, least, most = _apart(cause.height, cause.minimum, cause.maximum, decimals=3)
            return f"the hand is {height} in above {cause.name}; allowed: {least} to {most} in"
        case c.HeightUnknown():
            return f"no place was saved as {cause.name}"
        case c.GapTooSmall():
            gap, least = _apart(cause.gap, cause.minimum)
            return f"gap {gap} in, minimum {least} in"
        case c.GapTooLarge():
            gap, most = _apart(cause.gap, cause.maximum)
            return f"gap {gap} in, maximum {most} in"
        case c.NothingBetween():
            return f"at most one finger touches; the gap is {_inches(cause.gap)}"
        case (
            c.SwitchesClosed() | c.SwitchesOpen() | c.SwitchesCrossed() | c.SwitchesHard() | c.GapAstray()
            | c.GapStill() | c.GapJumped() | c.GapUnlike() | c.CurrentUnlike() | c.MotorSlow() | c.MotorFast()
            | c.ScrewHard() | c.ForceInAir()
            | c.DrivesUnlike() | c.CurrentShort()
            | c.JointSensesApart() | c.RateScatters() | c.JointAlone() | c.CurrentSilent() | c.PictureRepeated()
            | c.PictureBlank() | c.PictureNoisy()
        ):  # fmt: skip
            return doubt_sentence(cause)
        case c.NoPicture():
            return f"no picture {cause.picture} was taken"
        case c.NoGeneral():
            return "no earlier GENERAL found the part"
        case c.NoOutline() | c.OutsidePicture() | c.NoHoles():
            return _not_found(cause)
        case c.NoGasket() | c.GasketWrong():
            return inspection_sentence(cause)
        case c.PartAstray():
            return match_sentence(cause.off, cause.unlike)
        case c.NoSearch():
            return "no SEARCH was executed"
        case c.PlacesTried():
            return f"{counted(cause.places, 'place')} tried" + (
                f" around {cause.around}" if cause.around else ""
            )
        case c.Looping():
            return f"the program loops at line {cause.place} while nothing moves"
        case (
            c.UndoResisted() | c.HoldOff() | c.MetEarly() | c.ScrewFast() | c.ScrewLost() | c.BackingOut()
            | c.UndoUnknown()
        ):  # fmt: skip
            return _undo_stopped(cause)
    assert_never(cause)


_SWINGS = "swings about its set-point: its drive or the computer is late, or its tachometer fails"


def inspection_sentence(cause: c.InspectionCause | None) -> str:
    """Write the result of an inspection as a sentence. A cause of None means that the gasket passed."""
    match cause:
        case None:
            return "the gasket is in place"
        case c.NoGasket():
            return "no gasket: the later picture shows nothing new where the gasket should be"
        case c.GasketWrong():
            return "; ".join(f"the {fault.hole} hole {_hole(fault)}" for fault in cause.faults)
    assert_never(cause)


def match_sentence(off: float, unlike: float) -> str:
    """Write the result of a match as a sentence, from the displacement (m) and the fraction of the part that looks
    different.
    """
    moved = f"moved by {_inches(off)} relative to its surroundings"
    return f"{moved}; {100 * unlike:.1f} % of the part looks different"


def _undo_stopped(cause: c.UndoCause) -> str:
    match cause:
        case c.UndoResisted():
            felt, limit = distinct_digits([cause.force / OUNCE_FORCE, cause.limit / OUNCE_FORCE], 1)
            return f"something resists as the step is undone: the hand feels {felt} oz; allowed: {limit} oz"
        case c.HoldOff():
            gap, kept = _apart(cause.gap, cause.kept)
            held = "held an object at" if cause.holding else "stood at"
            return f"the gap is {gap} in; when the step was executed, the fingers {held} {kept} in"
        case c.MetEarly():
            return _met_early(cause)
        case c.ScrewFast():
            torque = f"{cause.torque / OUNCE_INCH:.0f} oz-in"
            return (
                f"the screw does not come out: it has risen by {_inches(cause.risen)}, and the driver's motor gives"
                f" {torque}"
            )
        case c.ScrewLost():
            force = f"{cause.force / OUNCE_FORCE:.0f} oz"
            return f"the hand does not hold the screw: the hand goes down {_inches(cause.way)} without meeting {force}"
        case c.BackingOut():
            return "the step drove a screw out, which cannot be undone"
        case c.UndoUnknown():
            return "the record for undoing this step cannot be used"
    assert_never(cause)


def _met_early(cause: c.MetEarly) -> str:
    gap, kept = _apart(cause.gap, cause.kept)
    then = "held an object" if cause.holding else "stood"
    touching = f"{touching_fingers(cause.fingers)} an object early, at a gap of {gap} in"
    reach_sentence = f"{touching}; when the step was executed, the fingers {then} at {kept} in"
    if all(cause.fingers) or not cause.holding:
        return reach_sentence
    return f"{reach_sentence}: the object lies {_inches((cause.gap - cause.kept) / 2)} off the centre of the hand"


def _not_found(cause: c.SightCause) -> str:
    match cause:
        case c.NoOutline():
            return "nothing of the part's size is visible against the background where it should be"
        case c.OutsidePicture():
            return "the part is not in the field of the close picture: is the camera aimed at it?"
        case c.NoHoles(blobs=0):
            return "found no hole: is the picture in focus, and is the part in it?"
        case c.NoHoles(blobs=1):
            return "found only one hole, which cannot locate the part: is the picture in focus?"
        case c.NoHoles():
            found = f"{cause.blobs} dark blobs are found"
            return f"{found}, but no two are the part's largest holes: is the picture in focus?"
    assert_never(cause)


def _hole(fault: c.BaseHoleUnseen | c.GasketHoleUnseen | c.GasketHoleOff) -> str:
    match fault:
        case c.BaseHoleUnseen():
            return "of the base was not found in the earlier picture"
        case c.GasketHoleUnseen():
            return "of the gasket was not found"
        case c.GasketHoleOff():
            return f"of the gasket is displaced by about {_inches(fault.off)}"
    assert_never(fault)


def _apart(*lengths: float, decimals: int = 2) -> list[str]:
    return distinct_digits([length / INCH for length in lengths], decimals)


def _inches(length: float) -> str:
    return f"{length / INCH:z.2f} in"


_FINGERS = ("+y", "-y")  # by side of the hand, in switch order


def doubt_sentence(cause: c.SenseCause) -> str:
    """Write the reason why a sensor is not believed, in inches, degrees and ounces."""
    match cause:
        case c.SwitchesClosed():
            return f"{_switches(cause.fingers)} closed although the fingers are open"
        case c.SwitchesOpen():
            held = f"something {_inches(cause.gap)} thick holds the fingers apart"
            return f"{_switches(cause.fingers)} open although {held}: {_untouched(cause)}"
        case c.SwitchesCrossed():
            still = f"still closed after the hand moved {_inches(cause.moved)} towards it, away from the part"
            return (
                f"{_switches(cause.fingers)} {still}: the two switches are swapped, or the switch of the other "
                "finger stays open"
            )
        case c.SwitchesHard():
            force = f"{cause.force / OUNCE_FORCE:.0f} oz"
            driven = f"the fingers are pressed together with {force}"
            return f"{_switches(cause.fingers)} open although {driven}: {_numb(cause.fingers)}"
        case c.GapJumped():
            before, after = _apart(cause.before, cause.gap)
            return f"the gap reading jumped from {before} in to {after} in: {_jump(cause)}"
        case c.GapUnlike():
            gap, thick = _apart(cause.gap, cause.thickness)
            times = f": {cause.gap / cause.thickness:.2f} times the thickness" if cause.thickness else ""
            return f"the gap reads {gap} in on {cause.held}, which is {thick} in thick there{times}"
        case c.DrivesUnlike():
            named = zip(cause.joints, cause.factors, strict=False)
            gives = " and ".join(
                f"the drive of the {joint.name} {factor:.2f} times as much" for joint, factor in named
            )
            return (
                "the weights of the links, as the drives feel them, have changed: a drive gives more or less torque "
                f"than commanded ({gives}), or the arm no longer stands upright"
            )
        case c.CurrentUnlike():
            told, known = (torque / OUNCE_INCH for torque in (cause.torque, cause.known))
            times = f": {told / known:.1f} times as much" if known else ""
            return f"the sensor shows {told:.1f} oz-in, but the motor takes {known:.1f} oz-in{times}"
        case c.CurrentShort():
            shown, asked = (torque / OUNCE_INCH for torque in (cause.torque, cause.asked))
            short = f"the sensor shows {shown:.1f} oz-in of the commanded {asked:.1f} oz-in while the motor is stalled"
            return f"{short}: the current sensor reads no higher, or the motor is weak"
        case c.MotorSlow():
            return (
                f"the motor had started after {cause.share:.1f} of the usual time: the motor turns too slowly"
            )
        case c.MotorFast():
            return f"the motor had not started after {cause.times:.1f} times its usual time: the motor turns too fast"
        case c.ScrewHard():
            takes, allowed = (torque / OUNCE_INCH for torque in (cause.torque, cause.limit))
            return (
                f"the sensor shows {takes:.1f} oz-in while the screw advances, allowed: {allowed:.1f} oz-in: its "
                "thread is hard to turn, or the current sensor fails"
            )
        case c.GapAstray():
            return f"the gap reads {_inches(cause.gap)}; the fingers were driven to {_inches(cause.goal)}"
        case c.GapStill():
            driven = f"the fingers were driven together by {_inches(cause.driven)}"
            return f"the gap still reads {_inches(cause.gap)}; {driven}"
        case c.ForceInAir():
            return _in_air(cause)
        case c.JointSensesApart():
            pot, tachometer = (_way(cause.joint, way) for way in (cause.potentiometer, cause.tachometer))
            ways = (
                f"{cause.joint.name} has moved {pot} by its potentiometer and {tachometer} by its tachometer"
            )
            return f"{ways}, although its brake is set; or the brake slips" if cause.braked else ways
        case c.RateScatters():
            scatter, limit = (_rate(cause.joint, rate) for rate in (cause.scatter, cause.limit))
            return (
                f"the tachometer reading of the {cause.joint.name} scatters by {scatter} while the arm holds still, "
                f"allowed: {limit}; or its drive, or something outside, shakes the arm"
            )
        case c.JointAlone():
            return _alone(cause)
        case c.CurrentSilent():
            most = f"{cause.torque / OUNCE_INCH:.1f} oz-in"
            return f"the sensor showed at most {most}, less than the motor needs to start"
        case c.PictureRepeated():
            return f"picture {cause.picture} is the same as {cause.earlier}, pixel by pixel"
        case c.PictureBlank():
            return f"picture {cause.picture} has the same intensity everywhere"
        case c.PictureNoisy():
            noise, most = distinct_digits([cause.noise, cause.most], 1)
            return f"picture {cause.picture} has noise of {noise} levels; allowed: {most}"
    assert_never(cause)


def _jump(cause: c.GapJumped) -> str:
    """Write the possible causes of a jump of the gap. If the fingers touch nothing, only the potentiometer can be
    the cause.
    """
    if not cause.held:
        return "no finger can move so fast"
    moved = "slipped" if cause.gap < cause.before else "been pushed and has forced the fingers apart"
    return f"the held part has {moved}, or the gap's potentiometer fails"


def touching_fingers(fingers: tuple[bool, bool]) -> str:
    """Write which fingers touch, with the verb, such as `both fingers touch`."""
    named = _named(fingers)
    return f"the {named[0]} finger touches" if len(named) == 1 else "both fingers touch"


def _switches(fingers: tuple[bool, bool]) -> str:
    named = _named(fingers)
    if len(named) == 1:
        return f"the switch of the {named[0]} finger is"
    return "the switches of both fingers are"


def _numb(fingers: tuple[bool, bool]) -> str:
    return f"{_failed(fingers)}, or the fingers' motor is weak"


def _untouched(cause: c.SwitchesOpen) -> str:
    """Write why the switches are open. A switch that is closed shows that the motor is strong enough."""
    causes = _numb(cause.fingers) if all(cause.fingers) else _failed(cause.fingers)
    return causes if cause.fits else f"{causes}, or something stands between the fingers beside their tips"


def _failed(fingers: tuple[bool, bool]) -> str:
    return f"{'the switches have' if all(fingers) else 'the switch has'} failed"


def _named(fingers: tuple[bool, bool]) -> list[str]:
    return [finger for finger, meant in zip(_FINGERS, fingers, strict=True) if meant]


def _in_air(cause: c.ForceInAir) -> str:
    components = zip("xyz", cause.force, strict=True)
    felt = ", ".join(f"{force / OUNCE_FORCE:z.0f} oz in {axis}" for axis, force in components)
    allowed, load = (f"{force / OUNCE_FORCE:.0f} oz" for force in (cause.limit, cause.load))
    return f"{felt}; allowed: {allowed}; declared load: {load}"


def _alone(cause: c.JointAlone) -> str:
    prismatic = cause.joint.kind == "prismatic"
    unit, name = (OUNCE_FORCE, "oz") if prismatic else (OUNCE_INCH, "oz-in")
    if cause.friction is None:
        return f"{cause.joint.name} does not move with {abs(cause.torque) / unit:.0f} {name}"
    took, takes = distinct_digits([cause.friction / unit, cause.torque / unit], 0)
    tilted = "; or the arm no longer stands upright" if cause.one_way else ""
    return f"{cause.joint.name} takes {takes} {name} to move; at the start it took {took} {name}{tilted}"


def _rate(joint: c.JointName, rate: float) -> str:
    return f"{rate / INCH:.2f} in/s" if joint.kind == "prismatic" else f"{rate / DEGREE:.1f} degrees/s"


def _way(joint: c.JointName, way: float) -> str:
    return _inches(way) if joint.kind == "prismatic" else f"{way / DEGREE:z.1f} degrees"
