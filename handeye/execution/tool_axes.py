"""Lets a program command an arm by axes: the axes of the tool, and the gap of the hand. The arm's own servo moves the
joints.
"""

from dataclasses import replace
from math import pi
from typing import Final

import numpy as np

from handeye.arm.kinematics import forward
from handeye.core.errors import ERRORS, BadArgument, Refused
from handeye.core.pose import Array, hand, hand_angles
from handeye.execution.drive import ArmDrive
from handeye.execution.servo import Motion
from handeye.execution.servo_loop import Outcome
from handeye.ports.axes import Axes, AxesReading, AxisSpec, Channel

SPEED: Final = 0.2  # m/s. At this speed, up to 7 N are sensed in free air; at .025 m/s, 2.5 N.
TURNING: Final = 1.0  # rad/s; our choice
FORCE: Final = Channel(name="force", unit="N", width=3)
MOMENT: Final = Channel(name="moment", unit="N m", width=3)
TOUCH: Final = Channel(name="touch", width=2)
TOOL_TORQUE: Final = Channel(name="tool_torque", unit="N m")
_AXES: Final = ("x", "y", "z", "o", "a", "t")


class ToolAxes(Axes):
    """The axes x, y, z (m, in W), O, A, T (rad) and the gap of the hand (m). A channel gives the force that the
    hand exerts on the world.

    Each goal moves the arm for one servo period, in the direction of the goal. No axis exceeds its speed limit. No
    path is planned: the caller must give a goal in every period, or the watchdog sets the brakes. Force is measured
    relative to the force at the last call of `tare`. The estimate of the force is good if the drive knows the friction
    of the joints (`measure_joints`). The estimate is one period late. For example, a descent onto the table that
    should stop at 6 N stops at a greater force: at 6.1 to 7.5 N if the speed is .01 m/s, at 17 N at .025 m/s, and at
    34 N at .05 m/s.
    """

    def __init__(self, drive: ArmDrive, name: str = "tool", reach: float = 1.5) -> None:
        """Take control of an arm that the servo holds in place. The coordinates x, y and z of a goal must be between
        -`reach` and `reach` (m), and the arm must be able to reach the goal.
        """
        self.name, self._drive = name, drive
        self._start = self._goal = self._pose(drive.state.q)  # set-points before and at the end of a period
        self._put_at = 0.0  # s
        self._motion: Motion[Outcome] | None = None
        gap, grip = drive.arm.hand.gap_max, drive.arm.hand.grip
        self._specs = (
            *(_axis(axis, -reach, reach) for axis in _AXES[:3]),
            *(replace(_axis(axis, -pi, pi), kind="revolute", speed=TURNING) for axis in _AXES[3:]),
            replace(_axis("gap", 0.0, gap), speed=drive.arm.hand.gap_speed, force=grip),
        )

    @property
    def specs(self) -> tuple[AxisSpec, ...]:
        return self._specs

    @property
    def channels(self) -> tuple[Channel, ...]:
        return FORCE, MOMENT, TOUCH, TOOL_TORQUE

    @property
    def period(self) -> float:
        return self._drive.period

    def tare(self) -> None:
        """Hold still for some servo periods, and take the force that is sensed during these periods as zero."""
        self._finish()
        self._goal = self._start if self._motion is not None else self._goal
        self._end(self._drive.zero())

    @property
    def goal(self) -> Array:
        """The set-points x, y, z (m), O, A, T (rad) at the end of the last servo period, shape (6,)."""
        self._finish()
        return self._goal

    def resume(self, goal: Array) -> None:
        """Continue from set-points that the property `goal` had earlier. The drive must be in the same state as at
        that time.
        """
        self._start = self._goal = goal
        self._motion = None

    def release(self) -> None:
        """Give up the present goal. Call this method after the brakes were set. The arm stays where it is."""
        self.resume(self._pose(self._drive.state.q))

    def read(self) -> AxesReading:
        self._finish()
        state, sensed = self._drive.state, self._drive.sensed
        values = (*-state.wrench, *map(float, sensed.touch), sensed.tool_torque)
        parts = [part for channel in self.channels for part in channel.parts]
        q = np.append(self._pose(state.here), sensed.gap)
        return AxesReading(time=sensed.time, q=q, channels=dict(zip(parts, map(float, values), strict=True)))

    def put(self, goal: Array) -> None:
        """Drive the arm for one servo period towards a goal. Raises Refused if the arm cannot go to the goal."""
        if np.shape(goal) != (count := len(self._specs),):
            raise BadArgument(f"a goal of {self.name} must have {count} numbers, one for each axis")
        if not np.isfinite(goal).all():
            raise BadArgument("a goal of an axis is not a finite number")
        self._finish()
        self._start = (
            self._start if self._motion is not None else self._goal
        )  # else the last goal is replaced
        most = np.array([spec.speed for spec in self._specs[:-1]]) * self.period
        way = goal[:-1] - self._start
        way[3:] = (way[3:] + pi) % (2 * pi) - pi
        self._goal = self._start + np.clip(way, -most, most)
        self._drive.state.gap = float(goal[-1])
        self._motion = self._drive.shifting(self._drive.dynamics(), hand(*self._goal), feeling=True)
        self._put_at = self._drive.cell.clock.now
        self._go_on(self._motion)

    def _finish(self) -> None:
        """If the servo period that the last `put` began has passed, process the readings of this period."""
        if self._motion is not None and self._drive.cell.clock.now > self._put_at:
            self._go_on(self._motion)

    def _go_on(self, motion: Motion[Outcome]) -> None:
        try:
            next(motion)
        except StopIteration as end:
            self._end(end.value)

    def _end(self, outcome: Outcome) -> None:
        self._motion = None
        if outcome.error is not None:
            self._goal = self._pose(self._drive.state.q)
            raise Refused(f"{self.name} does not reach its goal: {ERRORS[outcome.error]}")

    def _pose(self, q: Array) -> Array:
        """Return x, y, z (m) and O, A, T (rad) of the tool as an array, shape (6,). `q` are the joint positions."""
        X_WT = forward(self._drive.arm, q)
        return np.array([*X_WT[:3, 3], *hand_angles(X_WT)])


def _axis(name: str, lower: float, upper: float) -> AxisSpec:
    return AxisSpec(name=name, kind="prismatic", lower=lower, upper=upper, speed=SPEED)
