"""Drives the arm along set-points, a servo period at a time, while guards watch.

Everything here goes through the ports: positions are the potentiometers', forces are what the joint torques
leave unexplained.
"""

from collections.abc import Callable
from dataclasses import dataclass

import numpy as np

from handeye import errors
from handeye.arm.dynamics import gravity, mass_matrix
from handeye.arm.ik import solve
from handeye.arm.kinematics import forward, jacobian
from handeye.arm.model import ArmModel, constants
from handeye.arm.samples import Samples
from handeye.arm.servo import external_wrench, prepare, torque
from handeye.execution.compliance import Course
from handeye.execution.state import DriveState
from handeye.ports.workcell import Drive, Sensed, Workcell
from handeye.pose import Array, Pose, displaced, translated
from handeye.touch.guards import Monitor, Reading, Trip
from handeye.units import INCH, JIFFY

SETTLE_TICKS = 8
"""Periods held at the end of a motion, and averaged for the tare of the force estimate."""
LAG = np.array([0.05, 0.05, 0.03, 0.15, 0.15, 0.15])
"""Following error (rad, m) that means collision. Placeholder: twenty times what free motions show."""
SHORT = 0.004
"""Distance of the hand from its set-point at the end of a free motion (m) that means it stands on something: the
servo is soft. Placeholder: five times the .032 in that whole runs show."""
PRESS_TICKS = 600
"""Periods after which a pressing motion ends that neither gets on nor meets its guard: ten seconds."""

OILED = 0.1
"""s in which a floating arm comes to rest once nobody pushes it, by its tachometers. Chosen: with the little friction
of its joints alone it would go on."""


class Halted(Exception):
    """The panic button was hit: drives are off and brakes set since this servo period."""


@dataclass(frozen=True, slots=True, kw_only=True)
class Outcome:
    """How a motion ended."""

    trip: Trip | None = None
    """The guard that ended it."""
    error: int | None = None
    """An error of the motion itself (servo lag, watchdog)."""
    detail: str = ""


REACHED = Outcome()
CUT = Outcome(error=errors.WATCHDOG)


@dataclass(slots=True, kw_only=True)
class _Dynamics:
    """Inertia, gravity and Jacobian at a set-point, reused while the hand hardly moves."""

    M: Array
    bias: Array
    J: Array


@dataclass(slots=True, kw_only=True)
class ArmDrive:
    """The servo loop: the only place of the working phase that lets time pass with the arm powered."""

    cell: Workcell
    arm: ArmModel
    state: DriveState
    """What it remembers: set-points, load and what is felt."""
    watch: Callable[[Sensed, Array], None] = lambda _, __: None
    """Called after every servo period with what is sensed and the torques put out, shape (6,)."""
    halt: Callable[[], bool] = lambda: False
    """The panic button, asked at every servo period."""

    # -- time passes --------------------------------------------------------------------------------

    def brake(self, seconds: float) -> None:
        """Set the brakes and let time pass; the set-point becomes where the arm then is."""
        for _ in range(round(seconds / JIFFY)):
            self._tick(np.zeros(6), brakes=True)
        self.state.q = self.sensed.q.copy()

    def float(self, seconds: float) -> None:
        """Let go of the arm and let time pass: gravity is borne, and whoever pushes the hand moves it.

        The set-point becomes where the arm then is.
        """
        for _ in range(round(seconds / JIFFY)):
            q, qd = self.sensed.q, self.sensed.qd
            self._tick(gravity(self.arm, q) - mass_matrix(self.arm, q) @ qd / OILED)
        self.state.q = self.sensed.q.copy()

    def follow(
        self, samples: Samples, guard: Monitor | None = None, direction: Array | None = None
    ) -> Outcome:
        """Follow set-points; end early when `guard` trips.

        Args:
            direction: unit vectors of the motion for the guard, shape (3,) or (N, 3), in W.
        """
        if len(samples) == 0:
            return REACHED
        if guard is not None:
            self.zero()
        motion = prepare(self.arm, self.state.q, samples)
        J = (
            jacobian(self.arm, motion.q)
            if guard is not None or self.state.load
            else _no_jacobian(len(motion))
        )
        for i in range(len(motion)):
            here = _Dynamics(M=motion.M[i], bias=motion.bias[i], J=J[i])
            self._servo(here, motion.q[i], motion.qd[i], motion.qdd[i], estimate=guard is not None)
            if self.state.cut:
                return CUT
            self.state.q = samples.q[i]
            lag = np.abs(self.sensed.q - self.state.q) > LAG
            if lag.any():
                self.state.q = self.sensed.q.copy()
                joint = self.arm.joints[int(np.argmax(lag))].name
                return Outcome(error=errors.SERVO_LAG, detail=f"{joint} stayed behind its set-point")
            along = _row(direction, i)
            trip = guard.check(self._reading(along)) if guard is not None else None
            if trip is not None:
                self._freeze(along)
                return Outcome(trip=trip)
        self.hold(SETTLE_TICKS)
        return REACHED if guard is not None else self._arrived()

    def _arrived(self) -> Outcome:
        """Whether the hand is where it is held."""
        off = float(np.linalg.norm(self.hand()[:3, 3] - forward(self.arm, self.state.q)[:3, 3]))
        if off < SHORT:
            return REACHED
        return Outcome(error=errors.SERVO_LAG, detail=f"the hand is {off / INCH:.2f} in from its set-point")

    def comply(self, course: Course, guard: Monitor | None) -> Outcome:
        """Go straight, pressing, turning or giving way as the course says; end early when `guard` trips.

        A position servo in which the measured force moves the set-point: it needs no joint to be slack.
        """
        self.zero()
        X_start = forward(self.arm, self.state.q)
        gone, given, turn = 0.0, np.zeros(3), np.zeros(3)
        for tick in range(course.patience(PRESS_TICKS)):
            if gone >= course.distance:
                return REACHED if guard is not None else self._arrived()
            gone += course.advance(self.state.wrench, tick) * JIFFY
            given += course.yielding(self.state.wrench) * JIFFY
            turn = course.turned(turn, self.state.wrench)
            step = solve(self.arm, displaced(X_start, gone * course.direction + given, turn), self.state.q)
            if step.q is None:
                return Outcome(error=errors.JOINT_LIMIT, detail=step.message(self.arm))
            self._approach(self.dynamics(), step.q, estimate=True)
            if self.state.cut:
                return CUT
            trip = guard.check(self._reading(course.direction)) if guard is not None else None
            if trip is not None:
                self._freeze(course.direction)
                return Outcome(trip=trip)
        if guard is not None:  # its error says that nothing was met
            return REACHED
        return Outcome(error=errors.SERVO_LAG, detail=f"the hand got on {gone / INCH:.2f} in and no farther")

    def shift(self, here: _Dynamics, X_WT: Pose) -> Outcome:
        """One period towards a pose close by."""
        step = solve(self.arm, X_WT, self.state.q)
        if step.q is None:
            return Outcome(error=errors.JOINT_LIMIT, detail=step.message(self.arm))
        self._approach(here, step.q, estimate=False)
        return CUT if self.state.cut else REACHED

    def hold(self, ticks: int) -> None:
        """Hold the set-point."""
        here = self.dynamics()
        for _ in range(ticks):
            self._approach(here, self.state.q, estimate=False)

    def zero(self) -> None:
        """Hold still and take what is felt now as zero force."""
        here = self.dynamics()
        felt = []
        self.state.tare = np.zeros(6)
        for _ in range(SETTLE_TICKS):
            self._approach(here, self.state.q, estimate=True)
            felt.append(self.state.wrench)
        self.state.tare = np.mean(felt, axis=0)
        self.state.wrench = np.zeros(6)

    def _approach(self, here: _Dynamics, q: Array, *, estimate: bool) -> None:
        """One servo period towards a set-point close by."""
        self._servo(here, self.state.q, (q - self.state.q) / JIFFY, np.zeros(6), estimate=estimate)
        self.state.q = q

    def _servo(self, here: _Dynamics, q: Array, qd: Array, qdd: Array, *, estimate: bool) -> None:
        """One servo period in which the arm should begin at `q` with rates `qd`."""
        before = self.sensed
        load = here.J[2] * self.state.load
        tau = torque(self.arm, here.M, here.bias, q, qd, qdd, before.q, before.qd, exerted=load)
        effort = constants(self.arm).effort
        tau = np.clip(tau, -effort, effort)  # else force that the drives could not give would be felt
        self._tick(tau)
        if estimate:
            acceleration = (self.sensed.qd - before.qd) / JIFFY
            unexplained = here.M @ acceleration + here.bias - tau
            self.state.wrench = external_wrench(here.J, unexplained) - self.state.tare

    def _tick(self, tau: Array, brakes: bool = False) -> None:
        """One servo period. Raises Halted after it, if the panic button is down."""
        halted = self.halt()
        if halted:
            brakes, tau, self.state.tool = True, np.zeros(6), 0.0
        self.cell.tick(
            Drive(
                torque=tau,
                brakes=brakes,
                gap=self.state.gap,
                grip=self.state.grip,
                tool=self.state.tool,
                lamp=self.state.lamp,
            )
        )
        self.state.cut = self.sensed.braked and not brakes
        self.watch(self.sensed, tau)
        if halted:
            raise Halted

    # -- stopping -----------------------------------------------------------------------------------

    def _freeze(self, direction: Array) -> None:
        """Hold where the hand is along `direction`, with no reference velocity left to kick it back."""
        X_set, X_is = forward(self.arm, self.state.q), forward(self.arm, self.sensed.q)
        along = float((X_is[:3, 3] - X_set[:3, 3]) @ direction)
        held = solve(self.arm, translated(X_set, along * direction), self.state.q)
        self.state.q = self.sensed.q.copy() if held.q is None else held.q

    # -- knowing ------------------------------------------------------------------------------------

    @property
    def sensed(self) -> Sensed:
        """The reading of the interface in this servo period."""
        return self.cell.sense()

    def hand(self) -> Pose:
        """`X_WT` by the arm's own sensors."""
        return forward(self.arm, self.sensed.q)

    def dynamics(self) -> _Dynamics:
        """Inertia, bias torques and Jacobian at rest at the present set-point."""
        return _Dynamics(
            M=mass_matrix(self.arm, self.state.q),
            bias=gravity(self.arm, self.state.q),
            J=jacobian(self.arm, self.state.q),
        )

    def _reading(self, direction: Array) -> Reading:
        """What guards look at."""
        return Reading(
            force=-self.state.wrench[:3], moment=-self.state.wrench[3:], direction=direction,
            tool_torque=self.sensed.tool_torque, touch=self.sensed.touch,
        )  # fmt: skip


def _no_jacobian(count: int) -> Array:
    return np.zeros((count, 6, 6))


def _row(direction: Array | None, i: int) -> Array:
    if direction is None:
        return np.zeros(3)
    return direction if direction.ndim == 1 else direction[i]
