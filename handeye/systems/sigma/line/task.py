"""The assembly line as a task. The referee checks three facts: every piece is finished and was withdrawn by the belt;
the program counted the pieces correctly; and no arms have touched each other.
"""

from __future__ import annotations

from collections.abc import Mapping
from math import degrees, hypot
from typing import TYPE_CHECKING, Final, Literal

from handeye.core.units import MILLIMETRE
from handeye.judge.finding import Findings, at_most
from handeye.judge.measured import tilt
from handeye.systems.sigma.bus.layout import LINE as LINE_LAYOUT
from handeye.systems.sigma.gantries.job import JobTask
from handeye.systems.sigma.gantries.witness import HEARD
from handeye.systems.sigma.line.pieces import MOST, PIN, PINS, drawn, pin, stand
from handeye.systems.sigma.line.scene import LINE_RIG, TOP, line_scene
from handeye.systems.sigma.line.witness import LineWitness, WatchedLine
from handeye.systems.sigma.protocol import LINE_AXES
from handeye.tasks.interface import Words

if TYPE_CHECKING:
    import mujoco

    from handeye.cell.truth import Truth
    from handeye.systems.sigma.gantries.world import GantryWorld

LEAN: Final = 3.0  # deg
PLACED: Final = 3.0  # mm: greatest distance of a withdrawn piece from its place
STANDS: Final = 1.0  # mm: greatest height of a foot over the belt
PRESSED: Final = 0.5  # mm by which a pin may still stand out


class AssemblyLine(JobTask):
    """A feeder brings pieces, each of two SUPERSIGMAs presses one pin into every piece, and a belt takes the pieces
    away.
    """

    name = "line"
    words = Words(product="the line", done="Each piece is finished and withdrawn.")
    usual = MOST
    rig = LINE_RIG
    layout = LINE_LAYOUT
    joint_kinds: Mapping[str, Literal["revolute", "prismatic"]] = dict.fromkeys(LINE_AXES, "prismatic")

    def board(self, world: GantryWorld, count: int) -> tuple[mujoco.MjSpec, LineWitness]:
        spec, pieces = line_scene(world), drawn(world, count)
        stand(spec, pieces)
        return spec, LineWitness(WatchedLine(pieces=pieces))

    def judge(self, truth: Truth) -> Findings:
        watched = truth.states[HEARD]
        assert isinstance(watched, WatchedLine)
        leans, lifts, places, proud = [], [], [], []
        for piece in watched.pieces:
            body = truth.data.body(piece.name)
            x, y, z = body.xpos / MILLIMETRE
            leans.append(degrees(tilt(body.xmat.reshape(3, 3))))
            lifts.append(abs(z - TOP / MILLIMETRE))
            places.append(hypot(x - piece.goal[0], y - piece.goal[1]))
            pressed = [float(truth.data.joint(pin(piece.name, which)).qpos[0]) / MILLIMETRE for which in PINS]
            proud.append(PIN - min(pressed))
        finished = sum(
            lean <= LEAN and lift <= STANDS and place <= PLACED and out <= PRESSED
            for lean, lift, place, out in zip(leans, lifts, places, proud, strict=True)
        )
        wrong = max(abs(told - finished) for told in watched.counted)
        return {
            "standing": at_most(max(leans), LEAN, "deg", "greatest tilt of a piece"),
            "on_the_belt": at_most(
                max(lifts), STANDS, "mm", "greatest height of a piece's foot above the belt"
            ),
            "withdrawn": at_most(
                max(places), PLACED, "mm", "greatest distance of a piece from its final place"
            ),
            "pressed": at_most(max(proud), PRESSED, "mm", "greatest height of a pin above its piece"),
            "counted": at_most(
                wrong,
                0,
                "pieces",
                "difference between the program's counts and the number of finished pieces",
            ),
            "apart": at_most(watched.touched_ms, 0, "ms", "time for which arms touched each other"),
        }


LINE: Final = AssemblyLine()
