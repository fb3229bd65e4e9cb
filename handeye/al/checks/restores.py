"""Finds each RESTORE whose difference has not been saved on any path to that RESTORE.

There is one exception. In some programs, a RESTORE shifts the goal of a MOVE by a difference, and a SAVE after this
MOVE saves the same difference again, relative to the shifted goal. In such a program, the difference is zero before
the first SAVE, so the first RESTORE of this difference is no mistake.
"""

from collections.abc import Iterator
from functools import cache

from handeye.al.lower import Lowered
from handeye.al.parameters import uses
from handeye.al.syntax import Name, Statement
from handeye.core.diagnostics import Diagnostic, Label, problem, quoted
from handeye.program.flow_operations import Save
from handeye.program.graph import Graph
from handeye.program.motion_operations import Move


def check_restores(lowered: Lowered, graph: Graph) -> Iterator[Diagnostic]:
    """Report each RESTORE that is wrong in every call of the macro that contains it. A name without any SAVE is not
    reported here, because `check_names` reports it.
    """
    saves = {number: _name(lowered.origins[number]) for number in graph.which(Save)}
    first: dict[str, Name] = {}
    for save in saves.values():
        first.setdefault(save.text, save)
    bits = {name: 1 << number for number, name in enumerate(first)}
    everywhere = cache(lambda: _saved(graph, {number: bits[save.text] for number, save in saves.items()}))
    lost: dict[Statement, Name] = {}
    right: set[Statement] = set()
    for number, shifts in lowered.shifts.items():
        if number not in graph.reached:
            continue
        near = {saves[save].text for save in graph.last(number, Save)}
        for statement in shifts:
            name = _name(statement)
            if name.text in near or _follows(graph, number, name.text):
                right.add(statement)
            elif name.text in bits and (saved := everywhere()[number]) is not None:
                if saved & bits[name.text]:
                    right.add(statement)
                else:
                    lost[statement] = name
    for statement, name in lost.items():
        if statement not in right:
            message = (
                f"there is no `SAVE` of {quoted(name.text)} before this `RESTORE`, so the goal is not shifted"
            )
            here = Label(span=first[name.text].span, text="the only `SAVE`")
            yield problem("never-saved", message, name.span, here, *uses(name))


def _follows(graph: Graph, move: int, name: str) -> bool:
    """Return True if the difference `name` is saved after the step `move` and before the next MOVE. The difference is
    then relative to the goal of the step `move`.
    """
    seen: set[int] = set()
    waiting = list(graph.onward[move])
    while waiting:
        number = waiting.pop()
        if number is None or number in seen:
            continue
        seen.add(number)
        save = graph.at(number, Save)
        if save is not None and save.name == name:
            return True
        if graph.at(number, Move) is None:
            waiting += graph.onward[number]
    return False


def _saved(graph: Graph, bits: dict[int, int]) -> list[int | None]:
    """Return, for each step, a bit set of the names that may have been saved before the step; None if the step is
    unreachable.

    The sets are propagated forwards through the steps until no set changes any more.
    """
    before: list[int | None] = [None] * len(graph.steps)
    before[0] = 0
    changed = bytearray(len(before))
    number = 0
    while number >= 0:
        changed[number] = False
        after = (before[number] or 0) | bits.get(number, 0)
        for target in graph.onward[number]:
            if target is None:
                continue
            known = before[target]
            if known is None or after & ~known:
                before[target] = after | (known or 0)
                changed[target] = True
        ahead = changed.find(True, number + 1)
        number = ahead if ahead >= 0 else changed.find(True)
    return before


def _name(statement: Statement) -> Name:
    name = statement.operands[0]
    assert isinstance(name, Name)
    return name
