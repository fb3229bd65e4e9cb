"""Finds what a step depends on that is measured at run time: parts seen, saved positions and differences, a search.

For each step the possible newest measurements are computed over all paths through the graph, loops and error edges
included.
"""

from typing import Final, Literal, get_args

from handeye.core.record import Record
from handeye.core.source import line_name
from handeye.program.graph import Graph
from handeye.program.operation import Operation
from handeye.program.program import Program

Measured = Literal["part", "position", "difference", "search"]
Key = tuple[Measured, str]
_MEASURED: Final[tuple[Measured, ...]] = get_args(Measured)
Newest = dict[Key, frozenset[int]]
"""Steps that may have made each measurement last."""


class Dependence(Record, frozen=True, kw_only=True):
    """A measurement that a step depends on."""

    kind: Measured
    name: str  # empty for a search
    level: bool = False  # horizontal components only
    steps: tuple[int, ...]  # may have measured it last; empty: as planned, or zero
    lines: tuple[int | str, ...]  # lines of the source, or `pins.al:12` in a required file


def dependences(program: Program) -> tuple[tuple[Dependence, ...], ...]:
    """Dependences of each step, in order."""
    newest = _newest(program)
    kept = program.written("position")
    return tuple(
        tuple(
            _dependence(program, key, level, newest[number].get(key, frozenset()))
            for key, level in _uses(program, kept, step.operation)
        )
        for number, step in enumerate(program.steps)
    )


def _dependence(program: Program, key: Key, level: bool, steps: frozenset[int]) -> Dependence:
    places = sorted({(program.steps[number].file, program.steps[number].line) for number in steps})
    lines = tuple(line_name(line, file) if file else line for file, line in places)
    return Dependence(kind=key[0], name=key[1], level=level, steps=tuple(sorted(steps)), lines=lines)


def _uses(program: Program, kept: set[str], operation: Operation) -> list[tuple[Key, bool]]:
    """What a motion or look depends on, and whether only horizontally; `kept` are positions that a HERE defines."""
    found: list[tuple[Key, bool]] = []
    for kind, name, level in operation.reads if operation.family in ("motion", "sight") else ():
        if kind in ("difference", "search"):
            found.append(((kind, name), level))
        elif kind in ("position", "target", "part"):
            of: str | None = name
            if name in kept:
                found.append((("position", name), False))
            if name in program.positions:
                of = program.positions[name].of
            if of is not None:
                found.append((("part", of), False))
    return list(dict.fromkeys(found))


def _newest(program: Program) -> list[Newest]:
    """The newest measurements before each step."""
    graph = Graph(program.steps)
    measured = [
        [(kind, use.name) for use in step.operation.writes for kind in _MEASURED if kind == use.kind]
        for step in program.steps
    ]
    before: list[Newest] = [{} for _ in program.steps]
    waiting = list(range(len(program.steps)))[::-1]
    while waiting:
        number = waiting.pop()
        after = before[number] | dict.fromkeys(measured[number], frozenset({number}))
        for follower in dict.fromkeys(graph.onward[number]):
            if follower is None:
                continue
            merged = _merged(before[follower], after)
            if merged != before[follower]:
                before[follower] = merged
                waiting.append(follower)
    return before


def _merged(one: Newest, other: Newest) -> Newest:
    return one | {key: one.get(key, frozenset()) | steps for key, steps in other.items()}
