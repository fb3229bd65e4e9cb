"""The pieces of the insertion are square pegs, and plates with one square hole each. The pegs stand in front of a
rack, and each peg is rotated by up to 20 degrees.

A plate is held only by its friction on the board, and a peg only by the friction of the fingers.
"""

from typing import Final

import mujoco
import numpy as np

from handeye.core.errors import BadArgument
from handeye.core.record import Record
from handeye.systems.sigma.gantries.world import ACROSS, GantryWorld

MOST: Final = 4
OFF: Final = 3.0  # mm: greatest distance of a plate from its place in the drawing
TURNED: Final = 20.0  # deg: greatest rotation of a peg
SIDE: Final = 20.0  # mm: side of the square section of a peg
HIGH: Final = 50.0  # mm: height of a peg
HOLE: Final = 21.0  # mm, the side of a hole
THICK: Final = 18.0  # mm: thickness of a plate; its hole goes through
RACK_X: Final = 300.0  # mm: X of the middle of a peg that touches wall and tooth of the rack
_BEFORE: Final = 8.0  # mm along X and Y from that place to the place of a peg at the beginning
_PLATES_X: Final = (100.0, 500.0)  # mm: X of the plates of arm 1 and of arm 2 in the drawing
_PLATE: Final = 70.0  # mm, the side of a plate
_WALL: Final = (6.0, 10.0)  # mm, thickness and height of the rack
_PEG_DENSITY: Final = 2700.0  # kg/m3, aluminium
_PLATE_DENSITY: Final = 7850.0  # kg/m3, steel


class Peg(Record, frozen=True, kw_only=True):
    """The initial places of a peg and of the plate with the peg's hole (mm)."""

    name: str  # name of the peg's body; with a prefix, of the plate's body
    x: float
    y: float
    turned: float  # deg
    plate_x: float
    plate_y: float

    @property
    def plate(self) -> str:
        """The name of the body of the plate."""
        return f"plate_{self.name}"


def rack_y(number: int) -> float:
    """Return the Y coordinate (mm) of a place in the rack. Places are numbered from 1; arm 1 uses the places with odd
    numbers.
    """
    return 80.0 * number - 20.0


def drawn(world: GantryWorld, count: int) -> tuple[Peg, ...]:
    """Return the pegs of a world, with their plates. Raises BadArgument if there are too many pegs."""
    if not 1 <= count <= MOST:
        raise BadArgument(f"an insertion must have 1 to {MOST} pegs, not {count}")
    numbers, pegs = world.numbers("insert"), list[Peg]()
    for number in range(1, count + 1):
        name = f"peg_{number}"
        way, far = numbers.uniform(0, 2 * np.pi), OFF * np.sqrt(numbers.uniform())  # uniform over a disc
        pegs.append(
            Peg(
                name=name,
                x=round(RACK_X - _BEFORE + 1000 * world.normal(f"{name}.x", ACROSS), 2),
                y=round(rack_y(number) - _BEFORE + 1000 * world.normal(f"{name}.y", ACROSS), 2),
                turned=round(float(numbers.uniform(-TURNED, TURNED)), 1),
                plate_x=round(_PLATES_X[(number + 1) % 2] + float(far * np.cos(way)), 2),
                plate_y=round(180.0 * ((number + 1) // 2) - 80.0 + float(far * np.sin(way)), 2),
            )
        )
    return tuple(pegs)


def stand(spec: mujoco.MjSpec, pegs: tuple[Peg, ...]) -> None:
    """Add the rack, the pegs and their plates to the board."""
    _rack(spec)
    style, box = spec.find_default("piece"), mujoco.mjtGeom.mjGEOM_BOX
    rim, inner = (_PLATE - HOLE) / 4000, (_PLATE + HOLE) / 4000  # m: half the width of a rim, and its middle
    for peg in pegs:
        half = np.radians(peg.turned) / 2
        body = spec.worldbody.add_body(
            name=peg.name,
            pos=[peg.x / 1000, peg.y / 1000, HIGH / 2000],
            quat=[np.cos(half), 0, 0, np.sin(half)],
        )
        body.add_freejoint(name=peg.name)
        body.add_geom(
            style, type=box, size=[SIDE / 2000, SIDE / 2000, HIGH / 2000], density=_PEG_DENSITY,
            rgba=[0.86, 0.62, 0.20, 1],
        )  # fmt: skip
        plate = spec.worldbody.add_body(
            name=peg.plate, pos=[peg.plate_x / 1000, peg.plate_y / 1000, THICK / 2000]
        )
        plate.add_freejoint(name=peg.plate)
        for sign in (-1, 1):
            for size, pos in (
                ([rim, _PLATE / 2000, THICK / 2000], [sign * inner, 0, 0]),
                ([HOLE / 2000, rim, THICK / 2000], [0, sign * inner, 0]),
            ):
                plate.add_geom(
                    style, type=box, size=size, pos=pos, density=_PLATE_DENSITY, rgba=[0.60, 0.62, 0.66, 1]
                )


def _rack(spec: mujoco.MjSpec) -> None:
    """Add the rack, which is screwed to the board: a wall, and a tooth for each place."""
    thick, high = _WALL[0] / 2000, _WALL[1] / 2000
    face = (RACK_X + SIDE / 2) / 1000
    length = (rack_y(MOST) - rack_y(1) + 3 * SIDE) / 2000
    middle = (rack_y(MOST) + rack_y(1)) / 2000
    wall = mujoco.mjtGeom.mjGEOM_BOX
    colour, friction = [0.30, 0.33, 0.38, 1], [0.4, 0.005, 0.0001]
    spec.worldbody.add_geom(
        name="rack", type=wall, size=[thick, length, high], pos=[face + thick, middle, high], rgba=colour,
        friction=friction, group=2,
    )  # fmt: skip
    for number in range(1, MOST + 1):
        spec.worldbody.add_geom(
            name=f"tooth_{number}", type=wall, size=[SIDE / 2000, thick, high],
            pos=[RACK_X / 1000, (rack_y(number) + SIDE / 2) / 1000 + thick, high], rgba=colour, friction=friction,
            group=2,
        )  # fmt: skip
