"""Defines when a call to the operator names a fault correctly. Also defines the expectations that several faults share.

The expected detection of a fault is part of its declaration. A correct call names the faulty part or sense, so that a
person knows where to look. If the arm cannot distinguish several causes, the call names all of them. For example, a
screw that stops high may be cross-threaded, or its hole may be blocked.
"""

from typing import Final

from handeye.core.errors import (
    FEATURES_NOT_SEEN,
    GASKET_WRONG,
    NOTHING_HELD,
    PART_NOT_SEEN,
    PICTURE_WRONG,
    SEARCH_EXHAUSTED,
    WRONG_HEIGHT,
)
from handeye.core.faults import UNKNOWN, ExpectedDetection

SCREWED: Final = (1, 3, 6, 2, 5, 4)
"""The tapped holes in the order in which the program drives screws 1 to 6 into them."""
PINNED: Final = (2, 5)  # the tapped holes into which the program puts the aligning pins before that
INSERT_PINS: Final = "insert the aligning pins"
PUT_ON_GASKET: Final = "put on the gasket"
PUT_ON_TOP: Final = "put on the top"
DRIVE_FIRST: Final = "drive the first two screws"
DRIVE_LAST: Final = "drive the last four screws"

ASTRAY: Final = "{what}: THE BASE IS LOST, OR A JOINT READS WRONG"
"""Calls to the operator when the readings of a joint have been wrong from the beginning. These calls blame the base or
a joint, never the table or the blocks. The joint's two sensors agree, and the camera is calibrated with the wrong
readings, so only the parts in the cell reveal the error.
"""
JOINT_OR_PLACE: Final = "{what}, OR A JOINT READS WRONG"
"""Calls to the operator if a fixture or part is not where the program expects it, or if a hole or pin is not found.
Either the object is out of place, or the gear or the potentiometer of a joint is faulty.
"""
UNSEEN: Final = "THE BASE IS NOT SEEN ON THE BELT: ITS {what}"
NOT_WHERE_SEEN: Final = (
    "THE BASE IS NOT WHERE IT WAS SEEN: IT OR THE CAMERA HAS MOVED, OR A JOINT READS WRONG"
)
NOT_ON: Final = "THE GASKET IS NOT ON PROPERLY, OR THE CAMERA OR THE LIGHT HAS CHANGED"
TOO_LOW: Final = "THE GASKET IS MISSING OR TOO THIN, OR THE PUMP HAS MOVED, OR A JOINT READS WRONG"
TOO_HIGH: Final = "THE GASKET LIES TOO HIGH: THERE ARE TWO, OR IT IS TOO THICK, OR SOMETHING LIES UNDER IT"
GASKET_OFF: Final = "THE GASKET IS NOT WHERE IT SHOULD BE: {how}, OR A JOINT READS WRONG"
NOT_LIFTED: Final = "THE GASKET CANNOT BE TAKEN UP AGAIN"
NO_DRIVER: Final = "THE SCREWDRIVER DOES NOT STAND IN ITS RACK, OR A JOINT READS WRONG"
NO_TOP: Final = "NO TOP IS ON ITS STAND, OR THE STAND HAS MOVED"
GASKET_LOST: Final = "THE GASKET MEETS NOTHING: IT LIES REVERSED, OR IS LOST"
TOP_ASTRAY: Final = "THE TOP IS NOT WHERE IT SHOULD BE: IT OR ITS STAND HAS MOVED, OR A JOINT READS WRONG"
TOP_LOST: Final = "NO TOP UNDER THE FINGERS: IT IS REVERSED OR LOST, OR ITS STAND HAS MOVED"
NOT_FLAT: Final = "THE TOP DOES NOT LIE FLAT ON THE GASKET, OR THE GASKET IS MISSING"
ON_PINS: Final = "THE {part} DOES NOT GO DOWN ON ITS PINS: IT IS HELD ASKEW, OR A JOINT READS WRONG"
PIN_IN_NO_HOLE: Final = (
    "PIN {number} FINDS NO HOLE: ITS NOSE OR THE HOLE IS WRONG, OR THE BASE HAS MOVED, OR A JOINT READS WRONG"
)
NOT_IN_HOLDER: Final = (
    "PIN {number} IS NOT IN ITS HOLDER: IT IS MISSING, OR THE HOLDER HAS MOVED, OR A JOINT READS WRONG"
)
NO_BASE: Final = "NO BASE STANDS UNDER PIN {number}, OR IT MOVES WITH THE PIN"
PUMP_ASTRAY: Final = "THE PUMP IS NOT WHERE IT WAS PUT: {how}"
PUMP_CHANGED: Final = (
    "THE PUMP IS NOT WHERE IT WAS PUT: IT HAS MOVED SINCE IT WAS FELT, OR THE CAMERA OR THE LIGHT HAS CHANGED"
)
OR_PUMP: Final = "{what}, OR THE PUMP HAS MOVED, OR A JOINT READS WRONG"
"""Calls to the operator if the hand does not feel a part of the pump at its earlier place. The part or
the pump has moved, or a joint of the arm reads wrong.
"""
SCREW_IN_NO_HOLE: Final = (
    "SCREW {number} FINDS NO HOLE AT {hole}: POINT OR HOLE IS WRONG, OR A JOINT READS WRONG"
)

ONCE: Final = {
    PART_NOT_SEEN: (UNSEEN,),
    FEATURES_NOT_SEEN: (UNSEEN,),
    GASKET_WRONG: (NOT_ON,),
    WRONG_HEIGHT: (TOO_LOW, TOO_HIGH, NOT_FLAT),
    NOTHING_HELD: (NOT_WHERE_SEEN, NOT_LIFTED, NO_DRIVER, NO_TOP),
    SEARCH_EXHAUSTED: (PIN_IN_NO_HOLE, ON_PINS, SCREW_IN_NO_HOLE, NOT_WHERE_SEEN, NO_BASE),
}
"""For each error, the calls to the operator that have the same meaning as the error. Where a program that tries every
step only once, like the program of 1973, ends with the error, the careful program makes one of these calls.
"""

STIFF_ROTOR: Final = "THE ROTOR IS HARD TO TURN, OR A JOINT OF THE ARM IS"
CRANK_ASTRAY: Final = "THE CRANK IS NOT WHERE IT WAS LEFT"
UNSEATED_ROTOR: Final = "THE ROTOR DOES NOT SIT IN ITS BEARING, OR ITS CRANK IS BENT, OR A JOINT READS WRONG"

NO_SCREW: Final = "NO SCREW AT S{number}: IT IS MISSING, OR THE DISPENSER HAS MOVED, OR A JOINT READS WRONG"
LOST_SCREW: Final = (
    "THE BIT FINDS NO SCREW AT S{number}: IT IS LOST, OR THE DISPENSER HAS MOVED, OR A JOINT READS WRONG"
)

MOVED_DISPENSER: Final = ExpectedDetection(
    calls=(NO_SCREW, LOST_SCREW),
    harmless="The bit searches for each screw around the screw's planned place.",
)
MOVED_TOP_STAND: Final = ExpectedDetection(
    calls=(NO_TOP, TOP_LOST, TOP_ASTRAY),
    stages=(PUT_ON_TOP,),
    harmless="The fingers close on the top's hub, so they also grasp a displaced top.",
)
NO_PIN: Final = ExpectedDetection(errors=(NOTHING_HELD,), calls=(NOT_IN_HOLDER,), stages=(INSERT_PINS,))
NO_HOLE_FOR_PIN: Final = ExpectedDetection(
    errors=(SEARCH_EXHAUSTED,), calls=(PIN_IN_NO_HOLE,), stages=(INSERT_PINS,)
)
POOR_LIGHT: Final = ExpectedDetection(
    errors=(PART_NOT_SEEN, FEATURES_NOT_SEEN, PICTURE_WRONG, GASKET_WRONG),
    calls=(UNSEEN, NOT_ON),
    harmless="The camera adjusts itself to the light.",
)
LATE_LIGHT: Final = ExpectedDetection(
    errors=(PICTURE_WRONG, GASKET_WRONG), calls=(NOT_ON, PUMP_CHANGED), harmless=POOR_LIGHT.harmless
)


def names(expected: ExpectedDetection) -> set[int | str]:
    """Return the calls and errors that name a fault. An error is left out if one of the returned calls has the same
    meaning (see `ONCE`).
    """
    told = {number for number in expected.errors if not {*ONCE.get(number, ())} & {*expected.calls}}
    return {*expected.calls, *told}


def misfit_screw(number: int) -> str:
    return f"SCREW {number} STANDS WRONG: ITS LENGTH, ITS POINT OR ITS HOLE IS WRONG"


def loose_screw(number: int) -> str:
    return f"SCREW {number} MEETS NO TORQUE: ITS POINT, ITS THREAD OR THE BIT IS WRONG"


def driven_loose_screw(number: int) -> str:
    return (
        f"SCREW {number} STAYS IN ITS HOLE WITHOUT TORQUE: "
        "ITS POINT, ITS THREAD OR THE BIT IS WRONG, OR NO TOP IS UNDER IT"
    )


def high_screw(number: int) -> str:
    return f"SCREW {number} STOPS HIGH AGAIN AND AGAIN: ITS THREAD IS CROSSED, OR ITS HOLE IS BLOCKED"


def missing_head(number: int) -> str:
    return (
        f"SCREW {number} IS GONE: NO HEAD IS UNDER THE SOCKET, OR THE PUMP HAS MOVED, OR A JOINT READS WRONG"
    )


def unfelt_head(number: int) -> str:
    return (
        f"SCREW {number} IS GONE: NO HEAD IS UNDER THE FINGERS, OR THE PUMP HAS MOVED, OR A JOINT READS WRONG"
    )


def high_head(number: int) -> str:
    return f"SCREW {number} STANDS HIGH: IT IS LOOSE, OR SOMETHING LIES UNDER THE TOP, OR A JOINT READS WRONG"


def untight_screw(number: int) -> str:
    return f"SCREW {number} DOES NOT HOLD, OR IS GONE: IT MEETS NO TORQUE"


def shifted_head(number: int) -> str:
    return f"SCREW {number} DOES NOT STAND AS IT WAS DRIVEN, OR THE PUMP HAS MOVED, OR A JOINT READS WRONG"


def missing_pin(number: int) -> str:
    return f"PIN {number} DOES NOT STAND IN ITS HOLDER, OR A JOINT READS WRONG"


def screw_of(hole: int) -> int:
    """Return the number of the screw that the program drives into a tapped hole. In a pump with seven screws, the
    program leaves hole 7 empty.
    """
    return SCREWED.index(hole) + 1 if hole in SCREWED else hole


def if_used(number: int, expected: ExpectedDetection) -> ExpectedDetection:
    """Return `expected` if the program uses the screw or hole with the number `number`. A pump may have a seventh
    screw and a seventh hole, but the program uses neither of these two. For number 7, no expectation is therefore
    stated: only the referee can notice a fault of this screw or hole.
    """
    return expected if number <= len(SCREWED) else UNKNOWN
