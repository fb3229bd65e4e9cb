"""A simulated cell: a MuJoCo model, the devices in it, and the mechanisms of a task, under one clock."""

from collections.abc import Iterator, Sequence
from contextlib import contextmanager
from typing import Any, Final

import mujoco
import numpy as np

from handeye.cell.arm import SimulatedArm
from handeye.cell.camera import SimulatedCamera
from handeye.cell.hand import SimulatedHand, SimulatedLamp, SimulatedScrewdriver
from handeye.cell.mechanism import Mechanism
from handeye.cell.physics_stepper import PhysicsStepper, asleep, check_physics, let_rest
from handeye.cell.signal_lines import SOUND, SignalLines
from handeye.cell.snapshot_cell import SnapshotCell
from handeye.cell.state import CellState
from handeye.core.record import Vector3
from handeye.ports.camera import Renderer
from handeye.ports.clock import Clock, whole_steps
from handeye.ports.workcell import Workcell

_HELD: Final = 1 / 60
"""Longest time (s) between two actions of the devices on the simulator. The time must be short, because the finger
servo moves, and screws enter their threads, between two actions.
"""


class SimulatedCell(Clock, SnapshotCell):
    """A cell in one world. Equal worlds and equal commands give equal states, byte for byte."""

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
        lines: SignalLines = SOUND,
        stepper: PhysicsStepper | None = None,
        noise: np.random.Generator,
    ) -> None:
        """Switch a cell on, and read all its devices for the first time.

        `mechanisms`, such as screw threads and further arms, act on the model in the given order. All sensors except
        the camera draw their noise from `noise`. Raises ValueError if two devices or mechanisms have the same name,
        because their states are stored by name.
        """
        self.arm = arm  # kept for the experimenter, who may push the arm
        self.camera = camera  # and may remove the shadows from the camera's pictures
        self.lines = lines  # signal lines of the devices, with their defects
        devices = (arm, hand, screwdriver, lamp)
        parts: tuple[Mechanism[Any], ...] = (
            *((lines,) if lines.defects else ()),
            *(device for device in devices if device is not None),
            *mechanisms,
            *(() if camera is None else (camera,)),
        )
        SnapshotCell.__init__(self, model, data, parts, noise)
        self.devices = Workcell(
            clock=self, arm=arm, hand=hand, screwdriver=screwdriver, lamp=lamp, camera=camera
        )
        """The devices of the cell, as the working phase knows them."""
        self._warnings = data.warning.number  # kept, because MuJoCo makes a new view for each use
        self._step = float(model.opt.timestep)
        self._most = max(1, round(_HELD / self._step))
        self._stepper = stepper or PhysicsStepper(model, data)
        mujoco.mj_forward(model, data)
        self._read()

    @property
    def renderer(self) -> Renderer:
        """The renderer of the cell's camera. The method of this renderer is `none` if the cell has no camera."""
        camera = self.devices.camera
        return Renderer(method="none") if camera is None else camera.renderer

    @property
    def now(self) -> float:
        return float(self._data.time)

    def set_to_zero(self) -> None:
        """Set the clock to 0, because the program begins now."""
        self._data.time = 0.0

    def begin_stage(self, number: int) -> None:
        """Begin the stage `number` of the program. The first stage has the number 1. Faults may begin with a stage."""
        for part in self._mechanisms:
            part.begin_stage(number)

    def restore(self, state: CellState) -> None:
        """Restore the cell to a state; see `SnapshotCell.restore`. Bodies that were asleep in this state need only one
        step to fall asleep again.
        """
        super().restore(state)
        let_rest(self._model, self._data)

    def advance(self, seconds: float) -> None:
        """Let time pass. Raises BadArgument unless `seconds` is a whole number of physics steps, and PhysicsFailed
        if the simulation fails.
        """
        data, step = self._data, self._step
        left = whole_steps(seconds, step)
        while left:
            steps = min(left, self._most)
            for part in self._mechanisms:
                part.before(steps * step)
            if asleep(data):
                for part in self._mechanisms:
                    part.rested((left - steps) * step)
                steps = left
                data.time += steps * step
            else:
                self._stepper.step(steps)
                check_physics(self._warnings, data.qvel)
            self._read()
            left -= steps

    def _read(self) -> None:
        for part in self._mechanisms:
            part.after()


@contextmanager
def pushed(cell: SimulatedCell, force: Vector3) -> Iterator[None]:
    """Push the hand with a force (N, in W) while the context is open. This is an action of the experimenter that no
    program can perform.
    """
    applied, body = cell.truth.data.xfrc_applied, cell.arm.last_link
    applied[body, :3] = force
    try:
        yield
    finally:
        applied[body] = 0.0
