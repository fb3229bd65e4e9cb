"""Finds executed steps that left the cell as it was. One lift of the hand reverses all these steps.

Such steps are of two kinds: rounds of a loop, and touches. When a program jumps back to an earlier step, a round of a
loop is complete. The round is assumed to have left the cell as it was after that step if four conditions hold. First,
since that step, no stage began, and the program did not call the operator. Second, the hand holds the same object as
after that step. Third, every object was put down at the place where it was taken up, or taken up at the place where it
was put down. Fourth, every screw that was driven in was backed out. Rounds that carry objects to another place do not
meet the conditions and are reversed step by step.

A touch is a motion of an empty hand that ended on contact, together with the motion that left the object. If a touch
were reversed step by step, the hand would touch the object a second time. After the first touch, the object may have
been pushed. A finger that moved down beside the object at the first touch would then hit the object's edge.
"""

from collections.abc import Callable, Iterator, Sequence
from typing import Final

import numpy as np

from handeye.core.pose import Array
from handeye.execution.state import ExecutedStep
from handeye.program.guards import GuardKind

SAME_GAP: Final = 5e-4  # m, of an unchanged hold
SAME_PLACE: Final = (0.005, 0.02)
"""Tolerance (m), sideways and in height, between the place at which an object is put down and the place at which
it is taken up. The tolerance is needed because fingers slide on an object.
"""


def loop_entry(
    done: Sequence[ExecutedStep], hand: Callable[[int], Array | None], *, grasping: bool | None = None
) -> int | None:
    """Return the index of the step to which the last jump back led, if the state of the cell is now the same as at the
    end of this step. Returns None if the state differs, or if no jump counts.

    A jump counts only if all motions after its target step were in free air. One lift then reverses the rounds of the
    loop. If they were reversed step by step, the reversal of a MOVE to the next place of a search would bring the hand
    back into contact with the object at the previous place. `hand` takes the index of a step, and returns the position
    of the hand after the step (shape (3,), in W), or None if the hand had not moved yet. `grasping` gives the state of
    the fingers at the end of the last step. It is True if the fingers have closed, and have not opened after that. It
    is None if this state is the same as at the beginning of the last step.
    """
    last = len(done) - 1
    for head in range(last, 0, -1):
        jumped = done[head - 1].step >= done[head].step
        here = done[head]
        in_air = here.force == 0.0 and not here.tool and not here.called and not here.enters
        if not (in_air or (jumped and head == last)) or not _keeps_hold(done, head, grasping):
            return None
        if jumped:
            return next(
                (n for n in range(head) if _alike(done[n], done[head]) and _undone_itself(done, n, hand)),
                None,
            )
    return None


def _keeps_hold(done: Sequence[ExecutedStep], index: int, grasping: bool | None) -> bool:
    """Return True if the hand holds the same object before and after a step.

    A grasp at the beginning of a loop does not count as keeping hold of the same object, because the hand may grasp a
    different object in each round.
    """
    here, (before, behind) = done[index], done[index].gap
    after = (
        done[index + 1].grasping if index + 1 < len(done) else here.grasping if grasping is None else grasping
    )
    return here.grasping == after and abs(behind - before) < SAME_GAP


def touch_entry(done: Sequence[ExecutedStep], *, grasping: bool) -> int | None:
    """Return the index of the step before a touch, if the last step moved the empty hand away from the touched object.
    Returns -1 if the touch was the first step, and None if the last step did not follow a touch.

    `grasping` is True if the fingers have closed, and have not opened after that.
    """
    last = len(done) - 1
    if grasping or last < 1 or not _goes_empty(done[last]):
        return None
    for index in range(last, 0, -1):
        one, other = done[index - 1], done[index]
        if one.called or one.grasping or other.enters or one.fingers != other.fingers:
            return None
        if one.way:
            return index - 2 if _goes_empty(one) and one.ended is not None else None
    return None


def _goes_empty(done: ExecutedStep) -> bool:
    """Return True if the step moved the hand while it was empty, without moving the fingers."""
    before, after = done.gap
    return bool(done.way) and not done.grasping and not done.tool and abs(after - before) < SAME_GAP


def without_rounds(done: Sequence[ExecutedStep], hand: Callable[[int], Array | None]) -> Iterator[int]:
    """Yield the indices of the steps to reverse, in the order of reversal. If the rounds of a loop left the cell as it
    was, their steps are left out.
    """
    index = len(done) - 1
    while index >= 0:
        yield index
        grasping = done[index + 1].grasping if index + 1 < len(done) else None
        entry = loop_entry(done[: index + 1], hand, grasping=grasping)
        index = index - 1 if entry is None else entry


def _alike(one: ExecutedStep, other: ExecutedStep) -> bool:
    """Return True if two executed steps are the same step of the program, with the same load, grasp and gap, and with
    the screwdriver off.
    """
    same = (one.step, one.load, one.grasping) == (other.step, other.load, other.grasping)
    gaps = zip(one.gap, other.gap, strict=True)
    return same and one.tool == other.tool == 0.0 and all(abs(a - b) < SAME_GAP for a, b in gaps)


def _undone_itself(done: Sequence[ExecutedStep], entry: int, hand: Callable[[int], Array | None]) -> bool:
    """Return True if nothing but the program's memory has changed since the step at `entry` was first executed."""
    rounds = range(entry, len(done) - 1)
    if any(done[index].called or done[index + 1].enters for index in rounds):
        return False
    driven = sum(done[index].ended is GuardKind.TORQUE for index in rounds)
    backed = sum(done[index].tool < 0 and bool(done[index].way) for index in rounds)
    changes = [index for index in rounds if done[index].grasping != done[index + 1].grasping]
    paired = zip(changes[::2], changes[1::2], strict=False)
    return (
        driven == backed
        and len(changes) % 2 == 0
        and all(_near(hand(one), hand(other)) for one, other in paired)
    )


def _near(one: Array | None, other: Array | None) -> bool:
    if one is None or other is None:
        return one is other
    away = np.abs(one - other)
    aside, height = SAME_PLACE
    return bool(np.hypot(*away[:2]) < aside and away[2] < height)
