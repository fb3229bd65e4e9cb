"""Cell of the insertion bench: its scene, an arm and a hand, and a witness."""

import mujoco

from handeye.arm.robots.stanford import STANFORD
from handeye.cell.arm import SimulatedArm
from handeye.cell.hand import SimulatedHand
from handeye.cell.simulated import SimulatedCell
from handeye.tasks.insertion.scene import build
from handeye.tasks.insertion.witness import Witness
from handeye.tasks.insertion.world import BenchWorld
from handeye.tasks.water_pump.scene.arm import ARM
from handeye.tasks.water_pump.world.nominal import PARK


class InsertionCell(SimulatedCell):
    """A cell in which a witness sees what pin and plate do to each other."""

    def __init__(self, world: BenchWorld) -> None:
        """Switch the cell of a world on."""
        model = build(world)
        data, noise = mujoco.MjData(model), world.pump.generator("sensors")
        errors = world.pump
        arm = SimulatedArm(model, data, ARM, arm=STANFORD, posture=PARK, errors=errors.arm, noise=noise)
        hand = SimulatedHand(model, data, ARM, hand=STANFORD.hand, errors=errors.hand, noise=noise)
        self.witness = Witness(model, data)
        """For the bench; the working phase knows nothing of it."""
        super().__init__(model, data, arm=arm, hand=hand, stepper=self.witness, noise=noise)
