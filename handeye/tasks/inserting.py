"""Defines the interface of a task with one hole. The trials of insertion use this interface. The cell of such a task
has a witness, which records what really happened in each insertion.
"""

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
"""Difference between the diameters of hole and pin (mm). The Factory benchmark has the same difference for its peg
(docs/insertion.md).
"""
CHAMFER: Final = 1.0  # width of the chamfer, mm, as at the holes of the pump's base
SPREAD: Final = 1.0  # standard deviation of the hole's position error along each axis, mm: as in Factory


@dataclass(frozen=True, slots=True, kw_only=True)
class InsertionTruth:
    """A record of what really happened in an insertion. The program has no access to this record."""

    peak: float  # greatest resultant of all contacts between pin and plate in any physics step, N
    first: float | None  # time of the first contact, s on the cell's clock
    seated: float | None  # time at which the pin was first seated, s on the cell's clock
    right: bool  # whether the pin is seated now


class InsertionTask(Task):
    """A task with one hole. In each program of such a task, the first stage fetches the pin."""

    programs: Mapping[str, str]  # script files among the plans, by the name of their search

    @abstractmethod
    def caught(self, clearance: float, chamfer: float) -> float:
        """Return the greatest position error (m) at which the pin still enters a hole with the given clearance (m) and
        chamfer (m).
        """

    @abstractmethod
    def hole(self, clearance: float, chamfer: float) -> dict[str, float]:
        """Return the quantities of a world in which the hole lies exactly at its taught position and has the given
        clearance (m) and chamfer (m). All values are in SI units.
        """

    @abstractmethod
    def off(self, truth: Truth, error: tuple[float, float]) -> dict[str, float]:
        """Return the quantities of a world in which the hole is displaced by `error` (x and y, m) from the
        point below the held pin. All values are in SI units.
        """

    @abstractmethod
    def witnessed(self, cell: SimulatedCell) -> InsertionTruth:
        """Return what the witness in a cell of this task has recorded so far."""
