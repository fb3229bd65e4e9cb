"""What the insertion bench asks of its task: a thing is put into a hole, and a witness sees how."""

from __future__ import annotations

from abc import abstractmethod
from collections.abc import Mapping
from dataclasses import dataclass
from typing import TYPE_CHECKING, Final

from handeye.tasks.interface import Task

if TYPE_CHECKING:
    from handeye.cell.simulated import SimulatedCell
    from handeye.cell.truth import Truth

CLEARANCE: Final = 0.114
"""Diameter of the hole over that of what goes into it, mm: that of Factory's peg (docs/insertion.md)."""
CHAMFER: Final = 1.0
"""mm, as of the holes of the pump's base."""
SPREAD: Final = 1.0
"""Sigma of the error of the hole's place along each axis, mm: as in Factory."""


@dataclass(frozen=True, slots=True, kw_only=True)
class Witnessed:
    """What a witness has seen of an insertion, which the program never knows."""

    peak: float
    """The greatest force between the two in any physics step, N: of the resultant of all their contacts."""
    first: float | None
    """When they first touched, s by the cell's clock."""
    seated: float | None
    """When it was first seated, likewise."""
    right: bool
    """It is seated now."""


class Inserting(Task):
    """A task of one hole; its programs fetch in their first stage what goes into it."""

    programs: Mapping[str, str]
    """Files among the plans, by the name of their search."""

    @abstractmethod
    def caught(self, clearance: float, chamfer: float) -> float:
        """How far off (m) a hole may be and still catch what goes into it; of its clearance and chamfer, m."""

    @abstractmethod
    def hole(self, clearance: float, chamfer: float) -> dict[str, float]:
        """Quantities of a world in which the hole is so, and where it was taught, SI."""

    @abstractmethod
    def off(self, truth: Truth, error: tuple[float, float]) -> dict[str, float]:
        """Quantities of a world in which the hole is off by an error (x, y, m) from under what is held over it."""

    @abstractmethod
    def witnessed(self, cell: SimulatedCell) -> Witnessed:
        """What has been seen in a cell of this task so far."""
