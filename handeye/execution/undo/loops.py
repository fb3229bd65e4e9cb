"""Steps that changed nothing but what the program remembers: they are undone as one lift, and not one by one.

These are rounds of a loop, and touches. Where a program has jumped back to a step at which it was before, it takes the
world for what it was then. That is so if in between no stage began and nobody was called, the hand holds what it held,
whatever it put down it has taken up again at the same place (or the other way round), and whatever the driver drove in,
it has backed out. Rounds that carry things from one place to another are no such loop, and are undone one by one.

A touch is a motion of an empty hand that ended on something, and the one that left it. The way back would end on the
thing a second time, and a finger that came to its side comes down on its edge if it has been pushed since.
"""

from collections.abc import Callable, Iterator, Sequence
from typing import Final

import numpy as np

from handeye.core.pose import Array
from handeye.execution.undo.done import Done
from handeye.program.guards import GuardKind

SAME_GAP: Final = 5e-4
"""m: the hand holds what it held."""
SAME_PLACE: Final = (0.005, 0.02)
"""m sideways and in height within which a thing is taken up where it was put down: fingers slide on it."""


def loop_entry(
    done: Sequence[Done], hand: Callable[[int], Array | None], *, grasping: bool | None = None
) -> int | None:
    """The index of the step behind which a jump back, the last there was, found the world as that step had left it.

    That counts as long as the hand has only gone through free air since: the way back of a MOVE to the next place of a
    search would end on what was met at the place before.

    Args:
        hand: where the hand was when a step, given by its index, had been done, shape (3,), W; None: it never moved.
        grasping: the fingers were last told to close; None: as before the last step.
    """
    last = len(done) - 1
    for head in range(last, 0, -1):
        jumped = done[head - 1].step >= done[head].step
        passes = _keeps_hold if jumped and head == last else _in_air
        if not passes(done, head, grasping):
            return None
        if jumped:
            return next(
                (n for n in range(head) if _alike(done[n], done[head]) and _undone_itself(done, n, hand)),
                None,
            )
    return None


def _in_air(done: Sequence[Done], index: int, grasping: bool | None) -> bool:
    """A step felt nothing, called nobody, and changed nothing of what the hand and the driver do."""
    here = done[index]
    nothing = here.force == 0.0 and not here.tool and not here.called and not here.enters
    return nothing and _keeps_hold(done, index, grasping)


def _keeps_hold(done: Sequence[Done], index: int, grasping: bool | None) -> bool:
    """The hand holds behind a step what it held before.

    A grasp that a loop begins with is none such: what it took the first time is not what it takes the last time.
    """
    here, (before, behind) = done[index], done[index].gap
    after = (
        done[index + 1].grasping if index + 1 < len(done) else here.grasping if grasping is None else grasping
    )
    return here.grasping == after and abs(behind - before) < SAME_GAP


def touch_entry(done: Sequence[Done], *, grasping: bool) -> int | None:
    """The index of the step behind which an empty hand set out to touch what the last one left; -1: before the first.

    Args:
        grasping: the fingers were last told to close.

    Returns:
        None: the last one left no touch.
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


def _goes_empty(done: Done) -> bool:
    """It moved an empty hand, and not its fingers."""
    before, after = done.gap
    return bool(done.way) and not done.grasping and not done.tool and abs(after - before) < SAME_GAP


def without_rounds(done: Sequence[Done], hand: Callable[[int], Array | None]) -> Iterator[int]:
    """Indices of the steps as they are undone, the last first, without those of rounds that are left out."""
    index = len(done) - 1
    while index >= 0:
        yield index
        grasping = done[index + 1].grasping if index + 1 < len(done) else None
        entry = loop_entry(done[: index + 1], hand, grasping=grasping)
        index = index - 1 if entry is None else entry


def _alike(one: Done, other: Done) -> bool:
    """The same step, begun and ended with the same in the hand, and the driver off."""
    same = (one.step, one.load, one.grasping) == (other.step, other.load, other.grasping)
    gaps = zip(one.gap, other.gap, strict=True)
    return same and one.tool == other.tool == 0.0 and all(abs(a - b) < SAME_GAP for a, b in gaps)


def _undone_itself(done: Sequence[Done], entry: int, hand: Callable[[int], Array | None]) -> bool:
    """Nothing but memory is another now than when a step was first executed."""
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
