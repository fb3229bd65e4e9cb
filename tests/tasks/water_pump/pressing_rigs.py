"""Rigs for the hand: springs that the cell's arm presses on, and a weight on its fingers.

The hand presses as programs let it, by the servo loop; what it feels is the program's own estimate.
"""

from collections.abc import Callable, Iterator
from dataclasses import dataclass, field
from typing import Final

import mujoco
import numpy as np
from driving import Drive, tick
from static_rigs import Force, contact_wrench

from handeye.arm.dynamics import GRAVITY
from handeye.arm.ik import solve
from handeye.arm.robots.stanford import STANFORD
from handeye.cell.arm import SimulatedArm
from handeye.cell.hand import SimulatedHand
from handeye.cell.simulated import SimulatedCell
from handeye.core.pose import Array, Pose, hand
from handeye.core.units import DEGREE, INCH
from handeye.execution.compliance import Course
from handeye.execution.drive import ArmDrive
from handeye.execution.servo import ServoPeriod
from handeye.execution.state import DriveState
from handeye.tasks.stanford_cell.arm import ARM
from handeye.tasks.stanford_cell.dimensions import PARK
from handeye.tasks.water_pump.scene import specification
from handeye.tasks.water_pump.world.pump_world import PumpWorld

STIFFNESS: Final = 2000.0  # N/m
PRESS: Final = 20.0  # N
BALL: Final = 0.005  # m, radius
WEIGHT: Final = 1.0  # kg
MEAN: Final = 30  # servo periods over which the estimate is taken
NEAR: Final = hand(20 * INCH, 28 * INCH, 10 * INCH, 90 * DEGREE, 90 * DEGREE, 0.0)
FAR: Final = hand(38 * INCH, 36 * INCH, 14 * INCH, 20 * DEGREE, 90 * DEGREE, 0.0)
DOWN: Final = np.array([0.0, 0.0, -1.0])
ALONG_X: Final = np.array([1.0, 0.0, 0.0])
ASIDE: Final = 0.0363  # m, from the middle of the hand to that of a finger whose pad is .030 m off


@dataclass(slots=True, kw_only=True)
class Pressing:
    """The arm under its servo, and each period that the program saw."""

    cell: SimulatedCell
    drive: ArmDrive
    seen: list[ServoPeriod] = field(default_factory=list)

    def go(
        self,
        direction: Array,
        *,
        force: float | None = None,
        speed: float = 0.01,
        seconds: float = 3.5,
        then: Callable[[], None] = lambda: None,
    ) -> Array:
        """Press, or go, in a direction; `then` is done when the tare is taken.

        Returns:
            the wrench of the hand on the world as the program estimates it in the end, W, shape (6,).
        """
        k = STANFORD.compliance
        course = Course(compliance=k, direction=direction, distance=0.1, speed=speed, force=force)
        motion, period = self.drive.complying(course, None), STANFORD.servo.period
        for number in range(round(seconds / period)):
            if number == 3 * STANFORD.servo.settle:
                then()
            next(motion)
            self.cell.advance(period)
        felt = [each.wrench for each in self.seen[-MEAN:] if each.wrench is not None]
        return np.asarray(np.mean(felt, axis=0))

    def on(self, body: str) -> Array:
        """Contact force and moment of the fingers on a body, about the middle between their tips, in W, shape (6,)."""
        model, data = self.cell.truth.model, self.cell.truth.data
        tip = data.site(f"{ARM}tool").xpos
        fingers = (contact_wrench(model, data, body, f"{ARM}finger_{side}", tip) for side in "ab")
        return sum(fingers, np.zeros(6))

    def lever(self, body: str) -> float:
        """How far a body is from the middle of the hand, level, m."""
        data = self.cell.truth.data
        return float(np.hypot(*(data.body(body).xpos - data.site(f"{ARM}tool").xpos)[:2]))


def pressing(world: PumpWorld, X_WT: Pose, gap: float, added: Callable[[mujoco.MjSpec], None]) -> Pressing:
    """The hand at a pose under its servo, its fingers at a gap (m), with what is `added` to the cell's scene."""
    spec = specification(world)
    added(spec)
    model = spec.compile()
    data, noise = mujoco.MjData(model), world.generator("sensors")
    for side in "ab":
        data.joint(f"{ARM}finger_{side}").qpos = gap / 2
    q = solve(STANFORD, X_WT, PARK).q
    assert q is not None
    arm = SimulatedArm(model, data, ARM, arm=STANFORD, posture=q, errors=world.arm, noise=noise)
    fingers = SimulatedHand(model, data, ARM, hand=STANFORD.hand, errors=world.hand, noise=noise)
    cell = SimulatedCell(model, data, arm=arm, hand=fingers, noise=noise)
    tick(cell.devices, Drive(gap=gap, grip=80.0), 12)
    state, seen = DriveState.holding(cell.devices.sense(), STANFORD), []
    state.gap, state.friction = gap, world.arm_build.friction
    drive = ArmDrive(cell=cell.devices, arm=STANFORD, state=state, watch=seen.append)
    drive.hold(30)
    return Pressing(cell=cell, drive=drive, seen=seen)


def _pressed(
    world: PumpWorld, X_WT: Pose, direction: Array, at: Array, gap: float = 0.0
) -> tuple[Pressing, Array, float]:
    """The hand, what it feels, and the force (N) of a spring that it presses: its ball is `at` a place in T (m)."""

    def add(spec: mujoco.MjSpec) -> None:
        ball = spec.worldbody.add_body(name="ball", pos=X_WT[:3, :3] @ at + X_WT[:3, 3], gravcomp=1.0)
        slide = ball.add_joint(name="spring", type=mujoco.mjtJoint.mjJNT_SLIDE, axis=direction)
        slide.stiffness[0], slide.damping[0] = STIFFNESS, 40.0
        solid = spec.find_default("solid")
        ball.add_geom(solid, type=mujoco.mjtGeom.mjGEOM_SPHERE, size=[BALL, 0, 0], mass=0.2)

    rig = pressing(world, X_WT, gap, add)
    felt = rig.go(direction, force=PRESS)
    return rig, felt, STIFFNESS * float(rig.cell.truth.data.joint("spring").qpos[0])


def down(world: PumpWorld) -> Iterator[Force]:
    """Straight down, at two configurations."""
    for name, X_WT in (("near", NEAR), ("far out", FAR)):
        rig, felt, spring = _pressed(world, X_WT, DOWN, np.array([0, 0, BALL + 0.001]))
        yield Force(
            rig=f"the hand presses down a spring of 2 N/mm, {name}", what="down",
            reckoned=spring, simulated=float(rig.on("ball")[:3] @ DOWN), felt=float(felt[:3] @ DOWN),
        )  # fmt: skip


def sideways(world: PumpWorld) -> Iterator[Force]:
    """With the sides of the fingers, 10 mm above their tips."""
    at = NEAR[:3, :3].T @ ALONG_X * (STANFORD.hand.finger_width / 2 + BALL + 0.001) + [0, 0, -0.01]
    rig, felt, spring = _pressed(world, NEAR, ALONG_X, at)
    yield Force(
        rig="the hand presses a spring of 2 N/mm sideways", what="sideways",
        reckoned=spring, simulated=float(rig.on("ball")[:3] @ ALONG_X), felt=float(felt[:3] @ ALONG_X),
    )  # fmt: skip


def aside(world: PumpWorld) -> Iterator[Force]:
    """With one finger: a moment about the middle of the hand."""
    rig, felt, spring = _pressed(world, NEAR, DOWN, np.array([0, ASIDE, BALL + 0.001]), gap=0.06)
    axis = np.cross(NEAR[:3, 1], DOWN)
    yield Force(
        rig="the hand presses a spring with one finger, 36 mm from the middle of the hand", what="moment", unit="N m",
        reckoned=spring * rig.lever("ball"), felt=float(felt[3:] @ axis),
        simulated=float(rig.on("ball")[3:] @ axis),
    )  # fmt: skip


def weight(world: PumpWorld) -> Iterator[Force]:
    """A weight between the fingers that gravity takes hold of when the tare is taken; no LOAD tells of it."""

    def add(spec: mujoco.MjSpec) -> None:
        block = spec.worldbody.add_body(name="weight", pos=NEAR[:3, 3], gravcomp=1.0)
        block.add_freejoint()
        solid, half = spec.find_default("solid"), 0.5 * INCH
        block.add_geom(solid, type=mujoco.mjtGeom.mjGEOM_BOX, size=[half, half, half], mass=WEIGHT)

    rig = pressing(world, NEAR, 0.8 * INCH, add)

    def release() -> None:
        model = rig.cell.truth.model
        model.body_gravcomp[model.body("weight").id] = 0.0

    felt = rig.go(-DOWN, speed=1e-5, then=release)
    yield Force(
        rig="1 kg hung on the hand", what="up",
        reckoned=WEIGHT * GRAVITY, simulated=float(rig.on("weight")[2]), felt=float(felt[2]),
    )  # fmt: skip


RIGS: Final = (down, sideways, aside, weight)
