"""Where the search for the hole of the second aligning pin begins, calculated from the errors of the high level."""

from functools import cache

import numpy as np
import pytest

from handeye.arm.kinematics import forward
from handeye.arm.robots.stanford import STANFORD
from handeye.core.pose import Array
from handeye.core.resources import plans
from handeye.core.units import INCH
from handeye.core.variation import WorldSpec
from handeye.planfile.store import read_plan
from handeye.program.motion_operations import Move
from handeye.tasks.stanford_cell.dimensions import dimensions, standard
from handeye.tasks.water_pump.world.pump_world import PumpWorld
from handeye.touch.spiral import spiral

X, Y = np.array([1.0, 0.0]), np.array([0.0, 1.0])
NOSE = 2 * INCH  # from the fingers to the tip of the pin


@cache
def first_move(goal: str) -> tuple[Array, tuple[str, ...]]:
    """The joint positions of the careful program's first move to a goal, and what shifts it."""
    plan = read_plan(plans() / "water_pump.plan.json")
    steps = enumerate(plan.program.steps)
    number, move = next(
        (k, step.operation)
        for k, step in steps
        if isinstance(step.operation, Move) and step.operation.goal == goal
    )
    return np.array(plan.motions[number].knots[-1]), tuple(restore.name for restore in move.restore)


def tip(q: Array) -> Array:
    X_WT = forward(STANFORD, q)
    place: Array = (X_WT[:3, 3] + NOSE * X_WT[:3, 2])[:2]
    return place


def away(world: PumpWorld) -> Array:
    """How far from its hole the second pin is at the first place of its search (m, x and y of the table). The fingers
    hold the first pin in their middle along y, and the second along x.
    """
    d, q = dimensions(), {name: first_move(name)[0] for name in ("P1", "P2", "T1", "T2")}
    x1, y1, x2, y2 = d.all("pin_holder.places")
    holder = world.fixtures["pin_holder"].about((x1 + x2) / 2, (y1 + y2) / 2)
    pins = [(holder @ [*at, 0.0, 1.0])[:2] for at in ((x1, y1), (x2, y2))]
    blocks = world.fixtures["blocks"].about(d.all("blocks.left")[2], d.all("blocks.far")[1]) @ standard()
    drilled = world.drilled("base")
    holes = [(blocks @ [*drilled[int(k)], 0.0, 1.0])[:2] for k in d.all("base.screw_holes.pinned")]
    goal = {name: tip(each) for name, each in q.items()}
    error = {name: tip(world.arm.positions(each)) - goal[name] for name, each in q.items()}
    saved = {"C1": (pins[0] - goal["P1"] - error["P1"]) * Y}
    beside = (pins[0] - goal["P1"] - error["P1"]) * X
    saved["E1"] = holes[0] - beside - goal["T1"] - error["T1"]
    shift = sum((saved[name] for name in first_move("P2")[1]), np.zeros(2))
    saved["C2"] = (pins[1] - goal["P2"] - error["P2"]) * X
    beside = (pins[1] - goal["P2"] - error["P2"] - shift) * Y
    shift = sum((saved[name] for name in first_move("T2")[1]), np.zeros(2))
    found: Array = goal["T2"] + shift + error["T2"] + beside - holes[1]
    return found


@pytest.mark.slow
def test_the_first_pin_tells_where_the_hole_of_the_second_is() -> None:
    d = dimensions()
    play = d("base.screw_holes.radius") - d("pin.nose_radius")
    catch = play + d("base.screw_holes.chamfer") + d("pin.nose_bevel")
    places = 0.07 * INCH * np.array([spiral(k) for k in range(81)])
    worlds = [PumpWorld.draw(WorldSpec(seed=seed, level="high")) for seed in range(200)]
    errors = np.array([away(world) for world in worlds])
    caught = np.linalg.norm(errors[:, None] + places, axis=2) < catch
    assert caught.any(axis=1).all()
    assert caught.argmax(axis=1).mean() + 1 < 3.5  # from the taught place: 6.3
