"""The safety study: arm 1 runs into the stationary hand of arm 2, with the reflex and without it."""

from collections.abc import Mapping
from typing import Final

import numpy as np

from handeye.core.errors import BadArgument
from handeye.core.pose import Array
from handeye.core.record import Record
from handeye.ports.microbus import Status
from handeye.systems.sigma.bus.events import AnyBusEvent, StatusLines
from handeye.systems.sigma.bus.faults import defect
from handeye.systems.sigma.bus.wired import WiredBus
from handeye.systems.sigma.gantries.machine import Gantries, scene
from handeye.systems.sigma.gantries.world import GantryWorld
from handeye.systems.sigma.mal.compiler import program_of
from handeye.systems.sigma.mal.virtual_machine import VirtualMachine
from handeye.systems.sigma.protocol import AXES, NUMBERS, STEP_MM

ARMS: Final = ("X1", "X2")  # the axes that meet
GOAL: Final = 200.0  # mm: place to which X1 is sent
STANDS: Final = 400.0  # mm: place of X2; the hands meet at X1 = 160
SLOWEST, FASTEST = 2.0, 254.0  # mm/s: limits of a constant speed
_LONGEST: Final = 120_000_000  # microseconds
_REST: Final = 300_000  # microseconds until everything is at rest
LOWERED: Final = 100.0  # mm: the fingers of the other arm are then at the height of this arm's column
_PROGRAM: Final = """10 REM ARM 1 RUNS INTO ARM 2, WHICH STANDS
20 ORIGIN X1, X2
30 MOVE X2 TO {stands:g}
40 MOVE X1 TO {goal:g}{slow}
50 PRINT "ARRIVED AT", POS(X1)
"""
_LOWER: Final = "22 ORIGIN Z{arm}\n24 MOVE Z{arm} TO {lowered:g}\n"
_LAST: Final = 60
_ORIGIN: Final = f"{_LAST} ORIGIN X1, X2\n"


class CrashedAxis(Record, frozen=True, kw_only=True):
    """An axis after the collision. Positions are in mm."""

    axis: str
    force: float  # N: greatest force on the wrist
    status: str  # status lines A and B when the motor stopped
    believed: float  # place according to the count of the program
    counted: float  # place according to the count of the microcomputer
    true: float
    lost: int  # steps by which the microcomputer's count is wrong
    doubted: bool  # True: the interpreter marked the count as doubtful


class Crash(Record, frozen=True, kw_only=True):
    """The result of a collision."""

    speed: float | None  # mm/s; None: the profile of a fast move
    reflex: bool
    endless_loop: bool
    axes: tuple[CrashedAxis, ...]
    message: str  # what the program reports
    lower: int = 0  # arm whose hand is lower than the other's; 0: the hands meet
    origin: str = ""  # what ORIGIN reports after the program has ended; empty: ORIGIN was not executed


def program_text(speed: float | None, lower: int = 0) -> str:
    """Return the program of the study. If the hand of one arm is lower than the other hand, the program ends with an
    ORIGIN of both arms.
    """
    slow = "" if speed is None else f" SLOW {speed:g}"
    text = _PROGRAM.format(stands=STANDS, goal=GOAL, slow=slow)
    return text + _LOWER.format(arm=lower, lowered=LOWERED) + _ORIGIN if lower else text


def crash(speed: float | None, *, reflex: bool, endless_loop: bool = False, lower: int = 0) -> Crash:
    """Simulate the collision.

    Args:
        speed: speed of arm 1 (mm/s), or None for the greatest speed that a motor reaches over the distance.
        reflex: True if the wires from the wrists to the motors are connected.
        endless_loop: True if the central computer hangs after it has sent the move, and reads no status.
        lower: the arm whose hand is lower than the other hand. The column of this arm, above its wrist, then meets the
            hand of the other arm. If 0, the hands meet.
    """
    if speed is not None and not SLOWEST <= speed <= FASTEST:
        raise BadArgument(f"a constant speed must be between {SLOWEST:g} and {FASTEST:g} mm/s, not {speed:g}")
    world = GantryWorld()
    gantries = Gantries(scene(world), world)
    bus = WiredBus(plant=gantries, defects=[] if reflex else [defect("no-reflex")])
    greatest = np.zeros(len(AXES))

    def look() -> None:
        np.maximum(greatest, np.abs(gantries.felt), out=greatest)

    stops: dict[int, Status] = {}

    def hear(event: AnyBusEvent) -> None:
        if isinstance(event, StatusLines) and Status(event.status).aborted:
            stops[event.number] = Status(event.status)

    gantries.bench.after_step.append(look)
    bus.tell.append(hear)
    vm = VirtualMachine(program_of("crash.mal", program_text(speed, lower)), bus)
    vm.begin()
    while vm.turn and not (endless_loop and _sent(vm)) and not _arrived(vm):
        vm.statement()
        if not (endless_loop and _sent(vm)):
            vm.settle()
    _pass(bus)
    if endless_loop:
        message = "nothing, because the central computer hangs; its count assumes that the last command was executed"
    else:
        message = vm.memory.fault.told if vm.memory.fault else f"ARRIVED AT {GOAL:g}"
    axes = tuple(_after(axis, vm, bus, gantries, greatest, stops) for axis in ARMS)
    origin = ""
    if vm.turn and _arrived(vm):
        vm.statement()
        vm.settle()
        origin = vm.memory.fault.told if vm.memory.fault else "no step was lost"
    return Crash(
        speed=speed,
        reflex=reflex,
        endless_loop=endless_loop,
        axes=axes,
        message=message,
        lower=lower,
        origin=origin,
    )


def _arrived(vm: VirtualMachine) -> bool:
    """Return True if only the last ORIGIN remains to be executed."""
    return vm.program.line_of(vm.memory.tasks[vm.turn].pc).number == _LAST


def _sent(vm: VirtualMachine) -> bool:
    """Return True if the move of the study has been sent."""
    return vm.memory.counts.get("X1") == round(GOAL / STEP_MM)


def _pass(bus: WiredBus) -> None:
    for axis in ARMS:
        bus.wait_free(NUMBERS[axis], _LONGEST)
    end = bus.now + _REST
    while bus.now < end:
        bus.wait(end)


def _after(
    axis: str,
    vm: VirtualMachine,
    bus: WiredBus,
    gantries: Gantries,
    greatest: Array,
    stops: Mapping[int, Status],
) -> CrashedAxis:
    number, index = NUMBERS[axis], AXES.index(axis)
    count = bus.motor(number).count(bus.now * 1_000_000)
    true = float(gantries.places[index])
    status = stops.get(number, Status.FREE)
    return CrashedAxis(
        axis=axis,
        force=round(float(greatest[index]), 1),
        status=f"{status >> 1}-{status & 1}",
        believed=round(vm.memory.counts[axis] * STEP_MM, 2),
        counted=round(count * STEP_MM, 2),
        true=round(true * STEP_MM, 2),
        lost=round(count - true),
        doubted=axis in vm.memory.doubtful,
    )


def lines(found: Crash) -> list[str]:
    """Describe the result of a collision in sentences and a table."""
    speed = "full speed" if found.speed is None else f"{found.speed:g} mm/s"
    loop = ", with the central computer in an endless loop" if found.endless_loop else ""
    rows = [
        f"  {a.axis}  {a.force:5.1f} N{a.status:>8}{a.believed:14.2f} mm{a.true:10.2f} mm{a.lost:8d}"
        f"{'  doubted' if a.doubted else ''}"
        for a in found.axes
    ]
    origin = [f"ORIGIN then reports: {found.origin}"] if found.origin else []
    return [
        f"arm 1 runs {_MEETS[found.lower]}, at {speed}, reflex {'on' if found.reflex else 'off'}{loop}",
        "      force  status      believed         true   steps lost",
        *rows,
        f"the program reports: {found.message}",
        *origin,
    ]


_MEETS: Final = (
    "into the stationary hand of arm 2",
    "with its column, above its wrist, into the stationary hand of arm 2",
    "into the column of the stationary arm 2, above that arm's wrist",
)
_HITS: Final = {1: "the hand of arm 2, with the column of arm 1", 2: "the column of arm 2"}


STUDY: Final = (
    *((speed, reflex, False) for speed in (20.0, 50.0, 200.0, None) for reflex in (True, False)),
    (50.0, True, True),
    (50.0, False, True),
)
"""For each collision on the page: the speed, whether the reflex is on, and whether the computer hangs."""


ABOVE: Final = tuple((lower, speed) for lower in (2, 1) for speed in (50.0, None))
"""For each collision in which the hand of one arm hits the column of the other arm: the arm whose hand is lower and
whose column is hit, and the speed.
"""


def page_tables() -> str:
    """Return the tables of docs/safety_study.md."""
    return f"{_page_table()}\n## Above the wrist\n\n{_above_table()}"


def _above_table() -> str:
    heads = [
        "arm 1 hits",
        "speed",
        "axis",
        "greatest force",
        "status",
        "steps lost",
        "doubted",
        "found by ORIGIN",
    ]
    rows = [f"| {' | '.join(heads)} |\n|{'---|' * len(heads)}\n"]
    for lower, speed in ABOVE:
        found = crash(speed, reflex=True, lower=lower)
        what = (_HITS[lower], "full" if speed is None else f"{speed:g} mm/s")
        for axis in found.axes:
            named = (
                "yes"
                if axis.axis in found.origin
                else "no"
                if found.origin
                else "the program had already stopped"
            )
            cells = (
                *what, axis.axis, f"{axis.force:.1f} N", axis.status, str(axis.lost),
                "yes" if axis.doubted else "no", named,
            )  # fmt: skip
            rows.append(f"| {' | '.join(cells)} |\n")
            what = ("", "")
    return "".join(rows)


def _page_table() -> str:
    heads = ["speed", "reflex", "central computer", "axis", "greatest force", "status"]
    heads += ["believed", "true", "steps lost", "doubted"]
    head = f"| {' | '.join(heads)} |\n|{'---|' * len(heads)}\n"
    rows = []
    for speed, reflex, endless in STUDY:
        found = crash(speed, reflex=reflex, endless_loop=endless)
        what = (
            "full" if speed is None else f"{speed:g} mm/s",
            "on" if reflex else "off",
            "hangs" if endless else "works",
        )
        for axis in found.axes:
            cells = (
                *what, axis.axis, f"{axis.force:.1f} N", axis.status, f"{axis.believed:.2f} mm",
                f"{axis.true:.2f} mm", str(axis.lost), "yes" if axis.doubted else "no",
            )  # fmt: skip
            rows.append(f"| {' | '.join(cells)} |\n")
            what = ("", "", "")
    return head + "".join(rows)
