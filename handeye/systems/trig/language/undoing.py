"""Undoing: how each type of step is undone by the arm, under guards.

A move goes back to where it began, a hand is as it was, a position and a count have their old values. Where a hold
begins or ends, the fingers must stand as they stood then; what was taken up is set down on something; and what a
guarded step has met must still be there.
"""

import math
from itertools import islice
from typing import Final, Literal

from handeye.systems.trig.language.node import Node
from handeye.systems.trig.language.obstacles import HoldOff, Missed, Obstacle
from handeye.systems.trig.language.place import Place
from handeye.systems.trig.language.program import Done, TrigProgram
from handeye.systems.trig.language.teachable import Halted, Teachable
from handeye.touch.hold import as_before, at_least, least_gap

AGAIN: Final = 1e-3
"""m beyond the place where a guarded step has met something, within which it must be met again. Chosen: a twelfth of a
block."""
Stop = Literal["halted"] | Obstacle
_NO_WAY: Final = 1e-6
"""m: a step that has moved the arm no farther has no direction."""


def undo_last(program: TrigProgram, arm: Teachable, halted: Halted) -> Stop | None:
    """Make it as it was before what was done last, which stays on the trail.

    Returns:
        What has ended it before; None, if nothing has.

    Raises:
        InvalidInput: the arm cannot go back to where it was.
    """
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


def _way_back(program: TrigProgram, done: Done, arm: Teachable, halted: Halted) -> Stop | None:
    """Go back to where a move began; what was taken up there is set down there."""
    if _took_up(program) and at_least(arm.gap, least_gap(0.0)):
        return arm.set_down(done.place, halted, done.met)
    return arm.back(done.place, halted, done.met)


def _took_up(program: TrigProgram) -> bool:
    """Whether the hand was closed where the last move began."""
    for done in islice(reversed(program.trail), 1, None):
        node = program.graph.nodes.get(done.node)
        if node is None or node.type in ("normal", "guarded", "ungrasp"):
            return False
        if node.type == "grasp":
            return True
    return False


def _touch_again(node: Node, done: Done, arm: Teachable, halted: Halted) -> Stop | None:
    """See that what a guarded step has met is still there, before the arm leaves it; where it has been driven away, no.

    Where nothing is met, the arm goes back by as much, so that somebody can put there what is missing.
    """
    if done.touched is None or node.vector is None or node.threshold is None:
        return None
    way = done.touched.seen_from(done.place)
    far = math.hypot(*way[:3])
    if far < _NO_WAY or math.dist(arm.here()[:3], done.touched[:3]) > AGAIN:
        return None
    beyond = Place(*(component * AGAIN / far for component in way[:3]))
    goal = arm.within_travel(done.touched.moved(beyond))
    arrival = arm.feel(goal, node.vector, node.threshold, halted)
    if arrival.kind == "reached":
        return arm.back(done.touched, halted) or Missed()
    return "halted" if arrival.kind == "halted" else None


def _hand_back(done: Done, arm: Teachable) -> HoldOff | None:
    """The hand as it was before a step: where a hold begins or ends, the fingers stand as they stood then."""
    before, after = done.gaps
    off = _off_hold(after, arm)
    if off is None:
        arm.hand(done.closed)
        off = _off_hold(before, arm)
    return off


def _off_hold(kept: float, arm: Teachable) -> HoldOff | None:
    gap = arm.gap
    return None if as_before(gap, kept) else HoldOff(gap=round(gap, 6), kept=round(kept, 6))
