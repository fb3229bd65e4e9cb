"""The memory of the program. With each executed step, the values that the step changed are stored.

Pictures are not restored, because a program that continues takes new pictures before it examines them. Lens and aim
of the camera are not restored either, because a reversal moves only the arm.
"""

from dataclasses import dataclass
from typing import Any, Final, get_type_hints

from msgspec.structs import replace

from handeye.core.errors import InvalidInput
from handeye.core.mutable_records import MutableRecord, put_back
from handeye.core.packed import decoded, encoded
from handeye.execution.context import ExecutionContext
from handeye.execution.state import ExecutedStep, ExecutionState, check_fits
from handeye.execution.undo.way import packed

REMEMBERED: Final = (
    "pending", "saved", "heights", "counters", "search", "restored", "goal", "place", "travel",
    "finger_line", "grasping", "unlike", "general", "world",
)  # fmt: skip
Memory = dict[str, Any]  # from the name of a field of the state to its value
_UNCHECKED: Final[Memory] = {"done": [], "undoing": None, "unwound": {}, "shots": {}, "found": {}}
"""Large fields of the state that no step stores. They are known to be valid, so the check of a step's memory sees
empty values in their place.
"""
_TYPES: Final[dict[str, Any]] = get_type_hints(ExecutionState)


def memory(state: ExecutionState) -> dict[str, bytes]:
    """Return the present memory of the program, by field."""
    return {name: encoded(getattr(state, name)) for name in REMEMBERED}


def changed(before: dict[str, bytes], after: dict[str, bytes]) -> dict[str, bytes]:
    """Return the old values of the fields that have changed."""
    return {name: old for name, old in before.items() if after[name] != old}


def recalled(run: ExecutionContext, before: dict[str, bytes]) -> Memory:
    """Decode stored memory. Returns a dictionary with the value of each stored field of the state. Raises ValueError
    if the values do not fit the running program.
    """
    if not before.keys() <= set(REMEMBERED):
        raise ValueError("the record contains data that no program can produce")
    found = {name: decoded(data, _TYPES[name]) for name, data in before.items()}
    try:
        check_fits(replace(run.state, **_UNCHECKED, **found), run.plan, run.arm)
    except InvalidInput as fault:
        raise ValueError(str(fault)) from None
    return found


def remember(state: ExecutionState, found: Memory) -> None:
    """Put a stored memory back into a state."""
    for name, value in found.items():
        here = getattr(state, name)
        if isinstance(here, MutableRecord) and type(here) is type(value):
            put_back(here, value)  # in place: every holder of the record sees this
        else:
            setattr(state, name, value)


@dataclass(frozen=True, slots=True, kw_only=True)
class StateBefore:
    """The parts of the state that a step may change, as they were before the step."""

    gap: float
    fingers: float
    grasping: bool
    load: float
    tool: float
    memory: dict[str, bytes]


def before(run: ExecutionContext) -> StateBefore:
    """Record the state before a step."""
    state, drive = run.state, run.drive.state
    run.drive.track.begin(drive.q, drive.gap)
    return StateBefore(
        gap=round(run.drive.sensed.gap, 6),
        fingers=drive.gap,
        grasping=state.grasping,
        load=drive.load,
        tool=drive.tool,
        memory=memory(state),
    )


def noted(run: ExecutionContext, found: StateBefore, *, step: int, enters: bool) -> ExecutedStep:
    """Make the record of a finished step. `enters` is True for the first step of its stage."""
    drive, state = run.drive, run.state
    way = drive.track.way(drive.state.q, drive.state.gap)
    operation = run.plan.program.steps[step].operation
    guards = run.watching(operation.guards) if state.pending is None else ()
    return ExecutedStep(
        step=step,
        way=b"" if way is None else packed(way),
        gap=(found.gap, round(drive.sensed.gap, 6)),
        fingers=found.fingers,
        grasping=found.grasping,
        load=found.load,
        tool=found.tool,
        force=round(drive.track.force, 3),
        ended=guards[0].kind if guards else None,
        remembered=changed(found.memory, memory(state)),
        enters=enters,
    )
