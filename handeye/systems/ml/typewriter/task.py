"""Defines the job `typewriter` (bin, orientation and rail support in one program), its worlds and its referee."""

from __future__ import annotations

from math import hypot
from typing import TYPE_CHECKING, Final

import numpy as np

from handeye.core.faults import Catalogue
from handeye.core.units import MILLIMETRE
from handeye.core.variation import Variation, WorldSpec
from handeye.judge.finding import Findings, at_least, at_most
from handeye.systems.ml.bench.bars import LONG, WIDE, off_attitude
from handeye.systems.ml.bench.faults import arm_fault, planted, put_away
from handeye.systems.ml.bench.hardware import ArmTask
from handeye.systems.ml.bench.reporting import Listener, calls_of, counted
from handeye.systems.ml.bench.station import Station, scene
from handeye.systems.ml.bench.world import ARM, ArmWorld
from handeye.systems.ml.bin.faults import EMPTY
from handeye.systems.ml.bin.hopper import (
    BOX,
    HIGH,
    RIM,
    add_bin_box,
    add_hopper,
    hold_firmly,
    solve_densely_while_bars_move,
)
from handeye.systems.ml.bin.task import PARTS, POURED, SMOOTH, Poured, parts_of, poured, settled
from handeye.systems.ml.orient.task import ATTITUDE, STOP_PLACE, add_stop
from handeye.systems.ml.run.hardware import Hardware, Tell
from handeye.systems.ml.run.jobs import USUAL
from handeye.systems.ml.support import faults as support
from handeye.systems.ml.support.drawing import FRAME, PARTS_VARY, Drawing, mm
from handeye.systems.ml.support.referee import PLACED, SEATED, judge
from handeye.systems.ml.support.scene import add_ridge, add_support
from handeye.systems.ml.support.task import SupportHardware, screwing
from handeye.tasks.interface import Words
from handeye.tasks.stanford_cell.screws import Place
from handeye.tasks.stanford_cell.shapes import Shaper

if TYPE_CHECKING:
    import mujoco

    from handeye.cell.truth import Truth
    from handeye.systems.ml.run.plan import MlPlan
    from handeye.systems.ml.support.equipment import ForceGauge

HOPPER: Final = (2500, -8540)  # x and y of the slides
BAD: Final = (-9500, -8500)
STOP: Final = (-8700, 600)
BAR: Final = (0, -3350)  # the middle of the bar in the frame; it lies along x
_RIDGE: Final = (5.0, 5.0)  # mm, thickness and height of the ridges around it
_LEAD: Final = 2.0  # mm
_PLAY: Final = (0.7, 0.4)  # mm between the bar and a ridge: at its ends, and at its sides
TROUBLES: Final = {
    **support.TROUBLES,
    "7": "the hand and the range finder find no good bar in the bin",
    "8": "the bin still has bars that the hand cannot take out",
    "9": "the hand does not hold exactly one bar by its sides",
    "10": "the bar does not meet the table",
    "11": "the bar does not become level",
    "12": "the bar does not meet the stop",
}  # by the number that the program prints


_CALLS: Final = calls_of(TROUBLES)
_NONE, _NO_BAR = _CALLS[1], _CALLS[6]
_MAY_LACK: Final = ("rail_1", "pin_1")
FAULTS: Final = Catalogue(
    arm_fault("motor.z.dead"),
    arm_fault("motor.x.dead"),
    arm_fault("motor.roll.dead"),
    arm_fault("potentiometer.z.stuck"),
    arm_fault("range.silent", _NO_BAR),
    planted(EMPTY, "No bars were poured into the bin.", _NO_BAR),
    *(planted(f"{part}.missing", f"There is no {part}.", _NONE) for part in _MAY_LACK),
)


class Typewriter(ArmTask):
    """Take a bar out of a bin, orient it, put it into the frame, and assemble the rail support."""

    name = "typewriter"
    words = Words(
        product="the rail support with its bar",
        done="The rail support is assembled from 22 parts, and has a bar that comes from the bin.",
    )

    def variation(self) -> Variation:
        return Variation(*ARM, *PARTS, STOP_PLACE, *PARTS_VARY)

    def faults(self, world: WorldSpec) -> Catalogue:
        return FAULTS

    def station(self, bars: int, world: ArmWorld) -> tuple[Station, ForceGauge]:
        """Return the station with the parts of the support, and with the hopper, the box for bad bars and the stop."""
        spec = scene(world, wand=False)
        add_support(spec, Drawing(world))
        _add_ridges(spec)
        for part in _MAY_LACK:
            if world.fault(f"{part}.missing") is not None:
                put_away(spec, part)
        hopper = _metres(HOPPER)
        if world.fault(EMPTY) is not None:
            bars = 0
        add_hopper(spec, world.value(SMOOTH), hopper, HIGH)
        add_bin_box(spec, "bad", _metres(BAD))
        add_stop(spec, world, STOP)
        pile = poured(spec, world, bars, hopper)
        names = [f"part_{number}" for number in range(1, bars + 1)]
        hold_firmly(spec, names)
        station, gauge = screwing(spec, world, others=(pile,))
        solve_densely_while_bars_move(station.bench, names)
        return station, gauge

    def scene(self, spec: WorldSpec) -> mujoco.MjModel:
        return settled(self.station(int(USUAL["typewriter"]), self.world(spec))[0].bench)

    def recorded_scene(self, spec: WorldSpec, plan: bytes) -> mujoco.MjModel:
        from handeye.systems.ml.run.plan import decode

        bars = parts_of(decode(plan, "the plan of the run"))
        return self.station(bars, self.world(spec))[0].bench.model

    def hardware(self, plan: MlPlan, world: WorldSpec, tell: Tell) -> Hardware:
        return SupportHardware(*self.station(parts_of(plan), self.world(world)), tell, TROUBLES)

    def judge(self, truth: Truth) -> Findings:
        """Judge the bars. Also judge the support, in the same way as the referee of `support`."""
        pile = truth.states[POURED]
        assert isinstance(pile, Poured)
        fitted, left, boxed, lost = [], 0, 0, 0
        for number, quality in enumerate(pile.qualities, 1):
            x, y, _ = truth.data.body(f"part_{number}").xpos
            if _fits(truth, number):
                fitted.append(quality == "good")
            elif _near(x, y, HOPPER, RIM):
                left += 1
            elif _near(x, y, BAD, BOX):
                boxed += quality == "good"
            else:
                lost += 1
        return {
            "bar": at_least(len(fitted), 1, "bars", "bars in their place in the frame"),
            "passed": at_most(fitted.count(False), 0, "bars", "bad bars in the frame"),
            "rejected": at_most(boxed, 0, "bars", "good bars in the box for bad ones"),
            "lost": at_most(lost, 0, "bars", "bars that lie elsewhere"),
            **judge(truth, counted(truth.states[Listener.name]) - len(fitted)),
        }


def _metres(place: tuple[int, int]) -> Place:
    """Convert a place of the slides to scene coordinates (m)."""
    at = mm(*place)
    return Place(at.x * MILLIMETRE, at.y * MILLIMETRE)


def _add_ridges(spec: mujoco.MjSpec) -> None:
    """Add the four ridges between which the bar lies in the frame: one along each side of the bar, and one at each
    end.
    """
    shaper, frame, (thick, high) = Shaper(spec=spec), spec.body("frame"), _RIDGE
    middle, long, wide = mm(*BAR), LONG / MILLIMETRE, WIDE / MILLIMETRE
    end, side = (half / 2 + play + thick / 2 for half, play in zip((long, wide), _PLAY, strict=True))
    for way in (-1, 1):
        along = Place(middle.x, middle.y + way * side)
        add_ridge(shaper, frame, "bar_side", "rib", along, (long, thick, high), _LEAD, FRAME[2])
        across = Place(middle.x + way * end, middle.y)
        add_ridge(shaper, frame, "bar_end", "rib", across, (wide, thick, high), _LEAD, FRAME[2], across=True)


def _fits(truth: Truth, number: int) -> bool:
    """Return True if a bar lies in its place in the frame."""
    frame, bar = truth.data.body("frame"), truth.data.body(f"part_{number}")
    axes, at = frame.xmat.reshape(3, 3), mm(*BAR)
    x, y, z = (bar.xpos - frame.xpos) @ axes / MILLIMETRE
    turned = off_attitude(axes.T @ bar.xmat.reshape(3, 3), np.array([1.0, 0, 0]), np.array([0, 0, 1.0]))
    high = FRAME[2] + WIDE / 2 / MILLIMETRE
    return hypot(x - at.x, y - at.y) <= PLACED and abs(z - high) <= SEATED and turned <= ATTITUDE


def _near(x: float, y: float, place: tuple[int, int], half: float) -> bool:
    """Return True if a point of the scene (m) is inside a square around a place of the slides."""
    middle = _metres(place)
    return max(abs(x - middle.x), abs(y - middle.y)) < half


TYPEWRITER: Final = Typewriter()
