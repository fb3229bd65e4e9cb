"""Stops and checks that come out in one way only, whatever the arm meets."""

import math
import re
from collections.abc import Iterable, Iterator
from dataclasses import dataclass
from itertools import chain
from typing import Final

from handeye.core.units import INCH
from handeye.program.flow_operations import Tool, Undo, Wait
from handeye.program.graph import Graph
from handeye.program.guards import Force, GuardKind
from handeye.program.motion_operations import Center, Change, Close, Open, Travel

_TIME: Final = re.compile(r"[\d.]+ *(?:m?s|secs?|seconds?)?", re.ASCII | re.IGNORECASE)
LEAST: Final = 1e-6
"""m by which a figure has to be off before anything is said of it."""


@dataclass(frozen=True, slots=True, kw_only=True)
class AlwaysFails:
    """A step that never does what it is for."""

    code: str
    step: int
    message: str
    help: str
    cause: int | None = None
    """The step that is the reason."""


def in_vain(graph: Graph) -> Iterator[AlwaysFails]:
    """The steps of a program that never do what they are for, or always raise an error."""
    yield from _stops(graph)
    yield from _grasps(graph)
    yield from _travels(graph)
    yield from _torques(graph)
    yield from _touches(graph)
    yield from _pauses(graph)
    yield from _undoes(graph)


def _stops(graph: Graph) -> Iterator[AlwaysFails]:
    for number, change in graph.each(Change):
        if len(change.guards) != 1 or not isinstance(guard := change.guards[0], Force):
            continue
        (x, y, z), (f, g, h) = change.displacement, guard.force
        if x * f + y * g + z * h < 0:
            yield AlwaysFails(
                code="stop-away-from-motion",
                step=number,
                message="the hand moves away from what its `STOP` should press on",
                help="the vector of `STOP` is the force of the hand: point it where the hand goes",
            )


def _grasps(graph: Graph) -> Iterator[AlwaysFails]:
    """Grasps of more than the hand was opened to."""
    least = min(_gaps(graph, graph.which(Open)), default=math.inf)  # no OPEN is too little for less
    grasps: Iterator[tuple[int, Close | Center]] = chain(graph.each(Close), graph.each(Center))
    for number, grasp in grasps:
        if grasp.minimum <= least:
            continue
        before = graph.last(number, Open, Close, Center)
        opened = _gaps(graph, before)
        if before and len(opened) == len(before) and max(opened) < grasp.minimum - LEAST:
            yield AlwaysFails(
                code="opened-too-little",
                step=number,
                message=f"the grasp asks for at least {grasp.minimum / INCH:g} in, and the hand is open by "
                f"{max(opened) / INCH:g} in",
                help="it would always raise error 2",
                cause=max(before),
            )


def _gaps(graph: Graph, numbers: Iterable[int]) -> list[float]:
    """Gaps of those of some steps that open the hand, m."""
    return [opened.gap for n in numbers if (opened := graph.at(n, Open)) is not None]


def _travels(graph: Graph) -> Iterator[AlwaysFails]:
    """Checks for a longer way than the motion before goes."""
    for number, travel in graph.each(Travel):
        before = graph.last(number, Change)
        changes = (graph.at(n, Change) for n in before)
        ways = [math.hypot(*change.displacement) for change in changes if change is not None]
        if ways and max(ways) < travel.minimum - LEAST:
            yield AlwaysFails(
                code="travel-too-long",
                step=number,
                message=f"`TRAVEL` asks for at least {travel.minimum / INCH:g} in, and the motion goes at most "
                f"{max(ways) / INCH:g} in",
                help="it would always raise error 8",
                cause=max(before),
            )


def _torques(graph: Graph) -> Iterator[AlwaysFails]:
    """Stops on the torque of a screwdriver that does not turn."""
    tools = graph.each(Tool)
    running = {number for number, tool in tools if tool.speed}
    started: set[int] | None = None
    for number in _guarded(graph, GuardKind.TORQUE):
        started = graph.after(running) if started is None else started
        last = graph.last(number, Tool)
        if number not in started or (last and running.isdisjoint(last)):
            yield AlwaysFails(
                code="torque-without-tool",
                step=number,
                message="a torque should end this motion, but the screwdriver does not turn",
                help="`TOOL` runs the screwdriver; without it this always raises error 24",
                cause=max(last, default=None),
            )


def _touches(graph: Graph) -> Iterator[AlwaysFails]:
    """Stops on a touch of fingers that are closed."""
    for number in _guarded(graph, GuardKind.TOUCH):
        last = graph.last(number, Open, Close, Center)
        if last and not any(graph.at(n, Open) for n in last):
            yield AlwaysFails(
                code="touch-while-closed",
                step=number,
                message="a touch should end this motion, but the fingers are closed: what they hold ends it at once",
                help="`STOP` feels what the held thing meets; `TOUCH` needs open fingers",
                cause=max(last),
            )


def _guarded(graph: Graph, kind: GuardKind) -> Iterator[int]:
    """The motions that a guard of a kind may end."""
    for number in graph.which(*(one for one in graph.kinds if one.family == "motion")):
        if any(guard.kind is kind for guard in graph.steps[number].operation.guards):
            yield number


def _pauses(graph: Graph) -> Iterator[AlwaysFails]:
    """Calls of the operator that were meant to let time pass."""
    for number, wait in graph.each(Wait):
        if _TIME.fullmatch(wait.message):
            yield AlwaysFails(
                code="wait-for-time",
                step=number,
                message="`WAIT` stops the run and calls the operator: it does not wait for a time",
                help="leave it out: the arm is at rest when a motion ends",
            )


def _undoes(graph: Graph) -> Iterator[AlwaysFails]:
    """Stages that are undone whatever happens in them."""
    steps = graph.steps
    for number, _ in graph.each(Undo):
        stage = steps[number].stage
        here: int | None = next(first for first, step in enumerate(steps) if step.stage == stage)
        seen: set[int] = set()
        while here is not None and here != number and here not in seen and not steps[here].operation.branches:
            seen.add(here)
            here = steps[here].next
        if here == number:
            yield AlwaysFails(
                code="always-undone",
                step=number,
                message="the stage is undone whatever happens in it",
                help="test an error before it, with `SKIPE` or `SKIPN`",
            )
