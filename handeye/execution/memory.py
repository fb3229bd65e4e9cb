"""What the working phase remembers from step to step: for checkpoints and for going back in time.

The plan, the arm and the cell are not memory: they are given anew when a run is taken up again.
"""

from dataclasses import replace
from typing import Annotated, Any, Final

import msgspec

from handeye.errors import InvalidInput
from handeye.events import OperatorCalled
from handeye.execution.executor import Executor
from handeye.execution.state import Clockwork, ExecutionState, Fault, Found, SearchState, Shot
from handeye.ports.camera import COLUMNS, ROWS
from handeye.pose import Array, Pose
from handeye.program.program import Look, Position, Record
from handeye.vision.base import GeneralLocation

Natural = Annotated[int, msgspec.Meta(ge=0)]

DRIVE: Final = ("q", "gap", "grip", "load", "tool", "lamp", "cut", "tare", "wrench")
RUN: Final = ("goal", "travel", "finger_line", "lens")
TABLES: Final = ("saved", "counters", "restored", "shots", "general", "found")
EXECUTOR: Final = ("at", "pending", "stage", "stopped", "onward", "idle", "clock")


class DriveMemory(Record, frozen=True, kw_only=True):
    """What the servo loop holds; the fields are those of `ArmDrive`."""

    q: Array
    gap: float
    grip: float
    load: float
    tool: float
    lamp: bool
    cut: bool
    tare: Array
    wrench: Array


class Memory(Record, frozen=True, kw_only=True):
    """The state of executor, run and world model; the fields are theirs."""

    at: Natural | None
    pending: Fault | None
    stage: Natural | None
    stopped: OperatorCalled | None
    onward: Natural | None
    idle: int
    clock: float
    goal: Array
    travel: float
    finger_line: Array | None
    lens: float
    saved: dict[str, Array]
    counters: dict[str, int]
    restored: dict[str, Array]
    shots: dict[str, Shot]
    general: dict[str, GeneralLocation]
    found: dict[str, Found]
    search: SearchState | None
    clockwork: Clockwork
    measured: dict[str, Pose]
    moved: dict[str, Position]
    """Positions that `HERE`, or an experiment, has put elsewhere."""
    drive: DriveMemory


def remember(executor: Executor) -> Memory:
    """What an executor and its run remember now."""
    run = executor.state
    tables: dict[str, Any] = {name: dict(table) for name, table in _taken(run, TABLES).items()}
    return Memory(
        **_taken(executor, EXECUTOR),
        **_taken(run, RUN),
        **tables,
        search=None if run.search is None else replace(run.search),
        clockwork=replace(run.clockwork),
        measured=dict(run.world.measured),
        moved=dict(run.world.moved),
        drive=DriveMemory(**_taken(run.drive, DRIVE)),
    )


def _taken(holder: object, names: tuple[str, ...]) -> dict[str, Any]:
    return {name: getattr(holder, name) for name in names}


def recall(executor: Executor, memory: Memory) -> None:
    """Put an executor and its run back to where they were; the cell must be as it was then.

    Raises:
        InvalidInput: the memory is not of this plan.
    """
    run = executor.state
    _check(run, memory)
    for name in EXECUTOR:
        setattr(executor, name, getattr(memory, name))
    for name in RUN:
        setattr(run, name, getattr(memory, name))
    for name in TABLES:
        setattr(run, name, dict(getattr(memory, name)))
    run.search = None if memory.search is None else replace(memory.search)
    run.clockwork = replace(memory.clockwork)
    run.world.measured, run.world.moved = dict(memory.measured), dict(memory.moved)
    for name in DRIVE:
        setattr(run.drive, name, getattr(memory.drive, name))
    run.drive.sensed = run.cell.sense()


def _check(run: ExecutionState, memory: Memory) -> None:
    """Raises InvalidInput for steps, stages, parts, pictures and vectors that the plan does not have."""
    program = run.plan.program
    taken = {step.operation.picture for step in program.steps if isinstance(step.operation, Look)}
    vectors = [memory.goal, *memory.saved.values(), *memory.restored.values()]
    vectors += [] if memory.finger_line is None else [memory.finger_line]
    joints = (memory.drive.q, memory.drive.tare, memory.drive.wrench)
    fits = (
        all(step is None or step < len(program.steps) for step in (memory.at, memory.onward))
        and (memory.stage is None or memory.stage < len(program.stages))
        and (memory.stopped is None or (memory.stage is not None and memory.at is None))
        and {*memory.measured, *memory.general} <= set(program.parts)
        and {*memory.shots, *memory.found} <= taken  # names that become file names
        and all(shot.picture.shape == (ROWS, COLUMNS) for shot in memory.shots.values())
        and set(memory.moved) <= set(program.positions)
        and all(p.of is None or p.of in program.parts for p in memory.moved.values())
        and all(vector.shape == (3,) for vector in vectors)
        and all(values.shape == (6,) for values in joints)
        and all(X.shape == (4, 4) for X in memory.measured.values())
    )
    if not fits:
        raise InvalidInput("what the run remembers does not fit this plan")
