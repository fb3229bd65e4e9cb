"""Short scripts that the Stanford arm executes in the fake cell. They test the executor without physics of parts."""

from dataclasses import dataclass, field
from typing import TypeVar

import numpy as np
from compiled_mechanics import CompiledMechanics
from fakes import FakeCell

from handeye.al import compile_text
from handeye.arm.ik import solve
from handeye.arm.robots.stanford import STANFORD
from handeye.cell.compiled_arm import CompiledArm
from handeye.core.pose import Array, hand
from handeye.core.source import Source
from handeye.core.units import DEGREE, INCH
from handeye.execution.context import ExecutionContext
from handeye.execution.executor import Executor
from handeye.planning.planner import make_plan
from handeye.program.diagnosis.cause_text import call_sentence
from handeye.program.events import ErrorRaised, Event, StepStarted
from handeye.program.program import Held, Part, Position
from handeye.program.taught import Taught
from handeye.tasks.stanford_cell.dimensions import PARK
from handeye.tasks.water_pump.world.nominal import DRAWING

Kind = TypeVar("Kind", bound=Event)

T = Position(at=(25 * INCH, 38 * INCH, 6 * INCH, 90 * DEGREE, 90 * DEGREE, 0.0))
"""A position in the middle of the table, with the hand pointing down."""
AT_T = solve(STANFORD, hand(*T.at), PARK).q
"""The joint positions there."""


@dataclass(kw_only=True)
class FakeRun:
    """A script in a fake cell, and everything that happened."""

    cell: FakeCell
    executor: Executor
    events: list[Event] = field(default_factory=list)

    def go(self) -> "FakeRun":
        """Execute steps until the program ends or calls the operator."""
        while self.executor.state.at is not None:
            self.executor.step()
        return self

    def all(self, kind: type[Kind]) -> list[Kind]:
        """Events of a kind, in order."""
        return [event for event in self.events if isinstance(event, kind)]

    @property
    def errors(self) -> list[int]:
        return [event.number for event in self.all(ErrorRaised)]

    @property
    def steps(self) -> list[str]:
        """The texts of the steps that began, in order."""
        return [event.text for event in self.all(StepStarted)]

    @property
    def called(self) -> bool:
        """True if the program has called the operator."""
        return self.executor.state.stopped is not None

    @property
    def told(self) -> str:
        """The message to the operator."""
        stopped = self.executor.state.stopped
        assert stopped is not None
        return call_sentence(stopped.message, stopped.error, stopped.cause)

    def saved(self, name: str) -> Array:
        """A saved difference (in)."""
        return self.executor.state.saved[name] / INCH

    def off(self) -> Array:
        """Position of the hand relative to T (in)."""
        return np.asarray(self.executor.run.drive.hand()[:3, 3] / INCH - np.array(T.at[:3]) / INCH)


def fake_run(
    script: str,
    *,
    parts: dict[str, Part] | None = None,
    positions: dict[str, Position] | None = None,
    held: dict[str, Held] | None = None,
) -> FakeRun:
    """Return a script that knows the position T, and any further positions. The arm begins at T."""
    taught = Taught(positions={"T": T, **(positions or {})}, parts=parts or {}, held=held or {})
    program, diagnostics = compile_text(Source(name="fake.al", text=script), taught)
    assert program is not None, diagnostics
    plan, problems = make_plan(program, STANFORD, task="water_pump", start=AT_T)
    assert plan is not None, problems
    cell, events = FakeCell(AT_T, CompiledMechanics()), list[Event]()
    context = ExecutionContext(
        plan=plan, arm=STANFORD, cell=cell.devices, camera=DRAWING, emit=events.append, arithmetic=CompiledArm
    )
    return FakeRun(cell=cell, executor=Executor(run=context), events=events)
