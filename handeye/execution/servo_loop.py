"""The servo loop: motions of an arm along set-points, one servo period at a time, watched by guards.

A motion is a generator. After commanding all devices for a servo period, the motion yields, and the caller advances
the clock. When the caller resumes the motion, the motion reads the cell. Any number of arms can therefore move under
one clock.
"""

from collections.abc import Callable, Sequence
from dataclasses import dataclass

import numpy as np

from handeye.arm.computed_torque import prepare
from handeye.arm.dynamics import Dynamics
from handeye.arm.exertion import Exertion
from handeye.arm.ik import solve
from handeye.arm.joint_agreement import (
    Disagreement,
    JointAgreement,
    Scatter,
    crept,
    scattered,
    swings_unevenly,
)
from handeye.arm.joint_drag import alone, stiff
from handeye.arm.kinematics import jacobian
from handeye.arm.model import constants
from handeye.arm.samples import Samples
from handeye.arm.torque_balance import balanced
from handeye.core import errors
from handeye.core.pose import Array, Pose, displaced, translated
from handeye.execution.compliance import Course
from handeye.execution.servo import Motion, Servo
from handeye.ports.workcell import Sensed
from handeye.program.diagnosis.cause_record import JointName
from handeye.program.diagnosis.causes import Cause, HandAstray, HandPushed, HandStuck, JointBehind
from handeye.program.diagnosis.sense_causes import (
    DrivesUnlike,
    ForceInAir,
    JointAlone,
    JointSensesApart,
    RateScatters,
)
from handeye.touch.guards import ActiveGuard, Monitor, Trip
from handeye.touch.senses import FREE_FORCE, off_zero

DITHER = 2.0
"""Torque that shakes a joint, as a multiple of its friction. Our choice: half of the torque overcomes friction, and
the other half moves the joint.
"""
_FRESH = 0.25  # weight of the last servo period in the mean over the last few; chosen
_AT_ONCE = 15
"""Greatest number of servo periods that the servo loop skips at a time while the brakes are set. While the brakes are
set, the panic button thus acts up to .25 s late.
"""
LIGHT = 5.0
"""Greatest load in the hand (N) at which the servo loop judges the drag of the joints. If the hand lost a heavier
load, the loss would look like drag above the limit. The value is our choice.
"""
SWING = 0.3
"""A joint swings if it has been off its set-point on both sides, each time by at least this fraction of its greatest
permitted following error. A joint that an object stops is off only on one side. The fraction is our choice.
"""
PRESS_TIME = 10.0
"""Time (s) after which a pressing motion ends if it neither advances nor trips its guard. Our choice."""
_SIDES = np.array([[1.0], [-1.0]])  # signs of deviations to either side of a set-point


@dataclass(frozen=True, slots=True, kw_only=True)
class Outcome:
    """How a motion ended."""

    trip: Trip | None = None  # the guard that ended it
    error: int | None = None  # an error of the motion itself (servo lag, watchdog)
    cause: Cause | None = None  # cause of that error, if there is more to say about it
    off: float = 0.0
    """How far (m) the hand was from its set-points, on average over the middle third of the motion. This average is
    computed only if the hand did not reach the last set-point; if the hand reached it, `off` is 0.
    """


REACHED = Outcome()
CUT = Outcome(error=errors.WATCHDOG)


@dataclass(slots=True, kw_only=True)
class ServoLoop(Servo):
    """The motions of one arm, and the checks that can end a motion."""

    def _periods(self, seconds: float) -> int:
        """Return the number of servo periods in a time (s), at least one if the time is positive."""
        return max(1, round(seconds / self.period)) if seconds > 0 else 0

    # -- motions, a servo period at a time -----------------------------------------------------------

    def braking(self, seconds: float) -> Motion[None]:
        """Set the brakes. The final position of the arm becomes the set-point."""
        left = self._periods(seconds)
        while left:
            periods = 1 if left == self._periods(seconds) else min(left, _AT_ONCE)
            yield from self._wait(None, periods=periods)
            if self.state.rest is None or self.sensed.qd.any():
                self.state.rest = self.sensed.q.copy()
            left -= periods
        self.state.q, self.state.met = self.state.here.copy(), None

    def floating(self, seconds: float) -> Motion[None]:
        """Balance only gravity and load, so that a push moves the hand. The final position of the arm becomes the
        set-point.
        """
        for _ in range(self._periods(seconds)):
            here = self.chain.at_rest(self.state.here)
            borne = here.bias + here.J[2] * self.state.load
            yield from self._wait(borne - here.M @ self.sensed.qd / self.arm.servo.drag)
        self.state.q, self.state.met = self.state.here.copy(), None

    def exerting(self, torque: Array) -> Motion[None]:
        """Exert joint torques, shape (n,), for a servo period. The final position of the arm becomes the set-point."""
        yield from self._wait(torque)
        self.state.q, self.state.met = self.state.here.copy(), None

    def following(
        self,
        samples: Samples,
        guard: Monitor | None = None,
        direction: Array | None = None,
        beside: Callable[[int], None] = lambda _: None,
        taken: list[Exertion] | None = None,
    ) -> Motion[Outcome]:
        """Follow set-points. The motion ends early if `guard` trips. The torques of each servo period are appended to
        `taken`.

        The guard watches along `direction`, unit vectors in W, shape (3,) or (N, 3). `beside` is called with the
        number of each set-point, to give further commands for the servo period of that set-point.
        """
        if len(samples) == 0:
            return REACHED
        self.state.met = None
        if guard is not None:
            zeroed = yield from self.zeroing()
            if zeroed.error is not None:
                return zeroed
        motion = prepare(self.built, self.state.q, samples)
        count, n = motion.q.shape
        directions = np.broadcast_to(np.zeros(3) if direction is None else direction, (count, 3))
        friction, sensors = self._rubbing(motion.qd), self._sensors()
        off, met, swing = np.zeros(n), np.zeros(n), np.zeros((2, n))
        for i in range(count):
            here, q, along = motion.dynamics.at(i), motion.q[i], directions[i]
            beside(i)
            spare = yield from self._servo(
                here, q, motion.qd[i], motion.qdd[i],
                estimate=guard is not None, friction=friction[i], guards=_active(guard, along),
            )  # fmt: skip
            met = met + _FRESH * (spare - met)
            if self.state.cut:
                return CUT
            self.state.q, sensed = samples.q[i], self.sensed
            if taken is not None:
                taken.append(Exertion(q, spare, here.bias, sensed.qd))
            failed = self._doubted(sensors, sensed) or self._behind(met, swing)
            if failed is not None:
                return failed
            if count <= 3 * i < 2 * count:
                off += 3 * (self.state.here - self.state.q) / count
            trip = guard.check(self._reading(sensed, along)) if guard is not None else None
            if trip is not None:
                self._freeze(along)
                return Outcome(trip=trip)
        met = yield from self.holding(self.arm.servo.settle)
        return REACHED if guard is not None else self._arrived(off, met, swing)

    def gliding(
        self, samples: Samples, guard: Monitor | None, direction: Array | None, lift_off: int
    ) -> Motion[Outcome]:
        """Follow set-points through free air. `lift_off` is the number of set-points of the lift-off. See `following`.

        An obstacle and a steady force on the hand raise two different errors. The distance of the hand from its
        set-points in the middle of the motion shows which error to raise. A hand that meets an obstacle lags behind
        its set-points only after it has met the obstacle. A hand on which a steady force acts is displaced during the
        whole motion.

        The torques are compared with the arm's weight only if the hand is clear of all objects when the motion begins.
        After a guarded motion, for example, a held pin may stand in a hole, and the hole then bears part of the
        weight. The fingers may also press against a wall of the hole. Until the fingers are out of the hole, this
        force looks like friction. If the hand is not clear, friction is therefore judged only after the lift-off.
        """
        clear, self.state.clear = self.state.clear, False
        lift_off = 0 if clear else lift_off
        self.state.in_air = False
        taken: list[Exertion] = []
        outcome = yield from self.following(samples, guard, direction, taken=taken)
        if outcome.off > self.arm.servo.short / 2:  # far more than a free arm lags
            yield from self.zeroing()
            return self._force_in_air()
        if outcome == REACHED and self.state.load <= LIGHT:
            outcome = self._dragging(taken[lift_off:]) or REACHED
        elif isinstance(outcome.cause, HandAstray | JointBehind) and self.state.load <= LIGHT:
            first_half = taken[lift_off : (len(samples) + 1) // 2]  # long before the hand met anything
            outcome = self._dragging(first_half, outcome.cause.joint) or outcome
        if outcome == REACHED and taken and self.state.links is not None and clear:
            outcome = self._off_balance(taken) or REACHED
        self.state.in_air = outcome == REACHED
        self.state.clear = outcome == REACHED and guard is None
        return outcome

    def complying(self, course: Course, guard: Monitor | None) -> Motion[Outcome]:
        """Move along a straight course, pressing, turning or yielding as the course says. The motion ends early if
        `guard` trips.

        The position servo stays on, and the measured force moves its set-point. The arm therefore yields without any
        slack joint.
        """
        self.state.met = None
        zeroed = yield from self.zeroing()
        if zeroed.error is not None:
            return zeroed
        X_start, sensors = self.chain.forward(self.state.q), self._sensors()
        friction, met = self._on_course(X_start, course), np.zeros(len(self.state.q))
        gone, given, turn = 0.0, np.zeros(3), np.zeros(3)
        for tick in range(course.patience(round(PRESS_TIME / self.period), self.period)):
            if gone >= course.distance:
                return (
                    REACHED
                    if guard is not None
                    else self._arrived(np.zeros(len(met)), met, np.zeros((2, len(met))))
                )
            gone += course.advance(self.state.wrench, tick) * self.period
            given += course.yielding(self.state.wrench) * self.period
            turn = course.turned(turn, self.state.wrench, self.period)
            step = solve(self.arm, displaced(X_start, gone * course.direction + given, turn), self.state.q)
            if step.q is None:
                return Outcome(error=errors.JOINT_LIMIT, cause=step.cause(self.arm))
            guards = _active(guard, course.direction)
            spare = yield from self._approach(
                self.dynamics(), step.q, estimate=True, friction=friction, guards=guards
            )
            met = met + _FRESH * (spare - met)
            if self.state.cut:
                return CUT
            sensed = self.sensed
            doubted = self._doubted(sensors, sensed)
            if doubted is not None:
                return doubted
            trip = guard.check(self._reading(sensed, course.direction)) if guard is not None else None
            if trip is not None:
                self._freeze(course.direction)
                return Outcome(trip=trip)
        if guard is not None:  # the error of the guard says that nothing was met
            return REACHED
        return Outcome(error=errors.SERVO_LAG, cause=HandStuck(moved=round(gone, 6)))

    def _on_course(self, X_WT: Pose, course: Course) -> Array:
        """Return the known friction of the joints on a course that begins at a pose, shape (n,)."""
        ahead = solve(self.arm, translated(X_WT, course.speed * self.period * course.direction), self.state.q)
        goal = self.state.q if ahead.q is None else ahead.q
        return self._rubbing((goal - self.state.q) / self.period)

    def shifting(self, here: Dynamics, X_WT: Pose, *, feeling: bool = False) -> Motion[Outcome]:
        """Move for one servo period towards a nearby pose. If `feeling` is True, the force on the hand is estimated
        at the end.
        """
        self.state.met = None
        step = solve(self.arm, X_WT, self.state.q)
        if step.q is None:
            return Outcome(error=errors.JOINT_LIMIT, cause=step.cause(self.arm))
        friction = self._rubbing((step.q - self.state.q) / self.period)
        yield from self._approach(here, step.q, estimate=feeling, friction=friction)
        return CUT if self.state.cut else REACHED

    def holding(self, ticks: int) -> Motion[Array]:
        """Hold the set-point. Returns the mean torque residual, shape (n,)."""
        here, met = self.dynamics(), np.zeros(len(self.state.q))
        for _ in range(ticks):
            met += yield from self._approach(here, self.state.q, estimate=False)
        return met / max(ticks, 1)

    def zeroing(self) -> Motion[Outcome]:
        """Hold still and take the present force as zero. In free air the force is close to zero.

        If the friction of the joints is known, the servo adds a dither torque, which keeps the joints sliding to and
        fro. Without dither, the joints could rest anywhere within their friction, and the tare would contain that
        friction.

        The force on the hand is computed from the rates, so a tachometer whose readings scatter would cause a false
        force. Such readings also look like joints that slide unevenly. If the joints seem to slide unevenly, the arm
        therefore holds still a second time, without dither, and the rates are checked.

        If the reading of a potentiometer jumps while the arm holds still, the motion ends at once, because the servo
        would follow the wrong reading and move the joint.
        """
        uneven = yield from self._taring()
        scatter = (yield from self._resting()) if uneven else None
        if self.state.jump is not None:
            return self._apart(self.state.jump)
        if scatter is not None:
            return self._scatters(scatter)
        return self._force_in_air() if self.state.in_air and off_zero(self._unloaded()) else REACHED

    def _taring(self) -> Motion[bool]:
        """Take the present force as zero. Returns True if the dither makes the joints slide unevenly. Returns False if
        the screwdriver turns, because the screwdriver shakes the arm too.
        """
        here, dither, settle = self.dynamics(), DITHER * self.state.friction, self.arm.servo.settle
        felt, rates = [], []
        self.state.tare = np.zeros(6)
        for tick in range(2 * settle if dither.any() else settle):
            shaken = dither if tick % 2 else -dither
            yield from self._approach(here, self.state.q, estimate=True, taring=True, dither=shaken)
            if self.state.jump is not None:
                return False
            felt.append(self.state.wrench)
            rates.append(self.sensed.qd)
        if dither.any():
            yield from self._approach(here, self.state.q, estimate=False)  # the joints come to rest
        self.state.tare = np.mean(felt[-settle:], axis=0)
        self.state.wrench = np.zeros(6)
        shaken_only = bool(dither.any()) and not self.state.tool
        return shaken_only and swings_unevenly(self.arm, here.M, dither, np.array(rates[-settle:]))

    def _resting(self) -> Motion[Scatter | None]:
        """Hold still. Returns the joint whose rate readings scatter too much at the end, or None if no joint's
        readings do.
        """
        here, rates = self.dynamics(), []
        for _ in range(2 * self.arm.servo.settle):
            yield from self._approach(here, self.state.q, estimate=False)
            if self.state.jump is not None:
                return None
            rates.append(self.sensed.qd)
        return scattered(self.arm, here.M, self.state.friction, np.array(rates[-self.arm.servo.settle :]))

    # -- stopping -----------------------------------------------------------------------------------

    @property
    def height(self) -> float:
        """Height (m, in W) at which the hand has stopped, computed from its set-point.

        The converters round the readings, which therefore have steps. At the hand, these steps are up to .05 inch. A
        set-point has no steps. The arm takes many readings while it moves, and the rounding errors of these readings
        average out. On average, two motions that the same force stops therefore end at the same height.
        """
        met = self.state.met
        return float(self.chain.forward(self.state.q)[2, 3] if met is None else met[2])

    def _freeze(self, direction: Array) -> None:
        """Move the set-point of the hand along `direction` to the place where the hand now is at rest. If the
        set-point were not moved, the servo would kick the hand towards the old set-point.
        """
        self.state.met = self.chain.forward(self.state.q)[:3, 3]
        X_set, X_is = self.chain.forward(self.state.q), self.chain.forward(self.state.here)
        along = float((X_is[:3, 3] - X_set[:3, 3]) @ direction)
        held = solve(self.arm, translated(X_set, along * direction), self.state.q)
        self.state.q = self.state.here.copy() if held.q is None else held.q

    def _arrived(self, on_the_way: Array, met: Array, swing: Array) -> Outcome:
        """Check that the hand has reached its set-point. Returns the error if it has not.

        `on_the_way`, shape (n,), is the deviation of the joints from their set-points during the motion. `met`,
        shape (n,), is the torque residual. For `swing` see `_lagging`.
        """
        off = float(np.linalg.norm(self.hand()[:3, 3] - self.chain.forward(self.state.q)[:3, 3]))
        if off < self.arm.servo.short:
            return REACHED
        before = float(np.linalg.norm((jacobian(self.arm, self.state.q) @ on_the_way)[:3]))
        joint, _ = self._lagging(swing)
        name, swings = self.arm.joints[joint].name, bool((swing[:, joint] >= SWING).all())
        kind = HandPushed if self.state.tool else HandAstray
        cause = kind(distance=round(off, 6), joint=name, swings=swings)
        astray = Outcome(error=errors.SERVO_LAG, cause=cause, off=before)
        return self._alone(met) or astray

    # -- doubting -----------------------------------------------------------------------------------

    def _unloaded(self) -> Array:
        """Return the force (N, shape (3,)) on the hand at the last tare. The weight that the servo compensates is not
        included.
        """
        return np.asarray(self.state.tare[:3] + np.array((0.0, 0.0, self.state.load)))

    def _force_in_air(self) -> Outcome:
        """Return an error: the force that was taken as zero at the last tare is too large for free air."""
        x, y, z = (round(float(component), 6) for component in self._unloaded())
        cause = ForceInAir(force=(x, y, z), limit=FREE_FORCE, load=self.state.load)
        return Outcome(error=errors.FORCE_WRONG, cause=cause)

    def _sensors(self) -> JointAgreement:
        """Start a comparison of the sensors of all joints."""
        return JointAgreement(arm=self.arm, start=self.sensed.q, rate=self.sensed.qd)

    def _doubted(self, sensors: JointAgreement, sensed: Sensed) -> Outcome | None:
        """Compare the sensors of the joints at the end of a servo period. If the sensors of a joint disagree, return
        the error, and make the measured position of the arm the set-point.
        """
        change, self.state.crept = self.state.crept, None  # under the brakes; reported once
        rested = None if change is None else crept(self.arm, change)
        if self.state.tool:
            sensors.begin_anew(sensed.q, sensed.qd)
            found = self.state.jump or rested
        else:
            found = self.state.jump or rested or sensors.step(sensed.q, sensed.qd, self._unseen)
        return None if found is None else self._apart(found)

    def _apart(self, found: Disagreement) -> Outcome:
        """Return the error of a joint whose sensors disagree, and make the measured position of the arm the
        set-point.
        """
        self.state.jump = None  # reported once
        self.state.q = self.state.here.copy()
        cause = JointSensesApart(
            joint=self._named(found.joint),
            potentiometer=round(found.potentiometer, 6), tachometer=round(found.tachometer, 6),
            braked=found.braked,
        )  # fmt: skip
        return Outcome(error=errors.JOINT_SENSE_WRONG, cause=cause)

    def _scatters(self, found: Scatter) -> Outcome:
        cause = RateScatters(
            joint=self._named(found.joint), scatter=round(found.scatter, 6), limit=round(found.limit, 6)
        )
        return Outcome(error=errors.JOINT_SENSE_WRONG, cause=cause)

    def _behind(self, met: Array, swing: Array) -> Outcome | None:
        """Check that every joint follows its set-point. If a joint does not follow, return the error, and make the
        measured position of the arm the set-point. See `_lagging`.
        """
        joint, lag = self._lagging(swing)
        if lag <= 1.0:
            return None
        self.state.q = self.state.here.copy()
        cause = JointBehind(joint=self.arm.joints[joint].name, swings=bool((swing[:, joint] >= SWING).all()))
        return self._alone(met) or Outcome(error=errors.SERVO_LAG, cause=cause)

    def _lagging(self, swing: Array) -> tuple[int, float]:
        """Find the joint whose following error is largest relative to its limit. Returns the joint, and the ratio of
        its error to the limit.

        `swing`, shape (2, n), is updated in place. It holds the largest ratio during the motion for each joint, on
        each side of the set-point.
        """
        off = (self.state.here - self.state.q) / constants(self.arm).lag
        np.maximum(swing, off * _SIDES, out=swing)
        joint = int(np.abs(off).argmax())
        return joint, abs(float(off[joint]))

    def _dragging(self, taken: Sequence[Exertion], lagging: str = "") -> Outcome | None:
        """Check a motion through free air: no joint may have taken far more torque than its friction explains. Without
        known friction, nothing is checked.

        If the joint `lagging` lagged behind, no error is returned for any other joint.
        """
        friction = self.state.friction
        found = stiff(self.built, taken, friction, self.state.weights) if taken and friction.any() else None
        if found is None or lagging not in ("", self.arm.joints[found.joint].name):
            return None
        cause = JointAlone(
            joint=self._named(found.joint), torque=round(found.torque, 6), friction=round(found.friction, 6),
            one_way=found.one_way,
        )  # fmt: skip
        return Outcome(error=errors.JOINT_STIFF, cause=cause)

    def _off_balance(self, taken: Sequence[Exertion]) -> Outcome | None:
        """Compare the torques of a motion through free air with the present estimate of the arm's weight."""
        borne = jacobian(self.arm, taken[len(taken) // 2].q)[2] * self.state.load
        self.state.weights, found = balanced(
            self.built, taken, self.state.friction, self.state.weights, borne
        )
        if found is None:
            return None
        cause = DrivesUnlike(
            joints=tuple(map(self._named, found.joints)),
            factors=tuple(round(each, 3) for each in found.factors),
        )
        return Outcome(error=errors.FORCE_WRONG, cause=cause)

    def _alone(self, met: Array) -> Outcome | None:
        """Return the error of the joint that alone keeps the arm from its set-point, or None if a force on the hand
        explains the torques.
        """
        joint = alone(self.arm, jacobian(self.arm, self.state.here), met)
        if joint is None:
            return None
        cause = JointAlone(joint=self._named(joint), torque=round(float(met[joint]), 6))
        return Outcome(error=errors.JOINT_STIFF, cause=cause)

    def _named(self, number: int) -> JointName:
        joint = self.arm.joints[number]
        return JointName(name=joint.name, kind=joint.kind)


def _active(guard: Monitor | None, direction: Array) -> tuple[ActiveGuard, ...]:
    """Return the guards that are active in a servo period while the motion goes along the unit vector `direction`."""
    return () if guard is None else guard.active(direction)
