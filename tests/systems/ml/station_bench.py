"""The rectilinear arm with physics, for tests: its real-time level, and the truth."""

from collections.abc import Callable
from typing import Final

import mujoco
import numpy as np

from handeye.core.units import DEGREE
from handeye.core.variation import Overrides, WorldSpec
from handeye.program.events import SystemEvent
from handeye.systems.ml.bench.station import Station, scene
from handeye.systems.ml.bench.world import ArmWorld
from handeye.systems.ml.level import Post

UNIT: Final = 25.4e-6  # m
ANGLE: Final = DEGREE / 100  # rad
NAMES: Final = {1: "base", 2: "z", 3: "y", 4: "x", 8: "roll", 9: "yaw", 10: "pitch"}


def world(seed: int | None, **values: float) -> ArmWorld:
    """A world of a seed, with quantities set to SI values; `slides_bend` stands for `slides.bend`."""
    if seed is None:
        return ArmWorld()
    found = {name.replace("_", ".", 1): value for name, value in values.items()}
    return ArmWorld(WorldSpec(seed=seed, overrides=Overrides(set=found)))


class Arm:
    """The arm at a station, switched on."""

    def __init__(
        self,
        seed: int | None = None,
        *,
        add: Callable[[mujoco.MjSpec], object] = lambda _: None,
        at: dict[int, float] | None = None,
        wand: bool = True,
        enabled: bool = True,
    ) -> None:
        errors = world(seed)
        spec = scene(errors, wand=wand)
        add(spec)
        self.events: list[SystemEvent] = []
        self.station = Station(spec, errors, at=at)
        self.data = self.station.bench.data
        self.machine = self.station.machine(self.events.append)
        self.level = self.machine.levels["right"]
        if enabled:
            self.level.enable()
        self.cycles(1)

    def cycles(self, count: int) -> None:
        for _ in range(count):
            self.machine.cycle()

    def go(self, **goals: float) -> Post:
        """Start a motion of motors (`m3=2000`) and wait until it has ended."""
        if self.level.start({int(name[1:]): round(goal) for name, goal in goals.items()}):
            while not self.level.posted:
                self.machine.cycle()
        return self.level.posted

    def truth(self, motor: int) -> float:
        """True position of a motor before the hand, ML units."""
        unit = UNIT if motor in (2, 3, 4) else ANGLE
        return float(self.data.joint(NAMES[motor]).qpos[0]) / unit

    def tip(self) -> np.ndarray:
        """True place of the middle between the fingertips, m."""
        hand = self.data.body("hand")
        return np.asarray(hand.xpos + hand.xmat.reshape(3, 3) @ [0, 0, -0.15])
