"""Defines the job `blocks`, its worlds and its referee."""

from __future__ import annotations

from itertools import pairwise
from math import degrees
from typing import TYPE_CHECKING, Final

import numpy as np

from handeye.core.distributions import Noise, Range
from handeye.core.pose import Array
from handeye.core.units import MILLIMETRE
from handeye.core.variation import Variation
from handeye.judge.finding import Findings, at_most
from handeye.judge.measured import tilt
from handeye.systems.ml.bench.faults import put_away
from handeye.systems.ml.bench.reporting import ReportingTask
from handeye.systems.ml.bench.station import Station, scene
from handeye.systems.ml.bench.world import ARM, ArmWorld, quantity
from handeye.systems.ml.blocks.faults import FAULTS, OCCUPIED, SLIPPERY, TROUBLES
from handeye.systems.ml.machine.spec import LINEAR
from handeye.tasks.interface import Words

if TYPE_CHECKING:
    import mujoco

    from handeye.cell.truth import Truth

SIDE: Final = 0.03  # m
EXPECTED: Final = (
    (-4000, 2000),
    (0, 2000),
    (4000, 2000),
)  # x and y of the slides, where the program expects blocks
STACK: Final = (0, -2000)  # x and y of the slides, where the program stacks the blocks
APART: Final = 2.0  # mm: greatest distance of a block from the block below
HEIGHT: Final = 1.0  # mm
LEAN: Final = 2.0  # deg
PLACED: Final = 3.0  # mm: greatest distance of the lowest block from its place
_PLACE, _TURNED, _SIZE, _FRICTION = "blocks.place", "blocks.turned", "blocks.size", "blocks.friction"
SHORTER, LONGER = 0.008, 0.006  # m by which the side of a wrong block is shorter or longer
_DENSITY: Final = 600.0  # kg/m3, wood
VARIATION: Final = Variation(
    *ARM,
    quantity(
        _PLACE,
        "mm",
        Noise(1.5),
        8.0,
        "Standard deviation of a block's position along x and y. No source: our choice, for a block laid by hand.",
    ),
    quantity(
        _TURNED, "deg", Noise(2.0), 15.0, "Standard deviation of a block's rotation. No source: our choice."
    ),
    quantity(
        _SIZE,
        "mm",
        Noise(0.1),
        1.0,
        ("Standard deviation of the length of a block's side. No source: our choice."),
    ),
    quantity(
        _FRICTION,
        "",
        Range(0.3, 0.5),
        2.0,
        "Coefficient of friction of a block on the table and on another block. No source: our choice.",
        0.4,
    ),
)


class Blocks(ReportingTask):
    """Stack three blocks."""

    name = "blocks"
    words = Words(product="the stack", done="The three blocks are stacked.")
    quantities = VARIATION
    troubles = TROUBLES
    planted = FAULTS

    def station(self, world: ArmWorld) -> Station:
        """Return the station with its blocks."""
        spec = scene(world, wand=False)
        friction = world.fault(SLIPPERY) or world.value(_FRICTION)
        for number, (x, y) in enumerate(EXPECTED, 1):
            name = f"block_{number}"
            half = SIDE / 2 + world.normal(f"{name}.size", _SIZE) / 2
            half += (
                LONGER * (world.fault(f"{name}.large") or 0.0)
                - SHORTER * (world.fault(f"{name}.small") or 0.0)
            ) / 2
            off = world.normal(f"{name}.x", _PLACE), world.normal(f"{name}.y", _PLACE)
            at = x * LINEAR + off[0] + (world.fault(f"{name}.moved.x") or 0.0), y * LINEAR + off[1]
            _lay(spec, name, half, at, world.normal(f"{name}.turned", _TURNED), friction)
            if world.fault(f"{name}.missing") is not None:
                put_away(spec, name)
        if world.fault(OCCUPIED) is not None:
            _lay(spec, "stray", SIDE / 2, (STACK[0] * LINEAR, STACK[1] * LINEAR), 0.0, friction)
        return Station(spec, world)

    def judge(self, truth: Truth) -> Findings:
        bodies = [truth.data.body(f"block_{number}") for number in range(1, len(EXPECTED) + 1)]
        places = np.array([body.xpos for body in bodies])
        halves = [float(truth.model.geom(f"block_{n}").size[2]) for n in range(1, len(EXPECTED) + 1)]
        wanted = np.cumsum([halves[0], *(one + two for one, two in pairwise(halves))])
        off = np.hypot(*(places[1:, :2] - places[:-1, :2]).T)
        place = np.hypot(places[0, 0] - STACK[0] * LINEAR, places[0, 1] + STACK[1] * LINEAR)
        lean = max(tilt(body.xmat.reshape(3, 3)) for body in bodies)
        high: Array = np.abs(places[:, 2] - wanted)
        return {
            "stacked": at_most(
                float(off.max()) / MILLIMETRE,
                APART,
                "mm",
                "greatest horizontal distance between a block and the block below it",
            ),
            "heights": at_most(
                float(high.max()) / MILLIMETRE,
                HEIGHT,
                "mm",
                "greatest error of a block's height in the stack",
            ),
            "placed": at_most(
                float(place) / MILLIMETRE, PLACED, "mm", "distance of the lowest block from its place"
            ),
            "flat": at_most(degrees(lean), LEAN, "deg", "greatest tilt of a block"),
        }


def _lay(
    spec: mujoco.MjSpec, name: str, half: float, at: tuple[float, float], turned: float, friction: float
) -> None:
    """Lay a block on the table. `at` is its place, in the coordinates x and y of the slides (m)."""
    import mujoco

    turn = [np.cos(turned / 2), 0, 0, -np.sin(turned / 2)]
    body = spec.worldbody.add_body(name=name, pos=[at[0], -at[1], half], quat=turn)
    body.add_freejoint(name=name)
    body.add_geom(
        name=name, type=mujoco.mjtGeom.mjGEOM_BOX, size=[half, half, half], density=_DENSITY,
        friction=[friction, 0.003, 0.0001], rgba=[0.80, 0.62, 0.38, 1], group=1,
    )  # fmt: skip


BLOCKS: Final = Blocks()
