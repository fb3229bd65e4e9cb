"""Detects whether a follower has closed its circuit or is lost. A follower is a program that follows an outline. Its
touches and turns show its course. The program of the paper does not detect either case, and never ends.

When a circuit is closed, left turns outnumber right turns by four. If a follower misses its wall, it turns left four
times without a touch. The follower has then gone around a square with sides of one step, and is back where it was. The
turns of such a square are not counted. The follower then tries again; because each motion ends at a slightly different
place, the follower often finds the wall. A follower that has not found the wall after `IDLE` squares is lost.
"""

from collections.abc import Sequence
from math import hypot
from typing import Final, Literal

from msgspec.structs import replace

from handeye.core.plain_text import counted
from handeye.core.record import Record

STEP: Final = 1000.0  # units of the slides
ROUND: Final = 4  # left turns minus right turns in a circuit
NEAR: Final = 1.5 * STEP  # greatest distance from the first touch to the touch that closes a circuit
IDLE: Final = 40  # a follower is lost after this number of squares without a touch
ALONE: Final = 19  # statements (eight steps) without any touch; a plate is at most six steps ahead
NOTHING: Final = "the wand has touched nothing: there is no plate ahead of it, or the wand does not signal"
EVERYWHERE: Final = (
    "the wand signals wherever it goes: either its switch is stuck, or walls are all around it"
)
LONGEST: Final = 3000  # statements after which a follower with an open circuit is lost

Point = tuple[float, float]
Heading = tuple[int, int]
Turn = Literal["", "left", "right"]


class Felt(Record, frozen=True, kw_only=True):
    """What a follower has felt, as far as its computer knows. Places are given as x and y, in units of the slides."""

    touches: tuple[Point, ...] = ()
    left: int = 0  # turns
    right: int = 0
    idle: int = 0  # squares without a touch
    missed: int = 0  # left turns since the last touch
    heading: Heading = (0, 0)  # forward step along x and y
    statements: int = 0
    noticed: tuple[int, int] = (0, 0)  # two words of the cycle in which the last touch was noticed

    @property
    def turns(self) -> int:
        """Left turns minus right turns. Left turns around a square in which the wand touched nothing do not count."""
        return self.left - self.right - ROUND * self.idle

    @property
    def closed(self) -> bool:
        """True if the last touch closes a circuit."""
        return bool(
            self.turns >= ROUND and not self.missed and _apart(self.touches[0], self.touches[-1]) <= NEAR
        )

    @property
    def lost(self) -> bool:
        """True if the follower has touched nothing for too long, signals a touch wherever the wand goes, or needs too
        many statements to close its circuit.
        """
        return bool(self._lost)

    @property
    def _lost(self) -> str:
        """The reason why the follower is lost. The string is empty if the follower is not lost."""
        if not self.touches and self.statements >= ALONE:
            return NOTHING
        if self.turns <= -2 * ROUND:
            return EVERYWHERE
        if self.missed >= ROUND * IDLE:
            return (
                f"the wand has gone {counted(self.missed // ROUND, 'time')} around a square with sides of one step, "
                "and touched nothing"
            )
        if self.statements >= LONGEST:
            return f"the circuit is still open after {counted(self.statements, 'statement')}"
        return ""

    @property
    def text(self) -> str:
        """The end of the run in words."""
        felt = (
            f"{counted(len(self.touches), 'touch')}, {counted(self.left, 'left turn')}, "
            f"{counted(self.right, 'right turn')}, {counted(self.idle, 'square')} (sides of one step) without a "
            "touch"
        )
        if self.closed:
            return f"the circuit is closed: {felt}"
        return f"the follower is lost: {self._lost} ({felt})"


def followed(felt: Felt, forward: Sequence[int], touch: Point, noticed: tuple[int, int]) -> Felt:
    """Return what the follower has felt after one more statement.

    Args:
        forward: the present forward step of the program, along x and y.
        touch: where the wand touched last.
        noticed: the cycle in which that touch was noticed; (0, 0) if there was no touch yet.
    """
    statements = felt.statements + 1
    if noticed != felt.noticed:
        touches = (*felt.touches, touch)
        return replace(felt, touches=touches, missed=0, statements=statements, noticed=noticed)
    heading: Heading = (forward[0], forward[1])
    if not _straight(heading):  # a turn takes two statements
        return replace(felt, statements=statements)
    turn = _turn(felt.heading, heading)
    left, right = felt.left + (turn == "left"), felt.right + (turn == "right")
    missed = felt.missed + 1 if turn == "left" else felt.missed
    idle = felt.idle + (turn == "left" and missed % ROUND == 0)
    return replace(
        felt, left=left, right=right, idle=idle, missed=missed, heading=heading, statements=statements
    )


def _straight(heading: Heading) -> bool:
    return (heading[0] == 0) != (heading[1] == 0)


def _turn(was: Heading, now: Heading) -> Turn:
    """Return the turn from one heading to another, in the frame of the slides, whose z points down."""
    if now == (was[1], -was[0]):
        return "left" if _straight(was) else ""
    return "right" if now == (-was[1], was[0]) and _straight(was) else ""


def _apart(one: Point, other: Point) -> float:
    return hypot(one[0] - other[0], one[1] - other[1])
