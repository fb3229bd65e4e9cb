"""The second task: a small Cartesian arm picks up one block, and puts it down on a table."""

from dataclasses import replace
from functools import cache
from math import acos, degrees
from pathlib import Path
from typing import Final

import mujoco
import numpy as np
from robots import CARTESIAN, CARTESIAN_MJCF

from handeye import tasks
from handeye.al import compile_text
from handeye.cell.arm import SimulatedArm
from handeye.cell.device_errors import ArmErrors, HandErrors
from handeye.cell.hand import SimulatedHand
from handeye.cell.looks import SEEN
from handeye.cell.simulated import SimulatedCell
from handeye.cell.truth import Truth
from handeye.core.distributions import Normal, Range, Uniform
from handeye.core.source import Source, read_source
from handeye.core.units import INCH, OUNCE_FORCE
from handeye.core.variation import Overrides, Quantity, Variation, World, WorldSpec
from handeye.judge.finding import Findings, at_most
from handeye.planfile.plan import Plan
from handeye.planning.planner import make_plan
from handeye.program.taught import load_taught
from handeye.runs.runner import Runner
from handeye.runs.setup import Setup
from handeye.runs.snapshot import Checkpoint
from handeye.tasks.interface import Task, Words

SCRIPT: Final = Path(__file__).with_name("block.al")
EDGE: Final = 1.2
"""Edge of the block, in."""
HALF: Final = EDGE / 2 * INCH
"""m."""
FOOT: Final = HALF / 4
"""Half the height of the foot of a fin, m."""
GOAL: Final = np.array([30.0, 30.0]) * INCH
"""Where the block is to stand, x and y, m."""
STIFF: Final = [0.003, 1.0]
"""Time constant (s) and damping ratio of contacts with the block. With softer contacts, the fingers sink .05 in into
it.
"""
PLACE: Final = (
    0.3  # in: .2 across the finger line, where the hand feels nothing, and what is off with the arm
)
LEAN: Final = 1.0  # deg
HEIGHT: Final = 0.5  # mm, of its middle off half an edge

VARIATION: Final = Variation(
    Quantity(
        name="block.thickness", unit="in", distribution=Range(EDGE, EDGE), nominal=EDGE, limits=(0.02, EDGE),
        source="Along the finger line. Where it is less than the edge, the block is a fin on a foot.",
    ),
    *(
        Quantity(name=f"block.{axis}", unit="in", distribution=Uniform(0.2), source="Where the block stands.")
        for axis in "xy"
    ),
    *(
        Quantity(
            name=f"arm.offset.{joint}", unit="in", distribution=Normal(0.03), source="Potentiometers against joints."
        )
        for joint in (1, 2, 3)
    ),
)  # fmt: skip


class Block(Task):
    """Pick a block up and put it down elsewhere."""

    name = "block"
    arm = CARTESIAN
    park = np.array([24.0, 18.0, 0.0]) * INCH + np.array([0.0, 0.0, 0.8 - 12 * INCH])
    words = Words(product="the block", done="The block stands where it should.")

    def variation(self) -> Variation:
        return VARIATION

    def scene(self, spec: WorldSpec) -> mujoco.MjModel:
        world = VARIATION.draw(spec)
        scene = mujoco.MjSpec.from_string(CARTESIAN_MJCF)
        scene.option.timestep = 1 / 960
        scene.option.cone = mujoco.mjtCone.mjCONE_ELLIPTIC  # without it, a held block creeps away
        scene.option.impratio = 10
        scene.worldbody.add_camera(name="studio", pos=[0.6, -1.2, 1.0], xyaxes=[1, 0, 0, 0, 0.4, 0.9])
        scene.worldbody.add_geom(
            name="table", type=mujoco.mjtGeom.mjGEOM_BOX, size=[0.7, 0.7, 0.02], pos=[0.6, 0.7, -0.02],
            contype=1, conaffinity=3, group=SEEN,
        )  # fmt: skip
        block = scene.worldbody.add_body(
            name="block", pos=[20 * INCH + world["block.x"], 24 * INCH + world["block.y"], HALF]
        )
        block.add_freejoint(name="block")
        for size, height in _boxes(world["block.thickness"]):
            block.add_geom(
                type=mujoco.mjtGeom.mjGEOM_BOX, size=size, pos=[0.0, 0.0, height - HALF], mass=0.2, group=SEEN,
                contype=1, conaffinity=3, solref=STIFF, priority=1,
            )  # fmt: skip
        return scene.compile()

    def cell(self, spec: WorldSpec, camera: str) -> SimulatedCell:
        world = VARIATION.draw(spec)
        model = self.scene(spec)
        data = mujoco.MjData(model)
        noise = world.generator("sensors")
        return SimulatedCell(
            model, data, noise=noise,
            arm=SimulatedArm(model, data, "", arm=CARTESIAN, posture=self.park, errors=_errors(world), noise=noise),
            hand=SimulatedHand(model, data, "", hand=CARTESIAN.hand, errors=_switches(), noise=noise),
        )  # fmt: skip

    def judge(self, truth: Truth) -> Findings:
        model, data = truth.copy()
        mujoco.mj_step(model, data, 200)
        place, up = data.body("block").xpos, data.body("block").xmat[8]
        away = float(np.hypot(*(place[:2] - GOAL))) / INCH
        return {
            "place": at_most(away, PLACE, "in", "block from its place"),
            "height": at_most(abs(place[2] - HALF) * 1e3, HEIGHT, "mm", "middle of the block off its height"),
            "lean": at_most(degrees(acos(min(1.0, up))), LEAN, "deg", "lean of the block"),
        }


def _boxes(thickness: float) -> list[tuple[list[float], float]]:
    """Return the boxes of a block of the given thickness (m): their half sizes, and the heights of their middles."""
    if thickness > 2 * HALF - 1e-9:
        return [([HALF] * 3, HALF)]
    return [([HALF, HALF, FOOT], FOOT), ([HALF, thickness / 2, HALF - FOOT], HALF + FOOT)]


def _errors(world: World) -> ArmErrors:
    return replace(ArmErrors.none(3), offset=np.array(world.numbered("arm.offset")))


def _switches() -> HandErrors:
    return HandErrors(
        gap_offset=0.0, gap_scale=0.0, gap_noise=0.0, gap_step=0.0,
        switch_force=(2 * OUNCE_FORCE, 2 * OUNCE_FORCE), torque_noise=0.0,
    )  # fmt: skip


BLOCK: Final = Block()
tasks.register(BLOCK)


@cache
def block_plan(script: str | None = None) -> Plan:
    """Return the plan of a script for the small arm, with the positions in `block.toml`. By default, the script is
    `block.al`.
    """
    source = read_source(SCRIPT) if script is None else Source(name="small.al", text=script)
    program, problems = compile_text(source, load_taught(SCRIPT.with_suffix(".toml")))
    assert program is not None, problems
    plan, findings = make_plan(program, CARTESIAN, task="block")
    assert plan is not None, findings
    return plan


def block_run(script: str, seed: int = 0, **set: float) -> Runner:
    """Return a run that has not begun, of a script in the world of a seed, with some quantities set (SI)."""
    world = WorldSpec(seed=seed, overrides=Overrides(set=set))
    setup = Setup(plan=block_plan(script), world=world, camera="ray")
    return Runner(Checkpoint(setup=setup))
