"""The part of the state that all systems have: the place in the listing of steps."""

from typing import Annotated, NamedTuple

import msgspec

from handeye.core.mutable_records import MutableRecord
from handeye.program.events import OperatorCalled

Natural = Annotated[int, msgspec.Meta(ge=0)]


class TaskPlace(NamedTuple):
    """The place of one task of a system in the listing of steps."""

    task: str  # empty: the only one
    step: int  # the step that it does next
    waits_for: str = ""  # what the task waits for, in words; empty: only for its turn


class SystemState(MutableRecord, kw_only=True):
    """Base class of the states of systems. Each state contains the present step."""

    at: Natural | None = 0  # the step to do next; None when the program has ended or the operator was called
    stage: Natural | None = None  # the stage under way; None between two stages
    stopped: OperatorCalled | None = None  # the call to the operator that has not been answered
    onward: Natural | None = None  # after a stop: the step that would have been next

    @property
    def places(self) -> tuple[TaskPlace, ...]:
        """The place of each unfinished task. The task that runs next comes first. The next step of this task is also
        the value of the state's field `at`. A system with several tasks overrides this property.
        """
        return () if self.at is None else (TaskPlace("", self.at),)
