"""Record of an executed step, with what its reversal needs."""

from typing import Annotated

import msgspec

from handeye.core.record import Record
from handeye.program.events import AskedBy
from handeye.program.guards import GuardKind

Natural = Annotated[int, msgspec.Meta(ge=0)]


class ExecutedStep(Record, frozen=True, kw_only=True, omit_defaults=True):
    """An executed step; `before` and `after` refer to its start and end."""

    step: Natural
    way: bytes = b""  # set-points, see `undo.way`; empty: nothing moved
    gap: tuple[float, float]  # sensed before and after, m
    fingers: float  # gap set-point before, m
    grasping: bool = False  # fingers closed before
    load: float = 0.0  # compensated weight before, N
    tool: float = 0.0  # screwdriver speed before, rad/s
    force: float = 0.0  # greatest force felt, N; 0: none was estimated
    ended: GuardKind | None = None  # the guard that ended it
    risen: float = 0.0
    """Rise of the hand, m, while its screw was being turned out, if that was interrupted."""
    remembered: dict[str, bytes] = msgspec.field(default_factory=dict)
    """Memory before it, where it has changed; see `undo.memory`."""
    enters: bool = False  # first of its stage
    called: bool = False  # called the operator


class Undoing(Record, frozen=True, kw_only=True):
    """An order to reverse executed steps until `left` remain."""

    left: Natural
    halts: bool = False  # the run ends there
    asked_by: AskedBy = "person"
