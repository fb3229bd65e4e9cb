"""Record of an executed step: what it takes to undo it by motion."""

from typing import Annotated

import msgspec

from handeye.core.record import Record
from handeye.program.events import AskedBy
from handeye.program.guards import GuardKind

Natural = Annotated[int, msgspec.Meta(ge=0)]


class Done(Record, frozen=True, kw_only=True, omit_defaults=True):
    """An executed step. `before` and `after` are the moments at which it began and ended."""

    step: Natural
    way: bytes = b""
    """Set-points of joints and fingers, see `undo.way`; empty: nothing moved."""
    gap: tuple[float, float]
    """Finger gap as sensed before and after, m."""
    fingers: float
    """Set-point of the finger gap before, m."""
    grasping: bool = False
    """The fingers had been told to close before."""
    load: float = 0.0
    """Weight that the servo bore before, N."""
    tool: float = 0.0
    """Speed of the screwdriver before, rad/s."""
    force: float = 0.0
    """Greatest force that the hand has felt, N; 0: it felt for none."""
    ended: GuardKind | None = None
    """The guard that it ended on."""
    risen: float = 0.0
    """By how much the hand has risen while the screw that it drove in was turned out, m, if that was broken off."""
    remembered: dict[str, bytes] = msgspec.field(default_factory=dict)
    """What the program remembered before, as far as that has changed, see `undo.memory`."""
    enters: bool = False
    """Its stage began with it."""
    called: bool = False
    """It called the operator."""


class Undoing(Record, frozen=True, kw_only=True):
    """How far the arm is to undo what it did."""

    left: Natural
    """Executed steps that are to be left."""
    halts: bool = False
    """The run ends there; otherwise the program can go on."""
    asked_by: AskedBy = "person"
