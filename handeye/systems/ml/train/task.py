"""Defines the job `train`, its worlds and its referee."""

from __future__ import annotations

from math import degrees, pi
from typing import TYPE_CHECKING, Final

import numpy as np

from handeye.core.distributions import Noise, Range
from handeye.core.units import MILLIMETRE
from handeye.core.variation import Variation
from handeye.judge.finding import Findings, at_most
from handeye.judge.measured import tilt
from handeye.systems.ml.bench.faults import put_away
from handeye.systems.ml.bench.reporting import ReportingTask
from handeye.systems.ml.bench.station import Station, scene
from handeye.systems.ml.bench.world import ARM, ArmWorld, quantity
from handeye.systems.ml.machine.spec import LINEAR
from handeye.systems.ml.train.faults import FAULTS, TROUBLES
from handeye.systems.ml.train.vehicles import CLEARANCE, PEG, REACH, THICKER, add_vehicle
from handeye.tasks.interface import Words

if TYPE_CHECKING:
    from handeye.cell.truth import Truth

EXPECTED: Final = {"engine": (0, -3500), "wagon_1": (-5000, 2500), "wagon_2": (5000, 2500)}
"""Places at which the program expects the vehicles (x and y of the slides)."""
PULLED: Final = 0.050  # m by which the engine is pulled
COUPLED: Final = 0.5  # mm: greatest distance between the axes of a peg and its hole
SEATED: Final = 0.5  # mm: greatest height of a wagon over the table, with its peg in to the shoulder
PLACED: Final = 3.0  # mm: greatest distance of the engine from where it should be after the pull
LEAN: Final = 2.0  # deg
_PLACE, _TURNED, _FRICTION, _CLEARANCE = "train.place", "train.turned", "train.friction", "train.clearance"
VARIATION: Final = Variation(
    *ARM,
    quantity(
        _PLACE,
        "mm",
        Noise(1.5),
        5.0,
        "Standard deviation of a vehicle's position along x and y. No source: our choice, for a vehicle placed by "
        "hand.",
    ),
    quantity(
        _TURNED, "deg", Noise(2.0), 8.0, "Standard deviation of a vehicle's rotation. No source: our choice."
    ),
    quantity(
        _FRICTION,
        "",
        Range(0.3, 0.5),
        2.0,
        "Coefficient of friction between a vehicle and the table. No source: our choice.",
        0.4,
    ),
    quantity(
        _CLEARANCE,
        "mm",
        Range(0.2, 0.4),
        2.0,
        "Difference between the diameters of hole and peg. No source: our choice.",
        CLEARANCE / MILLIMETRE,
    ),
)


class Train(ReportingTask):
    """Couple an engine and two wagons, and pull them."""

    name = "train"
    words = Words(product="the train", done="Both wagons are coupled, and have followed the engine.")
    quantities = VARIATION
    troubles = TROUBLES
    planted = FAULTS

    def station(self, world: ArmWorld) -> Station:
        """Return the station with its vehicles."""
        spec = scene(world, wand=False)
        for name, (x, y) in EXPECTED.items():
            at = (
                x * LINEAR + world.normal(f"{name}.x", _PLACE) + (world.fault(f"{name}.moved.x") or 0.0),
                y * LINEAR + world.normal(f"{name}.y", _PLACE),
            )
            turned = world.normal(f"{name}.turned", _TURNED)
            turned += pi * (world.fault(f"{name}.reversed") or 0.0)
            peg = PEG + THICKER * (world.fault(f"{name}.peg.thick") or 0.0)
            if world.fault(f"{name}.peg.missing") is not None:
                peg = 0.0
            blocked = world.fault(f"{name}.hole.blocked") is not None
            friction, clearance = world.value(_FRICTION), world.value(_CLEARANCE)
            add_vehicle(spec, name, at, turned, friction, clearance, peg=peg, blocked=blocked)
            if world.fault(f"{name}.missing") is not None:
                put_away(spec, name)
        return Station(spec, world)

    def judge(self, truth: Truth) -> Findings:
        bodies = [truth.data.body(name) for name in EXPECTED]
        frames = [body.xmat.reshape(3, 3) for body in bodies]
        pegs = [body.xpos + R @ [0, REACH, 0] for body, R in zip(bodies, frames, strict=True)]
        holes = [body.xpos - R @ [0, REACH, 0] for body, R in zip(bodies, frames, strict=True)]
        apart = max(np.hypot(*(peg - hole)[:2]) for peg, hole in zip(pegs[1:], holes, strict=False))
        high = max(abs(float(body.xpos[2])) for body in bodies)
        x, y = EXPECTED["engine"]
        off = np.hypot(bodies[0].xpos[0] - x * LINEAR, -bodies[0].xpos[1] - (y * LINEAR - PULLED))
        return {
            "coupled": at_most(
                float(apart) / MILLIMETRE,
                COUPLED,
                "mm",
                "greatest distance between the axes of a peg and its hole",
            ),
            "seated": at_most(
                high / MILLIMETRE, SEATED, "mm", "greatest height of a vehicle above the table"
            ),
            "pulled": at_most(
                float(off) / MILLIMETRE, PLACED, "mm", "distance of the engine from where it should be"
            ),
            "flat": at_most(degrees(max(map(tilt, frames))), LEAN, "deg", "greatest tilt of a vehicle"),
        }


TRAIN: Final = Train()
