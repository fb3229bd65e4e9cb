"""The first thing that went otherwise in one of two runs: the step, the quantity, and both values."""

from collections.abc import Iterator
from dataclasses import dataclass
from itertools import zip_longest

import msgspec
from google.protobuf.message import DecodeError

from handeye.comparison.otherwise import otherwise
from handeye.comparison.pairing import TwoRuns
from handeye.comparison.place import Place, place_of
from handeye.comparison.stretches import Stretch, stretches
from handeye.core.errors import BadFile
from handeye.core.plain_text import one_line
from handeye.inspection.difference import step_changes
from handeye.program.events import AnyEvent, StepStarted
from handeye.report.recorded import Recorded
from handeye.tasks import known
from handeye.trace.quantities import QuantityDifference


@dataclass(frozen=True, slots=True, kw_only=True)
class First:
    """The first thing that went otherwise."""

    a: Place | None
    """The step under way; None: before the first one, or the run has ended there."""
    b: Place | None
    """That of the second run."""
    period: int | None = None
    """The servo period of the step, from 1; None: it is of none."""
    differing: QuantityDifference
    """The quantity, and both values."""
    next: tuple[AnyEvent | None, AnyEvent | None] = (None, None)
    """What happened next, where that is what differs; None: the step went on, or the run ended."""

    @property
    def place(self) -> Place | None:
        """The step under way in the first run; in the second, where the first has ended."""
        return self.a or self.b


def first_difference(runs: TwoRuns) -> First | None:
    """The first thing in which two runs differ, step beside step; None: nothing that was recorded of both.

    Times count from the beginning of each step: a run that was late in one step is not late in all that follow.

    Raises:
        InvalidInput: a message of a trace is not what its channel says.
    """
    try:
        for a, b in zip_longest(*_stretches(runs)):
            found = _other_step(runs, a, b) or _recorded_otherwise(runs, a, b)
            if found is not None:
                return found
    except (DecodeError, msgspec.DecodeError, KeyError, ValueError):
        names = " or ".join(run.trace.name for run in (runs.a, runs.b))
        raise BadFile(f"a message in {names} cannot be understood") from None
    return None


def _stretches(runs: TwoRuns) -> tuple[Iterator[Stretch], Iterator[Stretch]]:
    """The stretches of both traces, with what both hold."""
    unseen = max(run.trace.unseen for run in (runs.a, runs.b))
    a, b = (stretches(run.trace, unseen=unseen, periods=not runs.thinned) for run in (runs.a, runs.b))
    return a, b


def _other_step(runs: TwoRuns, a: Stretch | None, b: Stretch | None) -> First | None:
    """How the step that one run does is not that of the other; None: it is."""
    here, there = (None if stretch is None else stretch.started for stretch in (a, b))
    if here is None and there is None:  # before the first step
        return None
    places = _place(runs.a, here), _place(runs.b, there)
    if here is None or there is None or not runs.are_beside(here.step, there.step):
        one, other = (None if place is None else one_line(place.text) for place in places)
        return First(
            a=places[0], b=places[1], differing=QuantityDifference(quantity=("step",), a=one, b=other)
        )
    steps = runs.a.program.steps[here.step], runs.b.program.steps[there.step]
    for what, was, now in step_changes(*steps):
        return First(a=places[0], b=places[1], differing=QuantityDifference(quantity=(what,), a=was, b=now))
    return None


def _place(run: Recorded, started: StepStarted | None) -> Place | None:
    return None if started is None else place_of(run, started)


def _recorded_otherwise(runs: TwoRuns, a: Stretch | None, b: Stretch | None) -> First | None:
    """What was recorded otherwise of the same step; None: nothing was."""
    assert a is not None
    assert b is not None
    task = known(runs.a.trace.head.task)
    found = otherwise(a, b, None if task is None else task.arm)
    if found is None:
        return None
    return First(
        a=_place(runs.a, a.started),
        b=_place(runs.b, b.started),
        period=found.period,
        differing=found.differing,
        next=found.next,
    )
