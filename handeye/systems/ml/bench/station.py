"""A work station: a scene with the rectilinear arm, the arm's tools and the objects of a job. The scene may also have
the left arm.
"""

from collections.abc import Callable, Mapping, Sequence
from typing import Any, Final

import mujoco

from handeye.cell.bench import Bench
from handeye.cell.bench_axes import BenchOutputs
from handeye.cell.mechanism import Mechanism
from handeye.cell.snapshot_cell import SnapshotCell
from handeye.core.resources import scenes
from handeye.ports.axes import Axes, Outputs
from handeye.program.events import SystemEvent
from handeye.systems.ml.bench.faults import arm_of
from handeye.systems.ml.bench.left_arm import LeftArm
from handeye.systems.ml.bench.world import ArmWorld
from handeye.systems.ml.level import Side
from handeye.systems.ml.machine.rectilinear import LEFT, RIGHT
from handeye.systems.ml.machine.spec import ArmSpec
from handeye.systems.ml.realtime.machine import Machine

SCENE: Final = "rectilinear_arm/rectilinear_arm.xml"
CAMERA: Final = "people"
WAND: Final = "wand"
HAND: Final = ("separation", "angle")  # axes that the two fingers share
TABLE: Final = "table_1"  # the interlock of the work table, and the sensor of its load
FUSE: Final = 200.0  # N on the work table that blow its structural fuse


def scene(world: ArmWorld, *, wand: bool = True) -> mujoco.MjSpec:
    """Return the scene of the arm over an empty table, with or without the wand in the arm's left finger."""
    spec = mujoco.MjSpec.from_file(str(scenes() / SCENE))
    if not wand:
        for joint in ("wand_x", "wand_y"):
            spec.delete(spec.sensor(joint))
        spec.delete(spec.body(WAND))
        return spec
    for joint in ("wand_x", "wand_y"):
        spec.joint(joint).stiffness[0] *= world.wand_stiffness
    return spec


class Station:
    """The arm on a bench."""

    def __init__(
        self,
        spec: mujoco.MjSpec,
        world: ArmWorld,
        *,
        at: Mapping[int, float] | None = None,
        tools: Mapping[str, Callable[[float], None]] | None = None,
        others: Sequence[Mechanism[Any]] = (),
        left: bool = False,
    ) -> None:
        """Put the arm in a scene. The arm's pump is off.

        Args:
            at: a dictionary from the numbers of motors to the positions at which they begin (ML units). All other
                motors begin at 0.
            tools: a dictionary from the names of tools of the station to the functions that switch them. Other tools do
                nothing.
            others: further mechanisms of a job. The cell stores the states of these mechanisms, but the mechanisms do
                nothing as time passes.
            left: True if the scene also has the left arm.
        """
        self.bench = Bench(spec.compile())
        _stand(self.bench, at or {})
        self.arm = arm_of(self.bench, world)
        switched = dict.fromkeys(RIGHT.tools, _nothing) | dict(tools or {})
        self.outputs = BenchOutputs(self.bench, "outputs", switched)
        self.left = (LeftArm(self.bench), BenchOutputs(self.bench, "left_outputs", {})) if left else None
        self.others: Sequence[Mechanism[Any]] = others
        self._load = int(self.bench.model.sensor(TABLE).adr[0])
        self.bench.after_step.append(self._fuse)

    def _fuse(self) -> None:
        """Blow the fuse of the work table if the load on the table is too great. The interlock stays on until a person
        replaces the fuse.
        """
        if self.bench.data.sensordata[self._load] > FUSE:
            self.arm.signal(TABLE)

    def machine(self, tell: Callable[[SystemEvent], None] = lambda _: None) -> Machine:
        """Return the machine of the station, with a new real-time level."""
        arms: dict[Side, tuple[ArmSpec, Axes, Outputs]] = {"right": (RIGHT, self.arm, self.outputs)}
        if self.left is not None:
            arms["left"] = (LEFT, *self.left)
        return Machine(arms, self.bench, tell)

    def signal(self, interlock: str, *, on: bool) -> None:
        """Switch the signal of an interlock for all arms. In a real room, a person or a device would switch it."""
        self.arm.signal(interlock, on=on)
        if self.left is not None:
            self.left[0].signal(interlock, on=on)

    def cell(self) -> SnapshotCell:
        """Return the station as a cell whose state can be captured, restored and judged."""
        return self.bench.cell(*self.others)


def _nothing(value: float) -> None:
    """Do nothing: the program has switched a tool that the station lacks."""


def _stand(bench: Bench, at: Mapping[int, float]) -> None:
    """Set motors to positions (ML units)."""
    motors = {motor.number: motor for motor in RIGHT.motors}
    for number, place in at.items():
        axis, value = motors[number].axis, place * motors[number].unit
        fingers = [f"{side}_{axis}" for side in ("left", "right")] if axis in HAND else []
        for joint in fingers or [axis]:
            bench.data.joint(joint).qpos[0] = value / max(1, len(fingers))
    mujoco.mj_forward(bench.model, bench.data)
