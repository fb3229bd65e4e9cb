"""Faults of the devices of the pump's cell: what is broken on which line, and what that line then carries."""

from collections.abc import Callable, Iterator, Sequence
from dataclasses import dataclass
from functools import cache
from typing import Final

from handeye.cell.defects import DEAD, PICTURE, Defect, Drifting, Effect, Missing, Scaled, Shifted, Stuck
from handeye.core.faults import Fault, FaultKind, Size
from handeye.core.units import JIFFY
from handeye.tasks.water_pump.world.variation import JOINT_UNITS

_FINGERS: Final = ("finger_switch.plus_y", "finger_switch.minus_y")
_JUMP: Final = {
    "deg": Size(unit="deg", usual=3.0, limits=(-30.0, 30.0)),
    "in": Size(unit="in", usual=0.5, limits=(-10.0, 10.0)),
}
_DRIFT: Final = {
    "deg": Size(unit="deg/s", usual=0.01, limits=(-1.0, 1.0)),
    "in": Size(unit="in/s", usual=0.003, limits=(-1.0, 1.0)),
}
_LEFT: Final = (0.0, 100.0)
"""%: what is left of something that is weak."""


@dataclass(frozen=True, slots=True, kw_only=True)
class DeviceFault:
    """A fault of a device."""

    kind: FaultKind
    lines: Sequence[str]
    """The lines that it breaks."""
    effect: Callable[[float], Effect]
    """What it does to them, by its value."""

    def defects(self, fault: Fault) -> Iterator[Defect]:
        """What is broken of the cell's lines."""
        for line in self.lines:
            yield Defect(line=line, effect=self.effect(fault.value or 0.0), stage=fault.stage)


@cache
def device_faults() -> tuple[DeviceFault, ...]:
    """All of them, in the order they are listed."""
    return (*_switches(), *_hand(), *_force(), *_joints(), *_servo(), *_screwdriver(), *_sight())


def defects(faults: Sequence[Fault]) -> tuple[Defect, ...]:
    """What faults break of the lines of the cell; other faults break none."""
    known = {fault.kind.name: fault for fault in device_faults()}
    return tuple(
        defect for fault in faults if fault.name in known for defect in known[fault.name].defects(fault)
    )


def _fault(
    name: str,
    meaning: str,
    lines: str | Sequence[str],
    effect: Effect | Callable[[float], Effect],
    size: Size | None = None,
    stage: int | None = None,
) -> DeviceFault:
    made = effect if callable(effect) else lambda _: effect
    kind = FaultKind(name=name, meaning=meaning, size=size, usual_stage=stage)
    return DeviceFault(kind=kind, lines=(lines,) if isinstance(lines, str) else lines, effect=made)


def _switches() -> Iterator[DeviceFault]:
    told = {"closed": "tells of touch, whatever it meets", "open": "never tells of touch"}
    for state, tells in told.items():
        stuck = Stuck(float(state == "closed"))
        yield _fault(f"finger_switch.stuck_{state}", f"The switch of either finger {tells}.", _FINGERS, stuck)
        for line in _FINGERS:
            side = "+y" if line.endswith("plus_y") else "-y"
            yield _fault(f"{line}.stuck_{state}", f"The switch of the {side} finger {tells}.", line, stuck)


def _hand() -> Iterator[DeviceFault]:
    gap = "gap_potentiometer"
    yield _fault(f"{gap}.stuck", "The gap reads what it read when this set in.", gap, Stuck())
    yield _fault(
        f"{gap}.off",
        "The gap reads so much more than it is.",
        gap,
        Shifted,
        Size(unit="in", usual=0.5, limits=(-4.0, 4.0)),
    )
    yield _fault("finger_motor.dead", "The fingers press with nothing.", "finger_motor", DEAD)
    yield _fault(
        "finger_motor.weak", "So much is left of the force with which the fingers press.", "finger_motor", Scaled,
        Size(unit="%", usual=10.0, limits=_LEFT),
    )  # fmt: skip


def _force() -> Iterator[DeviceFault]:
    for axis in "xyz":
        yield _fault(
            f"force.off_zero.{axis}",
            f"The drives are off zero by what a force at the hand, along table {axis}, is to them: the arm bears a "
            "force that is not there, and the program, which reckons the force from the torques it put out, feels it.",
            f"force.{axis}", Shifted, Size(unit="N", usual=20.0, limits=(-100.0, 100.0)),
        )  # fmt: skip


def _joints() -> Iterator[DeviceFault]:
    for number, unit in enumerate(JOINT_UNITS, 1):
        pot, tachometer, drive = f"potentiometer.{number}", f"tachometer.{number}", f"drive.{number}"
        joint = f"of joint {number}"
        yield _fault(
            f"{pot}.stuck", f"The position {joint} reads what it read when this set in.", pot, Stuck()
        )
        yield _fault(
            f"{pot}.jump", f"The position {joint} reads so much more than it is.", pot, Shifted, _JUMP[unit]
        )
        yield _fault(
            f"{pot}.drift", f"The position {joint} reads more and more: so much more each second.", pot, Drifting,
            _DRIFT[unit],
        )  # fmt: skip
        yield _fault(f"{tachometer}.dead", f"The rate {joint} reads zero.", tachometer, DEAD)
        yield _fault(
            f"{drive}.weak", f"So much is left of the torque that the drive {joint} is told.", drive, Scaled,
            Size(unit="%", usual=50.0, limits=_LEFT),
        )  # fmt: skip
        yield _fault(
            f"brake.{number}.slips", f"So much is left of what the brake {joint} holds.", f"brake.{number}", Scaled,
            Size(unit="%", usual=10.0, limits=_LEFT),
        )  # fmt: skip


def _servo() -> Iterator[DeviceFault]:
    yield _fault(
        "servo.late", "The computer is late: no torque arrives at the drives for so many servo periods.", "servo",
        lambda periods: Missing(periods * JIFFY), Size(unit="", usual=60.0, limits=(1.0, 36000.0)), stage=3,
    )  # fmt: skip


def _screwdriver() -> Iterator[DeviceFault]:
    current, motor = "screwdriver.current", "screwdriver.motor"
    yield _fault(
        f"{current}.dead",
        "The current of the screwdriver's motor reads zero, and so does its torque.",
        current,
        DEAD,
    )
    yield _fault(f"{motor}.dead", "The screwdriver's motor never turns.", motor, DEAD)
    yield _fault(
        "magnet.weak", "So much is left of the force of the bit's magnet, which holds a screw.", "magnet", Scaled,
        Size(unit="%", usual=1.0, limits=_LEFT),
    )  # fmt: skip


def _sight() -> Iterator[DeviceFault]:
    yield _fault("lamp.dead", "The lamp on the hand stays dark.", "lamp", DEAD)
    yield _fault("picture.frozen", "Every picture is the first one after this set in.", PICTURE, Stuck())
    yield _fault("picture.dark", "Every picture is black.", PICTURE, DEAD)
    yield _fault(
        "camera.bumped", "The camera has been bumped: it looks so far aside and down of where its mount is told.",
        ("camera.pan", "camera.tilt"), Shifted, Size(unit="deg", usual=1.0, limits=(-20.0, 20.0)), stage=1,
    )  # fmt: skip
    yield _fault(
        "turret.stuck",
        "The lens stays that was turned to first after this set in.",
        "turret",
        Stuck(),
        stage=1,
    )
