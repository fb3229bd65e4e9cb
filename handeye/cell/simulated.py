"""The simulated work cell: MuJoCo behind the ports."""

from typing import Final

import mujoco
import numpy as np

from handeye.cell.camera import SimulatedCamera
from handeye.cell.drives import HandDrive, Lamp, SimulatedArm
from handeye.cell.renderers import make_renderer
from handeye.cell.sensors import Sensors
from handeye.cell.state import MUTABLE, CellState, noise_state, set_noise
from handeye.cell.truth import Drawn, Truth
from handeye.errors import HandeyeError, InvalidInput
from handeye.ports.workcell import Drive, Sensed, Workcell
from handeye.tasks.water_pump.clamping import Resting
from handeye.tasks.water_pump.pump_world import PumpWorld
from handeye.tasks.water_pump.scene import build
from handeye.tasks.water_pump.threads import Threads
from handeye.units import DEGREE, INCH, JIFFY

INTEGRATION: Final = int(mujoco.mjtState.mjSTATE_INTEGRATION)
"""What MuJoCo needs to go on from a state as if it had never left it."""

PARK: Final = np.array([-19.7, 104.0, 17.5, 0.0, 76.0, 70.3]) * [
    DEGREE, DEGREE, INCH, DEGREE, DEGREE, DEGREE
]  # fmt: skip
"""Where the arm stands at first: hand at (20, 28, 8) in, pointing down. Layout study, section 2."""


class SimulationError(HandeyeError):
    """The physics of the simulated cell broke down; not an event of the assembly."""


class SimulatedCell(Workcell):
    """A cell in one drawn world. Equal worlds and equal drives give equal bytes.

    After a missed servo period the drives stay cut until a `Drive` with brakes acknowledges it.
    """

    def __init__(self, world: PumpWorld, *, camera: str = "auto", rest: bool = True) -> None:
        """Build the cell of a world.

        Args:
            camera: how to make pictures: `auto`, `gl` or `ray`.
            rest: let parts sleep at rest and move as one when clamped; without, the same, slower.
        """
        model = build(world)
        data = mujoco.MjData(model)
        self._model, self._data = model, data
        self._drawn = Drawn(groups=model.geom_group.copy(), colours=model.mat_rgba.copy())
        self._steps = round(JIFFY / model.opt.timestep)
        self._arm, self._hand = SimulatedArm(model, data), HandDrive(model, data)
        self._lamp = Lamp(model)
        self._threads, self._sensors = Threads(model, data, world), Sensors(model, data, world)
        self._resting = Resting(model, data, allowed=rest)
        self._tripped = False
        data.qpos[self._arm.qpos] = PARK
        self._arm.put(np.zeros(6), brakes=True)
        mujoco.mj_forward(model, data)
        self._sensed = self._read(braked=True)
        self.camera: SimulatedCamera = SimulatedCamera(
            data, world.camera, world.generator("camera"), make_renderer(camera, model)
        )

    @property
    def truth(self) -> Truth:
        """What is really so; for the referee, the trace and tests only."""
        return Truth(
            model=self._model,
            data=self._data,
            drawn=self._drawn,
            threads=self._threads.holes,
            resting=self._resting,
        )

    def sense(self) -> Sensed:
        """Read the interface at the present tick."""
        return self._sensed

    def tick(self, drive: Drive) -> None:
        """Put `drive` out and let one servo period pass.

        Raises:
            InvalidInput: the drive holds something that is not a number.
            SimulationError: the physics broke down.
        """
        values = (*drive.torque, drive.gap, drive.grip, drive.tool)
        if not np.isfinite(values).all():
            raise InvalidInput("the drive holds a value that is not a finite number")
        self._tripped = self._tripped and not drive.brakes
        self._arm.put(drive.torque, brakes=drive.brakes or self._tripped)
        self._hand.put(drive.gap, drive.grip)
        self._lamp.put(drive.lamp)
        self._advance(tool=0.0 if self._tripped else drive.tool, braked=drive.brakes or self._tripped)

    def late(self) -> None:
        """Let one servo period pass without an answer: the watchdog cuts drives and sets brakes."""
        self._tripped = True
        self._arm.put(np.zeros(6), brakes=True)
        self._advance(tool=0.0, braked=True)

    def capture(self) -> CellState:
        """All that the future of this cell depends on; `restore` puts it back, in this cell or its like."""
        physics = np.empty(mujoco.mj_stateSize(self._model, INTEGRATION))
        mujoco.mj_getState(self._model, self._data, physics, INTEGRATION)
        return CellState(
            physics=physics,
            figures={name: np.array(getattr(self._model, name), dtype=float) for name in MUTABLE},
            threads=self._threads.holes,
            driven=self._threads.driven,
            clamped=self._resting.clamped,
            fingers=self._hand.set_point,
            tripped=self._tripped,
            sensed=self._sensed,
            noise=noise_state(self._sensors.rng),
            camera=self.camera.capture(),
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
            set_noise(self._sensors.rng, state.noise)
            self.camera.restore(state.camera)
        except (ValueError, KeyError, TypeError, OverflowError, RecursionError) as error:
            raise InvalidInput(f"this is not a state of this work cell: {error}") from None
        model, data = self._model, self._data
        for name, values in state.figures.items():
            getattr(model, name)[:] = values
        self._threads.holes, self._threads.driven = state.threads, state.driven
        self._resting.clamped, self._hand.set_point = state.clamped, state.fingers
        self._tripped, self._sensed = state.tripped, state.sensed
        mujoco.mj_resetData(model, data)
        mujoco.mj_setState(model, data, state.physics, INTEGRATION)
        mujoco.mj_forward(model, data)
        mujoco.mj_setState(model, data, state.physics, INTEGRATION)  # what the solver starts from, too

    def _check(self, state: CellState) -> None:
        """Raises ValueError unless every figure of a state has its place in this cell."""
        if state.physics.shape != (mujoco.mj_stateSize(self._model, INTEGRATION),):
            raise ValueError("its physics are of another scene")
        if set(state.figures) != set(MUTABLE):
            raise ValueError("it has not the figures that change in this scene")
        for name, values in state.figures.items():
            if values.shape != getattr(self._model, name).shape:
                raise ValueError(f"{name} has another size here")
        if not all(np.isfinite(values).all() for values in (state.physics, *state.figures.values())):
            raise ValueError("some of its figures are not finite numbers")
        screws = [hole.screw for hole in state.threads if hole.screw is not None]
        if len(state.threads) != len(self._threads.holes) or not set(screws) <= set(
            range(len(state.threads))
        ):
            raise ValueError("its screws are not those of this scene")
        sensed = (state.sensed.time, state.sensed.gap, *state.sensed.q, *state.sensed.qd)
        if len(sensed) != 14 or not np.isfinite(sensed).all() or not 0 <= state.sensed.time < 1e9:
            raise ValueError("its sensors read what they cannot")

    def _advance(self, *, tool: float, braked: bool) -> None:
        self._threads.before(tool)
        self._resting.before(self._threads.holes)
        mujoco.mj_step(self._model, self._data, self._steps)
        warnings = np.flatnonzero(self._data.warning.number)
        if warnings.size:
            kind = mujoco.mjtWarning(int(warnings[0])).name
            raise SimulationError(f"the simulated cell broke down at {self._data.time:.2f} s ({kind})")
        self._sensed = self._read(braked=braked)

    def _read(self, *, braked: bool) -> Sensed:
        return self._sensors.read(self._arm, self._hand, self._threads, braked=braked)
