"""The machines on a bench: joints and tendons with servos, sensor channels and outputs."""

from collections.abc import Callable, Mapping, Sequence
from itertools import chain
from math import isfinite

import mujoco
import numpy as np

from handeye.cell.bench import Bench
from handeye.cell.mechanism import Mechanism, scene_for
from handeye.cell.physics_stepper import allow, wake_all
from handeye.core.errors import BadArgument, BadFile, NoSuchName, PhysicsFailed, Refused
from handeye.core.plain_text import counted
from handeye.core.pose import Array
from handeye.core.record import Record
from handeye.ports.axes import Axes, AxesReading, AxisSpec, Channel, Outputs
from handeye.ports.clock import whole_steps

Sense = Callable[[mujoco.MjModel, mujoco.MjData], Sequence[float] | Array]
"""Function that reads the components of a channel from a scene."""


def sensor(name: str) -> Sense:
    """Make the function that reads the scene's sensor `name`. A sensor channel uses this function to get its values."""
    return lambda _, data: np.asarray(data.sensor(name).data)


def switch(name: str, above: float = 0.0) -> Sense:
    """Make the function that reads a switch channel: 1 while the sensor `name` shows more than the threshold
    `above`, otherwise 0.
    """
    return lambda _, data: (float(data.sensor(name).data[0] > above),)


class AxesState(Record, frozen=True, kw_only=True):
    """State of the controller of a machine with n axes."""

    goal: tuple[float, ...]  # where its servos are to be at the end of the period: n numbers, in m and rad
    way: tuple[float, ...]  # how far they go in a physics step, n numbers
    left: int  # physics steps of the period that are left
    powered: bool = True
    latched: dict[str, tuple[float, ...]]
    """For each latched channel, the values of its first nonzero reading since the channel was cleared."""


class BenchAxes(Axes, Mechanism[AxesState]):
    """One machine of a bench: joints or tendons with position servos, and sensor channels. Servos have the names of
    their joints or tendons.
    """

    kind = AxesState
    changes = ("actuator_gainprm", "actuator_biasprm", "tree_sleep_policy")

    def __init__(
        self,
        bench: Bench,
        specs: Sequence[AxisSpec],
        *,
        period: float,
        name: str = "axes",
        channels: Mapping[Channel, Sense] | None = None,
        at_once: Sequence[str] = (),
        bent: Callable[[Array], Array] = np.zeros_like,
    ) -> None:
        """Make a machine from joints of the scene, and add the machine to the bench.

        Args:
            specs: the axes of the machine. The name of an axis is also the name of its joint and its servo. A servo
                without a joint of its name drives a tendon.
            period: time between two goals, in s.
            channels: the sensor channels, each with the function that reads it.
            at_once: axes whose servos get a goal at once, not gradually during the period.
            bent: a function from the potentiometer readings, shape (n,), to the difference between true and
                indicated axis positions.
        """
        self.name, self._bench, self._specs, self._period = name, bench, tuple(specs), period
        self._senses, self._bent = channels or {}, bent
        parts = [part for channel in self._senses for part in channel.parts]
        if len({*parts}) < len(parts):
            raise BadArgument(
                f"the values of {name} need different names; the given names are {', '.join(parts)}"
            )
        self._holds = np.array([spec.holds for spec in specs])
        self._gradual = np.array([spec.name not in at_once for spec in specs])
        self._powered, self._latched = True, dict[str, tuple[float, ...]]()
        self._steps, self._left = whole_steps(period, float(bench.tick)), 0
        self._way = self._set_points = np.zeros(len(specs))
        self.bind(bench.model, bench.data)
        q = self.read().q
        bench.data.ctrl[self._servos] = self._goal = q + self._bent(q)
        bench.add(self)
        bench.before_step.append(self._interpolate)
        if any(channel.latched for channel in self._senses):
            bench.after_step.append(self._latch)

    @scene_for("a machine")
    def bind(self, model: mujoco.MjModel, data: mujoco.MjData) -> None:
        """Find the joints and servos of the machine in a scene."""
        self._servos = np.array([model.actuator(spec.name).id for spec in self._specs], dtype=int)
        joints = [mujoco.mj_name2id(model, mujoco.mjtObj.mjOBJ_JOINT, spec.name) for spec in self._specs]
        self._jointed = np.array([joint >= 0 for joint in joints], dtype=bool)
        self._qpos = model.jnt_qposadr[[joint for joint in joints if joint >= 0]]
        for servo, spec in zip(self._servos, self._specs, strict=True):
            if spec.force is not None:
                model.actuator_forcelimited[servo] = True
                model.actuator_forcerange[servo] = (-spec.force, spec.force)
        self._gains = model.actuator_gainprm[self._servos].copy(), model.actuator_biasprm[self._servos].copy()
        self._sleeps = bool(model.opt.enableflags & int(mujoco.mjtEnableBit.mjENBL_SLEEP))
        starts, counts = data.moment_rowadr[self._servos], data.moment_rownnz[self._servos]
        self._dofs = np.array(
            [dof for at, n in zip(starts, counts, strict=True) for dof in data.moment_colind[at : at + n]],
            dtype=int,
        )
        self._trees = {*map(int, model.dof_treeid[self._dofs])}
        self._allow_sleep(allowed=True)
        if not self._powered:
            self._switch(on=False)

    @property
    def specs(self) -> tuple[AxisSpec, ...]:
        return self._specs

    @property
    def channels(self) -> tuple[Channel, ...]:
        return tuple(self._senses)

    @property
    def period(self) -> float:
        return self._period

    def read(self) -> AxesReading:
        q = self._true()
        felt: dict[str, float] = {}
        for channel in self._senses:
            values = self._latched.get(channel.name) or self._sensed(channel)
            felt.update(zip(channel.parts, values, strict=True))
        told = q - self._bent(q)  # bends are so gentle that this is exact to a hundredth of them
        return AxesReading(time=self._bench.now, q=told, channels=felt)

    def _sensed(self, channel: Channel) -> tuple[float, ...]:
        values = tuple(map(float, self._senses[channel](self._bench.model, self._bench.data)))
        if len(values) != channel.width:
            raise BadArgument(
                f"{channel.name} of {self.name} has {counted(channel.width, 'value')}, not {len(values)}"
            )
        if not all(map(isfinite, values)):
            raise PhysicsFailed(f"{channel.name} of {self.name} shows a value that is not a finite number")
        return values

    def _true(self) -> Array:
        """Return the true positions of the axes, shape (n,)."""
        data = self._bench.data
        q = data.actuator_length[self._servos].copy()
        q[self._jointed] = data.qpos[self._qpos]
        return np.asarray(q)

    def put(self, goal: Array) -> None:
        if np.shape(goal) != (count := len(self._specs),):
            raise BadArgument(
                f"a goal of {self.name} must have {counted(count, 'number')}, one for each axis"
            )
        if not np.isfinite(goal).all():
            raise BadArgument("a goal of an axis is not a finite number")
        if not self._powered:
            raise Refused(f"the power of {self.name} is off")
        here = self._set_point
        self._goal, self._left = goal + self._bent(goal), self._steps
        self._way = np.where(self._gradual, (self._goal - here) / self._steps, 0.0)
        self._plan()
        self._allow_sleep(allowed=bool((self._goal == here).all()))

    def power(self, on: bool) -> None:
        if on == self._powered:
            return
        self._powered = on
        q, (gain, bias) = self._true(), self._gains
        ahead = (
            self._set_point - q + bias[:, 2] / gain[:, 0] * self._bench.data.actuator_velocity[self._servos]
        )
        most = [np.inf if spec.force is None else spec.force for spec in self._specs] / gain[:, 0]
        self._goal = q + np.where(
            self._holds, np.clip(ahead, -most, most), 0.0
        )  # an axis that holds its position keeps pressing as before
        self._way, self._left = np.zeros(len(self._specs)), 0
        self._switch(on=on)
        self._bench.data.ctrl[self._servos] = self._goal
        self._allow_sleep(allowed=False)
        self._allow_sleep(allowed=True)

    def clear(self, channel: str) -> None:
        if not any(each.name == channel and each.latched for each in self._senses):
            super().clear(channel)
        self._latched.pop(channel, None)

    # -- as time passes -------------------------------------------------------------------------------

    def _interpolate(self) -> None:
        """Move the set-points evenly towards the goal during a period. If the set-points jumped to the goal, the
        objects that lie on the axes would be shaken.

        We have measured this: when the set-points jumped, a platter on paths planned with 1 m/s2 reached an
        acceleration of 10.8 m/s2, which moved the blocks on the platter.
        """
        if self._left:
            self._left -= 1
            self._bench.data.ctrl[self._servos] = self._set_points[self._left]
            if not self._left:
                self._allow_sleep(allowed=True)

    def _plan(self) -> None:
        """Compute the set-points for the rest of the period. Row k is the set-point when k physics steps of the
        period are left.
        """
        self._set_points = self._goal - np.arange(self._left)[:, np.newaxis] * self._way

    @property
    def _set_point(self) -> Array:
        """Present set-points of the servos, shape (n,)."""
        return self._goal - self._left * self._way

    def after(self) -> None:
        self._latch()  # a channel may change while all sleeps

    def _latch(self) -> None:
        for channel in self._senses:
            if channel.latched and channel.name not in self._latched:
                values = self._sensed(channel)
                if any(values):
                    self._latched[channel.name] = values

    def _switch(self, *, on: bool) -> None:
        """Switch the gains of the servos on or off. Servos that hold their axes without power keep their gains."""
        model, slack = self._bench.model, self._servos[~self._holds]
        gain, bias = (gains[~self._holds] if on else 0.0 for gains in self._gains)
        model.actuator_gainprm[slack], model.actuator_biasprm[slack] = gain, bias

    def _allow_sleep(self, *, allowed: bool) -> None:
        """Allow the bodies of the machine to sleep while they are at rest, or keep all of them awake."""
        if not self._sleeps:
            return
        for tree in self._trees:
            allow(self._bench.model, tree, allowed=allowed)
        if not allowed:
            wake_all(self._bench.data, self._dofs)

    # -- state ----------------------------------------------------------------------------------------

    def state(self) -> AxesState:
        goal, way = tuple(self._goal.tolist()), tuple(self._way.tolist())
        return AxesState(
            goal=goal, way=way, left=self._left, powered=self._powered, latched=dict(self._latched)
        )

    def check(self, state: AxesState) -> None:
        if not len(state.goal) == len(state.way) == len(self._specs) or not 0 <= state.left <= self._steps:
            raise BadFile("its machine has different axes")
        if not np.isfinite((*state.goal, *state.way, *chain.from_iterable(state.latched.values()))).all():
            raise BadFile("a saved goal or a saved channel of the machine is not a finite number")
        widths = {channel.name: channel.width for channel in self._senses if channel.latched}
        if any(widths.get(name) != len(values) for name, values in state.latched.items()):
            raise BadFile("its machine has different channels")

    def restore(self, state: AxesState) -> None:
        self._goal, self._way, self._left = np.array(state.goal), np.array(state.way), state.left
        self._plan()
        self._powered, self._latched = state.powered, dict(state.latched)


class OutputsState(Record, frozen=True, kw_only=True):
    values: dict[str, float]


class BenchOutputs(Outputs, Mechanism[OutputsState]):
    """Outputs of a machine on a bench. Each output is 0 until it is set."""

    kind = OutputsState

    def __init__(self, bench: Bench, name: str, outputs: Mapping[str, Callable[[float], None]]) -> None:
        """Make outputs by name. Each output has a function that sets the output's value in its mechanism."""
        self.name, self._outputs = name, outputs
        self._values = dict.fromkeys(outputs, 0.0)
        bench.add(self)

    @property
    def names(self) -> tuple[str, ...]:
        return tuple(self._outputs)

    def set(self, name: str, value: float) -> None:
        if name not in self._outputs:
            raise NoSuchName(f"there is no output {name}; the outputs are {', '.join(self._outputs)}")
        if not np.isfinite(value):
            raise BadArgument(f"the output {name} is set to a value that is not a finite number")
        self._values[name] = float(value)

    def bind(self, model: mujoco.MjModel, data: mujoco.MjData) -> None:
        """Do nothing: outputs have no part in the scene."""

    def before(self, seconds: float) -> None:
        for name, act in self._outputs.items():
            act(self._values[name])

    def state(self) -> OutputsState:
        return OutputsState(values=dict(self._values))

    def check(self, state: OutputsState) -> None:
        if {*state.values} != {*self._outputs} or not np.isfinite([*state.values.values()]).all():
            raise BadFile("the saved outputs belong to another machine")

    def restore(self, state: OutputsState) -> None:
        self._values = dict(state.values)
