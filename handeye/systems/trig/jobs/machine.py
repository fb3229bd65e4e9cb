"""The Purbrick arm as its machine's manual would describe it, and as the scene has it.

The paper tells of six axes, of which the platter has two, of two fingers, and of a force sensor in one of them. It
gives no figures: all of them are chosen, and said to be in scenes/purbrick_arm/README.md.
"""

import math
from collections.abc import Callable
from typing import Final

import mujoco

from handeye.cell.bench import Bench, BenchAxes
from handeye.core.pose import Array
from handeye.core.resources import scenes
from handeye.ports.axes import AxisSpec

PERIOD: Final = 0.01
"""s between two goals that its controller takes."""
_TURN: Final = math.radians(170)
SPECS: Final = (
    AxisSpec(name="x", kind="prismatic", lower=-0.2, upper=0.2, speed=0.2),
    AxisSpec(name="y", kind="prismatic", lower=-0.2, upper=0.2, speed=0.2),
    AxisSpec(name="z", kind="prismatic", lower=0.0, upper=0.3, speed=0.2),
    AxisSpec(name="roll", kind="revolute", lower=-_TURN, upper=_TURN, speed=1.0),
    AxisSpec(name="pitch", kind="revolute", lower=-_TURN, upper=_TURN, speed=1.0),
    AxisSpec(name="yaw", kind="revolute", lower=-_TURN, upper=_TURN, speed=1.0),
)
"""Values of X and Y are those of the hand over the platter."""
FORCE: Final = "force_"
"""How the channels of the finger's force begin, N."""


def scene() -> mujoco.MjSpec:
    """The arm and its platter, with nothing on it."""
    return mujoco.MjSpec.from_file(str(scenes() / "purbrick_arm" / "purbrick.xml"))


def machine(bench: Bench, bent: Callable[[Array], Array]) -> BenchAxes:
    """The arm of a bench, with how far its axes are from where their potentiometers tell them to be."""
    return BenchAxes(bench, SPECS, hand="hand", period=PERIOD, channels={FORCE: "strain"}, bent=bent)
