"""Makes pictures of the pump base on the belt, for benchmarks of vision alone."""

from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from typing import Final

from handeye.core.variation import Overrides, WorldSpec
from handeye.ports.camera import CLOSE_UP, WIDE, Picture
from handeye.program.program import Part
from handeye.tasks.water_pump.trials.still_pump import StillPump, base_poses, look, pump_base, put_base
from handeye.tasks.water_pump.world.pump_world import PumpWorld
from handeye.vision.camera_model import View
from handeye.vision.hole_search import hole_places

WORLD_POSES: Final = 4
"""Number of poses in each world; all have the same light."""


@dataclass(frozen=True, slots=True, kw_only=True)
class Sight:
    """A part in a distant and in a close picture, taken by a camera whose model is exact."""

    part: Part
    pose: tuple[float, float, float]
    """True pose of the part: x, y (m) and yaw (rad) in W."""
    far: tuple[Picture, View]
    near: tuple[Picture, View]


def sights(number: int, camera: str) -> Iterator[Sight]:
    """Yield `number` sights, in the worlds from seed 0 on. Their cameras are exactly as designed, so all errors are
    those of vision.

    Raises:
        InvalidInput: this renderer does not work here.
    """
    for seed in range(-(-number // WORLD_POSES)):
        spec = WorldSpec(seed=seed, overrides=Overrides(without=("camera",)))
        still = StillPump(PumpWorld.draw(spec), renderer=camera)
        yield from _of_world(still, min(WORLD_POSES, number - seed * WORLD_POSES))


def _of_world(still: StillPump, number: int) -> Iterator[Sight]:
    part = pump_base()
    for pose in base_poses(still.world, number):
        x, y, yaw = pose
        put_base(still, (x, y, part.at[2], yaw), pins=False)
        middle = hole_places(part, pose).mean(axis=0)
        yield Sight(
            part=part, pose=pose, far=_seen(still, WIDE, part.at[:3]), near=_seen(still, CLOSE_UP, middle)
        )


def _seen(still: StillPump, lens: float, point: Sequence[float]) -> tuple[Picture, View]:
    x, y, z = map(float, point)
    view = look(still.camera, still.true_camera, lens, (x, y, z))
    return still.camera.digitise(), view
