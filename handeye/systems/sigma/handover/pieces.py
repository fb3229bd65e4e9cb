"""The pieces of the hand-over are round blocks. A pin stands out of the top of each block until arm 2 presses the pin
in.
"""

from typing import Final

import mujoco

from handeye.core.errors import BadArgument
from handeye.core.record import Record
from handeye.systems.sigma.gantries.world import ACROSS, GantryWorld

MOST: Final = 4
BEGIN_X: Final = 50.0  # mm: X of the pieces at the beginning
END_X: Final = 500.0  # mm: X of the finished pieces
APART: Final = 60.0  # mm: distance of two pieces along Y, and the Y of the first piece
HEIGHT: Final = 40.0  # mm, without the pin
RADIUS: Final = 14.0  # mm
PIN: Final = 5.0  # mm by which a pin stands out at first
_SPREAD: Final = 0.5  # mm by which a height differs at most from the nominal one
_FRICTION: Final = (6.0, 12.0)  # N: range of the friction that holds a pin
_PIN_RADIUS: Final = 3.0  # mm
_PIN_LENGTH: Final = 20.0  # mm
_PIN_MASS: Final = 0.004  # kg
_PIN_ARMATURE: Final = 0.2  # kg, so that friction holds a pin to less than .01 mm/s


class Piece(Record, frozen=True, kw_only=True):
    """A piece at its initial position (mm)."""

    name: str  # name of the piece's body
    x: float
    y: float
    height: float
    friction: float  # N: friction that holds the pin


def pin(name: str) -> str:
    """Return the name of the joint with which a piece's pin moves."""
    return f"{name}.pin"


def drawn(world: GantryWorld, count: int) -> tuple[Piece, ...]:
    """Return the pieces of a world. Raises BadArgument if there are too many pieces."""
    if not 1 <= count <= MOST:
        raise BadArgument(f"a hand-over must have 1 to {MOST} pieces, not {count}")
    numbers, pieces = world.numbers("handover"), list[Piece]()
    for number in range(1, count + 1):
        name = f"piece_{number}"
        pieces.append(
            Piece(
                name=name,
                x=round(BEGIN_X + 1000 * world.normal(f"{name}.x", ACROSS), 2),
                y=round(APART * number + 1000 * world.normal(f"{name}.y", ACROSS), 2),
                height=round(HEIGHT + float(numbers.uniform(-_SPREAD, _SPREAD)), 2),
                friction=round(float(numbers.uniform(*_FRICTION)), 2),
            )
        )
    return tuple(pieces)


def stand(spec: mujoco.MjSpec, pieces: tuple[Piece, ...]) -> None:
    """Add the pieces to the board."""
    style = spec.find_default("piece")
    for piece in pieces:
        body = spec.worldbody.add_body(name=piece.name, pos=[piece.x / 1000, piece.y / 1000, 0])
        body.add_freejoint(name=piece.name)
        half = piece.height / 2000
        cylinder = mujoco.mjtGeom.mjGEOM_CYLINDER
        body.add_geom(style, type=cylinder, size=[RADIUS / 1000, half, 0], pos=[0, 0, half])
        top = (piece.height + PIN - _PIN_LENGTH / 2) / 1000
        inner = body.add_body(name=pin(piece.name), pos=[0, 0, top], gravcomp=1)
        inner.add_joint(
            name=pin(piece.name),
            type=mujoco.mjtJoint.mjJNT_SLIDE,
            axis=[0, 0, -1],
            range=[0, PIN / 1000 + 0.001],
            frictionloss=piece.friction,
            armature=_PIN_ARMATURE,
            solref_friction=[0.004, 1],
            solimp_friction=[0.999, 0.9999, 0.001, 0.5, 2],
        )
        inner.add_geom(
            style,
            type=cylinder,
            size=[_PIN_RADIUS / 1000, _PIN_LENGTH / 2000, 0],
            mass=_PIN_MASS,
            rgba=[0.62, 0.64, 0.66, 1],
        )
