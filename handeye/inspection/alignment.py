"""Aligns the steps of two versions of a program."""

from collections.abc import Iterator, Sequence
from difflib import SequenceMatcher
from typing import Any

import msgspec

from handeye.core.plain_text import one_line
from handeye.program.program import Step

Pair = tuple[int | None, int | None]  # numbers of a step before and after; None if it was added or removed


def aligned(before: Sequence[Step], after: Sequence[Step]) -> list[Pair]:
    """Every step of both programs once, in text order.

    Identical steps are matched first. Between two such matches, steps are paired by their statements, then by the kind
    of their operation: a step counts as changed rather than as removed and added.
    """
    keys = (
        lambda step: f"{one_line(step.text)} {does(step)}",
        lambda step: one_line(step.text),
        lambda step: type(step.operation).__name__,
    )
    return list(_matched(before, after, range(len(before)), range(len(after)), keys))


def _matched(
    before: Sequence[Step], after: Sequence[Step], old: range, new: range, keys: tuple[Any, ...]
) -> Iterator[Pair]:
    """Pairs of a stretch of each program by the first key, and of the rest by the other keys."""
    if not keys or not old or not new:
        yield from ((number, None) for number in old)
        yield from ((None, number) for number in new)
        return
    one = [keys[0](before[number]) for number in old]
    other = [keys[0](after[number]) for number in new]
    for tag, a, b, c, d in SequenceMatcher(None, one, other, autojunk=False).get_opcodes():
        if tag == "equal":
            yield from zip(old[a:b], new[c:d], strict=True)
        else:
            yield from _matched(before, after, old[a:b], new[c:d], keys[1:])


def leads_alike(pairs: Sequence[Pair], old: int | None, new: int | None) -> bool:
    """True if an edge to step `old` and one to step `new` lead to the same place.

    An edge to a removed step leads to what followed it, or replaced it; None is the end of the program.
    """
    at = _place(pairs, 0, old)
    if at < len(pairs) and pairs[at][1] is not None:
        return pairs[at][1] == new
    return _survivor(pairs, at) == _survivor(pairs, _place(pairs, 1, new))


def _place(pairs: Sequence[Pair], side: int, number: int | None) -> int:
    """Index of the pair with a step of one side; past the last for the end of the program."""
    return next((at for at, pair in enumerate(pairs) if pair[side] == number is not None), len(pairs))


def _survivor(pairs: Sequence[Pair], at: int) -> int | None:
    """The first index from `at` on whose step is in both programs."""
    return next((place for place in range(at, len(pairs)) if None not in pairs[place]), None)


def does(step: Step) -> dict[str, Any]:
    """The operation of a step as data, without its branch target."""
    operation = step.operation.leading_to(None) if step.operation.branches else step.operation
    found: dict[str, Any] = msgspec.to_builtins(operation)
    return found
