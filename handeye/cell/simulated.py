"""A simulated cell: a MuJoCo model, the devices in it, and what a task adds to its physics, under one clock."""

from collections.abc import Sequence
from typing import Any, Final

import msgspec
import mujoco
import numpy as np

from handeye.cell.arm import SimulatedArm
from handeye.cell.camera import SimulatedCamera
from handeye.cell.hand import SimulatedHand
from handeye.cell.lamp import SimulatedLamp
from handeye.cell.lines import SOUND, Lines
from handeye.cell.mechanism import Mechanism
from handeye.cell.screwdriver import SimulatedScrewdriver
from handeye.cell.sleep import asleep
from handeye.cell.state import CellState, check_noise, noise_state, set_noise
from handeye.cell.stepper import Stepper
from handeye.cell.truth import Drawn, Truth
from handeye.errors import HandeyeError, InvalidInput
from handeye.ports.camera import Renderer
from handeye.ports.clock import Clock, whole_steps
from handeye.ports.workcell import Workcell

INTEGRATION: Final = int(mujoco.mjtState.mjSTATE_INTEGRATION)
"""MuJoCo's integration state: enough to continue from a state."""

_HELD: Final = 1 / 60
"""s for which a device may hold what it does to the simulator: the finger servo moves on, threads take screws."""


class SimulationError(HandeyeError):
    """The physics of the simulated cell broke down; not an event of the assembly."""

    def __init__(self, warning: str) -> None:
        """Say which warning the simulator gave, by its name; when, a run knows by its own time."""
        super().__init__(f"the simulated cell broke down ({warning})")
        self.warning = warning


class SimulatedCell(Clock):
    """A cell in one drawn world. Equal worlds and equal drives give equal bytes."""

    def __init__(
        self,
        model: mujoco.MjModel,
        data: mujoco.MjData,
        *,
        arm: SimulatedArm,
        hand: SimulatedHand | None = None,
        screwdriver: SimulatedScrewdriver | None = None,
        lamp: SimulatedLamp | None = None,
        camera: SimulatedCamera | None = None,
        mechanisms: Sequence[Mechanism[Any]] = (),
        lines: Lines = SOUND,
        stepper: Stepper | None = None,
        noise: np.random.Generator,
    ) -> None:
        """Switch a cell on; its devices are read for the first time.

        Args:
            mechanisms: whatever else acts on the model, in the order in which it does: threads, more arms.
            lines: those that its devices were given.
            stepper: lets its physics go on; by default one that looks at nothing.
            noise: the generator that all sensors but the camera draw from.

        Raises:
            ValueError: two of them have one name, by which their states are found.
        """
        self._model, self._data, self._noise = model, data, noise
        self.arm = arm
        """For the experimenter, who may push it."""
        self.lines = lines
        """Lines of its devices, and what is broken on them; for who carries out a program, who knows its stages."""
        self._drawn = Drawn(groups=model.geom_group.copy(), colours=model.mat_rgba.copy())
        devices = (arm, hand, screwdriver, lamp)
        self._mechanisms: tuple[Mechanism[Any], ...] = (
            *((lines,) if lines.defects else ()),
            *(device for device in devices if device is not None),
            *mechanisms,
            *(() if camera is None else (camera,)),
        )
        names = [part.name for part in self._mechanisms]
        if len({*names}) < len(names):
            raise ValueError(
                f"devices and mechanisms of a cell have names of their own; these are {', '.join(names)}"
            )
        self._changes = sorted({field for part in self._mechanisms for field in part.changes})
        self.devices = Workcell(
            clock=self, arm=arm, hand=hand, screwdriver=screwdriver, lamp=lamp, camera=camera
        )
        """The cell as the working phase knows it."""
        self._most = max(1, round(_HELD / model.opt.timestep))
        self._stepper = stepper or Stepper(model, data)
        mujoco.mj_forward(model, data)
        self._read()

    @property
    def truth(self) -> Truth:
        """The truth; for the referee, the trace and tests only."""
        return Truth(
            model=self._model,
            data=self._data,
            drawn=self._drawn,
            states={part.name: part.state() for part in self._mechanisms},
            mechanisms=self._mechanisms,
        )

    @property
    def renderer(self) -> Renderer:
        """How its camera's pictures are made, if it has one."""
        camera = self.devices.camera
        return Renderer(method="none") if camera is None else camera.renderer

    @property
    def now(self) -> float:
        return float(self._data.time)

    def begin_stage(self, number: int) -> None:
        """Begin a stage of the program, by its number from 1: faults may set in with it."""
        for part in self._mechanisms:
            part.begin_stage(number)

    def advance(self, seconds: float) -> None:
        """Let time pass.

        Raises:
            InvalidInput: not a whole number of physics steps.
            SimulationError: the physics broke down.
        """
        model, data = self._model, self._data
        left = whole_steps(seconds, model.opt.timestep)
        while left:
            steps = min(left, self._most)
            for part in self._mechanisms:
                part.before(steps * model.opt.timestep)
            if asleep(data):
                self.lines.before((left - steps) * model.opt.timestep)  # what is broken drifts on
                steps = left
                data.time += steps * model.opt.timestep
            else:
                self._stepper.step(steps)
                self._check_physics()
            self._read()
            left -= steps

    def _check_physics(self) -> None:
        warnings = self._data.warning.number
        if warnings.any():
            raise SimulationError(mujoco.mjtWarning(int(np.argmax(warnings != 0))).name)

    def _read(self) -> None:
        for part in self._mechanisms:
            part.after()

    def capture(self) -> CellState:
        """All that the future of this cell depends on; `restore` puts it back, in this cell or its like."""
        physics = np.empty(mujoco.mj_stateSize(self._model, INTEGRATION))
        mujoco.mj_getState(self._model, self._data, physics, INTEGRATION)
        return CellState(
            physics=physics,
            figures={name: np.array(getattr(self._model, name), dtype=float) for name in self._changes},
            noise=noise_state(self._noise),
            mechanisms={part.name: msgspec.to_builtins(part.state()) for part in self._mechanisms},
        )

    def restore(self, state: CellState) -> None:
        """Put the cell into a state; what follows is the same, to the byte, whatever was before.

        Sleep is not part of a state: everything wakes, and falls asleep again where it stands still. Therefore a run
        is the same with and without a stop only if its cell is put into its own state wherever it might be stopped.

        Raises:
            InvalidInput: it is the state of another kind of cell, or no state at all.
        """
        try:
            self._check(state)
            states = [self._checked(part, state) for part in self._mechanisms]
        except (ValueError, KeyError, TypeError, OverflowError, RecursionError, InvalidInput) as error:
            raise InvalidInput(f"this is not a state of this work cell: {error}") from None
        model, data = self._model, self._data
        set_noise(self._noise, state.noise)
        for name, values in state.figures.items():
            getattr(model, name)[:] = values
        for part, own in zip(self._mechanisms, states, strict=True):
            part.restore(own)
        mujoco.mj_resetData(model, data)
        mujoco.mj_setState(model, data, state.physics, INTEGRATION)
        mujoco.mj_forward(model, data)
        mujoco.mj_setState(model, data, state.physics, INTEGRATION)  # what the solver starts from, too

    def _check(self, state: CellState) -> None:
        """Raises ValueError unless every figure of a state has its place in this cell."""
        if state.physics.shape != (mujoco.mj_stateSize(self._model, INTEGRATION),):
            raise ValueError("its physics belong to another scene")
        if set(state.figures) != set(self._changes):
            raise ValueError("it lacks figures that change in this scene")
        for name, values in state.figures.items():
            if values.shape != getattr(self._model, name).shape:
                raise ValueError(f"{name} has another size here")
        if not all(np.isfinite(values).all() for values in (state.physics, *state.figures.values())):
            raise ValueError("some of its figures are not finite numbers")
        if not 0 <= state.time < 1e9:
            raise ValueError("its clock shows what it cannot")
        if set(state.mechanisms) != {part.name for part in self._mechanisms}:
            raise ValueError("it has other devices and mechanisms")
        check_noise(state.noise)

    def _checked(self, part: Mechanism[Any], state: CellState) -> msgspec.Struct:
        """The state of one mechanism. Raises what `Mechanism.check` does."""
        own: msgspec.Struct = msgspec.convert(state.mechanisms[part.name], part.kind)
        part.check(own)
        return own
