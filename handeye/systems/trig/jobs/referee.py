"""The referee of the block bench. The referee uses the true poses of the blocks and of the hand."""

from collections.abc import Mapping, Sequence
from math import acos, degrees
from typing import Final

import numpy as np

from handeye.core.pose import Array, Pose, inverse
from handeye.judge.finding import Finding, Findings, at_most
from handeye.judge.measured import tilt
from handeye.systems.trig.jobs.table import HEIGHT
from handeye.systems.trig.language.place import Place

PLACED: Final = 2.0  # mm from a block's place; blocks are 20 apart, and an open finger between them leaves 5
FLAT: Final = 2.0  # deg
ON: Final = 0.5  # mm in height; a block that lies on another block, or stands on its edge, is higher
BACK: Final = 3.0  # mm from where a block was: a tenth of its length
TURNED: Final = 1.0  # deg from a block's earlier yaw
BUCKET: Final = 35.0  # mm along X and Y: half its inside width
RIM: Final = 60.0  # mm, height of the bucket
HAND: Final = 0.5  # mm between hand and place; the potentiometers are off by up to .1 along each axis
_MM: Final = 1e3

Poses = Mapping[str, Pose]  # poses of the blocks relative to the platter, by name


def judge_placed(before: Poses, now: Poses, places: Sequence[Place]) -> Findings:
    """Check that the top block of a stack lies at the first of `places`, the next block at the second place, and so
    on. All other blocks must be where they were before.
    """
    taken = list(before)[::-1][: len(places)]
    there = [now[name] for name in taken]
    off = [float(np.hypot(*(X[:2, 3] - place[:2]))) for X, place in zip(there, places, strict=True)]
    high = [abs(float(X[2, 3]) - HEIGHT / 2) for X in there]
    return {
        "placed": at_most(
            _most(off) * _MM, PLACED, "mm", "greatest distance of a block from its place on the taught grid"
        ),
        "on_the_pallet": at_most(_most(high) * _MM, ON, "mm", "greatest height of a block above the pallet"),
        "flat": at_most(
            degrees(_most([tilt(X) for X in there])), FLAT, "deg", "greatest tilt of a block on the pallet"
        ),
        **_as_before(before, now, [name for name in before if name not in taken], "left in the stack"),
    }


def judge_back(before: Poses, now: Poses) -> Findings:
    """Check that every block is where it was before."""
    return _as_before(before, now, list(before), "back in the stack")


def judge_dropped(X: Pose, inside: tuple[float, float], place: Array, other: Pose) -> Findings:
    """Check that one block lies in a bucket whose centre is at `inside` (x and y, in metres), and that another
    block lies at `place` (in metres).
    """
    aside = float(np.max(np.abs(X[:2, 3] - inside)))
    return {
        "below_its_rim": at_most(float(X[2, 3]) * _MM, RIM, "mm", "height of the centre of block A"),
        "in_the_bucket": at_most(
            aside * _MM, BUCKET, "mm", "distance of block A from the centre of the bucket"
        ),
        "replaced": at_most(
            float(np.hypot(*(other[:2, 3] - place))) * _MM,
            PLACED,
            "mm",
            "distance of block B from the place where block A was grasped",
        ),
        "lies": at_most(
            abs(float(other[2, 3]) - HEIGHT / 2) * _MM, ON, "mm", "height of block B above the platter"
        ),
    }


def judge_hand(truth: Array, place: Array, what: str) -> Finding:
    """Check that the hand is at a place. `truth` is the true position of the hand. Position and place have shape (6,),
    in m and rad.
    """
    off = float(np.linalg.norm(truth[:3] - place[:3]))
    return at_most(off * _MM, HAND, "mm", f"distance of the hand from the place where the program {what}")


def judge_program(pallet: tuple[Place, Place], counts: Sequence[int]) -> Findings:
    """Check that the position PALLET has its taught value, and that all loop counts are 0."""
    now, taught = pallet
    off = float(np.linalg.norm(np.array(now) - np.array(taught)))
    return {
        "pallet": at_most(off * _MM, 0.0, "mm", "distance of the position PALLET from its taught place"),
        "loops": at_most(
            max(counts, default=0), 0, "rounds", "greatest number of rounds that the counter of a loop shows"
        ),
    }


def _as_before(before: Poses, now: Poses, names: Sequence[str], what: str) -> Findings:
    off = [float(np.linalg.norm(now[name][:3, 3] - before[name][:3, 3])) for name in names]
    turns = [_turn(inverse(before[name]) @ now[name]) for name in names]
    return {
        "blocks": at_most(
            _most(off) * _MM,
            BACK,
            "mm",
            f"greatest distance of a block {what} from its place at the start of the run",
        ),
        "turned": at_most(
            degrees(_most(turns)),
            TURNED,
            "deg",
            f"greatest rotation of a block {what} since the start of the run",
        ),
    }


def _turn(X: Pose) -> float:
    return acos(max(-1.0, min(1.0, (float(np.trace(X[:3, :3])) - 1) / 2)))


def _most(values: Sequence[float]) -> float:
    return max(values, default=0.0)
