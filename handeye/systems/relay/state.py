"""The state of a relay between two steps: which leg has the arm, the record, and the memory of each program."""

from typing import Any

import msgspec
from msgspec import field

from handeye.core.entries import entries
from handeye.execution.state import ReversalOrder
from handeye.program.system_state import SystemState
from handeye.runs.hand_over import HandOver, StationMemory
from handeye.runs.legs import leg_system


class RelayCore(SystemState, kw_only=True):
    """The state of a relay without the memories of its programs."""

    leg: int = 0  # index of the leg that has the arm, or had it last
    entered: bool = False  # the leg has taken the arm over
    refused: bool = False  # the leg has refused to take it over
    records: list[HandOver] = field(default_factory=list)  # made at the end of each leg before this one
    station: StationMemory | None = None  # None: not measured yet
    undoing: ReversalOrder | None = None  # an order to undo steps, perhaps of several programs

    @property
    def record(self) -> HandOver | None:
        """The record that the previous leg handed over; None for the first leg."""
        return self.records[-1] if self.records else None


def state_type() -> type[RelayCore]:
    """Return the type of the state of a relay. The state has a field for each system that can run legs. The field has
    the name of the system. Its value is a dictionary from the files of the system's programs to the states of these
    programs.
    """
    fields: list[Any] = [
        (entry.name, dict[str, leg_system(entry.name).state], field(default_factory=dict))  # type: ignore[misc]
        for entry in entries().values()
        if "leg" in entry.can
    ]
    made: Any = msgspec.defstruct("RelayState", fields, bases=(RelayCore,), kw_only=True, module=__name__)
    kind: type[RelayCore] = made
    return kind
