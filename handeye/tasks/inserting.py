"""The interface of a task of one hole, for trials that measure insertions: a witness sees the truth of each."""

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
CHAMFER: Final = 1.0  # width of the chamfer, mm, as at the holes of the pump's base
SPREAD: Final = 1.0  # sigma of the error of the hole's place along each axis, mm: as in Factory


@dataclass(frozen=True, slots=True, kw_only=True)
class InsertionTruth:
    """The truth of an insertion, which the program never knows."""

    peak: float  # greatest resultant of all contacts between the two in any physics step, N
    first: float | None  # time of the first contact, s on the cell's clock
    seated: float | None  # time at which it was first seated, s on the cell's clock
    right: bool  # whether it is seated now


class InsertionTask(Task):
    """A task of one hole; its programs fetch what goes into it in their first stage."""

    programs: Mapping[str, str]  # script files among the plans, by the name of their search

    @abstractmethod
    def caught(self, clearance: float, chamfer: float) -> float:
        """Greatest error of a hole's place at which it still catches what goes into it, m; arguments in m."""

    @abstractmethod
    def hole(self, clearance: float, chamfer: float) -> dict[str, float]:
        """Quantities of a world with this clearance and chamfer (m), the hole where it was taught; SI."""

    @abstractmethod
    def off(self, truth: Truth, error: tuple[float, float]) -> dict[str, float]:
        """Quantities of a world whose hole is off by an error (x, y, m) from below what is held over it; SI."""

    @abstractmethod
    def witnessed(self, cell: SimulatedCell) -> InsertionTruth:
        """The truth so far, by the witness in a cell of this task."""
