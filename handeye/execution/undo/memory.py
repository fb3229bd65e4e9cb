"""What the program remembers from step to step, kept with each step as far as the step has changed it.

Pictures stay: a program that goes on takes them anew before it looks at them. So does what the camera is: its lens and
its aim are where they are, and undoing moves only the arm.
"""

from typing import Any, Final, get_type_hints

from msgspec.structs import replace

from handeye.core.errors import InvalidInput
from handeye.core.mutable_records import MutableRecord, put_back
from handeye.core.packed import decoded, encoded
from handeye.execution.context import ExecutionContext
from handeye.execution.state import ExecutionState, check_fits

REMEMBERED: Final = (
    "pending", "saved", "heights", "counters", "search", "restored", "goal", "travel", "finger_line", "grasping",
    "general", "world",
)  # fmt: skip
"""Fields of the state."""
Memory = dict[str, Any]
"""Values of fields of the state."""
_UNCHECKED: Final[Memory] = {"done": [], "undoing": None, "unwound": {}, "shots": {}, "found": {}}
"""What no step remembers is sound already, and large."""
_TYPES: Final[dict[str, Any]] = get_type_hints(ExecutionState)


def memory(state: ExecutionState) -> dict[str, bytes]:
    """What is remembered now."""
    return {name: encoded(getattr(state, name)) for name in REMEMBERED}


def changed(before: dict[str, bytes], after: dict[str, bytes]) -> dict[str, bytes]:
    """What of it is another now, as it was before."""
    return {name: old for name, old in before.items() if after[name] != old}


def recalled(run: ExecutionContext, before: dict[str, bytes]) -> Memory:
    """What a program remembered, by the names of fields of its state.

    Raises:
        ValueError: it is no memory of the program that runs.
    """
    if not before.keys() <= set(REMEMBERED):
        raise ValueError("it remembers what no program does")
    found = {name: decoded(data, _TYPES[name]) for name, data in before.items()}
    try:
        check_fits(replace(run.state, **_UNCHECKED, **found), run.plan, run.arm)
    except InvalidInput as fault:
        raise ValueError(str(fault)) from None
    return found


def remember(state: ExecutionState, found: Memory) -> None:
    """Let a state remember again what it did."""
    for name, value in found.items():
        here = getattr(state, name)
        if isinstance(here, MutableRecord) and type(here) is type(value):
            put_back(here, value)  # whoever holds it sees this
        else:
            setattr(state, name, value)
