"""The outlines that can be followed: a square, an L, a U and a disc, as plates that lie on the table."""

from typing import Final, NamedTuple

import mujoco
import numpy as np

from handeye.core.pose import Array
from handeye.systems.ml.follow.names import OutlineName
from handeye.systems.ml.machine.spec import LINEAR

HIGH: Final = 0.03  # m, height of a plate
CENTRE: Final = -0.0134  # m along x of the scene: place of the wand while the slides are at 0
PLATE: Final = "plate"
_DENSITY: Final = 2700.0  # kg/m3, aluminium
_ROUND: Final = 180  # corners of the polygon that stands for a circle


class Rectangle(NamedTuple):
    """A rectangle in the plane of the slides x and y, in units of these slides."""

    left: float
    right: float
    back: float
    front: float  # smaller y is farther ahead


class Outline(NamedTuple):
    """A plate. Lengths are in units of the slides x and y, and the slides are at 0 at the origin."""

    corners: tuple[tuple[float, float], ...]  # x, y of a polygon, in order around it
    parts: tuple[Rectangle, ...]  # rectangles of which the plate consists; none: the plate is a disc
    start: tuple[float, float]  # x, y of the wand, before the follower begins
    radius: float = 0.0

    @property
    def points(self) -> Array:
        """Corners of the outline, shape (n, 2). A disc is approximated by a polygon with many corners."""
        if not self.radius:
            return np.array(self.corners, dtype=float)
        turns = 2 * np.pi * np.arange(_ROUND) / _ROUND
        return self.radius * np.stack((np.cos(turns), np.sin(turns)), axis=1)


OUTLINES: Final[dict[OutlineName, Outline]] = {
    "square": Outline(
        corners=((-3000, -3000), (3000, -3000), (3000, 3000), (-3000, 3000)),
        parts=(Rectangle(-3000, 3000, 3000, -3000),),
        start=(-2500, 8000),
    ),
    "L": Outline(
        corners=((-4000, -4000), (4000, -4000), (4000, 0), (0, 0), (0, 4000), (-4000, 4000)),
        parts=(Rectangle(-4000, 4000, 0, -4000), Rectangle(-4000, 0, 4000, 0)),
        start=(-3500, 8000),
    ),
    "U": Outline(
        corners=(
            (-4000, -4000), (4000, -4000), (4000, 4000), (2000, 4000), (2000, -1000), (-2000, -1000), (-2000, 4000),
            (-4000, 4000),
        ),
        parts=(
            Rectangle(-4000, 4000, -1000, -4000),
            Rectangle(-4000, -2000, 4000, -1000),
            Rectangle(2000, 4000, 4000, -1000),
        ),
        start=(-3500, 8000),
    ),
    "disc": Outline(corners=(), parts=(), start=(0, 8000), radius=3000),
}  # fmt: skip


def lay(
    spec: mujoco.MjSpec, outline: Outline, off: tuple[float, float], turned: float, friction: float
) -> None:
    """Lay a plate on the table.

    Args:
        off: how far the plate is displaced from its nominal place, along x and y of the slides (m).
        turned: rotation of the plate about z of the slides (rad).
        friction: coefficient of friction between plate and table.
    """
    at = [CENTRE + off[0], -off[1], HIGH / 2]
    turn = [np.cos(turned / 2), 0, 0, -np.sin(turned / 2)]
    body = spec.worldbody.add_body(name=PLATE, pos=at, quat=turn)
    body.add_freejoint(name=PLATE)

    def shape(kind: mujoco.mjtGeom, size: list[float], at: tuple[float, float] = (0.0, 0.0)) -> None:
        body.add_geom(
            type=kind,
            size=size,
            pos=[at[0], at[1], 0],
            density=_DENSITY,
            friction=[friction, 0.003, 0.0001],
            rgba=[0.72, 0.73, 0.75, 1],
            group=1,
        )

    if outline.radius:
        shape(mujoco.mjtGeom.mjGEOM_CYLINDER, [outline.radius * LINEAR, HIGH / 2, 0])
    for left, right, back, front in outline.parts:
        size = [(right - left) / 2 * LINEAR, (back - front) / 2 * LINEAR, HIGH / 2]
        shape(mujoco.mjtGeom.mjGEOM_BOX, size, ((left + right) / 2 * LINEAR, -(back + front) / 2 * LINEAR))


def placed(points: Array, R: Array, centre: Array) -> Array:
    """Return where the points `points` of a plate lie on the table, shape (n, 2), in units of the slides. The plate
    has the true rotation `R`, shape (3, 3), and the plate's middle is at `centre` (m, shape (3,)) in the scene.
    """
    flat = np.array([[1.0, 0.0], [0.0, -1.0]])  # from coordinates of the slides to those of the scene
    lying = points * LINEAR @ flat @ R[:2, :2].T + centre[:2] - [CENTRE, 0.0]
    return np.asarray(lying @ flat / LINEAR)
