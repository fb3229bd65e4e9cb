"""Reverses each type of step with the arm, under guards.

A move returns to its start, the hand to its state, positions and counts to their old values. Where a hold begins or
ends, the fingers must have the gap they had; what was taken up needs a support again; and what a guarded step met must
still be there.
"""

import math
from itertools import islice
from typing import Final, Literal

from handeye.systems.trig.language.node import Node
from handeye.systems.trig.language.obstacles import HoldOff, Missed, Obstacle
from handeye.systems.trig.language.place import Place
from handeye.systems.trig.language.program import RecordedStep, TrigProgram
from handeye.systems.trig.language.teachable import Halted, TrigArm
from handeye.touch.hold import as_before, at_least, least_gap

AGAIN: Final = 1e-3
"""m beyond a guarded step's contact within which it must be met again. Chosen: a twelfth of a block."""
Stop = Literal["halted"] | Obstacle
_MIN_MOTION: Final = 1e-6  # m that give a step a direction


def undo_last(program: TrigProgram, arm: TrigArm, halted: Halted) -> Stop | None:
    """Reverse the last step, which stays on the trail; returns what stopped it, or None."""
    done = program.trail[-1]
    node = program.graph[done.node]
    match node.type:
        case "normal" | "guarded":
            return _touch_again(node, done, arm, halted) or _way_back(program, done, arm, halted)
        case "grasp" | "ungrasp":
            return _hand_back(done, arm)
        case "savpos":
            program.positions[done.position].data = done.data
        case "loop":
            node.count = done.rounds
        case "bloop":
            program.graph[node.partner].count = done.rounds
    return None


def _way_back(program: TrigProgram, done: RecordedStep, arm: TrigArm, halted: Halted) -> Stop | None:
    """Return to the start of a move; set down there what was taken up there."""
    if _took_up(program) and at_least(arm.gap, least_gap(0.0)):
        return arm.set_down(done.place, halted, done.met)
    return arm.back(done.place, halted, done.met)


def _took_up(program: TrigProgram) -> bool:
    """True if the hand was closed where the last move began."""
    for done in islice(reversed(program.trail), 1, None):
        node = program.graph.nodes.get(done.node)
        if node is None or node.type in ("normal", "guarded", "ungrasp"):
            return False
        if node.type == "grasp":
            return True
    return False


def _touch_again(node: Node, done: RecordedStep, arm: TrigArm, halted: Halted) -> Stop | None:
    """Check that what a guarded step met is still there, before leaving it, unless it was driven away.

    If nothing is met, the arm returns to the place of contact, so that the user can put the object back.
    """
    if done.touched is None or node.vector is None or node.threshold is None:
        return None
    way = done.touched.seen_from(done.place)
    far = math.hypot(*way[:3])
    if far < _MIN_MOTION or math.dist(arm.here()[:3], done.touched[:3]) > AGAIN:
        return None
    beyond = Place(*(component * AGAIN / far for component in way[:3]))
    goal = arm.within_travel(done.touched.moved(beyond))
    arrival = arm.feel(goal, node.vector, node.threshold, halted)
    if arrival.kind == "reached":
        return arm.back(done.touched, halted) or Missed()
    return "halted" if arrival.kind == "halted" else None


def _hand_back(done: RecordedStep, arm: TrigArm) -> HoldOff | None:
    """Restore the hand; the gap must match at the start or end of a hold."""
    before, after = done.gaps
    off = _off_hold(after, arm)
    if off is None:
        arm.hand(done.closed)
        off = _off_hold(before, arm)
    return off


def _off_hold(kept: float, arm: TrigArm) -> HoldOff | None:
    gap = arm.gap
    return None if as_before(gap, kept) else HoldOff(gap=round(gap, 6), kept=round(kept, 6))
