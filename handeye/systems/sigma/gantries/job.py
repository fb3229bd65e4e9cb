"""A job of the gantries: pieces on the board, a program that moves the gantries, and a referee."""

from __future__ import annotations

from abc import abstractmethod
from typing import TYPE_CHECKING, Any

from handeye.core.variation import WorldSpec
from handeye.systems.sigma.bus.layout import SUPERSIGMA, Layout
from handeye.systems.sigma.gantries.machine import SUPERSIGMA as SUPERSIGMA_RIG
from handeye.systems.sigma.gantries.machine import Rig
from handeye.systems.sigma.gantries.task import GantryTask
from handeye.systems.sigma.gantries.world import GantryWorld
from handeye.systems.sigma.run.plan import decode

if TYPE_CHECKING:
    import mujoco

    from handeye.systems.sigma.gantries.machine import Gantries
    from handeye.systems.sigma.gantries.witness import Witness


class JobTask(GantryTask):
    """A job with pieces."""

    rig: Rig = SUPERSIGMA_RIG
    layout: Layout = SUPERSIGMA
    usual: int
    """Default number of pieces."""
    few = 2  # pieces for a short run
    judges_stopped = True

    @abstractmethod
    def board(self, world: GantryWorld, count: int) -> tuple[mujoco.MjSpec, Witness[Any]]:
        """Return the scene of a world with its pieces, and the witness of a run. Raises BadArgument if the number of
        pieces is impossible.
        """

    def equip(self, world: GantryWorld, count: int, gantries: Gantries) -> None:
        """Add the job's own mechanisms to the bench, in addition to the gantries. By default, a job has no mechanisms
        of its own.
        """

    def scene(self, spec: WorldSpec) -> mujoco.MjModel:
        return self.board(GantryWorld(spec), self.usual)[0].compile()

    def recorded_scene(self, spec: WorldSpec, plan: bytes) -> mujoco.MjModel:
        return self.board(GantryWorld(spec), decode(plan, "the plan of the run").pieces)[0].compile()
