"""The values of one world of the pump, sorted by device and part. The simulated cell is built from these values."""

from dataclasses import dataclass, fields, replace
from typing import Self

import numpy as np

from handeye.cell.device_errors import CameraErrors
from handeye.cell.raster import Raster
from handeye.core.pose import Pose, pose, rotation, rotation_x, rotation_z
from handeye.core.variation import Overrides, World, WorldSpec
from handeye.tasks.stanford_cell.arm_world import ArmWorld, arm_values
from handeye.tasks.stanford_cell.dimensions import Point, dimensions, screw_holes
from handeye.tasks.water_pump.world.stations import stations
from handeye.tasks.water_pump.world.variation import (
    DRILLED,
    RUBBING,
    SCREWS,
    STOOD,
    USUAL,
    variation,
)


@dataclass(frozen=True, slots=True, kw_only=True)
class Light:
    """The lamp that lights the work, and the ambient light of the room."""

    zenith: float  # rad from the vertical
    azimuth: float  # rad from table x, direction from which the light comes
    strength: float
    ambient: float


@dataclass(frozen=True, slots=True, kw_only=True)
class Placing:
    """A placement error: a displacement (m), and turns about z and then about the turned y and x axes (rad)."""

    x: float = 0.0
    y: float = 0.0
    z: float = 0.0
    yaw: float = 0.0
    pitch: float = 0.0
    roll: float = 0.0

    def about(self, x: float, y: float, z: float = 0.0) -> Pose:
        """Return the pose that applies this error to a part and to everything fixed to the part. The error displaces
        the part, and turns it about the point (x, y, z) (m).
        """
        R = rotation_z(self.yaw) @ rotation(np.array([0.0, self.pitch, 0.0])) @ rotation_x(self.roll)
        p, error = np.array([x, y, z]), np.array([self.x, self.y, self.z])
        return pose(R, p + error - R @ p)


@dataclass(frozen=True, slots=True, kw_only=True)
class PumpWorld(ArmWorld):
    """One world of the pump, with the errors drawn for it."""

    base: Placing
    """The pump base on the belt, in W: its reference point, and the direction of the line between its two large holes.
    """
    camera: CameraErrors
    light: Light
    fixtures: dict[str, Placing]  # error of each fixture
    parts: dict[str, Placing]  # error of each part's place on its fixture, by body; pins have no error
    holes: dict[str, tuple[Point, ...]]
    """Errors (m) of the screw holes of each part in DRILLED. The keys are the names of the parts. The screw holes of
    the base are tapped.
    """
    part_mass: float  # scale of the masses of base and top
    thread_phase: tuple[float, ...]  # angle at which each thread starts, rad

    @classmethod
    def of(cls, world: World) -> Self:
        """Group the drawn values of a world by device and part."""
        numbers = range(1, round(world[SCREWS]) + 1)
        return cls(
            **arm_values(world, RUBBING),
            base=_placing(world, "base"),
            camera=_camera(world),
            light=Light(**{field.name: world[f"light.{field.name}"] for field in fields(Light)}),
            fixtures={station: _placing(world, f"fixtures.{station}") for station in stations()},
            parts=_parts(world),
            holes={
                part: tuple((world[f"holes.{part}.{k}.x"], world[f"holes.{part}.{k}.y"]) for k in numbers)
                for part in DRILLED
            },
            part_mass=1 + world["part_mass"],
            thread_phase=world.numbered("thread_phase"),
        )

    @classmethod
    def draw(cls, spec: WorldSpec) -> Self:
        """Draw the world of a specification. Raises InvalidInput if the specification does not fit this task."""
        return cls.of(variation().draw(spec))

    @classmethod
    def sample(cls, seed: int) -> Self:
        """Draw the world of a seed, with errors of nominal size."""
        return cls.draw(WorldSpec(seed=seed))

    @classmethod
    def nominal(cls, screws: int = 6) -> Self:
        """Return the world that plan and controller assume: no errors, no noise, no quantisation by converters,
        and no friction in the joints.
        """
        table = variation()
        everything = tuple(sorted({name.split(".")[0] for name in table.quantities}))
        smooth = {quantity.name: 0.0 for quantity in table.select("arm.friction")}
        made = smooth if screws == USUAL else {**smooth, SCREWS: float(screws)}
        return cls.draw(WorldSpec(seed=0, overrides=Overrides(without=everything, set=made)))

    @property
    def screws(self) -> int:
        """Number of screws of the pump."""
        return len(self.holes["base"])

    def drilled(self, part: str) -> tuple[Point, ...]:
        """Return the true positions of a part's screw holes in the part's frame (m)."""
        drawn = screw_holes(self.screws)
        return tuple((x + dx, y + dy) for (x, y), (dx, dy) in zip(drawn, self.holes[part], strict=True))


def _placing(world: World, name: str) -> Placing:
    """Return the placement error called `name`. Components that do not vary are zero."""
    ways = (field.name for field in fields(Placing))
    return Placing(**{way: world.values.get(f"{name}.{way}", 0.0) for way in ways})


def _parts(world: World) -> dict[str, Placing]:
    d = dimensions()
    screws_play = d("dispenser.hole_radius") - d("screw.shank_radius")
    numbers = range(1, round(world[SCREWS]) + 1)
    return {
        **{part: _placing(world, f"parts.{part}") for part in STOOD},
        "driver": _in_play(world, "parts.driver", d("rack.play")),
        **{f"screw{k - 1}": _in_play(world, f"parts.screws.{k}", screws_play) for k in numbers},
    }


def _in_play(world: World, name: str, play: float) -> Placing:
    """Return the placement error called `name`. The world gives x and y of this error as fractions of `play` (m)."""
    share = _placing(world, name)
    return replace(share, x=share.x * play, y=share.y * play)


def _camera(world: World) -> CameraErrors:
    def three(name: str, x: str, y: str, z: str) -> tuple[float, float, float]:
        return world[f"camera.{name}.{x}"], world[f"camera.{name}.{y}"], world[f"camera.{name}.{z}"]

    return CameraErrors(
        place=three("place", "x", "y", "z"),
        turn=three("turn", "pan", "tilt", "roll"),
        focal_scale=(1 + world["camera.focal_length.25mm"], 1 + world["camera.focal_length.50mm"]),
        pot_noise=world["camera.pot_noise"],
        lens_place=(
            three("lens.25mm", "ahead", "side", "up"),
            three("lens.50mm", "ahead", "side", "up"),
        ),
        raster=Raster(
            pincushion=world["camera.raster.pincushion"],
            lines=world["camera.raster.lines"],
            field=world["camera.raster.field"],
        ),
        drift=world["camera.raster.drift"],
    )
