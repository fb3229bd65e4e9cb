"""The bin is a smooth hopper with a flat middle. The hand takes bars out of it and puts them into two boxes."""

from collections.abc import Sequence
from itertools import product
from math import cos, radians, sin, tan
from typing import Final

import mujoco
import numpy as np

from handeye.cell.bench import Bench
from handeye.systems.ml.bench.bars import turned
from handeye.systems.ml.machine.spec import LINEAR
from handeye.tasks.stanford_cell.screws import Place

ORIGIN: Final = Place(0, 0)
FLOOR: Final = 0.002  # m: height of the flat middle of the hopper over the table
HALF: Final = 0.048  # m: half the side of the flat middle
SLOPE: Final = radians(25)  # rad: slope of the hopper's four sides
RIM: Final = 0.090  # m from the middle of the hopper to its rim
BOXES: Final = {"good": -6500, "bad": 6500}  # x of the slides
BOX: Final = 0.050  # m: half the inner side of a box
TRAY: Final = (0.060, 0.090)  # m: half the inner sides of a large box, along x and y
HIGH: Final = 0.030  # m: height of low walls over the table, those of a small box or hopper
DEEP: Final = 0.080  # m: height of walls that no part leaves if it is let go between them
THIN: Final = 0.002  # m: half the thickness of the walls of a box
THICK: Final = (
    0.005  # m: half the thickness of the hopper's walls and slopes, between which the fingers close
)
PADS: Final = [0.999, 0.999, 0.0005, 0.5, 2.0]
"""Impedance of the contacts of fingers that hold light parts firmly.

In MuJoCo, a contact creeps if only friction holds it. With the arm's usual impedance of .95 to .99, a part turns if
the fingers hold it aslant. After a freeze, the fingers lose a quarter to a third of their force each half second. With
the impedance given here, the fingers lose only 1 percent of their force, but they shake out a part of .5 kg. With an
impedance of .9999, they shake out even a part of 26 g.
"""
_ENAMEL: Final = [0.45, 0.33, 0.24, 1]
_COLOURS: Final = {"good": [0.30, 0.45, 0.32, 1], "bad": [0.52, 0.26, 0.24, 1]}


def add_hopper(spec: mujoco.MjSpec, friction: float, place: Place = ORIGIN, rim: float = DEEP) -> None:
    """Add the hopper at a place of the scene (m). By default, this place is under the hand when the x and y slides are
    at 0. A part that slides in the hopper has the friction of the hopper, not its own. The contact forces in the pile
    are computed with dense matrices. A part that falls off the table comes to rest on the floor.

    Args:
        rim: height of the hopper's walls over the table, m.
    """
    _solve_densely(spec)
    spec.geom("floor").conaffinity = 1  # touches parts, but not the arm
    hopper = spec.worldbody.add_body(name="hopper", pos=[*place, 0])

    def plate(size: list[float], pos: list[float], quat: list[float]) -> None:
        hopper.add_geom(
            type=mujoco.mjtGeom.mjGEOM_BOX, size=size, pos=pos, quat=quat, friction=[friction, 0.003, 0.0001],
            priority=1, rgba=_ENAMEL, group=1,
        )  # fmt: skip

    plate([HALF, HALF, FLOOR / 2], [0, 0, FLOOR / 2], [1, 0, 0, 0])
    run = RIM - HALF
    middle, high = HALF + run / 2, FLOOR + run / 2 * tan(SLOPE)
    sunk = middle + THICK * sin(SLOPE), high - THICK * cos(SLOPE)  # so that the upper side lies in the slope
    for way in (-1, 1):
        plate(
            [run / 2 / cos(SLOPE), RIM, THICK],
            [way * sunk[0], 0, sunk[1]],
            turned("y", -way * SLOPE).tolist(),
        )
        plate(
            [RIM, run / 2 / cos(SLOPE), THICK], [0, way * sunk[0], sunk[1]], turned("x", way * SLOPE).tolist()
        )
        plate([THICK, RIM, rim / 2], [way * (RIM + THICK), 0, rim / 2], [1, 0, 0, 0])
        plate([RIM, THICK, rim / 2], [0, way * (RIM + THICK), rim / 2], [1, 0, 0, 0])


def hold_firmly(spec: mujoco.MjSpec, parts: Sequence[str] = ()) -> None:
    """Change the contacts of the fingers so that light parts do not slowly slip out.

    Args:
        parts: names of the light parts, if the fingers also carry heavy parts.
    """
    for side, piece in product(("left", "right"), ("bar", "pad")):
        finger = spec.geom(f"{side}_{piece}")
        slide, turn, roll = finger.friction
        for part in parts:
            spec.add_pair(
                geomname1=finger.name, geomname2=part, condim=4, friction=[slide, slide, turn, roll, roll],
                solref=finger.solref.tolist(), solimp=PADS,
            )  # fmt: skip
        if not parts:
            finger.solimp[:] = PADS


def _solve_densely(spec: mujoco.MjSpec) -> None:
    """Let MuJoCo solve for the contact forces with dense matrices. By default, MuJoCo uses sparse matrices if the
    model has 60 or more degrees of freedom.

    MuJoCo 4.0.0 factorises the sparse Hessian wrongly for some patterns of contacts, for example if fingers touch
    parts of a pile, and these parts touch each other. Newton's method then ends after 100 iterations without a
    solution, and the wrong forces throw a part out of the pile, spinning at 1000 rad/s.
    """
    spec.option.jacobian = mujoco.mjtJacobian.mjJAC_DENSE


def solve_densely_while_bars_move(bench: Bench, bars: Sequence[str]) -> None:
    """Let MuJoCo use dense matrices only while at least two of the bars are awake. In a large scene, where many other
    parts touch each other, dense matrices take some 40 ms a step.
    """
    model, data = bench.model, bench.data
    trees = [int(model.body_treeid[model.body(bar).id]) for bar in bars]

    def choose() -> None:
        awake = np.count_nonzero(data.tree_asleep[trees] < 0)
        model.opt.jacobian = mujoco.mjtJacobian.mjJAC_DENSE if awake > 1 else mujoco.mjtJacobian.mjJAC_AUTO

    bench.before_step.append(choose)


def add_boxes(spec: mujoco.MjSpec) -> None:
    """Add the boxes for good and for bad parts."""
    for name, x in BOXES.items():
        add_bin_box(spec, name, Place(x * LINEAR, 0), TRAY, DEEP)


def add_bin_box(
    spec: mujoco.MjSpec, name: str, place: Place, half: tuple[float, float] = (BOX, BOX), high: float = HIGH
) -> None:
    """Add the box for good or for bad parts at a place of the scene (m).

    Args:
        half: half the inner lengths of the box along x and y, m.
        high: height of the box's walls over the table, m.
    """
    box = spec.worldbody.add_body(name=f"{name}_box", pos=[*place, 0])
    x, y = half
    for way in (-1, 1):
        for size, pos in (
            ([THIN, y, high / 2], [way * (x + THIN), 0, high / 2]),
            ([x, THIN, high / 2], [0, way * (y + THIN), high / 2]),
        ):
            box.add_geom(type=mujoco.mjtGeom.mjGEOM_BOX, size=size, pos=pos, rgba=_COLOURS[name], group=1)
