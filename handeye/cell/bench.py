"""Bench: machines whose servos are closed outside the computer, in one scene under one clock."""

from collections.abc import Callable, Mapping, Sequence
from typing import Final

import mujoco
import numpy as np

from handeye.cell.mechanism import Mechanism
from handeye.core.errors import BadArgument, BadFile, InvalidInput
from handeye.core.pose import Array
from handeye.core.record import Record
from handeye.ports.axes import Axes, AxesReading, AxisSpec
from handeye.ports.clock import Clock, whole_steps

MICROSECONDS: Final = 1_000_000
_LATEST: Final = 10**15
FASTEST: Final = 1000.0
"""m/s and rad/s: nothing on a bench gets near it, unless the solver of its contacts has failed."""


class BenchTime(Record, frozen=True, kw_only=True):
    """What the clock of a bench shows."""

    microseconds: int


class Bench(Clock, Mechanism[BenchTime]):
    """A scene, and its time in whole microseconds: steps of the physics add up to it without rounding."""

    name = "clock"
    kind = BenchTime

    def __init__(self, model: mujoco.MjModel) -> None:
        self.model, self.data = model, mujoco.MjData(model)
        self.before_step: list[Callable[[], None]] = []
        """What the machines do before every step of the physics."""
        self.passed: list[Callable[[], None]] = []
        """Those who look on: called whenever time has passed."""
        self._step = round(model.opt.timestep * MICROSECONDS)
        self._now = 0
        mujoco.mj_forward(self.model, self.data)

    def replace(self, spec: mujoco.MjSpec) -> None:
        """Go on with a changed scene: what was there before is where it was."""
        self.model, self.data = spec.recompile(self.model, self.data)
        mujoco.mj_forward(self.model, self.data)

    @property
    def now(self) -> float:
        return self._now / MICROSECONDS

    @property
    def step(self) -> float:
        """s of one step of the physics."""
        return self._step / MICROSECONDS

    def advance(self, seconds: float) -> None:
        for _ in range(whole_steps(seconds, self.step)):
            for act in self.before_step:
                act()
            mujoco.mj_step(self.model, self.data)
            self._now += self._step
        if not np.abs(self.data.qvel).max(initial=0.0) < FASTEST:  # nor is what is not a number
            raise InvalidInput(f"the physics of the bench has failed at {self.now:.3f} s")
        for look in self.passed:
            look()

    def state(self) -> BenchTime:
        return BenchTime(microseconds=self._now)

    def check(self, state: BenchTime) -> None:
        if not 0 <= state.microseconds < _LATEST:
            raise BadFile("its clock shows what it cannot")

    def restore(self, state: BenchTime) -> None:
        self._now = state.microseconds


class AxesState(Record, frozen=True, kw_only=True):
    """What the controller of a machine holds."""

    goal: tuple[float, ...]
    """Where its servos are to be at the end of the period, m and rad."""
    way: tuple[float, ...]
    """How far they go in a step of the physics."""
    left: int
    """Steps of the period that are left."""


class BenchAxes(Axes, Mechanism[AxesState]):
    """One machine of a bench: joints with position servos, a hand, and what it senses."""

    name = "axes"
    kind = AxesState

    def __init__(
        self,
        bench: Bench,
        specs: Sequence[AxisSpec],
        *,
        hand: str,
        period: float,
        channels: Mapping[str, str],
        bent: Callable[[Array], Array] = np.zeros_like,
    ) -> None:
        """Take joints of a scene for a machine.

        Args:
            specs: its axes, by the names of joints and servos.
            hand: name of the servo of its hand.
            period: s between two goals.
            channels: sensors of three components by the channel that they are told as, with x, y and z behind it.
            bent: how far axes are from where their potentiometers tell them to be, by what these tell, shape (n,).
        """
        self._bench, self._specs, self._period = bench, tuple(specs), period
        self._hand, self._channels, self._bent = hand, channels, bent
        q = self.read().q
        self._goal, self._steps = q + bent(q), whole_steps(period, bench.step)
        self._way, self._left = np.zeros(len(specs)), 0
        self._servos: list[int] = []
        bench.before_step.append(self._interpolate)

    @property
    def specs(self) -> tuple[AxisSpec, ...]:
        return self._specs

    @property
    def period(self) -> float:
        return self._period

    def read(self) -> AxesReading:
        data = self._bench.data
        felt = {
            channel + axis: float(value)
            for channel, sensor in self._channels.items()
            for axis, value in zip("xyz", data.sensor(sensor).data, strict=True)
        }
        gap = float(data.actuator(self._hand).length[0])
        q = np.array([data.joint(spec.name).qpos[0] for spec in self._specs])
        told = q - self._bent(q)  # bends are so gentle that this is exact to a hundredth of them
        return AxesReading(time=self._bench.now, q=told, channels={**felt, "gap": gap})

    def put(self, goal: Array, hand: float) -> None:
        if not (np.isfinite(goal).all() and np.isfinite(hand)):
            raise BadArgument("a goal of an axis is not a finite number")
        data, told = self._bench.data, self._put
        self._servos = self._numbers()
        self._goal, self._left = goal + self._bent(goal), self._steps
        self._way = (self._goal - told) / self._steps
        data.actuator(self._hand).ctrl = hand

    def state(self) -> AxesState:
        return AxesState(goal=tuple(self._goal.tolist()), way=tuple(self._way.tolist()), left=self._left)

    def check(self, state: AxesState) -> None:
        if not len(state.goal) == len(state.way) == len(self._specs) or not 0 <= state.left <= self._steps:
            raise BadFile("its machine has other axes")
        if not np.isfinite((*state.goal, *state.way)).all():
            raise BadFile("a goal of its machine is not a finite number")

    def restore(self, state: AxesState) -> None:
        self._goal, self._way, self._left = np.array(state.goal), np.array(state.way), state.left
        self._servos = self._numbers()

    def _numbers(self) -> list[int]:
        """The numbers of its servos, which change with the scene."""
        return [self._bench.data.actuator(spec.name).id for spec in self._specs]

    def _interpolate(self) -> None:
        """Go on towards the goal, evenly for a period: goals that jump shake what lies on the axes.

        Measured: the platter's acceleration had peaks of 10.8 m/s2 on ways planned with 1, which drew blocks along.
        """
        if self._left:
            self._left -= 1
            self._bench.data.ctrl[self._servos] = self._put

    @property
    def _put(self) -> Array:
        """What the servos are told now, shape (n,)."""
        return self._goal - self._left * self._way
