"""The servo of an arm. In each servo period, the servo commands torques and estimates the force on the hand.

The servo uses only the device interfaces. It measures positions with the potentiometers, and refines them with the
tachometers. It computes forces from the residual of the joint torques. The code that is executed in a servo period
does not itself let time pass. After commanding all devices, this code yields to its caller, who lets time pass. When
the caller resumes the code, the code reads the cell.
"""

from collections.abc import Callable, Generator
from dataclasses import dataclass, field
from typing import TypeVar

import numpy as np

from handeye.arm.arithmetic import ArmArithmetic, Formulas
from handeye.arm.computed_torque import felt_wrench, torque
from handeye.arm.converters import followed, sliding
from handeye.arm.dynamics import Dynamics
from handeye.arm.joint_agreement import Disagreement, blown, jumped, thrown
from handeye.arm.model import ArmModel, constants
from handeye.arm.weighing import weighed
from handeye.core.pose import Array, Pose
from handeye.core.record import Record
from handeye.core.small_arrays import limited
from handeye.execution.state import DriveState
from handeye.execution.undo.way import Track
from handeye.ports.workcell import Sensed, Workcell
from handeye.program.diagnosis.sense_causes import GapJumped
from handeye.touch.guards import ActiveGuard, Reading
from handeye.touch.senses import FAST_PERIODS, PLATEAU, kept_apart, leapt, work_of_fingers


class ServoPeriod(Record, frozen=True, kw_only=True):
    """Readings, torques, sensed force and guards of one servo period."""

    sensed: Sensed  # readings of all devices at its end
    effort: Array
    """Commanded joint torques, shape (n,), N m (N if prismatic). The torques are zero while the brakes are set. If the
    servos are outside the computer, the torques are always zero.
    """
    wrench: Array | None = None
    """Estimated force (N) of the hand on the world and moment (N m) about its tool centre point, in W, shape (6,). If
    a sensor measures the force, the array contains only the force, shape (3,). None if nothing was estimated, or if
    only the tare was estimated.
    """
    guards: tuple[ActiveGuard, ...] = ()  # guards that watch at its end


T = TypeVar("T")
Motion = Generator[float, None, T]
"""A motion in progress: a generator that yields the time (s) after which it must be resumed, and returns the result
of the motion.
"""


class Halted(Exception):
    """Raised when the panic button is pressed. From the servo period in which the button is pressed, the drives are
    off and the brakes are set.
    """


@dataclass(slots=True, kw_only=True)
class Servo:
    """The servo of one arm. In each servo period, the servo sends commands to the arm, the hand, the screwdriver and
    the lamp.
    """

    cell: Workcell
    arm: ArmModel
    state: DriveState  # its state: set-points, load and felt wrench
    watch: Callable[[ServoPeriod], None] = lambda _: None  # called after every servo period
    halt: Callable[[], bool] = lambda: False  # the panic button, polled in every servo period
    track: Track = field(default_factory=Track)  # records commands and felt forces, for a later undo
    arithmetic: Callable[[ArmModel], ArmArithmetic] = Formulas  # computes an arm at one configuration
    _chain: tuple[ArmModel, ArmArithmetic] | None = field(default=None, init=False)
    _unseen: Array | None = field(default=None, init=False)
    """How far (rad, m) each joint moved in the last servo period, minus the motion that its rates show. An object that
    shifts in the fingers can move the hand so suddenly that the rates do not show this motion. The gap then becomes
    smaller. The value is None if the gap has not become smaller.
    """

    @property
    def period(self) -> float:
        """Servo period, in s."""
        return self.arm.servo.period

    @property
    def built(self) -> ArmModel:
        """The arm model with the link weights that the arm has measured."""
        links = self.state.links
        return self.arm if links is None else weighed(self.arm, tuple(links.tolist()))

    @property
    def chain(self) -> ArmArithmetic:
        """The kinematics and dynamics of the model `built`."""
        built = self.built
        if self._chain is None or self._chain[0] is not built:
            self._chain = built, self.arithmetic(built)
        return self._chain[1]

    # -- knowing ------------------------------------------------------------------------------------

    @property
    def sensed(self) -> Sensed:
        """Readings of all devices in this servo period."""
        return self.cell.sense()

    def hand(self) -> Pose:
        """Return the hand pose `X_WT`, measured by the sensors of the arm."""
        return self.chain.forward(self.state.here)

    def dynamics(self) -> Dynamics:
        """Return the mass matrix, bias torques and Jacobian at rest at the present set-point."""
        return self.chain.at_rest(self.state.q)

    def _reading(self, sensed: Sensed, direction: Array) -> Reading:
        """Return the sensor readings for the guards."""
        exerted = -self.state.wrench
        return Reading(
            force=exerted[:3], moment=exerted[3:], direction=direction,
            tool_torque=sensed.tool_torque, touch=sensed.touch,
        )  # fmt: skip

    def _rubbing(self, rate: Array) -> Array:
        """Return the known friction of joints that slide at given rates. Both arrays have shape (..., n). Friction of
        joints that hardly slide is reduced; see `sliding`.
        """
        return np.asarray(self.state.friction * sliding(self.arm, rate))

    # -- one servo period ------------------------------------------------------------------------------

    def _approach(
        self,
        here: Dynamics,
        q: Array,
        *,
        estimate: bool,
        taring: bool = False,
        friction: Array | float = 0.0,
        dither: Array | float = 0.0,
        guards: tuple[ActiveGuard, ...] = (),
    ) -> Motion[Array]:
        """Run one servo period towards a nearby set-point; see `_servo`."""
        qd, rest = (q - self.state.q) / self.period, np.zeros(len(self.state.q))
        spare = yield from self._servo(
            here, self.state.q, qd, rest,
            estimate=estimate, taring=taring, friction=friction, dither=dither, guards=guards,
        )  # fmt: skip
        self.state.q = q
        return spare

    def _servo(
        self,
        here: Dynamics,
        q: Array,
        qd: Array,
        qdd: Array,
        *,
        estimate: bool,
        guards: tuple[ActiveGuard, ...],
        taring: bool = False,
        friction: Array | float = 0.0,
        dither: Array | float = 0.0,
    ) -> Motion[Array]:
        """Run one servo period. At the beginning of the period, the arm should be at `q` and move with rates `qd`.

        If `estimate` is True, the force on the hand is estimated at the end of the period. The estimate is used for
        the tare if `taring` is True, and for `guards` if not. `friction` are the torques of known friction, which are
        compensated, so that friction is not sensed as force. The torques `dither` are added to those of the servo.
        Returns the torque residual, shape (n,): the torques less those for weight, inertia and load. The residual
        includes friction.
        """
        q_was, before = self.state.here, self.sensed
        load = here.J[2] * self.state.load
        bias = here.bias + friction
        tau = torque(self.arm, here.M, bias, q, qd, qdd, q_was, before.qd, exerted=load + dither)
        # without this, excess torque would be sensed as force
        tau = limited(tau, constants(self.arm).effort)

        def feel(after: Sensed) -> None:
            # gravity and Jacobian where the arm is, not at its set-point: a force pushes the arm off its set-point
            weight, J = self.chain.statics((q_was + self.state.here) / 2)
            bias_so = here.bias + weight - self.chain.gravity(q) + friction
            felt = felt_wrench(here.M, bias_so, J, tau, before.qd, after.qd, self.period)
            self.state.wrench = felt - self.state.tare

        after = yield from self._wait(tau, feel if estimate else None, guards, taring=taring)
        return np.asarray(tau - here.bias - load - here.M @ (after.qd - before.qd) / self.period)

    def _wait(
        self,
        tau: Array | None,
        feel: Callable[[Sensed], None] | None = None,
        guards: tuple[ActiveGuard, ...] = (),
        *,
        taring: bool = False,
        periods: int = 1,
    ) -> Motion[Sensed]:
        """Run one servo period with torques `tau` or, if `tau` is None, several periods under brakes. At the end, the
        function `feel`, if given, estimates the force from the readings.

        Returns the readings at the end.
        """
        halted, period = self.halt(), self.period
        if halted:
            tau, self.state.tool = None, 0.0
        before = self.sensed
        if tau is not None and self.state.rest is not None:
            self.state.crept, self.state.rest = before.q - self.state.rest, None
        if tau is not None:
            self.track.note(self.state.q, self.state.gap)
        self.put_out(tau)
        yield periods * period
        sensed = self.sensed
        moved = (before.qd + sensed.qd) * (period / 2)
        if periods == 1 and self.state.jump is None:
            self.state.jump = self._jumped(tau, before, sensed)
        self.state.here = followed(self.arm, self.state.here, moved, sensed.q)
        self.state.cut = sensed.braked and tau is not None
        if self.state.tool:
            self.state.current = max(self.state.current, abs(sensed.tool_torque))
            if len(self.state.starting) < FAST_PERIODS:
                self.state.starting = [*self.state.starting, abs(sensed.tool_torque)]
            self.state.lately = [*self.state.lately, abs(sensed.tool_torque)][-round(PLATEAU / period) :]
        reach = self.arm.hand.gap_speed * periods * period
        if self.state.leapt is None and leapt(sensed.gap - before.gap, reach):
            self.state.leapt = GapJumped(
                gap=round(sensed.gap, 6),
                before=round(before.gap, 6),
                held=self._holds(before, sensed),
            )
        if feel is not None and not halted:
            feel(sensed)
        unfelt = feel is None or taring or halted or sensed.braked  # what the brakes bear cannot be sensed
        if not unfelt:
            self.track.felt(self.state.wrench)
        self.watch(
            ServoPeriod(
                sensed=sensed,
                effort=np.zeros(len(self.state.q)) if tau is None else tau,
                wrench=None if unfelt else -self.state.wrench,
                guards=() if unfelt else guards,
            )
        )
        if halted:
            raise Halted
        return sensed

    def _jumped(self, tau: Array | None, before: Sensed, after: Sensed) -> Disagreement | None:
        """Find a potentiometer whose reading jumped within a servo period. `tau` are the torques of the drives in this
        period, or None if the brakes were set. A blow on the hand also changes readings suddenly. Such a blow is
        recognised by the readings of the other joints, and is not taken for a jump. An object that shifts in the
        fingers also gives a blow. This blow is not taken for a jump either, because it shows in the gap of the
        fingers, which becomes smaller.
        """
        moved, work = after.q - before.q, self._work(before, after)
        self._unseen = moved - (before.qd + after.qd) * (self.period / 2) if work else None
        found = jumped(self.arm, moved, before.qd, after.qd)
        if found is None or tau is None:
            return found
        here = self.chain.at_rest(self.state.here)
        driven = (tau - here.bias - here.J[2] * self.state.load) * self.period
        rest, rub = here.M @ (after.qd - before.qd) - driven, self.state.friction * self.period
        blow = blown(here, rest - rest.clip(-rub, rub))
        return jumped(self.arm, moved, before.qd, after.qd, blow, thrown(here.M, work, self.period))

    def _work(self, before: Sensed, after: Sensed) -> float:
        """Return the work (J) that the fingers have done in a servo period on an object between them."""
        work = work_of_fingers(after.gap - before.gap, self.state.grip)
        return work if work and self._holds(before, after) else 0.0

    def _holds(self, before: Sensed, after: Sensed) -> bool:
        """Return True if the fingers have held or touched an object in a servo period between two readings."""
        return any(before.touch) or any(after.touch) or kept_apart(before.gap, self.state.gap)

    def put_out(self, tau: Array | None) -> None:
        """Command all devices of the cell for the next servo period."""
        cell = self.cell
        cell.arm.drive(tau)
        if cell.hand is not None:
            cell.hand.drive(self.state.gap, self.state.grip)
        if cell.screwdriver is not None:
            cell.screwdriver.drive(self.state.tool)
            cell.screwdriver.attract(self.state.magnet)
        if cell.lamp is not None:
            cell.lamp.switch(self.state.lamp)
