"""The task of the hand-over. The referee checks that the pieces that the program counted are finished and at their
places. It also checks that the arms have not touched each other.
"""

from __future__ import annotations

from math import degrees, hypot
from typing import TYPE_CHECKING, Final

from handeye.core.units import MILLIMETRE
from handeye.judge.finding import Findings, at_most
from handeye.judge.measured import tilt
from handeye.systems.sigma.gantries.job import JobTask
from handeye.systems.sigma.gantries.machine import scene
from handeye.systems.sigma.gantries.witness import HEARD
from handeye.systems.sigma.handover.pieces import APART, END_X, MOST, PIN, drawn, pin, stand
from handeye.systems.sigma.handover.witness import HandoverWitness, Watched
from handeye.tasks.interface import Words

if TYPE_CHECKING:
    import mujoco

    from handeye.cell.truth import Truth
    from handeye.systems.sigma.gantries.world import GantryWorld

LEAN: Final = 3.0  # deg
PLACED: Final = 3.0  # mm: greatest distance of a finished piece from its place
STANDS: Final = 1.0  # mm: greatest height of a foot over the board
PRESSED: Final = 0.5  # mm by which a pin may still stand out


class Handover(JobTask):
    """Arm 1 brings pieces to a shared place; arm 2 presses in the pin of each piece, and takes the piece away."""

    name = "handover"
    words = Words(product="the hand-over", done="Each piece is finished and at its place.")
    usual = MOST

    def board(self, world: GantryWorld, count: int) -> tuple[mujoco.MjSpec, HandoverWitness]:
        spec, pieces = scene(world), drawn(world, count)
        stand(spec, pieces)
        return spec, HandoverWitness(Watched(pieces=pieces))

    def judge(self, truth: Truth) -> Findings:
        watched = truth.states[HEARD]
        assert isinstance(watched, Watched)
        leans, lifts, places, proud = [], [], [], []
        for number, piece in enumerate(watched.pieces, 1):
            body = truth.data.body(piece.name)
            x, y, z = body.xpos / MILLIMETRE
            leans.append(degrees(tilt(body.xmat.reshape(3, 3))))
            lifts.append(abs(z))
            places.append(hypot(x - END_X, y - APART * number))
            proud.append(PIN - float(truth.data.joint(pin(piece.name)).qpos[0]) / MILLIMETRE)
        finished = sum(
            lean <= LEAN and lift <= STANDS and place <= PLACED and out <= PRESSED
            for lean, lift, place, out in zip(leans, lifts, places, proud, strict=True)
        )
        counted = 0 if watched.counted is None else watched.counted
        wrong = abs(counted - finished)
        return {
            "standing": at_most(max(leans), LEAN, "deg", "greatest tilt of a piece"),
            "on_the_board": at_most(
                max(lifts), STANDS, "mm", "greatest height of a piece's foot above the board"
            ),
            "placed": at_most(max(places), PLACED, "mm", "greatest distance of a piece from its final place"),
            "pressed": at_most(max(proud), PRESSED, "mm", "greatest height by which a pin still protrudes"),
            "counted": at_most(
                wrong, 0, "pieces", "difference between the program's count and the number of finished pieces"
            ),
            "apart": at_most(watched.touched_ms, 0, "ms", "time for which the arms touched each other"),
        }


HANDOVER: Final = Handover()
