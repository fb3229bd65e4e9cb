"""Finds steps that can never have their effect, or that raise an error in every world."""

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
TOLERANCE_M: Final = 1e-6


@dataclass(frozen=True, slots=True)
class AlwaysFails:
    """A step that can never have its effect. `cause` is the step that prevents the effect; None if no step prevents
    it.
    """

    code: str
    step: int
    message: str
    help: str
    cause: int | None = None


def always_failing(graph: Graph) -> Iterator[AlwaysFails]:
    """Yield the steps that can never have their effect, or that always raise an error."""
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
            message = "the hand moves away from the surface on which the `STOP` should end the motion"
            help = "the vector of `STOP` is the force that the hand exerts: point the vector in the direction of motion"
            yield AlwaysFails("stop-away-from-motion", number, message, help)


def _grasps(graph: Graph) -> Iterator[AlwaysFails]:
    """Yield the grasps of objects that are expected to be wider than the gap between the open fingers."""
    least = min(_gaps(graph, graph.which(Open)), default=math.inf)  # no OPEN is narrower
    grasps: Iterator[tuple[int, Close | Center]] = chain(graph.each(Close), graph.each(Center))
    for number, grasp in grasps:
        if grasp.minimum <= least:
            continue
        before = graph.last(number, Open, Close, Center)
        opened = _gaps(graph, before)
        if before and len(opened) == len(before) and max(opened) < grasp.minimum - TOLERANCE_M:
            message = (
                f"the grasp needs at least {grasp.minimum / INCH:g} in, but the hand is open only "
                f"{max(opened) / INCH:g} in"
            )
            help = "open the fingers wider, or reduce the minimum: this grasp always raises error 2"
            yield AlwaysFails("opened-too-little", number, message, help, max(before))


def _gaps(graph: Graph, numbers: Iterable[int]) -> list[float]:
    """Return the gaps (m) of the OPEN steps among `numbers`."""
    return [opened.gap for n in numbers if (opened := graph.at(n, Open)) is not None]


def _travels(graph: Graph) -> Iterator[AlwaysFails]:
    """Yield each TRAVEL whose minimum is greater than the length of the motion before it."""
    for number, travel in graph.each(Travel):
        before = graph.last(number, Change)
        changes = (graph.at(n, Change) for n in before)
        lengths = [math.hypot(*change.displacement) for change in changes if change is not None]
        if lengths and max(lengths) < travel.minimum - TOLERANCE_M:
            message = (
                f"`TRAVEL` needs at least {travel.minimum / INCH:g} in, but the motion is at most "
                f"{max(lengths) / INCH:g} in"
            )
            help = "lower the minimum or lengthen the motion: this `TRAVEL` always raises error 8"
            yield AlwaysFails("travel-too-long", number, message, help, max(before))


def _torques(graph: Graph) -> Iterator[AlwaysFails]:
    """Yield the motions that wait for a torque while the screwdriver is switched off."""
    tools = graph.each(Tool)
    running = {number for number, tool in tools if tool.speed}
    started: set[int] | None = None
    for number in _guarded(graph, GuardKind.TORQUE):
        started = graph.after(running) if started is None else started
        last = graph.last(number, Tool)
        if number not in started or (last and running.isdisjoint(last)):
            message = "this motion waits for a torque, but the screwdriver does not turn"
            help = (
                "start the screwdriver with `TOOL`; while it stands still, this motion always raises error 24"
            )
            yield AlwaysFails("torque-without-tool", number, message, help, max(last, default=None))


def _touches(graph: Graph) -> Iterator[AlwaysFails]:
    """Yield the motions that wait for a touch while the fingers are closed."""
    for number in _guarded(graph, GuardKind.TOUCH):
        last = graph.last(number, Open, Close, Center)
        if last and not any(graph.at(n, Open) for n in last):
            message = (
                "this motion waits for a touch, but the fingers are closed, and the part between them ends the "
                "motion immediately"
            )
            help = "use `STOP`, which feels contact through the held part; `TOUCH` needs open fingers"
            yield AlwaysFails("touch-while-closed", number, message, help, max(last))


def _guarded(graph: Graph, kind: GuardKind) -> Iterator[int]:
    """Yield the motions that have a guard of the kind `kind`."""
    for number in graph.which(*(one for one in graph.kinds if one.family == "motion")):
        if any(guard.kind is kind for guard in graph.steps[number].operation.guards):
            yield number


def _pauses(graph: Graph) -> Iterator[AlwaysFails]:
    """Yield each WAIT that seems to be intended as a delay."""
    for number, wait in graph.each(Wait):
        if _TIME.fullmatch(wait.message):
            message = "`WAIT` stops the run and calls the operator; it is not a delay"
            help = "leave `WAIT` out: the arm is at rest when a motion ends"
            yield AlwaysFails("wait-for-time", number, message, help)


def _undoes(graph: Graph) -> Iterator[AlwaysFails]:
    """Yield the stages that are undone unconditionally."""
    steps = graph.steps
    for number, _ in graph.each(Undo):
        stage = steps[number].stage
        here: int | None = next(first for first, step in enumerate(steps) if step.stage == stage)
        seen: set[int] = set()
        while here is not None and here != number and here not in seen and not steps[here].operation.branches:
            seen.add(here)
            here = steps[here].next
        if here == number:
            message = "the stage is always undone, even without an error"
            help = "before the `UNDO`, test for an error with `SKIPE` or `SKIPN`"
            yield AlwaysFails("always-undone", number, message, help)
