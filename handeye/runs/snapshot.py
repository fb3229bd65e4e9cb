"""The complete state of a run between two steps, and the checkpoints made from this state."""

from collections.abc import Iterable
from typing import Annotated

import msgspec

from handeye.cell.state import CellState
from handeye.core.record import Record
from handeye.program.events import (
    AnyEvent,
    ExperimentMade,
    LineTyped,
    OperatorAnswered,
    PeriodsCommanded,
    UndoOrdered,
)
from handeye.program.system_state import SystemState
from handeye.runs.setup import Setup
from handeye.runs.systems import listing_of


class Snapshot(Record, frozen=True, kw_only=True):
    """The state of a run between two steps."""

    position: Annotated[int, msgspec.Meta(ge=0)]  # steps done
    happened: Annotated[int, msgspec.Meta(ge=0)]  # number of events so far, without undone events
    cell: CellState | None  # None: the system acts on no simulated cell
    state: SystemState


class Checkpoint(Record, frozen=True, kw_only=True):
    """Everything needed to resume a run, on any computer."""

    setup: Setup
    snapshot: Snapshot | None = None  # None: the run has not begun
    events: tuple[AnyEvent, ...] = ()  # events that were not undone

    @property
    def position(self) -> int:
        """Number of steps done; -1 if the run has not begun."""
        return -1 if self.snapshot is None else self.snapshot.position

    @property
    def ended(self) -> bool:
        """True if the plan has ended: no step is left, and no call to the operator is unanswered."""
        state = None if self.snapshot is None else self.snapshot.state
        return state is not None and state.at is None and state.stopped is None

    @property
    def touched(self) -> bool:
        """True if a person intervened with an experiment, a typed line, an answer of the operator, or an order
        to undo."""
        return interfered(self.events)

    @property
    def between_stages(self) -> bool:
        """True if the next step begins a stage."""
        if self.snapshot is None:
            return False
        state = self.snapshot.state
        return state.at is not None and state.stage is None

    @property
    def stage(self) -> str | None:
        """Name of the present or next stage, or None if the run has not begun or has ended."""
        if self.snapshot is None:
            return None
        state, listing = self.snapshot.state, listing_of(self.setup)
        if state.stage is not None:
            return listing.stages[state.stage]
        return None if state.at is None else listing.stages[listing.steps[state.at].stage]


def interfered(events: Iterable[AnyEvent]) -> bool:
    """Return True if these events show that a person intervened in the run."""
    return any(
        event.asked_by == "person"
        if isinstance(event, UndoOrdered)
        else isinstance(event, ExperimentMade | LineTyped | OperatorAnswered | PeriodsCommanded)
        for event in events
    )
