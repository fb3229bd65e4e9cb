"""Runs with one fault each: where it is noticed, by which error, and whether that is its right name."""

from collections import Counter
from collections.abc import Iterator, Sequence
from functools import partial
from typing import Annotated, Final, Literal

import msgspec

from handeye.core.faults import Catalogue, Expected, Fault, FaultKind
from handeye.core.record import Record
from handeye.core.variation import WorldSpec
from handeye.planfile.plan import Plan
from handeye.program.events import AnyEvent, StepStarted
from handeye.results.result import Result
from handeye.tasks import task
from handeye.trials.assembly import run_plan
from handeye.trials.brakes import brakes_hold
from handeye.trials.panic import PanicInStage
from handeye.trials.seeds import in_processes

Outcome = Literal["recovered", "stopped", "misnamed", "unnoticed", "unbraked", "silent"]
"""How a run with a fault ended: with a right pump, as it may; stopped, with brakes on, by an error that names the
fault, in a stage where that is right; likewise by another one, or in another stage; with a right pump, although the
fault should have been noticed; stopped, and the brakes were not on; with a wrong pump that the program took for right.
"""

UNDETECTED: tuple[Outcome, ...] = ("unnoticed", "unbraked", "silent")
"""Outcomes that a fault must never have."""


PANIC: Final = FaultKind(
    name="panic",
    meaning="Somebody hits the panic button while the arm moves. A run is given it by Ctrl-C, and not by --fault.",
    usual_stage=4,
    expected=Expected(calls=("stopped by the panic button; the brakes are set",)),
)
"""No fault of a cell: the button of whoever stands beside it."""


def with_panic(catalogue: Catalogue) -> Catalogue:
    """The faults of a task, and the panic button."""
    return Catalogue(*catalogue.kinds.values(), PANIC, matrix=(*catalogue.matrix, PANIC.name))


class FaultTrial(Record, frozen=True, kw_only=True):
    """What a run with one fault came to."""

    name: str
    """The fault, as it would be typed."""
    outcome: Outcome
    stage: str | None
    """In which it stopped; None: it came to its end, or did not begin."""
    message: str
    """What the operator was told, or what the referee found wrong."""
    error: int | None
    line: str | None
    """Of the script, where it stopped in a stage."""
    exit_code: Annotated[int, msgspec.Meta(ge=0)]


class FaultMatrix(Record, frozen=True, kw_only=True):
    """What runs with one fault each came to."""

    n: int
    undetected: int
    faults: tuple[FaultTrial, ...]


def matrix_of(trials: Sequence[FaultTrial]) -> FaultMatrix:
    """Trials in the order of their names."""
    found = tuple(sorted(trials, key=lambda trial: trial.name))
    undetected = sum(trial.outcome in UNDETECTED for trial in found)
    return FaultMatrix(n=len(found), undetected=undetected, faults=found)


def chosen(catalogue: Catalogue, names: Sequence[str]) -> list[FaultKind]:
    """The faults of some names and groups; those of the matrix, if there are none.

    Raises:
        InvalidInput: there is neither a fault nor a group of a name.
    """
    found = [kind for name in names or catalogue.matrix for kind in catalogue.select(name)]
    return list({kind.name: kind for kind in found}.values())


def try_faults(
    plan: Plan, world: WorldSpec, kinds: Sequence[FaultKind], *, stage: int | None, camera: str, workers: int
) -> Iterator[FaultTrial]:
    """Carry a plan out once with each fault at its usual size, in the order that runs end.

    Args:
        stage: number of the stage with which the faults set in, but for those that must be there from the beginning;
            None: all are.
    """
    given = [kind.usual(None if kind.from_start else stage) for kind in kinds]
    worlds = [msgspec.structs.replace(world, faults=(fault,)) for fault in given]
    yield from in_processes(partial(_tried, plan, camera), worlds, workers)


def _tried(plan: Plan, camera: str, world: WorldSpec) -> FaultTrial:
    """What a run in a world with one fault comes to, or one in which somebody hits the panic button."""
    (fault,), catalogue = world.faults, with_panic(task(plan.task).faults(world.seed))
    if fault.name == PANIC.name:
        button = PanicInStage((fault.stage or 1) - 1)
        sound = msgspec.structs.replace(world, faults=())
        done = run_plan(plan, world=sound, camera=camera, halt=button.down, observers=button.watching)
    else:
        done = run_plan(plan, world=world, camera=camera)
    braked = brakes_hold(done.runner.arm_cell)
    return trial_of(fault, catalogue, done.result, done.runner.events, braked=braked)


def trial_of(
    fault: Fault, catalogue: Catalogue, result: Result, events: Sequence[AnyEvent], *, braked: bool
) -> FaultTrial:
    """What a run with a fault came to, by its result and by what happened."""
    begun = [event for event in events if isinstance(event, StepStarted)]
    stopped = not result.completed and begun
    return FaultTrial(
        name=catalogue.written(fault),
        outcome=outcome(catalogue.kind(fault.name).expected, result, braked=braked),
        stage=result.stopped_at,
        message=_message(result),
        error=result.error,
        line=begun[-1].place if stopped else None,
        exit_code=result.exit_code,
    )


def _message(result: Result) -> str:
    """What the operator was told, or what the referee found wrong."""
    if result.completed:
        return "; ".join(check.told for check in result.referee.values() if check.refuses)
    return result.message


def outcome(expected: Expected, result: Result, *, braked: bool) -> Outcome:
    """How a run ended that should have ended as expected; `braked`: the brakes were on when it had."""
    if result.exit_code == 3:
        return "silent"
    if result.exit_code == 0:
        return "recovered" if expected.harmless else "unnoticed"
    if not braked:
        return "unbraked"
    return "stopped" if _named(expected, result) and _placed(expected, result) else "misnamed"


def _named(expected: Expected, result: Result) -> bool:
    """See whether a run stopped by something that calls the fault by its right name."""
    if result.error is not None:
        return result.error in expected.errors
    return expected.at_setup if result.stopped_at is None else result.message in expected.calls


def _placed(expected: Expected, result: Result) -> bool:
    """See whether a run stopped where that name is the right one."""
    return not expected.stages or result.stopped_at is None or result.stopped_at in expected.stages


def counted_outcomes(trials: Sequence[FaultTrial]) -> str:
    """How many runs ended how, as a sentence."""
    counts = Counter(trial.outcome for trial in trials)
    return ", ".join(f"{count} {outcome}" for outcome, count in counts.most_common())
