"""The plate of the pump as a task. The referee measures the true depth and clamping force of each screw, the depth of
each pin, and the seat of the plate. It also compares its own counts with the program's counts.
"""

from __future__ import annotations

from math import degrees, hypot
from typing import TYPE_CHECKING, Final

import numpy as np

from handeye.cell.threads import ThreadFigures, Threads
from handeye.core.units import MILLIMETRE
from handeye.judge.finding import Findings, at_least, at_most
from handeye.judge.measured import tilt
from handeye.systems.sigma.gantries.job import JobTask
from handeye.systems.sigma.gantries.machine import Gantries, scene
from handeye.systems.sigma.gantries.witness import HEARD
from handeye.systems.sigma.prco.drawing import BASE, MOST, PIN_DEPTH, PINS, PLATE, Pump, drawn
from handeye.systems.sigma.prco.driver import HandDriver
from handeye.systems.sigma.prco.scene import add_pump
from handeye.systems.sigma.prco.witness import PumpWitness, WatchedPump
from handeye.tasks.interface import Words
from handeye.tasks.stanford_cell.screws import LENGTH

if TYPE_CHECKING:
    import mujoco

    from handeye.cell.truth import Truth
    from handeye.core.pose import Array
    from handeye.systems.sigma.gantries.world import GantryWorld

# The limits of screws are those of the pump (handeye/tasks/water_pump/referee/limits.py).
HEAD_GAP: Final = 0.2  # mm: greatest gap under a head
LEAN: Final = 1.0  # deg: greatest tilt of a screw or pin
CLAMP: Final = 40.0  # N: least clamping force
STRAIN: Final = 420.0  # N: greatest clamping force
SEATED: Final = 0.3  # mm: greatest height of the plate over the base
PIN_SEATED: Final = 0.5  # mm: greatest height of a pin over the floor of its hole
PIN_PLACE: Final = 0.3  # mm: greatest distance of a pin from the axis of its hole


class Plate(JobTask):
    """Arm 1 lays the plate on the base and puts in two pins; arm 2 drives the screws."""

    name = "prco"
    words = Words(product="the plate", done="The plate is on its base, with its pins and screws.")
    usual = few = MOST  # its program drives all screws

    def board(self, world: GantryWorld, count: int) -> tuple[mujoco.MjSpec, PumpWitness]:
        spec, pump = scene(world), drawn(world, count)
        add_pump(spec, pump)
        return spec, PumpWitness(WatchedPump(pump=pump))

    def equip(self, world: GantryWorld, count: int, gantries: Gantries) -> None:
        bench, pump, driver = gantries.bench, drawn(world, count), HandDriver()
        gantries.actuated.append(driver.actuated)
        figures = ThreadFigures(phases=pump.phases, friction=pump.friction)
        bench.add(driver)
        bench.add(Threads(bench.model, bench.data, driver, figures))

    def judge(self, truth: Truth) -> Findings:
        watched = truth.states[HEARD]
        assert isinstance(watched, WatchedPump)
        pump = watched.pump
        pins, screws = _Pins(truth, pump), _Screws(truth, pump)
        gaps = _gaps(truth)
        counted = watched.counted
        wrong = abs(counted[0] - pins.right) + abs(counted[1] - screws.right)
        return {
            "plate": at_most(max(gaps), SEATED, "mm", "greatest gap between plate and base at a corner"),
            "pins": at_least(
                pins.right, PINS, "pins", "pins that stand upright at the bottom of their holes"
            ),
            "screws": at_least(
                screws.taken, pump.screws, "screws", "number of threads whose screw is not crossed"
            ),
            "screws_depth": at_most(screws.gap, HEAD_GAP, "mm", "greatest gap under the head of a screw"),
            "screws_clamp": at_least(screws.weakest, CLAMP, "N", "smallest clamping force of a screw"),
            "screws_strain": at_most(screws.strongest, STRAIN, "N", "greatest clamping force of a screw"),
            "counted": at_most(
                wrong,
                0,
                "parts",
                "difference between the program's counts and the numbers of pins and screws in place",
            ),
            "apart": at_most(watched.touched_ms, 0, "ms", "time for which the arms touched each other"),
        }


class _Pins:
    """The pins that are right."""

    def __init__(self, truth: Truth, pump: Pump) -> None:
        base = truth.data.body("base")
        down = base.xmat.reshape(3, 3).T
        self.right = 0
        for hole in pump.base_pins:
            for number in range(1, PINS + 1):
                pin = truth.data.body(f"pin_{number}")
                x, y, z = down @ (pin.xpos - base.xpos) / MILLIMETRE
                lean = degrees(tilt(down @ pin.xmat.reshape(3, 3)))
                deep = abs(z - BASE[2] + PIN_DEPTH) <= PIN_SEATED
                self.right += deep and lean <= LEAN and hypot(x - hole.x, y - hole.y) <= PIN_PLACE


class _Screws:
    """The screws in their threads."""

    def __init__(self, truth: Truth, pump: Pump) -> None:
        (threads,) = (part for part in truth.mechanisms if isinstance(part, Threads))
        axes = truth.data.body("base").xmat.reshape(3, 3)
        self.taken = self.right = 0
        self.gap, self.weakest, self.strongest = 0.0, np.inf, 0.0
        for number, thread in enumerate(threads.holes):
            good = thread.screw is not None and not thread.crossed
            gap, lean, clamp = LENGTH, 0.0, 0.0
            if thread.screw is not None:
                carrier, mouth = truth.data.body(f"carrier{number}"), truth.data.site(f"plate_bore{number}")
                axis = carrier.xmat.reshape(3, 3)[:, 2]
                under = carrier.xpos + LENGTH * MILLIMETRE * axis - mouth.xpos
                gap = float(under @ axes[:, 2]) / MILLIMETRE
                lean = degrees(tilt(axes.T @ carrier.xmat.reshape(3, 3)))
                clamp = threads.head_force(number)
            self.gap = max(self.gap, gap)
            self.weakest, self.strongest = min(self.weakest, clamp), max(self.strongest, clamp)
            self.taken += good
            self.right += good and lean <= LEAN and gap <= HEAD_GAP and CLAMP <= clamp <= STRAIN


def _gaps(truth: Truth) -> list[float]:
    """Return the gaps (mm) between the plate and the base at the corners of the plate."""
    base, plate = truth.data.body("base"), truth.data.body("plate")
    axes = base.xmat.reshape(3, 3)
    corners: Array = np.array(
        [(sx * PLATE[0] / 2, sy * PLATE[1] / 2, 0.0) for sx in (-1, 1) for sy in (-1, 1)]
    )
    places = plate.xpos + corners * MILLIMETRE @ plate.xmat.reshape(3, 3).T
    return [abs(float(each)) for each in ((places - base.xpos) @ axes)[:, 2] / MILLIMETRE - BASE[2]]


PRCO: Final = Plate()
