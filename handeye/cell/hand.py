"""A simulated hand with its lamp and its screwdriver. The hand has a potentiometer, two switches and one motor, which
moves both fingers.
"""

from collections.abc import Sequence
from typing import Final

import mujoco
import numpy as np

from handeye.arm.model import HandModel
from handeye.cell.arm import Watchdog
from handeye.cell.device_errors import HandErrors
from handeye.cell.mechanism import Mechanism
from handeye.cell.physics_stepper import wake
from handeye.cell.signal_lines import SOUND, SignalLines, converted
from handeye.cell.state import finite
from handeye.core.record import Record
from handeye.ports.workcell import HandPort, HandReading, LampPort, ScrewdriverPort

_LAG: Final = 0.03  # s, time constant of the finger servo. Assembly study: 60 N s/m over 2000 N/m.


class HandState(Record, frozen=True, kw_only=True):
    """State of a hand: its readings, and the state of its servo."""

    gap: float
    touch: tuple[bool, bool]
    set_point: float  # of the finger servo, in m
    command: tuple[float, float] | None  # commanded gap (m) and grip (N)


class SimulatedHand(Mechanism[HandState], HandPort):
    """Two fingers, their motor `grip`, and the sensors `switch_a` and `switch_b`. In the MuJoCo model, all their names
    have a common prefix.

    The activation of the actuator `grip` is the set-point of the finger servo, and the control of the actuator is
    the rate of that set-point. The fingers therefore move smoothly between two commands, as with an analogue servo.
    """

    kind = HandState
    changes = ("actuator_gainprm", "actuator_biasprm", "actuator_forcerange")

    def __init__(
        self,
        model: mujoco.MjModel,
        data: mujoco.MjData,
        prefix: str,
        *,
        hand: HandModel,
        errors: HandErrors,
        noise: np.random.Generator,
        lines: SignalLines = SOUND,
    ) -> None:
        """Make a hand at rest.

        The lines of a hand are `gap_potentiometer`, `finger_motor`, `finger_switch.plus_y` and
        `finger_switch.minus_y`. The lines `switch_force.plus_y` and `switch_force.minus_y` carry one factor for each
        switch. The hand multiplies the force at which the switch closes by this factor. While the line `switches`
        carries 1, the two switches are exchanged.
        """
        self.name = f"{prefix}hand"
        self._model, self._data = model, data
        self._hand, self._errors, self._noise, self._lines = hand, errors, noise, lines
        self._motor = model.actuator(f"{prefix}grip").id
        fingers = [model.joint(f"{prefix}finger_{side}").id for side in "ab"]
        self._fingers = [int(model.jnt_qposadr[finger]) for finger in fingers]
        self._dof = int(model.jnt_dofadr[fingers[0]])
        self._switches = [int(model.sensor(f"{prefix}switch_{side}").adr[0]) for side in "ab"]
        self._set_point = self.gap  # of the finger servo, in m on the scale of the sensor
        self._command: tuple[float, float] | None = None
        self._reading = HandReading(gap=self.gap, touch=(False, False))
        self._act = int(model.actuator_actadr[self._motor])
        data.act[self._act] = self._set_point

    @property
    def gap(self) -> float:
        """The true gap between the finger tips, in m."""
        first, second = self._fingers
        qpos = self._data.qpos
        return float(qpos[first] + qpos[second])

    def read(self) -> HandReading:
        return self._reading

    def drive(self, gap: float, grip: float) -> None:
        if self._command == (gap, grip):
            return
        finite([gap, grip], "the gap or the grip")
        wake(self._data, self._dof)
        self._command = gap, grip

    def before(self, seconds: float) -> None:
        """Move the set-point towards the commanded gap, but never far ahead of fingers that are blocked. Set-point and
        command are in the scale of the sensor.
        """
        if self._command is None:
            return
        gap, grip = self._command
        goal = min(max(gap, 0.0), self._hand.gap_max)
        here, step = self._reading.gap, self._hand.gap_speed * seconds
        give = self._hand.grasp.give
        start = min(max(self._set_point, here - give), here + give)
        if (goal - here) * (start - here) < 0 and abs(start - here) > step:
            start = here
        moved = min(max(goal - start, -step), step)
        if abs(start + moved - self._set_point) > step / 4:  # not just noise of the reading
            wake(self._data, self._dof)
        self._set_point = start + moved
        grip = self._lines.carried("finger_motor", min(max(grip, 0.0), self._hand.grip))
        self._press(grip, start, moved / seconds)

    def _press(self, grip: float, start: float, rate: float) -> None:
        """Set the force limit (N), a stiffness that is proportional to the force limit, and the set-point. The
        set-point begins at `start` (m, in the scale of the sensor) and moves at `rate` (m/s).

        The actuator uses the true gap, which the servo does not know. The set-point is therefore shifted by the
        error of the reading, and moved ahead by the lag of the servo.
        """
        model, motor, stiffness = self._model, self._motor, grip / self._hand.grasp.give
        bias, force = model.actuator_biasprm[motor], model.actuator_forcerange[motor]
        model.actuator_gainprm[motor, 0] = stiffness
        bias[1], bias[2] = -stiffness, -stiffness * _LAG
        force[0], force[1] = -grip, grip
        self._data.act[self._act] = start + rate * _LAG - (self._reading.gap - self.gap)
        self._data.ctrl[motor] = rate

    def after(self) -> None:
        errors, noise = self._errors, self._noise.standard_normal()
        gap = self.gap * (1 + errors.gap_scale) + errors.gap_offset + errors.gap_noise * noise
        gap = self._lines.carried("gap_potentiometer", gap)
        first, second = self._told("plus_y", 0), self._told("minus_y", 1)
        exchanged = bool(self._lines.carried("switches", 0.0))
        self._reading = HandReading(
            gap=converted(gap, errors.gap_step),
            touch=(second, first) if exchanged else (first, second),
        )

    def _told(self, finger: str, number: int) -> bool:
        """Return the reading of the switch of a finger."""
        force = self._errors.switch_force[number] * self._lines.carried(f"switch_force.{finger}", 1.0)
        closed = self._data.sensordata[self._switches[number]] > force
        return bool(self._lines.carried(f"finger_switch.{finger}", float(closed)))

    def state(self) -> HandState:
        read = self._reading
        return HandState(gap=read.gap, touch=read.touch, set_point=self._set_point, command=self._command)

    def check(self, state: HandState) -> None:
        finite([state.gap, state.set_point, *(state.command or ())], "the hand")

    def restore(self, state: HandState) -> None:
        self._reading = HandReading(gap=state.gap, touch=state.touch)
        self._set_point, self._command = state.set_point, state.command


class LampState(Record, frozen=True, kw_only=True):
    """State of a lamp."""

    lit: bool


class SimulatedLamp(Mechanism[LampState], LampPort):
    """A lamp that is represented by a material of the MuJoCo model."""

    kind = LampState
    changes = ("mat_rgba", "mat_emission")

    _LIT: Final = (np.array((1.0, 0.96, 0.85, 1.0), dtype=np.float32), 1.0)

    def __init__(self, model: mujoco.MjModel, material: str, lines: SignalLines = SOUND) -> None:
        """Make a lamp that is switched off. Its line is `lamp`."""
        self.name = material
        self._lines = lines
        self._model = model
        self._material = model.material(material).id
        self._dark = (model.mat_rgba[self._material].copy(), 0.0)
        self._lit = False

    def switch(self, lit: bool) -> None:
        self._lit = lit

    def before(self, seconds: float) -> None:
        rgba, emission = self._LIT if self._lines.carried("lamp", float(self._lit)) else self._dark
        self._model.mat_rgba[self._material] = rgba
        self._model.mat_emission[self._material] = emission

    def state(self) -> LampState:
        return LampState(lit=self._lit)

    def restore(self, state: LampState) -> None:
        self._lit = state.lit


class ScrewdriverState(Record, frozen=True, kw_only=True):
    """State of a screwdriver: reading and commanded speed."""

    torque: float
    command: float  # rad/s
    magnet: bool = True  # the magnet of the bit is on


class SimulatedScrewdriver(Mechanism[ScrewdriverState], ScrewdriverPort):
    """The motor of a screwdriver. The torque of the motor is read from actuators of the model. The task, which models
    the screw threads, computes the effect of the screwdriver's speed.
    """

    name = "screwdriver"
    kind = ScrewdriverState

    def __init__(
        self,
        model: mujoco.MjModel,
        data: mujoco.MjData,
        motors: Sequence[str],
        *,
        torque_noise: float,
        noise: np.random.Generator,
        watchdog: Watchdog,
        lines: SignalLines = SOUND,
    ) -> None:
        """Make a screwdriver at rest. `torque_noise` is the standard deviation of the screwdriver's torque reading, in
        N m.

        The torque of the screwdriver is the sum of the torques of `motors`, counter-clockwise about the spindle.
        The watchdog of the arm that carries the screwdriver also stops the screwdriver's motor. The lines are
        `screwdriver.current`, from which the torque is read, and `screwdriver.motor`.
        """
        self._data, self._watchdog, self._lines = data, watchdog, lines
        self._motors = [model.actuator(name).id for name in motors]
        self._torque_noise, self._noise = torque_noise, noise
        self._command = self._torque = 0.0
        self.magnet = True
        """True if the magnet of the bit is commanded to be on. `cell/threads.py` switches the magnet."""

    @property
    def speed(self) -> float:
        """Commanded speed of the motor, in rad/s, positive to drive a screw in."""
        return 0.0 if self._watchdog.tripped else self._lines.carried("screwdriver.motor", self._command)

    def torque(self) -> float:
        return self._torque

    def drive(self, speed: float) -> None:
        if speed != self._command:
            finite([speed], "the speed of the screwdriver")
            self._command = speed

    def attract(self, on: bool) -> None:
        self.magnet = on

    def before(self, seconds: float) -> None:
        if self._watchdog.tripped:
            self._command = 0.0

    def after(self) -> None:
        forces = self._data.actuator_force
        true = -float(sum([forces[motor] for motor in self._motors]))
        told = float(true + self._torque_noise * self._noise.standard_normal())
        self._torque = self._lines.carried("screwdriver.current", told)

    def state(self) -> ScrewdriverState:
        return ScrewdriverState(torque=self._torque, command=self._command, magnet=self.magnet)

    def check(self, state: ScrewdriverState) -> None:
        finite([state.torque, state.command], "the screwdriver")

    def restore(self, state: ScrewdriverState) -> None:
        self._torque, self._command, self.magnet = state.torque, state.command, state.magnet
