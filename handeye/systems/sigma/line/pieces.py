"""The pieces of the assembly line: round blocks, each with two pins that stand out of its top until
they are pressed in."""

from typing import Final

import mujoco

from handeye.core.errors import BadArgument
from handeye.core.record import Record
from handeye.core.units import MILLIMETRE
from handeye.systems.sigma.gantries.machine import SWITCHED_ON_AT
from handeye.systems.sigma.gantries.world import ACROSS, SWITCHES, GantryWorld
from handeye.systems.sigma.line.scene import CELL, TOP, TRAY_X, TRAY_Y
from handeye.systems.sigma.motors.rotor import STEP

MOST: Final = 4
HEIGHT: Final = 40.0  # mm, without the pins
RADIUS: Final = 14.0  # mm
PIN: Final = 5.0  # mm by which a pin stands out at first
PIN_X: Final = 7.0  # mm along X from the middle of a piece to each of its pins
BELT_X, BELT_Y = 1150.0, 80.0  # mm: place at which arm 4 puts finished pieces on the belt
PITCH: Final = 70.0  # mm by which the belt advances
_PUT: Final = 4  # stops of the belt from where a piece is loaded to where it is put back
_STOPS: Final = 8  # number of times that the belt advances
_SPREAD: Final = 0.5  # mm by which a height differs at most from the nominal one
_FRICTION: Final = (6.0, 12.0)  # N: range of the friction that holds a pin
_PIN_RADIUS: Final = 2.5  # mm
_PIN_LENGTH: Final = 20.0  # mm
_PIN_MASS: Final = 0.003  # kg
_PIN_ARMATURE: Final = 0.2  # kg, so that friction holds a pin to less than .01 mm/s
PINS: Final = ("a", "b")  # pressed in by the first SUPERSIGMA, and by the second one


class LinePiece(Record, frozen=True, kw_only=True):
    """A piece on the feeder's tray, as it lies when the power is switched on. Lengths are in mm."""

    name: str  # name of the piece's body
    x: float
    y: float
    height: float
    friction: tuple[float, ...]  # N: friction that holds each pin

    @property
    def number(self) -> int:
        """The number of the piece, counted from 1."""
        return int(self.name.rsplit("_", 1)[1])

    @property
    def goal(self) -> tuple[float, float]:
        """Place of the piece on the belt (mm), after the last advance of the belt."""
        return BELT_X + PITCH * (_STOPS - _PUT - (self.number - 1)), BELT_Y


def pin(piece: str, which: str) -> str:
    """Return the name of the joint with which a pin of a piece moves."""
    return f"{piece}.{which}"


def drawn(world: GantryWorld, count: int) -> tuple[LinePiece, ...]:
    """Return the pieces of a world. The pieces fill the cells of the tray in order. Raises BadArgument if there are too
    many pieces.
    """
    if not 1 <= count <= MOST:
        raise BadArgument(f"the feeder must have 1 to {MOST} pieces, not {count}")
    numbers, pieces = world.numbers("line"), list[LinePiece]()
    first = [
        (middle + SWITCHED_ON_AT * STEP + world.normal(f"{SWITCHES}.{axis}", SWITCHES)) / MILLIMETRE
        for axis, middle in (("X5", TRAY_X), ("Y5", TRAY_Y))
    ]
    for number in range(count):
        name = f"piece_{number + 1}"
        row, column = divmod(number, 2)
        pieces.append(
            LinePiece(
                name=name,
                x=round(
                    first[0] - CELL / MILLIMETRE * column + world.normal(f"{name}.x", ACROSS) / MILLIMETRE, 2
                ),
                y=round(
                    first[1] - CELL / MILLIMETRE * row + world.normal(f"{name}.y", ACROSS) / MILLIMETRE, 2
                ),
                height=round(HEIGHT + float(numbers.uniform(-_SPREAD, _SPREAD)), 2),
                friction=tuple(round(float(numbers.uniform(*_FRICTION)), 2) for _ in PINS),
            )
        )
    return tuple(pieces)


def stand(spec: mujoco.MjSpec, pieces: tuple[LinePiece, ...]) -> None:
    """Put the pieces on the tray of the feeder."""
    style, cylinder = spec.find_default("piece"), mujoco.mjtGeom.mjGEOM_CYLINDER
    for piece in pieces:
        body = spec.worldbody.add_body(name=piece.name, pos=[piece.x / 1000, piece.y / 1000, TOP])
        body.add_freejoint(name=piece.name)
        half = piece.height / 2000
        body.add_geom(style, type=cylinder, size=[RADIUS / 1000, half, 0], pos=[0, 0, half])
        top = (piece.height + PIN - _PIN_LENGTH / 2) / 1000
        for which, friction, side in zip(PINS, piece.friction, (-1, 1), strict=True):
            inner = body.add_body(name=pin(piece.name, which), pos=[side * PIN_X / 1000, 0, top], gravcomp=1)
            inner.add_joint(
                name=pin(piece.name, which),
                type=mujoco.mjtJoint.mjJNT_SLIDE,
                axis=[0, 0, -1],
                range=[0, PIN / 1000 + 0.001],
                frictionloss=friction,
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
