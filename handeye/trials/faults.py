"""Runs with one fault each: where it is noticed, by which error, and whether that is its right name."""

from collections import Counter
from collections.abc import Iterator, Sequence
from functools import partial
from typing import Annotated, Literal

import msgspec

from handeye.events import AnyEvent, StepStarted
from handeye.faults import Catalogue, Expected, Fault, FaultKind
from handeye.planfile.plan import Plan
from handeye.record import Record
from handeye.report.result import Result
from handeye.tasks import task
from handeye.trials.assembly import run_plan
from handeye.trials.seeds import in_processes
from handeye.variation import WorldSpec

Verdict = Literal["noticed", "stopped", "harmless", "unnoticed", "silent"]
"""How a run with a fault ended: stopped by an error that names the fault; by another one; with a right pump, as it may;
with a right pump, although the fault should have been noticed; with a wrong pump that the program took for right."""

GOOD: tuple[Verdict, ...] = ("noticed", "stopped", "harmless")
"""Verdicts of runs that did not end as if nothing was broken."""


class FaultTrial(Record, frozen=True, kw_only=True):
    """What a run with one fault came to."""

    fault: str
    """As it would be typed."""
    verdict: Verdict
    exit_code: Annotated[int, msgspec.Meta(ge=0)]
    stage: str | None
    """In which it stopped; None: it came to its end, or did not begin."""
    line: str | None
    """Of the script, likewise."""
    error: int | None
    message: str
    """The program's words, or what the referee found wrong."""


def chosen(catalogue: Catalogue, names: Sequence[str]) -> list[FaultKind]:
    """The faults of some names and groups; all, if there are none.

    Raises:
        InvalidInput: there is neither a fault nor a group of a name.
    """
    if not names:
        return list(catalogue.kinds.values())
    found = [kind for name in names for kind in catalogue.select(name)]
    return list({kind.name: kind for kind in found}.values())


def try_faults(
    plan: Plan, world: WorldSpec, kinds: Sequence[FaultKind], *, stage: int | None, camera: str, jobs: int
) -> Iterator[FaultTrial]:
    """Carry a plan out once with each fault at its usual size, in the order that runs end.

    Args:
        stage: number of the stage with which the faults set in, but for those that must be there from the beginning;
            None: all are.
    """
    given = [kind.usual(None if kind.from_start else stage) for kind in kinds]
    worlds = [msgspec.structs.replace(world, faults=(fault,)) for fault in given]
    yield from in_processes(partial(_tried, plan, camera), worlds, jobs)


def _tried(plan: Plan, camera: str, world: WorldSpec) -> FaultTrial:
    """What a run in a world with one fault comes to."""
    (fault,), done = world.faults, run_plan(plan, world=world, camera=camera)
    return trial_of(fault, task(done.result.task).faults(world.seed), done.result, done.runner.events)


def trial_of(fault: Fault, catalogue: Catalogue, result: Result, events: Sequence[AnyEvent]) -> FaultTrial:
    """What a run with a fault came to, by its result and by what happened."""
    wrong = [check.sentence for check in result.referee.values() if not check.ok]
    begun = [event for event in events if isinstance(event, StepStarted)]
    stopped = not result.completed and begun
    return FaultTrial(
        fault=catalogue.told(fault),
        verdict=verdict(catalogue.kind(fault.name).expected, result),
        exit_code=result.exit_code,
        stage=result.stopped_at,
        line=begun[-1].place if stopped else None,
        error=result.error,
        message=result.message if not result.completed else "; ".join(wrong),
    )


def verdict(expected: Expected, result: Result) -> Verdict:
    """How a run ended that should have ended as expected."""
    if result.exit_code == 3:
        return "silent"
    if result.exit_code == 0:
        return "harmless" if expected.harmless else "unnoticed"
    return "noticed" if _named(expected, result) else "stopped"


def _named(expected: Expected, result: Result) -> bool:
    """See whether a run stopped by something that calls the fault by its right name."""
    if result.error is not None:
        return result.error in expected.errors
    return expected.at_setup if result.stopped_at is None else result.message in expected.calls


def counted_verdicts(trials: Sequence[FaultTrial]) -> str:
    """How many runs ended how, as a sentence."""
    counts = Counter(trial.verdict for trial in trials)
    return ", ".join(f"{count} {verdict}" for verdict, count in counts.most_common())
