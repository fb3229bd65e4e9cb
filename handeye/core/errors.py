"""Exceptions for callers, and the numbered errors that a script can test.

A wrong script is a `Diagnostic`, collected and never raised. A world that does not cooperate is an error
*number*, tested by SKIPE and SKIPN. The exceptions here are for a caller who misuses the interface or hands
over an unusable file, and for a run that broke down; each carries one clear sentence for the user:

    HandeyeError
    ├── InvalidInput              what was given cannot be used
    │   ├── BadArgument           an argument, an option or a typed command
    │   │   └── NoSuchName        nothing is called that; the sentence says what there is
    │   ├── BadFile               missing, unreadable, damaged, or of another version, plan or run
    │   ├── CannotWrite           a file or a folder
    │   │   ├── Taken             one of its kind is there, and may not be replaced
    │   │   └── HoldsRun          a folder that holds a run (runs.folder)
    │   ├── Refused               understood, but this machine, system or state does not do it
    │   │   └── MissingExtra      a package of an extra is not installed
    │   └── ScriptError           a script has errors: the diagnostics are with it (api)
    ├── PhysicsFailed             the simulation of a work cell broke down
    ├── CalibrationFailed         the camera could not be calibrated
    └── FrictionUnknown           the friction of the joints could not be measured

A system or a sweep may have its own beneath these. The command line ends with exit code 2 on whichever reaches it.
"""

from typing import Final


class HandeyeError(Exception):
    """Base of every exception a caller may want to catch; `str(error)` is a sentence for the user."""


class InvalidInput(HandeyeError):
    """A file or argument is unusable, or its request cannot be executed."""


class BadArgument(InvalidInput):
    """An argument, an option or a typed command cannot be used."""


class NoSuchName(BadArgument):
    """Nothing is called that."""


class BadFile(InvalidInput):
    """A file is missing, cannot be read, is damaged, or is of another version, plan or run."""


class CannotWrite(InvalidInput):
    """A file or folder cannot be written, or has contents that must not be replaced."""


class Taken(CannotWrite):
    """The folder or file exists already and may not be replaced."""


class Refused(InvalidInput):
    """A valid request that this machine, system or state cannot execute."""


class PhysicsFailed(HandeyeError):
    """The simulation of a work cell broke down; not an event of its work."""


class CalibrationFailed(HandeyeError):
    """The camera could not be calibrated: the lamp was not seen often enough."""


class FrictionUnknown(HandeyeError):
    """The arm did not move as it must for its friction to be measured, or has links of a weight that cannot be."""


JOINT_LIMIT: Final = 1
NOTHING_HELD: Final = 2
NO_SOLUTION: Final = 3
SERVO_LAG: Final = 4
WATCHDOG: Final = 5
SEARCH_EXHAUSTED: Final = 6
WRONG_THICKNESS: Final = 7
WRONG_TRAVEL: Final = 8
WRONG_HEIGHT: Final = 9
NO_FORCE: Final = 23
NO_TORQUE: Final = 24
NO_TOUCH: Final = 25
PART_NOT_SEEN: Final = 30
FEATURES_NOT_SEEN: Final = 31
GASKET_WRONG: Final = 32
PART_ASTRAY: Final = 33
SWITCH_WRONG: Final = 50
GAP_WRONG: Final = 51
FORCE_WRONG: Final = 52
JOINT_SENSE_WRONG: Final = 53
CURRENT_WRONG: Final = 54
PICTURE_WRONG: Final = 55
JOINT_STIFF: Final = 57

ERRORS: Final[dict[int, str]] = {
    JOINT_LIMIT: "a joint would move beyond its limit",
    NOTHING_HELD: "the fingers closed beyond the minimum gap: there is nothing between them, or something too thin",
    NO_SOLUTION: "the position is out of the arm's reach",
    SERVO_LAG: "the arm did not follow its set-points: something is in the way, or a joint is stiff, weak or late",
    WATCHDOG: "the computer missed a servo period: drives cut, brakes set",
    SEARCH_EXHAUSTED: "the search has tried all its places",
    WRONG_THICKNESS: "the object between the fingers is thicker than the maximum",
    WRONG_TRAVEL: "the last CHANGE, PLACE or CENTER moved too far, or not far enough",
    WRONG_HEIGHT: "the hand stopped at a wrong height above the place of a SAVE",
    NO_FORCE: "the motion ended without meeting the force of its STOP",
    NO_TORQUE: "the motion ended without meeting the torque of its TORQUE",
    NO_TOUCH: "the motion ended without a finger touching anything",
    PART_NOT_SEEN: "the part is not seen in the picture",
    FEATURES_NOT_SEEN: "the holes of the part are not found in the picture",
    GASKET_WRONG: "the gasket is not in place",
    PART_ASTRAY: "the part has moved since the earlier picture",
    SWITCH_WRONG: "a finger switch does not show what its finger touches, or the fingers press too weakly",
    GAP_WRONG: "the gap is not the commanded one: its potentiometer fails, something holds or forces the fingers, or "
    "the held part has slipped",
    FORCE_WRONG: "the hand feels a force in free air: something touches it, the load differs from the declared one, "
    "or the force sense or a drive fails",
    JOINT_SENSE_WRONG: "the potentiometer and the tachometer of a joint disagree: one of them fails",
    CURRENT_WRONG: "the current of the screwdriver's motor does not fit its torque and speed",
    PICTURE_WRONG: "the camera gives a picture that is not live, or too noisy",
    JOINT_STIFF: "one joint alone does not follow its drive: its drive, brake or friction has changed",
}
"""Error numbers a script can test, with the operator's message. 2 and 23 are from the period; from 50 on, a
sensor is faulty."""


class MissingExtra(Refused):
    """A package of an extra is not installed."""

    def __init__(self, command: str, package: str, extra: str) -> None:
        super().__init__(
            f"`{command}` needs {package}, which is not installed: `pip install {package}` installs it, and so does "
            f"the extra `{extra}` of handeye"
        )
