"""The interface of a task with one hole, for trials of insertion; a witness records the truth of each insertion."""

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
"""Difference between the diameters of hole and pin, mm: that of Factory's peg (docs/insertion.md)."""
CHAMFER: Final = 1.0  # width of the chamfer, mm, as at the holes of the pump's base
SPREAD: Final = 1.0  # sigma of the error of the hole's place along each axis, mm: as in Factory


@dataclass(frozen=True, slots=True, kw_only=True)
class InsertionTruth:
    """The truth of an insertion, which the program cannot know."""

    peak: float  # greatest resultant of all contacts between the two in any physics step, N
    first: float | None  # time of the first contact, s on the cell's clock
    seated: float | None  # time at which it was first seated, s on the cell's clock
    right: bool  # whether it is seated now


class InsertionTask(Task):
    """A task with one hole; its programs fetch the pin in their first stage."""

    programs: Mapping[str, str]  # script files among the plans, by the name of their search

    @abstractmethod
    def caught(self, clearance: float, chamfer: float) -> float:
        """Greatest error of a hole's position, m, at which the hole still catches the pin; arguments in m."""

    @abstractmethod
    def hole(self, clearance: float, chamfer: float) -> dict[str, float]:
        """Quantities of a world with this clearance and chamfer (m), and the hole at its taught position; SI."""

    @abstractmethod
    def off(self, truth: Truth, error: tuple[float, float]) -> dict[str, float]:
        """Quantities of a world in which the hole is displaced by `error` (x, y, m) from the point below the held
        pin; SI.
        """

    @abstractmethod
    def witnessed(self, cell: SimulatedCell) -> InsertionTruth:
        """The truth so far, as recorded by the witness in a cell of this task."""
