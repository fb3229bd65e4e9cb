"""Which step of one program is which step of another, after somebody has changed the script."""

from collections.abc import Iterator, Sequence
from difflib import SequenceMatcher
from typing import Any

import msgspec

from handeye.core.plain_text import one_line
from handeye.program.program import Step

Pair = tuple[int | None, int | None]
"""Numbers of a step before and after; None: it was added, or removed."""


def aligned(before: Sequence[Step], after: Sequence[Step]) -> list[Pair]:
    """Every step of both programs once, in the order of their texts.

    Steps that do and say the same are matched first. Between two such matches, steps are paired by what they say,
    then by the kind of their operation: a step is changed rather than removed and added.
    """
    keys = (_exact, _said, _kind)
    return list(_matched(before, after, range(len(before)), range(len(after)), keys))


def _matched(
    before: Sequence[Step], after: Sequence[Step], old: range, new: range, keys: tuple[Any, ...]
) -> Iterator[Pair]:
    """Pairs of a stretch of each program, by the first of the keys; what differs in it, by the others."""
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
    """True if a way that led to step `old` and now leads to `new` still goes to the same place.

    A way to a step that was removed goes on to what stood behind it, or to what has come in its place; None is
    the end of the program.
    """
    at = _place(pairs, 0, old)
    if at < len(pairs) and pairs[at][1] is not None:
        return pairs[at][1] == new
    return _survivor(pairs, at) == _survivor(pairs, _place(pairs, 1, new))


def _place(pairs: Sequence[Pair], side: int, number: int | None) -> int:
    """Where a step of one side stands among the pairs; the end of the program behind them all."""
    return next((at for at, pair in enumerate(pairs) if pair[side] == number is not None), len(pairs))


def _survivor(pairs: Sequence[Pair], at: int) -> int | None:
    """The first place from `at` on whose step is in both programs."""
    return next((place for place in range(at, len(pairs)) if None not in pairs[place]), None)


def does(step: Step) -> dict[str, Any]:
    """The operation of a step as data, but for where it leads."""
    operation = step.operation
    found: dict[str, Any] = msgspec.to_builtins(
        operation.leading_to(None) if operation.branches else operation
    )
    return found


def _exact(step: Step) -> str:
    return f"{one_line(step.text)} {does(step)}"


def _said(step: Step) -> str:
    return one_line(step.text)


def _kind(step: Step) -> str:
    return type(step.operation).__name__
