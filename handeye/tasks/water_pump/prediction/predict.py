"""The whole assembly, operation by operation, in many worlds."""

from collections.abc import Sequence
from typing import Final

import numpy as np

from handeye.core.errors import Refused
from handeye.core.pose import Array
from handeye.core.units import INCH
from handeye.core.variation import WorldSpec
from handeye.program.motion_operations import Travel
from handeye.program.program import Program
from handeye.program.senses import Sense
from handeye.tasks.interface import Predicted
from handeye.tasks.water_pump.prediction import grasping, layers, pins, screws
from handeye.tasks.water_pump.prediction.assembly import Assembly
from handeye.tasks.water_pump.prediction.poses import points
from handeye.tasks.water_pump.prediction.things import standing_base
from handeye.tasks.water_pump.prediction.worlds import Worlds
from handeye.tasks.water_pump.world.dimensions import base_top, dimensions, standard

GOALS: Final = (
    "A", "B", *(goal for pin in pins.PINS for goal in pin.positions), "GUP", "GON", "TOPON", "FACE", "D",
    "DX", *(goal for screw in screws.SCREWS for goal in (screw.fetched, screw.driven)), "DUP", "CRANK",
)  # fmt: skip
"""Positions that every program of the pump goes to."""
BESIDE: Final = 0.3 * INCH
"""From closed fingers beside the pump to its rim, as taught."""


def predict(
    program: Program, world: WorldSpec, seeds: Sequence[int], without: tuple[Sense, ...]
) -> tuple[Predicted, ...]:
    """How far off each contact operation of a program is in some worlds, in the order of the work.

    Raises:
        InvalidInput: a world cannot be drawn here, the program does not go where the pump's does, or force is to be
            done without.
    """
    if "force" in without:
        raise Refused(
            "the prediction takes motions to end where they should; what comes without force, it cannot tell"
        )
    assembly = Assembly(worlds=Worlds(world, seeds), program=program, without=frozenset(without))
    lacking = [goal for goal in GOALS if goal not in assembly.ways]
    lacking += ["TOP"] if assembly.ways.keys().isdisjoint({"TOP", "TOPUP"}) else []
    if lacking:
        raise Refused(f"the prediction is of the pump's program; this one never goes to {lacking[0]}")
    grasping.grasp(assembly)
    for pin in pins.PINS:
        pins.insert(assembly, pin)
    pins.ask_across(assembly)
    layers.save_heights(assembly)
    layers.lay_gasket(assembly)
    top = layers.lay_top(assembly)
    flange = base_top() + dimensions()("gasket.thickness") + dimensions()("top.flange")
    layers.feel(assembly, "top", "FLANGE", flange)
    _drive(assembly, "", screws.SCREWS[: screws.FIRST])
    for pin in pins.PINS:
        pins.take_out(assembly, pin)
    _drive(assembly, ", again", screws.SCREWS[screws.FIRST :])
    _turn(assembly, top)
    _inspect(assembly, flange)
    return tuple(assembly.found)


def _drive(assembly: Assembly, again: str, each: Sequence[screws.Screw]) -> None:
    held = screws.take_driver(assembly, f"driver{again}")
    screws.drive(assembly, held, each)
    screws.put_back(assembly, held, f"rack{again}")


def _turn(assembly: Assembly, top: Array) -> None:
    """Put the fingers over the crank."""
    d = dimensions()
    angle, radius = np.pi + top[:, 2], d("rotor.crank_radius")
    crank = np.column_stack(
        [top[:, :2] + radius * np.column_stack([np.cos(angle), np.sin(angle)]), np.zeros(len(top))]
    )
    off = points(standing_base(assembly.worlds), crank) - assembly.hand("CRANK")[:, :3, 3]
    assembly.fits("rotor", "CRANK", off, d("rotor.crank_diameter"))


def _inspect(assembly: Assembly, flange: float) -> None:
    """Feel the flange, and push the pump to its blocks."""
    for goal, way in (("FLANGE", 1), ("SIDE", 0), ("WAIST", 0)):
        if len(assembly.ways.get(goal, ())) > way:
            layers.feel(assembly, "inspection", goal, flange, way=way)
    for goal, direction in (("RIM1", (0.0, 1.0, 0.0)), ("RIM2", (-1.0, 0.0, 0.0))):
        if goal in assembly.ways:
            planned = assembly.planned(goal)[:3, 3] - standard()[:3, 3]
            moved = assembly.hand(goal)[:, :3, 3] - standing_base(assembly.worlds)[:, :3, 3] - planned
            assembly.window("inspection", goal, Travel, BESIDE - moved @ np.array(direction))
