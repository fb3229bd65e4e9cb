"""Drives an arm: motions of its servo loop, with time passing."""

from collections.abc import Callable
from dataclasses import dataclass
from typing import Final

from handeye.arm.dynamics import Dynamics
from handeye.arm.samples import Samples
from handeye.core.pose import Array, Pose
from handeye.execution.compliance import Course
from handeye.execution.scheduler import run
from handeye.execution.servo import Motion, T
from handeye.execution.servo_loop import Outcome, ServoLoop
from handeye.touch.guards import Monitor

_STANDS: Final = 0.1
"""s in which the brakes bring the arm to rest. Chosen."""


@dataclass(slots=True, kw_only=True)
class ArmDrive(ServoLoop):
    """A servo loop alone under its clock: the only place of the working phase that lets time pass."""

    def brake(self, seconds: float) -> None:
        """Set the brakes and let time pass; the set-point becomes where the arm then is."""
        self._pass(self.braking(seconds))

    def stop(self) -> None:
        """Set the brakes, and wait until the arm stands."""
        self.brake(_STANDS)

    def float(self, seconds: float) -> None:
        """Let go of the arm and let time pass: gravity and load are balanced, and a push moves the hand."""
        self._pass(self.floating(seconds))

    def follow(
        self,
        samples: Samples,
        guard: Monitor | None = None,
        direction: Array | None = None,
        beside: Callable[[int], None] = lambda _: None,
    ) -> Outcome:
        """Follow set-points; end early when `guard` trips. See `following`."""
        return self._pass(self.following(samples, guard, direction, beside))

    def glide(
        self, samples: Samples, guard: Monitor | None = None, direction: Array | None = None
    ) -> Outcome:
        """Follow set-points through free air. See `gliding`."""
        return self._pass(self.gliding(samples, guard, direction))

    def comply(self, course: Course, guard: Monitor | None) -> Outcome:
        """Go straight, pressing, turning or giving way as the course says; end early when `guard` trips."""
        return self._pass(self.complying(course, guard))

    def shift(self, here: Dynamics, X_WT: Pose) -> Outcome:
        """One period towards a pose close by."""
        return self._pass(self.shifting(here, X_WT))

    def zero(self) -> Outcome:
        """Hold still, and take the force felt as zero. See `zeroing`."""
        return self._pass(self.zeroing())

    def hold(self, ticks: int) -> None:
        """Hold the set-point for some servo periods."""
        self._pass(self.holding(ticks))

    def _pass(self, motion: Motion[T]) -> T:
        (outcome,) = run(self.cell.clock, [motion])
        return outcome
