"""Defines the job `orient`, its worlds and its referee."""

from __future__ import annotations

from typing import TYPE_CHECKING, Final

import numpy as np

from handeye.core.distributions import Noise, Range
from handeye.core.units import MILLIMETRE
from handeye.core.variation import Variation
from handeye.judge.finding import Findings, at_least, at_most
from handeye.systems.ml.bench.bars import LONG, WIDE, add_bar, after, off_attitude, turned
from handeye.systems.ml.bench.faults import put_away
from handeye.systems.ml.bench.reporting import ReportingTask
from handeye.systems.ml.bench.station import Station, scene
from handeye.systems.ml.bench.world import ARM, ArmWorld, quantity
from handeye.systems.ml.machine.spec import LINEAR
from handeye.systems.ml.orient import faults
from handeye.systems.ml.orient.faults import FAULTS, TROUBLES
from handeye.tasks.interface import Words

if TYPE_CHECKING:
    from collections.abc import Sequence

    import mujoco

    from handeye.cell.truth import Truth
    from handeye.core.pose import Array

CRADLE: Final = (0, 3000)  # x and y of the slides, where the program expects the bar
STOP: Final = (-4000, -1500)  # x and y of the slides: axis of the stop that the bar is moved against
ASKED: Final = (3000, -2500, 0.100)  # where the bar is wanted: x and y of the slides, and m over the table
ATTITUDE: Final = 3.0  # deg
PLACED: Final = 1.0  # mm
STOP_RADIUS: Final = 0.004  # m: the stop fits between fingers that hold a bar
HIGH: Final = 0.050  # m: height of the middle of the bar over the table, in its cradle
_PITCH, _YAW = "cradle.pitch", "cradle.yaw"
_PLACE, _STOP, _FRICTION = "cradle.place", "stop.place", "bar.friction"
_OFF: Final = 0.003  # m by which a wrong bar is too narrow or too wide
_SHORTER: Final = 0.004  # m by which a short bar is too short
_PLATE: Final = (0.0025, 0.004, 0.0015)  # m: half sizes of the two plates on which the ends of the bar lie
_LIP: Final = (0.0025, 0.0015, 0.004)  # m: half sizes of the lip at the lower end
STOP_PLACE: Final = quantity(
    _STOP,
    "mm",
    Noise(0.05),
    1.0,
    "Standard deviation of the stop's position along x and y. No source: our choice, for a stop that is screwed "
    "on.",
)
VARIATION: Final = Variation(
    *ARM,
    quantity(
        _PITCH,
        "deg",
        Range(0.0, 50.0),
        50.0,
        "Pitch of the bar in its cradle; the seed determines which end is higher. From row 48 of docs/ml_checks.md.",
    ),
    quantity(
        _YAW,
        "deg",
        Range(0.0, 25.0),
        25.0,
        "Yaw of the bar in its cradle; the seed determines the direction. From row 48 of docs/ml_checks.md.",
    ),
    quantity(
        _PLACE,
        "mm",
        Noise(1.5),
        5.0,
        "Standard deviation of the cradle's position along x and y. No source: our choice, for a cradle placed by "
        "hand.",
    ),
    STOP_PLACE,
    quantity(
        _FRICTION,
        "",
        Range(0.3, 0.5),
        2.0,
        "Coefficient of friction of the bar on the table and on the cradle. No source: our choice.",
        0.4,
    ),
)


class Orient(ReportingTask):
    """Turn a bar into a known attitude."""

    name = "orient"
    words = Words(product="the bar", done="The bar has the required attitude and is at the required place.")
    quantities = VARIATION
    troubles = TROUBLES
    planted = FAULTS

    def station(self, world: ArmWorld) -> Station:
        """Return the station with the cradle and its bar, and with the stop."""
        spec = scene(world, wand=False)
        at = np.array(CRADLE) * LINEAR + [
            world.normal("cradle.x", _PLACE) + (world.fault(faults.CRADLE) or 0.0),
            world.normal("cradle.y", _PLACE),
        ]
        pitch, yaw = (world.value(name) * world.numbers(name).choice((-1, 1)) for name in (_PITCH, _YAW))
        friction = world.value(_FRICTION)
        wide = WIDE + _OFF * ((world.fault(faults.WIDE) or 0.0) - (world.fault(faults.NARROW) or 0.0))
        long = LONG - _SHORTER * (world.fault(faults.SHORT) or 0.0)
        _add_cradle(spec, at, pitch, yaw, friction, wide=wide, long=long)
        if world.fault(faults.MISSING) is not None:
            put_away(spec, "bar")
        moved = world.fault(faults.STOP) or 0.0
        if world.fault(faults.NO_STOP) is None:
            add_stop(spec, world, STOP, moved)
        return Station(spec, world)

    def judge(self, truth: Truth) -> Findings:
        bar = truth.data.body("bar")
        x, y, high = ASKED
        off = np.linalg.norm(bar.xpos - [x * LINEAR, -y * LINEAR, high])
        turn = off_attitude(bar.xmat.reshape(3, 3), np.array([0.0, 1.0, 0.0]), np.array([0.0, 0.0, 1.0]))
        touching = sum(_touch(truth, "bar", pad) for pad in ("left_pad", "right_pad"))
        return {
            "attitude": at_most(turn, ATTITUDE, "deg", "angle between the bar and the required attitude"),
            "place": at_most(
                float(off) / MILLIMETRE, PLACED, "mm", "distance of the bar from the required place"
            ),
            "held": at_least(touching, 2, "", "fingers that touch the bar"),
        }


def _touch(truth: Truth, one: str, other: str) -> bool:
    pair = {truth.model.geom(one).id, truth.model.geom(other).id}
    return any({*map(int, geoms)} == pair for geoms in truth.data.contact.geom)


def _add_cradle(
    spec: mujoco.MjSpec, at: Array, pitch: float, yaw: float, friction: float, *, wide: float, long: float
) -> None:
    """Add the bar and its cradle, at x and y of the slides (m). The ends of the bar lie on two narrow plates of the
    cradle. Each plate stands on a foot. The cradle has a lip at the lower end of the bar.
    """
    import mujoco

    middle = np.array([at[0], -at[1], HIGH])
    quat = after(turned("z", yaw), turned("x", pitch))
    add_bar(spec, "bar", middle, quat, friction, wide=wide, long=long)
    R, below = _matrix(quat), -WIDE / 2 - _PLATE[2]
    lower = -1 if pitch > 0 else 1  # a positive pitch lifts the end along y
    cradle = spec.worldbody.add_body(name="cradle", pos=middle.tolist(), quat=quat.tolist())
    colour = [0.30, 0.36, 0.46, 1]

    def box(body: mujoco.MjsBody, size: Sequence[float], place: Sequence[float]) -> None:
        body.add_geom(type=mujoco.mjtGeom.mjGEOM_BOX, size=size, pos=place, rgba=colour, group=1)

    for end in (-1, 1):
        plate = np.array([0, end * (LONG / 2 - _PLATE[1]), below])
        box(cradle, _PLATE, plate.tolist())
        x, y, z = middle + R @ plate
        box(spec.worldbody, (0.0022, 0.0022, z / 2), (x, y, z / 2))
    box(cradle, _LIP, (0, lower * (LONG / 2 + _LIP[1]), _LIP[2] - WIDE / 2 - 2 * _PLATE[2]))


def _matrix(quat: Array) -> Array:
    import mujoco

    flat = np.empty(9)
    mujoco.mju_quat2Mat(flat, quat)
    return flat.reshape(3, 3)


def add_stop(spec: mujoco.MjSpec, world: ArmWorld, place: tuple[int, int], moved: float = 0.0) -> None:
    """Add the stop, an upright pin. `place` is a place in coordinates of the slides. The stop is displaced from this
    place by its error in the world.

    Args:
        moved: a further displacement of the stop along y (m).
    """
    import mujoco

    at = np.array(place) * LINEAR + [
        world.normal("stop.x", _STOP),
        world.normal("stop.y", _STOP) + moved,
    ]
    spec.worldbody.add_geom(
        name="stop", type=mujoco.mjtGeom.mjGEOM_CYLINDER, size=[STOP_RADIUS, 0.02, 0], pos=[at[0], -at[1], 0.02],
        rgba=[0.62, 0.55, 0.30, 1], group=1,
    )  # fmt: skip


ORIENT: Final = Orient()
