"""Drives a single arm: executes the arm's motions in a servo loop, and lets time pass."""

from collections.abc import Callable
from contextlib import closing
from dataclasses import dataclass
from typing import Final

from handeye.arm.dynamics import Dynamics
from handeye.arm.samples import Samples
from handeye.core.pose import Array, Pose
from handeye.execution.compliance import Course
from handeye.execution.servo import Motion, T
from handeye.execution.servo_loop import Outcome, ServoLoop
from handeye.touch.guards import Monitor

_STANDS: Final = 0.1
"""Time (s) in which the brakes bring the arm to rest. Our choice."""


@dataclass(slots=True, kw_only=True)
class ArmDrive(ServoLoop):
    """The servo loop of an arm that has the clock to itself. In the working phase, only this class lets time pass."""

    def brake(self, seconds: float) -> None:
        """Set the brakes and let time pass. The final position of the arm becomes the set-point."""
        self._pass(self.braking(seconds))

    def stop(self) -> None:
        """Set the brakes, and wait until the arm is at rest."""
        self.brake(_STANDS)

    def float(self, seconds: float) -> None:
        """Release the arm and let time pass. The drives balance gravity and load, so that a push moves the hand."""
        self._pass(self.floating(seconds))

    def exert(self, torque: Array) -> None:
        """Apply joint torques, shape (n,), for one servo period. The final position of the arm becomes the
        set-point.
        """
        self._pass(self.exerting(torque))

    def follow(
        self,
        samples: Samples,
        guard: Monitor | None = None,
        direction: Array | None = None,
        beside: Callable[[int], None] = lambda _: None,
    ) -> Outcome:
        """Follow set-points. The motion ends early if `guard` trips. See `following`."""
        return self._pass(self.following(samples, guard, direction, beside))

    def glide(
        self,
        samples: Samples,
        guard: Monitor | None = None,
        direction: Array | None = None,
        *,
        lift_off: int = 0,
    ) -> Outcome:
        """Follow set-points through free air. See `gliding`."""
        return self._pass(self.gliding(samples, guard, direction, lift_off))

    def comply(self, course: Course, guard: Monitor | None) -> Outcome:
        """Move along a straight course, pressing, turning or yielding as the course says. The motion ends early if
        `guard` trips.
        """
        return self._pass(self.complying(course, guard))

    def shift(self, here: Dynamics, X_WT: Pose) -> Outcome:
        """Move for one servo period towards a nearby pose."""
        return self._pass(self.shifting(here, X_WT))

    def zero(self) -> Outcome:
        """Hold still, and take the force sensed now as zero. See `zeroing`."""
        return self._pass(self.zeroing())

    def hold(self, ticks: int) -> None:
        """Hold the set-point for some servo periods."""
        self._pass(self.holding(ticks))

    def _pass(self, motion: Motion[T]) -> T:
        with closing(motion):
            try:
                while True:
                    self.cell.clock.advance(next(motion))
            except StopIteration as end:
                outcome: T = end.value
                return outcome
