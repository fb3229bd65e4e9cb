"""By which error each fault of the pump's world should be noticed, or why it may do no harm."""

from typing import Final

from handeye.errors import (
    CURRENT_WRONG,
    FEATURES_NOT_SEEN,
    FORCE_WRONG,
    GAP_WRONG,
    JOINT_SENSE_WRONG,
    NO_FORCE,
    NO_TORQUE,
    NOTHING_HELD,
    PART_NOT_SEEN,
    PICTURE_WRONG,
    SEARCH_EXHAUSTED,
    SERVO_LAG,
    SWITCH_WRONG,
    WRONG_THICKNESS,
    WRONG_TRAVEL,
)
from handeye.faults import UNKNOWN, Expected

EXPECTED: Final[dict[str, Expected]] = {
    "finger_switch": Expected(errors=(SWITCH_WRONG,)),
    "gap_potentiometer": Expected(errors=(GAP_WRONG,)),
    "finger_motor": Expected(errors=(GAP_WRONG, NOTHING_HELD)),
    "force": Expected(errors=(FORCE_WRONG,), at_setup=True),
    "potentiometer": Expected(errors=(JOINT_SENSE_WRONG,), at_setup=True),
    "tachometer": Expected(errors=(JOINT_SENSE_WRONG,), at_setup=True),
    "drive": Expected(errors=(FORCE_WRONG, SERVO_LAG), at_setup=True),
    "brake": Expected(
        harmless="The brakes hold for as long as a picture takes, and the potentiometers tell where the arm sank."
    ),
    "screwdriver.current": Expected(errors=(CURRENT_WRONG,)),
    "screwdriver.motor": Expected(errors=(CURRENT_WRONG, NO_TORQUE)),
    "screwdriver.missing": Expected(errors=(NOTHING_HELD,)),
    "magnet": Expected(errors=(NO_TORQUE,)),
    "bit": Expected(errors=(NO_TORQUE,)),
    "lamp": Expected(at_setup=True),
    "picture": Expected(errors=(PICTURE_WRONG,), at_setup=True),
    "base.missing": Expected(errors=(PART_NOT_SEEN,)),
    "base.turned": Expected(
        errors=(PART_NOT_SEEN, FEATURES_NOT_SEEN),
        harmless="The job is for a base that lies anyhow within the arm's reach.",
    ),
    "base.reversed": Expected(errors=(FEATURES_NOT_SEEN,)),
    "gasket.missing": Expected(errors=(NOTHING_HELD,)),
    "gasket.doubled": Expected(errors=(WRONG_THICKNESS, WRONG_TRAVEL)),
    "gasket.thick": Expected(errors=(WRONG_THICKNESS, WRONG_TRAVEL)),
    "gasket.reversed": Expected(errors=(NO_FORCE,)),
    "top.missing": Expected(errors=(NOTHING_HELD,)),
    "pin.1.missing": Expected(errors=(NOTHING_HELD,)),
    "pin.2.missing": Expected(errors=(NOTHING_HELD,)),
    "pin.1.thick": Expected(errors=(SEARCH_EXHAUSTED,)),
    "pin.2.thick": Expected(errors=(SEARCH_EXHAUSTED,)),
    "rotor": Expected(calls=("THE ROTOR IS HARD TO TURN",)),
    "thread": Expected(
        harmless="A screw that comes in straight goes home in a scarred thread, too; the referee cautions."
    ),
}
"""By the names of faults and of groups of them; what stands under a longer name counts."""


def expected(name: str) -> Expected:
    """How a run with a fault of a name should end."""
    known = [group for group in EXPECTED if f"{name}.".startswith(f"{group}.")]
    return EXPECTED[max(known, key=len)] if known else UNKNOWN
