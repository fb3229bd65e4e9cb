"""Sentences for causes, in inches, degrees and ounces."""

from typing import assert_never

from handeye.core.errors import ERRORS
from handeye.core.plain_text import counted, distinct_digits
from handeye.core.units import INCH, OUNCE_FORCE, OUNCE_INCH
from handeye.program.diagnosis import causes as c
from handeye.program.diagnosis.causes import Cause
from handeye.program.diagnosis.reach import reach_sentence
from handeye.program.diagnosis.sense_causes import SenseCause
from handeye.program.diagnosis.sense_text import doubt_sentence, inches, inches_apart, touching_fingers
from handeye.program.guards import GuardKind


def error_sentence(number: int, cause: Cause | None) -> str:
    """Write the meaning of an error, with its cause in brackets."""
    meaning = ERRORS.get(number, "an error")
    if isinstance(cause, c.JointBehind | c.HandAstray | c.GapTooSmall) and cause.of:
        meaning += f", or {cause.of} has moved"
    words = "" if cause is None else cause_sentence(cause)
    return f"{meaning} ({words})" if words else meaning


def call_sentence(message: str, error: int | None, cause: Cause | None) -> str:
    """Write the sentence for a call to the operator: the program's own message, if there is one. Without a message,
    the function writes the sentence of the error. Without an error, it writes the sentence of the cause.
    """
    if message:
        return message
    if error is not None:
        return error_sentence(error, cause)
    return "" if cause is None else cause_sentence(cause)


def cause_sentence(cause: Cause) -> str:
    """Write the sentence for a cause. The sentence is empty if the cause adds nothing to the meaning of the error."""
    if isinstance(cause, SenseCause):
        return doubt_sentence(cause)
    match cause:
        case c.BeyondArm():
            goal = f"{cause.goal}: " if cause.goal else ""
            return goal + reach_sentence(cause.arm, cause.reason)
        case c.JointBehind():
            return f"{cause.joint} {_SWINGS if cause.swings else 'lags behind its set-point'}"
        case c.HandAstray():
            lags = f"; {cause.joint} {_SWINGS if cause.swings else 'lags most'}" if cause.joint else ""
            turning = "; a turning screw may have pushed it" if isinstance(cause, c.HandPushed) else ""
            return f"the hand is {inches(cause.distance)} from its set-point{turning}{lags}"
        case c.HandStuck():
            return f"the hand stopped after {inches(cause.moved)}"
        case c.GuardsUnmet():
            return "or the moment" if GuardKind.MOMENT in cause.guards else ""
        case c.TravelOutside():
            went, least, most = inches_apart(cause.travel, cause.minimum, cause.maximum)
            return f"the hand moved {went} in; allowed: {least} to {most} in"
        case c.HeightOutside():
            height, least, most = inches_apart(cause.height, cause.minimum, cause.maximum, decimals=3)
            return f"the hand is {height} in above {cause.name}; allowed: {least} to {most} in"
        case c.HeightUnknown():
            return f"no place was saved as {cause.name}"
        case c.GapTooSmall():
            gap, least = inches_apart(cause.gap, cause.minimum)
            return f"gap {gap} in, minimum {least} in"
        case c.GapTooLarge():
            gap, most = inches_apart(cause.gap, cause.maximum)
            return f"gap {gap} in, maximum {most} in"
        case c.NothingBetween():
            return f"at most one finger touches; the gap is {inches(cause.gap)}"
        case c.NoPicture():
            return f"no picture {cause.picture} was taken"
        case c.NoGeneral():
            return "no earlier GENERAL found the part"
        case (
            c.NoOutline()
            | c.OutsidePicture()
            | c.FaintPicture()
            | c.DarkPart()
            | c.NoHoles()
            | c.CallersVision()
        ):
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
    """Write the result of an inspection as a sentence. If `cause` is None, the gasket passed the inspection."""
    match cause:
        case None:
            return "the gasket is in place"
        case c.NoGasket():
            return "no gasket: the later picture shows nothing new where the gasket should be"
        case c.GasketWrong():
            return "; ".join(map(_gasket_fault, cause.faults))
        case c.CallersVision():
            return f"the calling program's own vision, {cause.by}, rejects the gasket"
    assert_never(cause)


def match_sentence(off: float, unlike: float) -> str:
    """Write the result of a match as a sentence. `off` is the displacement of the part (m), and `unlike` is the
    fraction of the part that looks different.
    """
    moved = f"moved by {inches(off)} relative to its surroundings"
    return f"{moved}; {100 * unlike:.1f} % of the part looks different"


def _undo_stopped(cause: c.UndoCause) -> str:
    match cause:
        case c.UndoResisted():
            felt, limit = distinct_digits([cause.force / OUNCE_FORCE, cause.limit / OUNCE_FORCE], 1)
            return f"something resists as the step is undone: the hand feels {felt} oz; allowed: {limit} oz"
        case c.HoldOff():
            gap, kept = inches_apart(cause.gap, cause.kept)
            held = ", with an object between the fingers" if cause.holding else ""
            return f"the gap is {gap} in; when the step was executed, the gap was {kept} in{held}"
        case c.MetEarly():
            return _met_early(cause)
        case c.ScrewFast():
            torque = f"{cause.torque / OUNCE_INCH:.0f} oz-in"
            return (
                f"the screw does not come out: it has risen by {inches(cause.risen)}, and the driver's motor gives"
                f" {torque}"
            )
        case c.ScrewLost():
            force = f"{cause.force / OUNCE_FORCE:.0f} oz"
            return f"the hand has lost the screw: the hand went down {inches(cause.way)} and felt less than {force}"
        case c.BackingOut():
            return "the step drove a screw out, which cannot be undone"
        case c.UndoUnknown():
            return "the record for undoing this step cannot be used"
    assert_never(cause)


def _met_early(cause: c.MetEarly) -> str:
    gap, kept = inches_apart(cause.gap, cause.kept)
    then = "held an object" if cause.holding else "stood"
    touching = f"{touching_fingers(cause.fingers)} an object early, at a gap of {gap} in"
    reach_sentence = f"{touching}; when the step was executed, the fingers {then} at {kept} in"
    if all(cause.fingers) or not cause.holding:
        return reach_sentence
    return (
        f"{reach_sentence}: the object lies {inches((cause.gap - cause.kept) / 2)} off the centre of the hand"
    )


def _not_found(cause: c.SightCause) -> str:
    match cause:
        case c.NoOutline():
            return "no object of the part's size stands out from the background where the part should be"
        case c.OutsidePicture():
            return "the part is not in the field of the close picture: is the camera aimed at it?"
        case c.FaintPicture():
            return (
                f"the earlier picture is too faint to compare: its contrast on the part is {cause.contrast:.1f} "
                f"grey levels, but at least {cause.least:.1f} are needed; check camera and light"
            )
        case c.DarkPart():
            return (
                f"the part is too dark in the earlier picture to compare: its brightness is {cause.brightness:.1f} "
                f"grey levels, but at least {cause.least:.1f} are needed; does a shadow lie on it?"
            )
        case c.NoHoles(blobs=0):
            return "found no hole: is the picture in focus, and is the part in it?"
        case c.NoHoles(blobs=1):
            return "found only one hole, which cannot locate the part: is the picture in focus?"
        case c.CallersVision():
            return f"the calling program's own vision, {cause.by}, does not accept what it sees"
        case c.NoHoles():
            found = f"{cause.blobs} dark blobs are found"
            return f"{found}, but no two are the part's largest holes: is the picture in focus?"
    assert_never(cause)


def _gasket_fault(fault: c.GasketFault) -> str:
    match fault:
        case c.BaseHoleUnseen():
            return f"the {fault.hole} hole of the base was not found in the earlier picture"
        case c.GasketHoleUnseen():
            return f"the {fault.hole} hole of the gasket was not found"
        case c.GasketHoleOff():
            return f"the {fault.hole} hole of the gasket is displaced by about {inches(fault.off)}"
        case c.GasketTorn():
            bare = f"{fault.bare / INCH**2:.2f} sq in"
            return (
                f"the gasket leaves {bare} of the base's face bare: it is torn, or a piece of it is missing"
            )
    assert_never(fault)
