"""The task of the insertion. The referee checks that the pegs that the program counted are in their holes. It also
checks that no plate has moved, no force was too great, and no motor has lost a step.
"""

from __future__ import annotations

from math import hypot
from typing import TYPE_CHECKING, Final

from handeye.core.units import MILLIMETRE
from handeye.judge.finding import Findings, at_most
from handeye.systems.sigma.gantries.job import JobTask
from handeye.systems.sigma.gantries.machine import scene
from handeye.systems.sigma.gantries.witness import HEARD
from handeye.systems.sigma.insert.pieces import HIGH, HOLE, MOST, SIDE, drawn, stand
from handeye.systems.sigma.insert.witness import InsertionWitness, WatchedInsertion
from handeye.systems.sigma.motors.rotor import POLE
from handeye.tasks.interface import Words

if TYPE_CHECKING:
    import mujoco

    from handeye.cell.truth import Truth
    from handeye.systems.sigma.gantries.world import GantryWorld

PROUD: Final = 1.0  # mm: greatest height of a peg over the floor of its hole
MOVED: Final = 1.0  # mm by which a plate may have moved
FORCE: Final = 25.0  # N: greatest force in a wrist along an axis
_IN_HOLE: Final = (HOLE - SIDE) / 2 + 0.5  # mm from the middle of a hole within which a peg is inside it


class Insertion(JobTask):
    """Straighten pegs in a rack, and insert them into plates that are displaced from their nominal places."""

    name = "insert"
    words = Words(product="the insertion", done="Each peg is in its hole.")
    usual = MOST

    def board(self, world: GantryWorld, count: int) -> tuple[mujoco.MjSpec, InsertionWitness]:
        spec, pegs = scene(world), drawn(world, count)
        stand(spec, pegs)
        return spec, InsertionWitness(WatchedInsertion(pegs=pegs))

    def judge(self, truth: Truth) -> Findings:
        watched = truth.states[HEARD]
        assert isinstance(watched, WatchedInsertion)
        proud, beside, moved = [], [], []
        for peg in watched.pegs:
            x, y, z = truth.data.body(peg.name).xpos / MILLIMETRE
            hole_x, hole_y, _ = truth.data.body(peg.plate).xpos / MILLIMETRE
            proud.append(abs(z - HIGH / 2))
            beside.append(hypot(x - hole_x, y - hole_y))
            moved.append(hypot(hole_x - peg.plate_x, hole_y - peg.plate_y))
        inserted = sum(high <= PROUD and far <= _IN_HOLE for high, far in zip(proud, beside, strict=True))
        counted = 0 if watched.counted is None else watched.counted
        return {
            "at_depth": at_most(
                max(proud), PROUD, "mm", "greatest height of a peg above the floor of its hole"
            ),
            "in_the_hole": at_most(
                max(beside), _IN_HOLE, "mm", "greatest distance of a peg from the middle of its hole"
            ),
            "plates": at_most(max(moved), MOVED, "mm", "greatest distance by which a plate has moved"),
            "force": at_most(watched.most_n, FORCE, "N", "greatest force in a wrist"),
            "steps": at_most(watched.lost * POLE, 0, "steps", "number of steps that motors have lost"),
            "counted": at_most(
                abs(counted - inserted),
                0,
                "pegs",
                "difference between the program's count and the number of inserted pegs",
            ),
            "apart": at_most(watched.touched_ms, 0, "ms", "time for which the arms touched each other"),
        }


INSERTION: Final = Insertion()
