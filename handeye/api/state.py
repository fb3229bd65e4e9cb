"""The state of a paused run, for Python programs, in SI units. Arrays are read-only."""

from collections.abc import Mapping
from dataclasses import dataclass, fields

import numpy as np

from handeye.core.plain_text import counted, one_line
from handeye.core.pose import Array, Pose
from handeye.core.source import line_name
from handeye.debugger.formatting import as_text
from handeye.debugger.reply import Reply
from handeye.runs.runner import Runner


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class Memory:
    """The program's memory: raised error, saved differences, counters, measured parts and place of the search.
    Lengths are in m, in the table frame W.
    """

    error: int | None  # number of the raised error, for which the next step may test
    saved: Mapping[str, Array]  # differences that `SAVE` saved, each of shape (3,), in m
    counters: Mapping[str, int]
    parts: Mapping[str, Pose]  # measured poses X_WP of parts, each of shape (4, 4), in m
    place: int | None  # number of the search's present place, from 0; None without a search

    def __eq__(self, other: object) -> bool:
        return isinstance(other, Memory) and _same(_values(self), _values(other))


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class State:
    """The state in which a run is paused: the place in the program, and the arm as measured by its own sensors.
    Two states are equal if all fields are equal.

    >>> state = handeye.begin("OPEN 1\\nOPEN 2\\n", camera="ray").step()
    >>> state
    <State 1 step done, 0.85 s, program, line 2: OPEN 2; paused after 1 step>
    >>> state.joints.shape, round(state.gap / 0.0254, 2)
    ((6,), 1.0)
    """

    position: int  # number of steps done since the run began
    time: float  # simulated time since the program began, in s
    stage: str | None  # the present or next stage; None after the last stage
    step: int | None  # number of the next step; None if the run cannot continue by itself
    file: str  # required file that contains the next step; empty if the script itself contains it
    line: int | None  # line of the next step
    text: str | None  # statement of the next step, without its modifiers, such as `STOP`
    why: str  # reason for the pause, in words
    joints: Array
    """Joint positions, shape (n,), in rad; in m for prismatic joints (joint 3 of the Stanford arm)."""
    gap: float  # sensed opening of the fingers, in m
    hand: Pose
    """X_WT, the pose of the hand, shape (4, 4), in m: origin midway between the finger tips, z along the approach,
    y along the finger line.
    """
    force: Array  # last estimate of the hand's force on the world, in the table frame W, shape (3,), in N
    memory: Memory

    def __eq__(self, other: object) -> bool:
        return isinstance(other, State) and _same(_values(self), _values(other))

    def __repr__(self) -> str:
        return f"<State {self}>"

    def __str__(self) -> str:
        done = f"{counted(self.position, 'step')} done, {self.time:.2f} s"
        stage = "" if self.stage is None else f", {self.stage}"
        line = "" if self.line is None else f", line {line_name(self.line, self.file)}: {self.text}"
        return f"{done}{stage}{line}; {self.why}"


def state_of(runner: Runner, stage: str | None, why: str) -> State:
    """Return the state of a paused run. Raises InvalidInput if no arm in the system of the run executes a plan."""
    run, step = runner.context, runner.next
    drive = run.drive
    return State(
        position=runner.position,
        time=runner.time,
        stage=stage,
        step=runner.at,
        file="" if step is None else step.file,
        line=None if step is None else step.line,
        text=None if step is None else one_line(step.text),
        why=why,
        joints=_kept(drive.sensed.q),
        gap=float(drive.sensed.gap),
        hand=_kept(drive.hand()),
        force=_kept(-drive.state.wrench[:3]),
        memory=_memory(runner),
    )


def _memory(runner: Runner) -> Memory:
    state = runner.context.state
    return Memory(
        error=None if state.pending is None else state.pending.number,
        saved={name: _kept(difference) for name, difference in sorted(state.saved.items())},
        counters=dict(state.counters),
        parts={name: _kept(X_WP) for name, X_WP in sorted(state.world.measured.items())},
        place=None if state.search is None else state.search.count,
    )


def _values(record: State | Memory) -> dict[str, object]:
    return {field.name: getattr(record, field.name) for field in fields(record)}


def _same(one: object, other: object) -> bool:
    """Return True if two values are equal; arrays are compared element by element."""
    if isinstance(one, Mapping) and isinstance(other, Mapping):
        return one.keys() == other.keys() and all(_same(one[name], other[name]) for name in one)
    if isinstance(one, np.ndarray) and isinstance(other, np.ndarray):
        return np.array_equal(one, other)
    return one == other


def _kept(values: Array) -> Array:
    """Return a read-only copy."""
    copy = np.array(values)
    copy.flags.writeable = False
    return copy


class Answer(Reply, frozen=True, kw_only=True):
    """A reply of the stepper. `print` shows the reply as the stepper does."""

    def __str__(self) -> str:
        """The reply as lines of text."""
        return as_text(self)


def answer(reply: Reply) -> Answer:
    """Make a reply printable."""
    return Answer(**{field: getattr(reply, field) for field in reply.__struct_fields__})
