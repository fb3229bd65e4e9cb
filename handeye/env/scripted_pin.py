"""A scripted policy for `handeye/Pin-v0`. The hand makes guarded descents at the places of a spiral until it finds the
hole. It then presses the pin down to its seat.

The policy knows only the observations. The policy uses the servo of the working phase. This servo computes torques
from the readings, and estimates the force on the hand from torques and rates.
"""

from typing import Final

import numpy as np

from handeye.arm.friction import felt_friction
from handeye.arm.ik.result import IKResult
from handeye.arm.line import straight
from handeye.cell.compiled_arm import CompiledArm
from handeye.core.pose import Array
from handeye.env.policies import ArmFacts, Episode, Policy
from handeye.env.seen_cell import seen_cell
from handeye.env.spaces import ActionKind
from handeye.execution.compliance import Course
from handeye.execution.drive import ArmDrive
from handeye.execution.state import DriveState
from handeye.program.guards import Force
from handeye.touch.guards import monitor
from handeye.touch.spiral import spiral

NOSE: Final = 0.01905  # length of the pin's nose, m: scenes/water_pump/dimensions.toml
GAP_TO_FACE: Final = 0.0033  # from the pin's end to the face as taught, m: plans/insertion.toml
STEP: Final = 0.00178  # between two places of the spiral, m: .07 in, see docs/insertion.md
PLACES: Final = 121  # out to five steps on each side
SLOW: Final = 0.0028  # m/s where metal may meet metal: .11 in/s
QUICK: Final = 0.02  # m/s where nothing is in the way
FELT: Final = 7.0  # N that end a descent: 25 oz
PRESSED: Final = 30.0  # N with which the pin must stand on its shoulder
LIFTED: Final = 0.0015  # m over the face between two places
OFF: Final = 0.0015  # m by which the depth of a seated pin may differ from the length of its nose
SETTLED: Final = 0.0004  # m by which a pin on its shoulder still goes down under the greater force
_DOWN: Final = np.array([0.0, 0.0, -1.0])


class ScriptedPin(Policy):
    """Searches for the hole on a square spiral by touch, and inserts the pin."""

    facts: ArmFacts
    actions: tuple[ActionKind, ...] = ("torques",)
    environments = ("handeye/Pin-v0",)

    def play(self, episode: Episode) -> None:
        cell, clock = seen_cell(episode)
        arm = self.facts.arm
        state = DriveState.holding(cell.sense(), arm)
        state.friction, state.links, state.gap = self.facts.friction, self.facts.links, 0.0
        drive = ArmDrive(cell=cell, arm=arm, state=state, arithmetic=CompiledArm)
        start = drive.hand()[:3, 3]
        face = float(start[2]) - GAP_TO_FACE
        touched = False
        for k in range(PLACES):
            x, y = spiral(k)
            height = face + LIFTED if touched else float(start[2])
            self._go(drive, np.array([start[0] + x * STEP, start[1] + y * STEP, height]))
            if self._down(drive, height - face + LIFTED, SLOW, FELT):
                face, touched = self._height(drive), True
                continue
            if self._seated(drive, face):
                clock.done()
            self._go(drive, np.array([*drive.hand()[:2, 3], face + LIFTED]))

    def _go(self, drive: ArmDrive, place: Array) -> None:
        """Move the hand to a place: first straight up or down, then straight across."""
        here = drive.chain.forward(drive.state.q)[:3, 3]
        for way in (np.array([0.0, 0.0, place[2] - here[2]]), np.array([*(place - here)[:2], 0.0])):
            samples = straight(drive.arm, drive.state.q, way, QUICK) if way.any() else None
            if samples is not None and not isinstance(samples, IKResult):
                drive.follow(samples)

    def _down(self, drive: ArmDrive, distance: float, speed: float, force: float) -> bool:
        """Go down, and yield sideways. Returns True if a force stopped the hand before the hand had moved by
        `distance` (m).
        """
        friction = np.abs(felt_friction(drive.arm, drive.state.q, drive.state.friction)).sum(axis=1)
        course = Course(
            compliance=drive.arm.compliance, direction=_DOWN, distance=distance, speed=speed,
            free=np.array([1.0, 1.0, 0.0]), friction=friction,
        )  # fmt: skip
        return drive.comply(course, monitor((Force(force=(0.0, 0.0, -force)),))).trip is not None

    def _seated(self, drive: ArmDrive, face: float) -> bool:
        """Push down a pin whose nose is in the hole. Returns True if the pin then stands on its shoulder."""
        if self._down(drive, NOSE - 3 * LIFTED, QUICK, PRESSED) or not self._down(
            drive, 0.01, SLOW, PRESSED / 2
        ):
            return False
        first = self._height(drive)
        pressed = self._down(drive, 0.01, SLOW, PRESSED)
        last = self._height(drive)
        return pressed and first - last < SETTLED and abs(face - last - NOSE) < OFF

    def _height(self, drive: ArmDrive) -> float:
        """Return the measured height of the hand (m, in W)."""
        return float(drive.hand()[2, 3])
