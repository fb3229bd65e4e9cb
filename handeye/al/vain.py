"""Stops and checks that come out in one way only, whatever the arm meets."""

import math
from collections.abc import Iterator
from dataclasses import dataclass
from typing import Final

from handeye.al.graph import Graph
from handeye.plan import program as op
from handeye.units import INCH

LEAST: Final = 1e-6
"""m by which a figure has to be off before anything is said of it."""


@dataclass(frozen=True, slots=True, kw_only=True)
class Vain:
    """A step that is in vain."""

    code: str
    step: int
    message: str
    help: str
    cause: int | None = None
    """The step that makes it so."""


def in_vain(graph: Graph) -> Iterator[Vain]:
    """The steps of a program that never do what they are for, or always raise an error."""
    yield from _stops(graph)
    yield from _grasps(graph)
    yield from _travels(graph)


def _stops(graph: Graph) -> Iterator[Vain]:
    for number in graph.which(op.Change):
        change = graph.steps[number].operation
        assert isinstance(change, op.Change)
        stop = change.stop
        if stop is None or stop.force is None or stop.moment is not None:
            continue
        (x, y, z), (f, g, h) = change.displacement, stop.force
        if x * f + y * g + z * h < 0:
            yield Vain(
                code="stop-away-from-motion",
                step=number,
                message="the hand moves away from what its `STOP` would have it press on",
                help="the vector of a `STOP` is the force of the hand: let it point where the hand goes",
            )


def _grasps(graph: Graph) -> Iterator[Vain]:
    """Grasps of more than the hand was opened to."""
    for number in graph.which(op.Close, op.Center):
        grasp = graph.steps[number].operation
        assert isinstance(grasp, op.Close | op.Center)
        before = graph.last(number, op.Open, op.Close, op.Center)
        opened = [o.gap for n in before if isinstance(o := graph.steps[n].operation, op.Open)]
        if before and len(opened) == len(before) and max(opened) < grasp.minimum - LEAST:
            yield Vain(
                code="opened-too-little",
                step=number,
                message=f"at least {grasp.minimum / INCH:g} in are to be grasped, and the hand is open by "
                f"{max(opened) / INCH:g} in",
                help="it would always raise error 2",
                cause=max(before),
            )


def _travels(graph: Graph) -> Iterator[Vain]:
    """Checks for a longer way than the motion before goes."""
    for number in graph.which(op.Travel):
        travel = graph.steps[number].operation
        assert isinstance(travel, op.Travel)
        before = graph.last(number, op.Change)
        ways = [
            math.hypot(*o.displacement)
            for n in before
            if isinstance(o := graph.steps[n].operation, op.Change)
        ]
        if ways and max(ways) < travel.minimum - LEAST:
            yield Vain(
                code="travel-too-long",
                step=number,
                message=f"at least {travel.minimum / INCH:g} in are asked for, and the motion goes "
                f"{max(ways) / INCH:g} in at most",
                help="it would always raise error 8",
                cause=max(before),
            )
