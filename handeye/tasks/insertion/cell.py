"""Cell of the insertion bench: an arm, a hand, and a witness of the truth of each physics step, for the referee."""

import math
from typing import Final

import mujoco
import numpy as np

from handeye.arm.robots.stanford import STANFORD
from handeye.cell.arm import SimulatedArm
from handeye.cell.hand import SimulatedHand
from handeye.cell.physics_stepper import PhysicsStepper
from handeye.cell.simulated import SimulatedCell
from handeye.core.pose import Array
from handeye.tasks.insertion.scene import FACE, PUSH, build, in_holder
from handeye.tasks.insertion.world import InsertionWorld
from handeye.tasks.stanford_cell.arm import ARM
from handeye.tasks.stanford_cell.dimensions import PARK, dimensions

SEATED: Final = 2e-4
"""Height of the shoulder over the face up to which a pin is seated, m. Chosen: a hundredth of its way."""


class Witness(PhysicsStepper):
    """Steps the physics, and looks at pin and plate after each step in which anything touches."""

    def __init__(self, model: mujoco.MjModel, data: mujoco.MjData) -> None:
        super().__init__(model, data)
        self._push = data.sensor(PUSH).data
        self.peak = 0.0  # greatest resultant of all contacts of pin and plate in any step so far, N
        self.first: float | None = None  # time of the first contact, s on the cell's clock
        self.seated: float | None = None  # time at which the pin was first seated, s on the cell's clock

    def _closely(self, steps: int) -> None:
        for _ in range(steps):
            mujoco.mj_step(self._model, self._data)
            self._look()

    def _look(self) -> None:
        x, y, z = self._push
        if not (x or y or z):
            return
        time = float(self._data.time)
        self.first = time if self.first is None else self.first
        self.peak = max(self.peak, math.hypot(x, y, z))
        if self.seated is None and shoulder(self._data) <= SEATED:
            self.seated = time


class InsertionCell(SimulatedCell):
    """A cell in which a witness sees what pin and plate do to each other."""

    def __init__(self, world: InsertionWorld) -> None:
        """Switch the cell of a world on."""
        model = build(world)
        data, noise = mujoco.MjData(model), world.generator("sensors")
        arm = SimulatedArm(model, data, ARM, arm=STANFORD, posture=PARK, errors=world.arm, noise=noise)
        hand = SimulatedHand(model, data, ARM, hand=STANFORD.hand, errors=world.hand, noise=noise)
        self.witness = Witness(model, data)  # for the bench; the working phase knows nothing of it
        super().__init__(model, data, arm=arm, hand=hand, stepper=self.witness, noise=noise)


def shoulder(data: mujoco.MjData) -> float:
    """Height of the pin's shoulder over the face, m."""
    return float(data.body("pin").xpos[2]) - FACE


def off_holder(data: mujoco.MjData) -> tuple[float, float]:
    """Distance of the pin from its place in the holder, m, and its lean, rad."""
    pin = data.body("pin")
    return float(np.linalg.norm(pin.xpos - in_holder())), math.acos(min(1.0, float(pin.xmat[8])))


def tip(data: mujoco.MjData) -> Array:
    """Middle of the nose's end in W, m, shape (3,)."""
    pin = data.body("pin")
    return np.asarray(pin.xpos - dimensions()("pin.nose_length") * pin.xmat.reshape(3, 3)[:, 2])
