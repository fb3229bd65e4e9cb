"""Experiments: giving what the program remembers another value, in the units of the language."""

import math
import re
from typing import Final

from handeye.debugger.breakpoints import meant
from handeye.diagnostics import quoted
from handeye.errors import InvalidInput
from handeye.program.program import Program
from handeye.runs.runner import Runner
from handeye.units import DEGREE, INCH

FARTHEST: Final = 1000.0
"""No inches or degrees of an experiment are more."""


def set_saved(runner: Runner, text: str) -> None:
    """Give a saved difference another value: `NAME x y z` (in).

    Raises:
        InvalidInput: the program has no such difference, or these are not three numbers.
    """
    name, values = _read(text, (3,), "set saved NAME x y z")
    known = saved_names(runner.setup.plan.program)
    name = _known(name, known, "saved difference")
    x, y, z = values
    runner.set_saved(name, (x * INCH, y * INCH, z * INCH))


def set_position(runner: Runner, text: str) -> None:
    """Teach a position anew: `NAME x y z` or `NAME x y z o a t` (in, deg), in the frame it was taught in.

    Raises:
        InvalidInput: the program has no such position, or these are not three or six numbers.
    """
    name, values = _read(text, (3, 6), "set position NAME x y z [o a t]")
    world = runner.run.world
    name = _known(name, sorted(world.positions), "position")
    x, y, z = values[:3]
    o, a, t = world.state.moved.get(name, world.positions[name]).at[3:]
    if len(values) == 6:
        o, a, t = (angle * DEGREE for angle in values[3:])
    runner.set_position(name, (x * INCH, y * INCH, z * INCH, o, a, t))


def saved_names(program: Program) -> list[str]:
    """The differences that a program saves or restores."""
    uses = (use for step in program.steps for use in (*step.operation.reads, *step.operation.writes))
    return sorted({use.name for use in uses if use.kind == "difference"})


def _read(text: str, counts: tuple[int, ...], usage: str) -> tuple[str, list[float]]:
    """The name and the numbers, brackets and commas left out."""
    name, *words = re.sub(r"[\[\](),]", " ", text).split() or [""]
    if not name or len(words) not in counts:
        raise InvalidInput(f"an experiment is written `{usage}`")
    return name, [_number(word) for word in words]


def _number(word: str) -> float:
    try:
        value = float(word)
    except ValueError:
        value = math.nan
    if not abs(value) <= FARTHEST:
        raise InvalidInput(f"{quoted(word)} is no number from {-FARTHEST:g} to {FARTHEST:g}")
    return value


def _known(name: str, known: list[str], what: str) -> str:
    """The name as the program has it."""
    for choice in (name, name.upper()):
        if choice in known:
            return choice
    raise InvalidInput(f"the program has no {what} {quoted(name)}{meant(name, known)}")
