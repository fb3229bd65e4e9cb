"""Exceptions for callers, and the numbered errors that a script can test.

A mistake in a script is a `Diagnostic`, which is collected and not raised. A failure in the cell, such as an empty
hand, is an error *number*, which SKIPE and SKIPN test. The exceptions of this module are for a caller who misuses the
interface or gives an unusable file, and for a run that broke down. Each exception carries one clear sentence for the
user:

    HandeyeError
    ├── InvalidInput              an argument, file or request cannot be used
    │   ├── BadArgument           an argument, an option or a typed command
    │   │   └── NoSuchName        an unknown name; the sentence gives the known ones
    │   ├── BadFile               missing, unreadable, damaged, or of another version, plan or run
    │   ├── CannotWrite           a file or a folder
    │   │   ├── Taken             a file or folder of this kind exists and may not be replaced
    │   │   └── HoldsRun          the folder holds a run (runs.folder)
    │   ├── Refused               a valid request that this machine, system or state cannot execute
    │   │   └── MissingExtra      a package of an extra is not installed
    │   └── ScriptError           a script has errors; its diagnostics are attached (api)
    ├── PhysicsFailed             the simulation of a work cell broke down
    ├── CalibrationFailed         the camera could not be calibrated
    └── FrictionUnknown           the friction of the joints could not be measured

A system or a sweep may define subclasses of these exceptions. If any of these exceptions is raised, the command line
ends with exit code 2.
"""

from typing import Final


class HandeyeError(Exception):
    """Base class of all exceptions that a caller may want to catch; `str(error)` is a sentence for the user."""


class InvalidInput(HandeyeError):
    """Raised when an argument or file cannot be used, or when a request cannot be executed."""


class BadArgument(InvalidInput):
    """Raised when an argument, an option or a typed command cannot be used."""


class NoSuchName(BadArgument):
    """Raised when there is no object with the given name."""


class BadFile(InvalidInput):
    """Raised when a file is missing, cannot be read, is damaged, or belongs to another version, plan or run."""


class CannotWrite(InvalidInput):
    """Raised when a file or folder cannot be written, or when its contents must not be replaced."""


class Taken(CannotWrite):
    """Raised when the folder or file already exists and may not be replaced."""


class Refused(InvalidInput):
    """Raised for a valid request that this machine or system cannot execute, or cannot execute in its present state."""


class PhysicsFailed(HandeyeError):
    """Raised when the simulation of a work cell breaks down. This is a defect of the simulation, not an error in
    the assembly.
    """


class CalibrationFailed(HandeyeError):
    """Raised when the camera cannot be calibrated because it did not see the lamp often enough."""


class FrictionUnknown(HandeyeError):
    """Raised when the friction of the arm's joints cannot be measured, because the arm did not move as required or
    because the weights of its links are unknown.
    """


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
    NOTHING_HELD: "the fingers closed beyond the minimum gap: there is nothing between them, or the object is too thin",
    NO_SOLUTION: "the position is out of the arm's reach",
    SERVO_LAG: "the arm did not follow its set-points: something is in the way, or a joint is stiff, weak or slow to "
    "respond",
    WATCHDOG: "the computer missed a servo period; the drives were switched off, and the brakes set",
    SEARCH_EXHAUSTED: "the search has tried all its places",
    WRONG_THICKNESS: "the object between the fingers is thicker than the maximum",
    WRONG_TRAVEL: "the last CHANGE, PLACE or CENTER moved the hand too far or not far enough",
    WRONG_HEIGHT: "the hand stopped at a wrong height above the place of a SAVE",
    NO_FORCE: "the motion ended without meeting the force of its STOP",
    NO_TORQUE: "the motion ended without meeting the torque of its TORQUE",
    NO_TOUCH: "the motion ended without a finger touching anything",
    PART_NOT_SEEN: "the part is not seen in the picture",
    FEATURES_NOT_SEEN: "the holes of the part are not found in the picture",
    GASKET_WRONG: "the gasket is not in place",
    PART_ASTRAY: "the part has moved since the earlier picture",
    SWITCH_WRONG: "the fingers press too weakly, or a finger switch does not show whether its finger touches anything",
    GAP_WRONG: (
        "the finger gap differs from the commanded gap: the potentiometer of the fingers fails, something holds or "
        "forces the fingers, or the held part has slipped"
    ),
    FORCE_WRONG: (
        "the hand feels a force in free air: something touches the hand, the load differs from the declared load, "
        "or the force sense or a drive fails"
    ),
    JOINT_SENSE_WRONG: "the potentiometer and the tachometer of a joint disagree: one of them fails",
    CURRENT_WRONG: "the current of the screwdriver's motor does not fit its torque and speed",
    PICTURE_WRONG: "the camera's picture is not live, or is too noisy",
    JOINT_STIFF: (
        "one joint alone does not follow its drive: the drive, the brake or the friction of this joint has changed"
    ),
}
"""Error numbers that a script can test, with the message to the operator. Numbers 2 and 23 are from 1973; numbers
from 50 on usually mean a faulty sensor or drive.
"""


class MissingExtra(Refused):
    """Raised when a package of one of handeye's extras is not installed."""

    def __init__(self, command: str, package: str, extra: str) -> None:
        super().__init__(
            f"`{command}` needs {package}, which is not installed: `pip install {package}` installs it, and so does "
            f"the extra `{extra}` of handeye"
        )
