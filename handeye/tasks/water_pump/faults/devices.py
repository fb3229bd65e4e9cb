"""Faults of devices, which begin at the start of a run or with a stage. Each fault is a defect of one or more
signal lines.
"""

from collections.abc import Callable, Iterator, Sequence
from dataclasses import replace
from functools import cache
from typing import Final

from handeye.cell.defects import (
    DEAD,
    PICTURE,
    Defect,
    DriftEffect,
    DropoutEffect,
    Effect,
    GainEffect,
    OffsetEffect,
    PulseEffect,
    SlipEffect,
    Stuck,
)
from handeye.core.errors import (
    CURRENT_WRONG,
    FEATURES_NOT_SEEN,
    FORCE_WRONG,
    GAP_WRONG,
    GASKET_WRONG,
    JOINT_SENSE_WRONG,
    JOINT_STIFF,
    NOTHING_HELD,
    PART_NOT_SEEN,
    PICTURE_WRONG,
    SEARCH_EXHAUSTED,
    SWITCH_WRONG,
    WATCHDOG,
)
from handeye.core.faults import ExpectedDetection, Fault, Size
from handeye.core.units import JIFFY
from handeye.tasks.stanford_cell.arm_variation import JOINT_UNITS
from handeye.tasks.water_pump.faults import shared_expectations as detect
from handeye.tasks.water_pump.faults.declaration import PumpFault, broken, declared

_FINGERS: Final = ("finger_switch.plus_y", "finger_switch.minus_y")
_JUMP: Final = {
    "deg": Size(unit="deg", usual=3.0, limits=(-30.0, 30.0)),
    "in": Size(unit="in", usual=0.5, limits=(-10.0, 10.0)),
}
_DRIFT: Final = {
    "deg": Size(unit="deg/s", usual=0.01, limits=(-1.0, 1.0)),
    "in": Size(unit="in/s", usual=0.003, limits=(-1.0, 1.0)),
}
_SLIP: Final = {
    "deg": Size(unit="deg", usual=0.6, limits=(-5.0, 5.0)),
    "in": Size(unit="in", usual=0.4, limits=(-2.0, 2.0)),
}
SLIP_S: Final = 0.5
_FACTOR: Final = Size(unit="", usual=1.04, limits=(0.1, 5.0))
_PERCENT_LEFT: Final = (0.0, 100.0)

_WITHIN_AGREEMENT: Final = (
    "Even without a fault, the two sensors of a joint may differ by up to 2 % of a long motion. If the factor of a "
    "sensor is wrong, readings near zero are still nearly right."
)
_WITHIN_SEARCHES: Final = "The searches and CENTER find parts in spite of small displacements."
_WITHIN_DRIVES: Final = (
    "The drives overcome the friction, and the error of the felt force stays below the limit of the guard."
)

_WITHIN_WEIGHTS: Final = (
    "Only joints 2 and 3 carry weight, and the arm knows the weight on joint 2 to within 6 %, and on joint 3 to "
    "within 17 %. If the error is present from the start, the arm mistakes the error for a different weight of the "
    "links."
)
_GAIN: Final = Size(unit="", usual=1.3, limits=(0.0, 3.0))

Lines = Sequence[tuple[str, Callable[[float], Effect]]]
"""The signal lines that a fault affects. For each line, a function takes the size of the fault and returns the effect.
"""
DeviceFault = PumpFault[Lines]


@cache
def device_faults() -> tuple[DeviceFault, ...]:
    """Return all faults of devices, in the order of the catalogue."""
    return (*_switches(), *_hand(), *_force(), *_joints(), *_screwdriver(), *_sight())


def defects(faults: Sequence[Fault]) -> tuple[Defect, ...]:
    """Return the defects that the given faults make in the cell's signal lines. Only a fault of a device makes such a
    defect.
    """
    return tuple(
        Defect(line=line, effect=effect(fault.value or 0.0), stage=fault.stage)
        for fault, lines in broken(device_faults(), faults)
        for line, effect in lines
    )


def _fault(
    name: str,
    meaning: str,
    lines: str | Sequence[str],
    effect: Effect | Callable[[float], Effect],
    expected: ExpectedDetection,
    size: Size | None = None,
    stage: int | None = None,
) -> DeviceFault:
    made = effect if callable(effect) else lambda _: effect
    breaks = [(line, made) for line in ((lines,) if isinstance(lines, str) else lines)]
    return declared(name, meaning, breaks, expected, size, stage=stage)


def _switches() -> Iterator[DeviceFault]:
    told = {"closed": "always reports touch", "open": "never reports touch"}
    expected = ExpectedDetection(errors=(SWITCH_WRONG,))
    for state, tells in told.items():
        stuck = Stuck(float(state == "closed"))
        yield _fault(
            f"finger_switch.stuck_{state}", f"The switch of each finger {tells}.", _FINGERS, stuck, expected
        )
        for line in _FINGERS:
            side = "+y" if line.endswith("plus_y") else "-y"
            meaning = f"The switch of the {side} finger {tells}."
            yield _fault(f"{line}.stuck_{state}", meaning, line, stuck, expected)
    yield _fault(
        "finger_switch.swapped", "The switches of the two fingers are swapped.", "switches", Stuck(1.0),
        replace(expected, harmless=(
            "Only CENTER depends on which finger touches, and if both fingers touch at the same moment, the swap "
            "has no effect."
        )),
    )  # fmt: skip
    yield _fault(
        "finger_switch.hard", "The switches of both fingers need this many times their usual force.",
        ("switch_force.plus_y", "switch_force.minus_y"), GainEffect,
        replace(expected, harmless="A switch that needs up to five times its usual force still closes when the "
                                   "fingers press with 10 oz; only CENTER depends on a lighter touch."),
        Size(unit="", usual=10.0, limits=(0.0, 100.0)),
    )  # fmt: skip


def _hand() -> Iterator[DeviceFault]:
    gap, expected = "gap_potentiometer", ExpectedDetection(errors=(GAP_WRONG,))
    yield _fault(f"{gap}.stuck", "The gap reading is frozen.", gap, Stuck(), expected)
    yield _fault(
        f"{gap}.off", "The gap reading is too large by this amount.", gap, OffsetEffect, expected,
        Size(unit="in", usual=0.5, limits=(-4.0, 4.0)),
    )  # fmt: skip
    yield _fault(
        f"{gap}.factor", "The gap reading is the true gap times this factor.", gap, GainEffect,
        replace(expected, harmless=(
            "The switches of the fingers still feel a part. If the gap reading is wrong by less than a tenth, the "
            "fingers hold the part as firmly as with a correct reading."
        )),
        Size(unit="", usual=1.15, limits=(0.1, 5.0)),
    )  # fmt: skip
    expected = ExpectedDetection(errors=(GAP_WRONG, NOTHING_HELD, FORCE_WRONG))
    yield _fault("finger_motor.dead", "The fingers have no force.", "finger_motor", DEAD, expected)
    yield _fault(
        "finger_motor.weak", (
            "The fingers press with only this fraction of their nominal force."
        ), "finger_motor", GainEffect,
        ExpectedDetection(errors=(SWITCH_WRONG, GAP_WRONG, FORCE_WRONG)),
        Size(unit="%", usual=10.0, limits=_PERCENT_LEFT),
    )  # fmt: skip


def _force() -> Iterator[DeviceFault]:
    for axis in "xyz":
        yield _fault(
            f"force.off_zero.{axis}",
            f"The drives have an offset that equals this force at the hand along the {axis} axis of the table. The "
            "program computes the force from the commanded torques, so it feels a force that does not exist.",
            f"force.{axis}", OffsetEffect, ExpectedDetection(errors=(FORCE_WRONG,), at_setup=True),
            Size(unit="N", usual=20.0, limits=(-100.0, 100.0)),
        )  # fmt: skip


def _joints() -> Iterator[DeviceFault]:
    wrong = ExpectedDetection(errors=(JOINT_SENSE_WRONG,), at_setup=True)
    for number, unit in enumerate(JOINT_UNITS, 1):
        pot, tachometer, drive = f"potentiometer.{number}", f"tachometer.{number}", f"drive.{number}"
        joint = f"of joint {number}"
        yield _fault(f"{pot}.stuck", f"The position reading {joint} is frozen.", pot, Stuck(), wrong)
        yield _fault(
            f"{pot}.jump", f"The position reading {joint} is too large by this amount.", pot, OffsetEffect,
            replace(wrong, errors=(JOINT_SENSE_WRONG, FORCE_WRONG), calls=(detect.JOINT_OR_PLACE,)), _JUMP[unit],
        )  # fmt: skip
        yield _fault(
            f"{pot}.drift", f"The position reading {joint} drifts by this amount per second.", pot, DriftEffect,
            wrong, _DRIFT[unit],
        )  # fmt: skip
        yield _fault(
            f"{pot}.factor", f"The position reading {joint} is the true position times this factor.", pot, GainEffect,
            replace(wrong, harmless=_WITHIN_AGREEMENT), _FACTOR,
        )  # fmt: skip
        yield _fault(
            f"{tachometer}.factor", f"The rate reading {joint} is the true rate times this "
            "factor.", tachometer, GainEffect,
            replace(wrong, harmless=_WITHIN_AGREEMENT), replace(_FACTOR, usual=1.3),
        )  # fmt: skip
        yield declared(
            f"gear.{number}.slips",
            f"The gear {joint} slips by this amount within {SLIP_S:g} s; neither sensor of the joint shows the "
            "slip.",
            ((pot, _slipped), (tachometer, _slipping)),
            ExpectedDetection(
                calls=(detect.JOINT_OR_PLACE,), harmless=_WITHIN_SEARCHES
            ), _SLIP[unit], stage=8,
        )  # fmt: skip
        yield _fault(
            f"joint.{number}.stiff", f"The friction {joint} is this many times its earlier "
            "value.", f"friction.{number}",
            GainEffect, ExpectedDetection(errors=(JOINT_STIFF,), at_setup=True, harmless=_WITHIN_DRIVES),
            Size(unit="", usual=5.0, limits=(0.0, 20.0)), stage=3,
        )  # fmt: skip
        yield _fault(f"{tachometer}.dead", f"The rate reading {joint} is zero.", tachometer, DEAD, wrong)
        yield _fault(
            f"{drive}.weak", f"The drive {joint} gives this fraction of the commanded torque.", drive, GainEffect,
            ExpectedDetection(errors=(FORCE_WRONG, JOINT_STIFF), at_setup=True),
            Size(unit="%", usual=50.0, limits=_PERCENT_LEFT),
        )  # fmt: skip
        yield _fault(
            f"{drive}.factor", f"The drive {joint} gives the commanded torque times this factor.", drive, GainEffect,
            ExpectedDetection(
                errors=(FORCE_WRONG, JOINT_STIFF), at_setup=True, harmless=_WITHIN_WEIGHTS,
            ),
            _GAIN, stage=4,
        )  # fmt: skip
        yield _fault(
            f"brake.{number}.slips",
            f"The brake {joint} holds only this fraction of its torque.", f"brake.{number}", GainEffect,
            replace(wrong, harmless=(
                "The arm depends on its brakes only while a picture is taken, and the potentiometers show how far "
                "the arm has sunk."
            )),
            Size(unit="%", usual=10.0, limits=_PERCENT_LEFT),
        )  # fmt: skip
    yield _fault(
        "drives.factor", "All drives give the commanded torque times this factor.",
        [f"drive.{number}" for number in range(1, len(JOINT_UNITS) + 1)], GainEffect,
        ExpectedDetection(errors=(FORCE_WRONG, JOINT_STIFF), at_setup=True, harmless=_WITHIN_WEIGHTS), _GAIN, stage=4,
    )  # fmt: skip
    yield _fault(
        "servo.late", "The computer is late: the drives get no torque for this number of servo periods.", "servo",
        lambda periods: DropoutEffect(periods * JIFFY), ExpectedDetection(errors=(WATCHDOG,)),
        Size(unit="", usual=60.0, limits=(1.0, 36000.0)), stage=3,
    )  # fmt: skip


def _slipped(way: float) -> Effect:
    return SlipEffect(-way, SLIP_S)


def _slipping(way: float) -> Effect:
    return PulseEffect(-way / SLIP_S, SLIP_S)


def _screwdriver() -> Iterator[DeviceFault]:
    current, motor = "screwdriver.current", "screwdriver.motor"
    yield _fault(
        f"{current}.dead", "The current of the screwdriver's motor reads zero, and so does the torque computed from "
        "it.", current, DEAD,
        ExpectedDetection(errors=(CURRENT_WRONG,)),
    )  # fmt: skip
    within = (
        "The noise of the current hides a factor up to 1.1 when a screw seats, and a factor down to .7 when the "
        "motor starts."
    )
    yield _fault(
        f"{current}.factor", "The current of the screwdriver's motor shows the true torque times this "
        "factor.", current,
        GainEffect,
        ExpectedDetection(errors=(CURRENT_WRONG,), harmless=within), Size(unit="", usual=0.5, limits=(0.0, 10.0)),
    )  # fmt: skip
    yield _fault(
        f"{motor}.slow", "The screwdriver's motor turns at the commanded speed times this factor.", motor, GainEffect,
        ExpectedDetection(
            errors=(CURRENT_WRONG,), calls=(detect.loose_screw(1), detect.loose_screw(3)),
            harmless="A screw that turns more slowly seats equally well. Half the usual speed is noticed, because "
            "the motor reaches this lower speed too soon.",
        ),
        Size(unit="", usual=0.4, limits=(0.0, 2.0)),
    )  # fmt: skip
    yield _fault(
        f"{motor}.dead", "The screwdriver's motor never turns.", motor, DEAD,
        ExpectedDetection(errors=(CURRENT_WRONG,), calls=(detect.loose_screw(1),)),
    )  # fmt: skip
    yield _fault(
        "magnet.weak", (
            "The bit's magnet, which holds a screw, has only this fraction of its nominal force."
        ), "magnet", GainEffect,
        ExpectedDetection(
            calls=(
                "SCREW {number} IS NOT ON THE BIT",
                "SCREW {number} IS NOT ON THE BIT: IT IS LOST, OR LOOSE IN ITS HOLE",
                detect.NO_SCREW,  # the screw is fetched once more, and may have moved by then
            ),
            harmless="A screw weighs .06 N, a hundredth of the magnet's usual force. A weak magnet that can still "
            "carry a screw also holds the screw straight.",
        ),
        Size(unit="%", usual=1.0, limits=_PERCENT_LEFT),
    )  # fmt: skip


def _sight() -> Iterator[DeviceFault]:
    yield _fault(
        "lamp.dead", "The lamp on the hand stays dark.", "lamp", DEAD, ExpectedDetection(at_setup=True)
    )
    wrong = ExpectedDetection(errors=(PICTURE_WRONG,), at_setup=True)
    yield _fault(
        "picture.frozen",
        "Every picture repeats the first picture that was taken after the fault began.",
        PICTURE,
        Stuck(),
        wrong,
    )
    yield _fault("picture.dark", "Every picture is black.", PICTURE, DEAD, wrong)
    yield _fault(
        "camera.bumped",
        "The camera has been bumped: relative to its mounting direction, it is turned by this angle to the "
        "side, and by the same angle downwards.",
        ("camera.pan", "camera.tilt"), OffsetEffect,
        ExpectedDetection(
            errors=(PART_NOT_SEEN, FEATURES_NOT_SEEN, SEARCH_EXHAUSTED, NOTHING_HELD, GASKET_WRONG),
            calls=(detect.UNSEEN, detect.NOT_WHERE_SEEN, detect.NOT_ON),
            harmless="The hand searches for the base around the place where the camera saw it.",
        ),
        Size(unit="deg", usual=1.0, limits=(-20.0, 20.0)), stage=1,
    )  # fmt: skip
    yield _fault(
        "turret.stuck", "The lens turret stays at the first lens chosen after the fault began.", "turret", Stuck(),
        ExpectedDetection(errors=(PART_NOT_SEEN, FEATURES_NOT_SEEN, PICTURE_WRONG), calls=(detect.UNSEEN,)), stage=1,
    )  # fmt: skip
