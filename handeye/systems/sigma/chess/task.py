"""Defines the chess experiment as a task. The referee checks that each piece stands on the line for pieces of its
height, and that the reported heights are right.
"""

from __future__ import annotations

from collections.abc import Sequence
from math import degrees, inf
from typing import TYPE_CHECKING, Final

from handeye.core.units import MILLIMETRE
from handeye.judge.finding import Findings, at_most
from handeye.judge.measured import tilt
from handeye.systems.sigma.chess.heights import ToldHeight
from handeye.systems.sigma.chess.pieces import Piece, drawn, stand
from handeye.systems.sigma.chess.witness import HeardHeights
from handeye.systems.sigma.gantries.job import JobTask
from handeye.systems.sigma.gantries.machine import scene
from handeye.systems.sigma.gantries.witness import HEARD, Witness
from handeye.systems.sigma.gantries.world import GantryWorld
from handeye.tasks.interface import Words

if TYPE_CHECKING:
    import mujoco

    from handeye.cell.truth import Truth

LEAN: Final = 3.0  # deg
PLACED: Final = 5.0  # mm: greatest distance of a piece from its line
HEIGHT: Final = 0.6  # mm
STANDS: Final = 1.0  # mm: greatest height of a foot over the board
_NEAR: Final = 10.0  # mm along X from a piece to the place at which the program reports it


class Chess(JobTask):
    """Find pieces along three lines, measure their heights, and put each on the line for pieces of its height."""

    name = "chess"
    words = Words(product="the board", done="Each piece stands on the line for its height.")

    usual = 8

    def board(self, world: GantryWorld, count: int) -> tuple[mujoco.MjSpec, Witness[HeardHeights]]:
        spec, pieces = scene(world), drawn(world, count)
        stand(spec, pieces)
        return spec, Witness(HeardHeights(pieces=pieces))

    def judge(self, truth: Truth) -> Findings:
        heard = truth.states[HEARD]
        assert isinstance(heard, HeardHeights)
        bodies = [(piece, truth.data.body(piece.name)) for piece in heard.pieces]
        lean = max(tilt(body.xmat.reshape(3, 3)) for _, body in bodies)
        lifted = max(abs(float(body.xpos[2])) for _, body in bodies)
        across = max(abs(body.xpos[1] / MILLIMETRE - piece.goal) for piece, body in bodies)
        wrong = max(_error(piece, heard.heights) for piece in heard.pieces)
        return {
            "standing": at_most(degrees(lean), LEAN, "deg", "greatest tilt of a piece"),
            "on_the_board": at_most(
                lifted / MILLIMETRE, STANDS, "mm", "greatest height of a piece's foot above the board"
            ),
            "sorted": at_most(
                across,
                PLACED,
                "mm",
                "greatest distance of a piece from the line for its height",
            ),
            "heights": at_most(wrong, HEIGHT, "mm", "greatest error of a height measured by the program"),
        }


def _error(piece: Piece, told: Sequence[ToldHeight]) -> float:
    """Return the greatest error (mm) of the heights that were reported for a piece. The error is infinite if no height
    was reported.
    """
    here = [each for each in told if each.line == piece.line and abs(each.x - piece.x) < _NEAR]
    return max((abs(each.height - piece.height) for each in here), default=inf)


CHESS: Final = Chess()
