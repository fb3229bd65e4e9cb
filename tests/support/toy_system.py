"""A counter machine, the second system: registers, and lines that add to one, jump while one is positive, or call.

It has no arm, no cell and no physics; a line takes a second. A program may have several tasks, which run at the same
time.
"""

from typing import ClassVar

import msgspec
from toy_entry import ENTRY
from toy_events import CountTold

from handeye.core.entries import register
from handeye.core.errors import InvalidInput
from handeye.core.record import Record
from handeye.core.variation import WorldSpec
from handeye.core.versions import versions
from handeye.execution.scheduler import Agenda
from handeye.planfile.store import written_digest
from handeye.ports.camera import Renderer
from handeye.program.events import (
    Choice,
    OperatorAnswered,
    OperatorCalled,
    RunFinished,
    RunStarted,
    StageFinished,
    StageStarted,
    StepFinished,
    StepStarted,
)
from handeye.program.system_state import SystemState, TaskPlace
from handeye.runs.setup import Setup
from handeye.runs.snapshot import Checkpoint
from handeye.runs.system import RunCallbacks, RunningSystem, Settable, StepperWords, System

SECOND = 1_000_000
"""Microseconds of the machine's clock that a line takes."""


class Line(Record, frozen=True, kw_only=True):
    """A line: `ADD A 1`, `JUMP A 0` (to line number 0 while A is positive) or `CALL A` (the operator, once)."""

    stage: int
    line: int
    text: str
    label: str = ""
    ways: tuple[int | None, ...]
    file: ClassVar[str] = ""
    macro: ClassVar[str] = ""
    examines: ClassVar[None] = None
    guarded: ClassVar[bool] = False
    begins_search: ClassVar[bool] = False
    needs: ClassVar[None] = None

    @property
    def word(self) -> str:
        return self.text.split()[0]

    @property
    def place(self) -> str:
        return str(self.line)


class Lines(Record, frozen=True, kw_only=True):
    """A program of the counter machine."""

    name: str = "toy"
    stages: tuple[str, ...] = ("count",)
    steps: tuple[Line, ...]
    tasks: dict[str, int] = msgspec.field(default_factory=dict)
    """The step with which each task begins; empty if the program has one task."""
    task: str = "counting"
    required: ClassVar[dict[str, str]] = {}
    numbered: ClassVar[dict[int, str]] = {}
    errors: ClassVar[tuple[int, ...]] = ()

    @property
    def labels(self) -> dict[str, list[int]]:
        return {step.label: [number] for number, step in enumerate(self.steps) if step.label}

    @property
    def source(self) -> str:
        return "\n".join(step.text for step in self.steps)


class Registers(SystemState, kw_only=True):
    """What the counter machine remembers."""

    cursors: dict[str, int] = msgspec.field(default_factory=dict)
    """The next step of each task."""
    turn: str = ""
    """The task whose turn is next."""
    agenda: Agenda[int] = msgspec.field(default_factory=lambda: Agenda(now=0))

    time: float = 0.0
    values: dict[str, int] = msgspec.field(default_factory=dict)

    @property
    def places(self) -> tuple[TaskPlace, ...]:
        if not self.cursors:
            return super().places
        waits = self.agenda.waits
        return tuple(TaskPlace(task, step, waits.get(task, "")) for task, step in self.cursors.items())


class CounterMachine(RunningSystem):
    """An interpreter of ten lines, and the methods that a run requires of every system."""

    cell = None
    trouble = None

    def __init__(self, setup: Setup, around: RunCallbacks) -> None:
        assert isinstance(setup.plan, Lines)
        self._setup, self._around, self._lines = setup, around, setup.plan
        self._state = Registers()

    @property
    def state(self) -> Registers:
        return self._state

    @property
    def time(self) -> float:
        return self._state.time

    def begin(self) -> list[RunStarted]:
        steps, plan = self._lines.steps, written_digest(encoded(self._lines))
        begun = RunStarted(
            system="toy", time=0.0, program="toy", steps=len(steps), plan=plan, arm="", arm_digest="",
            world=self._setup.world, camera=Renderer(method="none"), versions=versions(), task=self._setup.task,
        )  # fmt: skip
        for task, first in self._lines.tasks.items():
            self._state.cursors[task] = first
            self._state.agenda.add(task)
        self._take_turns()
        return [begun]

    def _take_turns(self) -> None:
        """Find the task whose turn is next, if there are several."""
        state = self._state
        if self._lines.tasks:
            state.turn = state.agenda.turn(self._met, lambda time: time) or ""
            state.at = state.cursors.get(state.turn)
            state.time = state.agenda.now / SECOND

    def _met(self, task: str) -> bool:
        register, _, least = self._state.agenda.waits[task].partition(" ")
        return self._state.values.get(register, 0) >= int(least)

    def _go_on(self, line: Line, onward: int | None) -> None:
        """Move the task that had its turn to its next line."""
        state, task = self._state, self._state.turn
        if onward is None:
            del state.cursors[task]
            state.agenda.end(task)
            return
        state.cursors[task] = onward
        if line.word == "WAIT":
            state.agenda.wait(task, line.text.removeprefix("WAIT "))
        else:
            state.agenda.sleep(task, SECOND)

    def step(self) -> None:
        at = self._state.at
        assert at is not None
        line = self._lines.steps[at]
        self._enter(line.stage)
        self._around.emit(StepStarted(time=self.time, step=at, line=line.line, text=line.text))
        onward = self._interpret(line)
        self._state.at = onward
        if self._lines.tasks:
            self._go_on(line, onward)
        self._around.emit(StepFinished(time=self.time, step=at, hand=None, planned=None, gap=None))
        if line.word == "CALL":
            self._state.stopped = OperatorCalled(time=self.time, message="the operator is wanted", error=None)
            self._around.emit(self._state.stopped)
            self._state.at, self._state.onward = None, onward
        else:
            self._take_turns()
        self._leave()

    def _interpret(self, line: Line) -> int | None:
        values = self._state.values
        word, register_name, *operand = line.text.split()
        self._state.time += 1.0
        if word == "ADD":
            values[register_name] = values.get(register_name, 0) + int(operand[0])
        if word == "TELL":
            held = values.get(register_name, 0)
            self._around.emit(CountTold(time=self.time, register=register_name, value=held))
        if word == "JUMP" and values.get(register_name, 0) > 0:
            return line.ways[-1]
        return line.ways[0]

    def answer(self, choice: Choice) -> None:
        state = self._state
        state.at = state.onward if choice != "retry" else 0
        state.stopped, state.onward = None, None
        self._around.emit(OperatorAnswered(time=self.time, choice=choice, step=state.at))
        self._leave()

    def finish(self) -> bool:
        completed = self._state.at is None and self._state.stopped is None
        self._around.emit(RunFinished(time=self.time, completed=completed))
        return completed

    def restore(self, state: SystemState) -> None:
        if not isinstance(state, Registers) or (state.at or 0) >= len(self._lines.steps):
            raise InvalidInput("the state of the run does not fit this plan")
        from handeye.core.mutable_records import put_back

        put_back(self._state, state)

    def settables(self) -> dict[str, Settable]:
        return {
            "register": Settable(
                noun="register",
                usage="NAME n",
                names=("A", "B"),
                units=(1.0,),
                fewest=1,
                present=lambda _: (),
            )
        }

    def set_value(self, what: str, name: str, value: tuple[float, ...]) -> None:
        if what != "register" or len(value) != 1:
            raise InvalidInput(f"{what} {name} cannot be set")
        self._state.values[name] = int(value[0])

    def _enter(self, stage: int) -> None:
        if self._state.stage is None:
            self._state.stage = stage
            self._around.emit(StageStarted(time=self.time, stage=self._lines.stages[stage]))

    def _leave(self) -> None:
        state, lines = self._state, self._lines
        over = state.at is None or lines.steps[state.at].stage != state.stage
        if over and state.stage is not None and state.stopped is None:
            self._around.emit(StageFinished(time=self.time, stage=lines.stages[state.stage], status="done"))
            state.stage = None


def encoded(lines: Lines) -> bytes:
    return msgspec.json.encode(lines)


def decoded(data: bytes, name: str) -> Lines:
    try:
        return msgspec.json.decode(data, type=Lines)
    except msgspec.DecodeError as error:
        raise InvalidInput(f"{name} is not sound: {error}") from None


class ToySystem(System):
    """Programs of the counter machine."""

    name, plan, state = "toy", Lines, Registers
    words = StepperWords(
        about=("The counter machine counts a line at a time; the arrow stands before the next one.",),
        units="lines and seconds",
        commands={"retry": "count from the first line"},
        without=("picture",),
    )

    def encode(self, plan: Lines) -> bytes:
        return encoded(plan)

    def decode(self, data: bytes, name: str) -> Lines:
        return decoded(data, name)

    def listing(self, plan: Lines) -> Lines:
        return plan

    def build(self, setup: Setup, around: RunCallbacks) -> CounterMachine:
        return CounterMachine(setup, around)


TOY = ToySystem()
register(ENTRY)


def counting(times: int = 5) -> Lines:
    """A program that counts A down and B up, `times` times. It then calls the operator, and counts B further."""
    return Lines(
        stages=("count", "ask"),
        steps=(
            Line(stage=0, line=1, text=f"ADD A {times}", ways=(1,)),
            Line(stage=0, line=2, text="ADD B 1", label="AGAIN", ways=(2,)),
            Line(stage=0, line=3, text="ADD A -1", ways=(3,)),
            Line(stage=0, line=4, text="JUMP A 1", ways=(4, 1)),
            Line(stage=1, line=5, text="CALL B", ways=(5,)),
            Line(stage=1, line=6, text="ADD B 10", ways=(None,)),
        ),
    )


def begin_toy(times: int = 5) -> Checkpoint:
    """A run of the counter machine that has not begun."""
    return Checkpoint(setup=Setup(system="toy", plan=counting(times), world=WorldSpec(seed=0), camera="ray"))
