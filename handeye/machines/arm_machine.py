"""An arm with axes and a hand, as a value. The value contains the specification from the arm's manual, and the
function that puts the arm on a bench.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from typing import TYPE_CHECKING

import numpy as np

from handeye.core.pose import Array
from handeye.core.resources import scenes
from handeye.ports.axes import AxisSpec, Channel

if TYPE_CHECKING:  # for types only: the limits of a machine are also read where there is no simulator
    import mujoco

    from handeye.cell.bench import Bench
    from handeye.cell.bench_axes import BenchAxes


@dataclass(frozen=True, slots=True, kw_only=True)
class HandlingLimits:
    """Limits of speed while an object is held, and of force at the finger. Tuples have one number for each axis."""

    acceleration: tuple[float, ...]  # m/s2 and rad/s2
    guarded_speed: tuple[float, ...]  # m/s and rad/s of a guarded move
    settling: float  # s to wait after a move, until the servos have settled
    standing: tuple[float, ...]  # m and rad, greatest distance of an axis at rest from its goal
    lag: float  # s, greatest lag of a moving axis behind its goal
    open: float  # goal that opens the hand, m between the fingers; `closed` likewise
    closed: float
    grasping: float  # s to wait after a goal of the hand
    carried: (
        float  # N, upwards on the finger; a greater force shows that something else carries the held object
    )
    resistance: float  # N, on the finger; a greater force on the way back shows an obstacle


@dataclass(frozen=True, slots=True, kw_only=True)
class ArmMachine:
    """An arm with axes, a hand, and a finger that senses force."""

    name: str
    scene_file: str  # below the folder of scenes, or an absolute path
    period: float  # least time between two goals that its controller accepts, s
    axes: tuple[AxisSpec, ...]
    hand: AxisSpec
    force: Channel  # force that the finger exerts, N, shape (3,)
    force_sensor: str  # the sensor of the scene that measures it
    limits: HandlingLimits

    @property
    def specs(self) -> tuple[AxisSpec, ...]:
        """Specifications of the axes, with the hand as the last axis."""
        return (*self.axes, self.hand)

    def scene(self) -> mujoco.MjSpec:
        """Build the scene that contains only the arm."""
        import mujoco  # here: names and limits of machines are read without a simulator

        return mujoco.MjSpec.from_file(str(scenes() / self.scene_file))

    def on_bench(self, bench: Bench, bent: Callable[[Array], Array] = np.zeros_like) -> BenchAxes:
        """Put the arm in the scene of a bench. `bent` takes the potentiometer readings of the axes, without the hand.
        It returns the difference between the true and the indicated positions of these axes.
        """
        from handeye.cell.bench_axes import BenchAxes, sensor

        def bent_axes(q: Array) -> Array:
            return np.append(bent(q[:-1]), 0.0)

        return BenchAxes(
            bench, self.specs, period=self.period, name=self.name,
            channels={self.force: sensor(self.force_sensor)}, at_once=[self.hand.name], bent=bent_axes,
        )  # fmt: skip
