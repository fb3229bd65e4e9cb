"""A task can reach a line by several paths. For each line of a single task, this module finds the places, limits and
speeds that are the same on every path.
"""

from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass, field, replace
from itertools import pairwise
from typing import Final, NamedTuple

from handeye.systems.sigma.mal.check import constant
from handeye.systems.sigma.mal.syntax import Binary, Call, Line, Statement
from handeye.systems.sigma.protocol import COMPONENTS

END: Final = None  # stands for the number of a line: the program ends


@dataclass(frozen=True, slots=True)
class Unknown:
    """A value that the text of the program does not determine, because the value depends on a force, or on the path by
    which the program reaches a line.
    """


UNKNOWN: Final = Unknown()
Known = float | Unknown | None
Axes = Mapping[str, Known]


@dataclass(frozen=True, slots=True, kw_only=True)
class Before:
    """What holds before a line. Each field has a value for each component: X, Y and Z."""

    places: Axes = field(default_factory=lambda: dict.fromkeys(COMPONENTS, UNKNOWN))  # mm
    limits: Axes = field(default_factory=lambda: dict.fromkeys(COMPONENTS))  # N; None is the standard limit
    speeds: Axes = field(default_factory=lambda: dict.fromkeys(COMPONENTS))  # mm/s; None is no limit
    aborts: Mapping[str, int | Unknown | None] = field(default_factory=lambda: dict.fromkeys(COMPONENTS))
    """The line to which an abort leads; None if the program stops."""

    def met(self, other: "Before") -> "Before":
        """Return what is certain before a line that the program can reach either in this state or in the state
        `other`.
        """

        def same(one: Mapping[str, object], two: Mapping[str, object]) -> dict[str, object]:
            return {name: value if value == two[name] else UNKNOWN for name, value in one.items()}

        return Before(
            places=same(self.places, other.places),  # type: ignore[arg-type]
            limits=same(self.limits, other.limits),  # type: ignore[arg-type]
            speeds=same(self.speeds, other.speeds),  # type: ignore[arg-type]
            aborts=same(self.aborts, other.aborts),  # type: ignore[arg-type]
        )


class ForceTest(NamedTuple):
    """An IF that compares the size of a force with a number."""

    axis: str
    limit: float  # N
    over: int | None  # the line that follows if the force is greater
    under: int | None


def force_test(line: Line, after: int | None) -> ForceTest | None:
    """Return the force test of an IF statement, or None if the statement tests something else. `after` is the next
    line.
    """
    match line.statement:
        case Statement(
            values=(Binary(operator=sign, left=Call("ABS", Call("FORCE", axis)), right=right),),
            then=then,
            otherwise=otherwise,
        ) if then is not None:
            limit, yes = constant(right), _jump(then)
            no = after if otherwise is None else _jump(otherwise)
            if limit is None or sign not in (">", ">=", "<", "<=") or -1 in (yes, no):
                return None
            over, under = (yes, no) if sign in (">", ">=") else (no, yes)
            return ForceTest(axis.text, limit, over, under)  # type: ignore[union-attr]
    return None


def _jump(statement: Statement) -> int | None:
    """Return the line to which a branch of IF leads; -1 if the branch does something else."""
    if statement.word in ("END", "STOP"):
        return END
    return int(statement.target.text) if statement.word == "GOTO" and statement.target is not None else -1


def goals(statement: Statement, places: Axes) -> dict[str, Known]:
    """Return the place (mm) to which a MOVE moves each of its axes; the place is UNKNOWN if the MOVE is relative and
    starts at an unknown place.
    """
    found: dict[str, Known] = {}
    for goal in statement.goals:
        name, distance = goal.axis.text[0], constant(goal.distance)
        assert distance is not None
        here = found.get(name, places[name])
        found[name] = (
            distance if goal.mode == "TO" else here + distance if isinstance(here, float) else UNKNOWN
        )
    return found


Tests = Mapping[int, ForceTest]
"""For the line of each motion, the force test that directly follows the line."""


def flow(lines: Sequence[Line], tests: Tests) -> dict[int, Before]:
    """Return what is known before each line that can be reached. The keys are the numbers of the lines."""
    by_number = {line.number: line for line in lines}
    after = dict(pairwise(by_number))
    holds: dict[int, Before] = {lines[0].number: Before()} if lines else {}
    due = [*holds]
    while due:
        number = due.pop()
        for target, left in _left(by_number[number], after.get(number), holds[number], tests.get(number)):
            if target is END:
                continue
            met = holds[target].met(left) if target in holds else left
            if met != holds.get(target):
                holds[target] = met
                due.append(target)
    return holds


def _left(
    line: Line, after: int | None, before: Before, test: ForceTest | None
) -> list[tuple[int | None, Before]]:
    """Return the lines that may follow a line, each with the facts that are known before it is executed."""
    statement = line.statement
    change: Callable[..., Before] = lambda **fields: replace(before, **fields)  # noqa: E731
    match statement.word:
        case "END" | "STOP":
            return []
        case "GOTO":
            return [(_jump(statement), before)]
        case "ORIGIN":
            return [
                (after, change(places={**before.places, **{axis.text[0]: 0.0 for axis in statement.names}}))
            ]
        case "LIMIT" | "SPEED":
            value = constant(statement.values[0]) if statement.values else None
            name = "limits" if statement.word == "LIMIT" else "speeds"
            kept = value or None if name == "speeds" else value
            return [(after, change(**{name: {**getattr(before, name), statement.names[0].text[0]: kept}}))]
        case "ON":
            named = [axis.text[0] for axis in statement.names] or COMPONENTS
            assert statement.target is not None
            target = int(statement.target.text)
            return [(after, change(aborts={**before.aborts, **dict.fromkeys(named, target)}))]
        case "MOVE":
            moved = goals(statement, before.places)
            there = change(places={**before.places, **moved})
            lost = change(places={**before.places, **dict.fromkeys(moved, UNKNOWN)})
            if test is not None:
                return [(test.under, there), (test.over, lost)]
            ways = {before.aborts[name] for name in moved if before.limits[name] is not None}
            return [(after, there), *((way, lost) for way in ways if isinstance(way, int))]
    return [(after, before)]
