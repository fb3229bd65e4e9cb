"""A simulated arm: torque motors, brakes, potentiometers, tachometers, and a watchdog."""

from dataclasses import dataclass
from typing import Final

import mujoco
import numpy as np

from handeye.arm.kinematics import jacobian
from handeye.arm.model import ArmModel, constants
from handeye.cell.device_errors import ArmErrors
from handeye.cell.mechanism import Mechanism
from handeye.cell.physics_stepper import allow, wake
from handeye.cell.signal_lines import SOUND, Converters, SignalLines
from handeye.cell.state import figures, finite
from handeye.core.errors import BadArgument
from handeye.core.plain_text import counted
from handeye.core.pose import Array
from handeye.core.record import Record
from handeye.core.small_arrays import limited, span
from handeye.ports.workcell import ArmPort, ArmReading

_LATE: Final = 1e-6  # share of a period lost to rounding


@dataclass(slots=True)
class Watchdog:
    """Switches off the drives of an arm when its computer stops answering. The drives stay off until the program
    sets the brakes.
    """

    period: float  # s
    tripped: bool = False
    unanswered: float = 0.0  # s since the arm was driven

    def answer(self, *, braked: bool) -> None:
        """Record that the computer has sent a command. A command to set the brakes resets a tripped watchdog."""
        self.unanswered = 0.0
        self.tripped = self.tripped and not braked

    def wait(self, seconds: float) -> None:
        """Add the next `seconds` to the time since the last command. During these seconds, the drives hold that
        command. The watchdog trips if the total exceeds a servo period.
        """
        self.unanswered += seconds
        self.tripped = self.tripped or self.unanswered > self.period * (1 + _LATE)


class JointSensors:
    """The sensors of n joints, connected by lines named `potentiometer.N` and `tachometer.N`."""

    def __init__(self, errors: ArmErrors, noise: np.random.Generator, lines: SignalLines) -> None:
        """Make sensors with the given errors. `noise` generates their noise."""
        self._errors, self._noise, self._lines = errors, noise, lines
        self._joints = len(errors.offset)
        self._sigma = np.concatenate((errors.pot_noise, errors.tachometer_noise))
        self._converters = Converters(np.concatenate((errors.pot_step, errors.tachometer_step)))

    def read(self, q: Array, qd: Array) -> tuple[Array, Array]:
        """Return the sensor readings for true positions and rates, shape (n,), in rad or m, and rad/s or m/s."""
        n, lines = self._joints, self._lines
        told = np.empty(2 * n)
        told[:n], told[n:] = self._errors.readings(q), qd
        told += self._sigma * self._noise.standard_normal(2 * n)
        if lines.defects:
            told[:n] = lines.carried_each("potentiometer", told[:n])
            told[n:] = lines.carried_each("tachometer", told[n:])
        told = self._converters(told)
        return told[:n], told[n:]


_BRAKE_STIFFNESS: Final = ((0.004, 1.0), (0.999, 0.9999, 0.001, 0.5, 2.0))
"""Constraint stiffness of the brakes. With this stiffness, the arm creeps by less than .01 degrees in 10 s. When the
simulator puts the arm to sleep, the creeping ends.
"""


class ArmState(Record, frozen=True, kw_only=True):
    """State of an arm: its readings, torques and watchdog."""

    q: tuple[float, ...]
    qd: tuple[float, ...]
    braked: bool
    command: tuple[float, ...] | None  # torques; None for the brakes
    tripped: bool
    unanswered: float  # s since it was driven


class SimulatedArm(Mechanism[ArmState], ArmPort):
    """Motors, brakes and sensors of n joints. In the MuJoCo model, the joints are called `<prefix>j1`, `<prefix>j2`,
    ...

    A brake is dry friction in the joint. The brake holds the joint in place, and slips under a torque greater than the
    torque of the brake.
    """

    kind = ArmState
    changes = ("dof_frictionloss", "tree_sleep_policy")

    def __init__(
        self,
        model: mujoco.MjModel,
        data: mujoco.MjData,
        prefix: str,
        *,
        arm: ArmModel,
        posture: Array,
        errors: ArmErrors,
        noise: np.random.Generator,
        lines: SignalLines = SOUND,
    ) -> None:
        """Make an arm at a given posture, shape (n,), in rad or m. Its brakes are set. `noise` generates the noise of
        the arm's sensors.

        The signal lines of an arm are `potentiometer.N`, `tachometer.N`, `drive.N`, `brake.N` and `friction.N` for
        joint N. The lines `force.x`, `force.y` and `force.z` carry the offset of the drives as a force at the hand (N,
        in W): 0 in a sound arm. The drives add the torques of this force to the commanded torques. Torques from the
        computer arrive only while the line `servo` carries 1.
        """
        self.name = prefix.rstrip("/")
        names = [f"{prefix}j{number}" for number in range(1, len(arm.joints) + 1)]
        joints = [model.joint(name).id for name in names]
        self.qpos = model.jnt_qposadr[joints]  # indices of its joints in the simulator's positions
        self.dofs = model.jnt_dofadr[joints]
        self.last_link = int(model.jnt_bodyid[joints[-1]])  # the body that carries the hand
        self.watchdog = Watchdog(arm.servo.period)
        self.motors = np.array([model.actuator(name).id for name in names])
        """Ids of the motors, which are actuators of the MuJoCo model."""
        self._joints, self._rates, self._drives = span(self.qpos), span(self.dofs), span(self.motors)
        self._limits = model.actuator_ctrlrange[self.motors, 1].copy()
        self._friction = model.dof_frictionloss[self.dofs].copy()
        self._brake, self._errors = constants(arm).brake, errors
        self._arm, self._lines = arm, lines
        self._model, self._data = model, data
        self._sensors = JointSensors(errors, noise, lines)
        self._torque_converters = Converters(errors.torque_step)
        self._tree = int(model.dof_treeid[self.dofs[0]])
        model.dof_solref[self.dofs] = _BRAKE_STIFFNESS[0]
        model.dof_solimp[self.dofs] = _BRAKE_STIFFNESS[1]
        data.qpos[self.qpos] = posture
        self._torque: Array | None = None
        self._braked = True
        self._put(None)
        self._read(posture.copy(), np.zeros(len(posture)), braked=True)

    def read(self) -> ArmReading:
        return self._reading

    def drive(self, torque: Array | None) -> None:
        if torque is not None:
            torque, joints = np.array(torque, dtype=float), len(self.dofs)  # a copy of its own
            if torque.shape != (joints,):
                raise BadArgument(
                    f"torques of shape {torque.shape} were sent to an arm of {counted(joints, 'joint')}"
                )
            finite(torque, "the torque")
            if not self._lines.carried("servo", 1.0):
                return
        self._torque = torque
        self.watchdog.answer(braked=torque is None)

    def before(self, seconds: float) -> None:
        if self._torque is not None:
            self.watchdog.wait(seconds)
        self._put(None if self.watchdog.tripped else self._torque)

    def _put(self, torque: Array | None) -> None:
        """Apply a torque, shape (n,), from now on. If the torque is None, set the brakes."""
        self._braked = torque is None
        allow(self._model, self._tree, allowed=self._braked)
        if not self._braked:
            wake(self._data, int(self.dofs[0]))
        line, holding = ("brake", self._brake) if self._braked else ("friction", self._friction)
        self._model.dof_frictionloss[self._rates] = self._lines.carried_each(line, holding)
        driven = 0.0 if torque is None else limited(self._driven(torque), self._limits)
        self._data.ctrl[self._drives] = driven

    def _driven(self, torque: Array) -> Array:
        """Return the torque that the drives produce for a commanded torque, shape (n,)."""
        torque = self._torque_converters(torque) * self._errors.drive_gain
        if not self._lines.defects:
            return torque
        torque = self._lines.carried_each("drive", torque)
        force = np.array([self._lines.carried(f"force.{axis}", 0.0) for axis in "xyz"])
        return np.asarray(torque + jacobian(self._arm, self._data.qpos[self._joints])[:3].T @ force)

    def after(self) -> None:
        q, qd = self._sensors.read(self._data.qpos[self._joints], self._data.qvel[self._rates])
        self._read(q, qd, braked=self._braked)

    def _read(self, q: Array, qd: Array, *, braked: bool) -> None:
        """Store the readings of the present moment as arrays that cannot be changed."""
        q.setflags(write=False)
        qd.setflags(write=False)
        self._reading = ArmReading(q=q, qd=qd, braked=braked)

    def state(self) -> ArmState:
        read = self._reading
        return ArmState(
            q=figures(read.q),
            qd=figures(read.qd),
            braked=read.braked,
            command=None if self._torque is None else figures(self._torque),
            tripped=self.watchdog.tripped,
            unanswered=self.watchdog.unanswered,
        )

    def check(self, state: ArmState) -> None:
        lengths = {len(state.q), len(state.qd), len(self.dofs if state.command is None else state.command)}
        if lengths != {len(self.dofs)}:
            raise ValueError("the saved state is the state of an arm with a different number of joints")
        finite([*state.q, *state.qd, *(state.command or ()), state.unanswered], "the arm")
        if state.unanswered < 0:
            raise ValueError("the saved time since the last command to the arm is negative")

    def restore(self, state: ArmState) -> None:
        self._read(np.array(state.q), np.array(state.qd), braked=state.braked)
        self._torque = None if state.command is None else np.array(state.command)
        self.watchdog.tripped, self.watchdog.unanswered = state.tripped, state.unanswered
