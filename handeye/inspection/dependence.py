"""What a step depends on that only the working phase knows: parts seen, positions and differences kept, a search.

For each step it is worked out which measurements can be the newest when it is reached, over every way through the
graph, loops and error edges included.
"""

from typing import Literal

from handeye.program import program as op
from handeye.source import line_name

Kind = Literal["part", "position", "difference", "search"]
Key = tuple[Kind, str]
Newest = dict[Key, frozenset[int]]
"""The steps that may have measured something last."""


class Dependence(op.Record, frozen=True, kw_only=True):
    """Something measured that a step is carried out by."""

    kind: Kind
    name: str
    """Of the part, position or difference; empty for a search."""
    level: bool = False
    """Only its horizontal components count."""
    steps: tuple[int, ...]
    """Steps that may have measured it last. None: a place is as planned, a difference is zero."""
    lines: tuple[int | str, ...]
    """Their lines of the source: 12, or `pins.al:12` in a required file."""


def dependences(program: op.Program) -> tuple[tuple[Dependence, ...], ...]:
    """What each step of a program depends on, in the order of the steps."""
    newest = _newest(program)
    kept = {step.operation.position for step in program.steps if isinstance(step.operation, op.Here)}
    return tuple(
        tuple(
            _dependence(program, key, level, newest[number].get(key, frozenset()))
            for key, level in _uses(program, kept, step.operation)
        )
        for number, step in enumerate(program.steps)
    )


def successors(step: op.Step) -> tuple[int, ...]:
    """The steps that may follow a step."""
    return tuple(dict.fromkeys(way for way in step.ways if way is not None))


def _dependence(program: op.Program, key: Key, level: bool, steps: frozenset[int]) -> Dependence:
    places = sorted({(program.steps[number].file, program.steps[number].line) for number in steps})
    lines = tuple(line_name(line, file) if file else line for file, line in places)
    return Dependence(kind=key[0], name=key[1], level=level, steps=tuple(sorted(steps)), lines=lines)


def _measures(operation: op.AnyOperation) -> Key | None:
    """What an operation measures."""
    if isinstance(operation, op.General | op.Specific):
        return "part", operation.part
    if isinstance(operation, op.Save):
        return "difference", operation.name
    if isinstance(operation, op.Here):
        return "position", operation.position
    return ("search", "") if isinstance(operation, op.Search) else None


def _uses(program: op.Program, kept: set[str], operation: op.AnyOperation) -> list[tuple[Key, bool]]:
    """What an operation is carried out by, and whether only its horizontal components count; `kept`: by a HERE."""
    found: list[tuple[Key, bool]] = []
    named = [getattr(operation, field, None) for field in ("goal", "centre", "target", "part")]
    for name in (*named, *getattr(operation, "via", ())):
        if name in kept:
            found.append((("position", name), False))
        if name in program.positions:
            name = program.positions[name].of
        if name is not None and not isinstance(operation, op.General):
            found.append((("part", name), False))
    if isinstance(operation, op.Move):
        found += [(("difference", restore.name), restore.level) for restore in operation.restore]
        found += [(("search", ""), False)] if operation.searching else []
    return list(dict.fromkeys(found))


def _newest(program: op.Program) -> list[Newest]:
    """The newest measurements before each step."""
    before: list[Newest] = [{} for _ in program.steps]
    waiting = list(range(len(program.steps)))[::-1]
    while waiting:
        number = waiting.pop()
        key = _measures(program.steps[number].operation)
        after = before[number] | ({} if key is None else {key: frozenset({number})})
        for follower in successors(program.steps[number]):
            merged = _merged(before[follower], after)
            if merged != before[follower]:
                before[follower] = merged
                waiting.append(follower)
    return before


def _merged(one: Newest, other: Newest) -> Newest:
    return one | {key: one.get(key, frozenset()) | steps for key, steps in other.items()}
