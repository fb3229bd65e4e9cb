"""Chooses chess pieces at random, and random positions for them along three lines of a board. The pieces have the
shapes of pieces turned from boxwood.
"""

from typing import Final, NamedTuple

import mujoco
import numpy as np

from handeye.core.errors import BadArgument
from handeye.core.record import Record
from handeye.systems.sigma.gantries.world import ACROSS, GantryWorld
from handeye.systems.sigma.run.plan import MOST_PIECES

LINES: Final = (50.0, 100.0, 150.0)  # mm: Y of the lines on which pieces stand at first
BY_HEIGHT: Final = (250.0, 300.0, 350.0)  # mm: Y of the lines for low, middle and high pieces
LIMITS: Final = (50.0, 70.0)  # mm: heights that separate low, middle and high pieces
_FIRST, _LAST = 30.0, 365.0  # mm: X of the first and the last possible piece
_GAP: Final = 30.0  # mm: least distance between two pieces, for an open hand
_SPREAD: Final = 1.5  # mm by which a height differs at most from that of the kind
_FOOT: Final = 4.0  # mm, half the height of a foot
_STEM: Final = (0.70, 0.56, 0.42)  # radii of the rings of a stem, from below; the foot has 1
_HEAD: Final = 8.5  # mm, the largest radius of a head


class Kind(NamedTuple):
    """A kind of piece, with its dimensions (mm)."""

    name: str
    height: float
    radius: float  # mm: radius of the foot


KINDS: Final = (
    Kind("pawn", 38, 11),
    Kind("rook", 46, 12.5),
    Kind("knight", 58, 13),
    Kind("bishop", 64, 13),
    Kind("queen", 78, 14),
    Kind("king", 92, 15),
)


class Piece(Record, frozen=True, kw_only=True):
    """A piece at its initial position (mm)."""

    name: str  # name of the piece's body
    kind: str
    height: float
    radius: float
    x: float
    y: float
    line: int  # from 1

    @property
    def goal(self) -> float:
        """Y coordinate (mm) of the line on which pieces of this height must stand."""
        return BY_HEIGHT[sum(self.height > limit for limit in LIMITS)]


def drawn(world: GantryWorld, count: int) -> tuple[Piece, ...]:
    """Choose the pieces of a board at random. Raises BadArgument if there are too many pieces."""
    if not 1 <= count <= MOST_PIECES:
        raise BadArgument(f"a board must have 1 to {MOST_PIECES} pieces, not {count}")
    numbers, pieces = world.numbers("pieces"), list[Piece]()
    first = int(numbers.integers(len(LINES)))
    for line in range(len(LINES)):
        here = count // len(LINES) + ((line - first) % len(LINES) < count % len(LINES))
        kinds = [KINDS[number] for number in numbers.integers(len(KINDS), size=here)]
        slack = _LAST - _FIRST - sum(2 * kind.radius for kind in kinds) - _GAP * max(0, here - 1)
        shares = np.sort(numbers.uniform(size=here)) * slack
        taken = _FIRST
        for kind, share in zip(kinds, shares, strict=True):
            name = f"piece_{len(pieces) + 1}"
            pieces.append(
                Piece(
                    name=name,
                    kind=kind.name,
                    height=round(kind.height + float(numbers.uniform(-_SPREAD, _SPREAD)), 2),
                    radius=kind.radius,
                    x=round(taken + float(share) + kind.radius, 2),
                    y=round(LINES[line] + 1000 * world.normal(f"{name}.y", ACROSS), 2),
                    line=line + 1,
                )
            )
            taken += 2 * kind.radius + _GAP
    return tuple(pieces)


def stand(spec: mujoco.MjSpec, pieces: tuple[Piece, ...]) -> None:
    """Add pieces to the board. Each piece consists of a foot, a tapered stem of three rings, and a round head."""
    for piece in pieces:
        body = spec.worldbody.add_body(name=piece.name, pos=[piece.x / 1000, piece.y / 1000, 0])
        body.add_freejoint(name=piece.name)
        style = spec.find_default("piece")

        def turned(
            radius: float,
            low: float,
            high: float,
            body: mujoco.MjsBody = body,
            style: mujoco.MjsDefault = style,
        ) -> None:
            body.add_geom(
                style,
                type=mujoco.mjtGeom.mjGEOM_CYLINDER,
                size=[radius / 1000, (high - low) / 2000, 0],
                pos=[0, 0, (low + high) / 2000],
            )

        head = min(_HEAD, 0.62 * piece.radius)
        top, low = piece.height - 1.84 * head, 2 * _FOOT
        turned(piece.radius, 0, low)
        ring = (top - low) / len(_STEM)
        for number, share in enumerate(_STEM):
            turned(share * piece.radius, low + number * ring, low + (number + 1) * ring)
        body.add_geom(
            style,
            type=mujoco.mjtGeom.mjGEOM_SPHERE,
            size=[head / 1000, 0, 0],
            pos=[0, 0, (piece.height - head) / 1000],
        )
