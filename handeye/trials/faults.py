"""Executes runs with one fault each. The runs show whether the fault is noticed, in which stage, and whether the
message names it correctly."""

from collections import Counter
from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import Annotated, Final, Literal

import msgspec

from handeye.core.faults import Catalogue, ExpectedDetection, Fault, FaultKind
from handeye.core.plain_text import counted
from handeye.core.record import Record
from handeye.core.variation import WorldSpec
from handeye.execution.servo import ServoPeriod
from handeye.planfile.plan import Plan
from handeye.program.events import AnyEvent, StageStarted, StepStarted
from handeye.results.result import Result
from handeye.runs.observer import Observer
from handeye.runs.runner import Runner
from handeye.runs.setup import Setup
from handeye.runs.snapshot import Checkpoint
from handeye.tasks import task
from handeye.trials.assembly import brakes_hold, run_on
from handeye.trials.sound_run import sound_run, with_faults
from handeye.trials.sweep import Case, Sweep, TrialRow

Outcome = Literal["recovered", "stopped", "misnamed", "unnoticed", "unbraked", "silent"]
"""The outcome of a run with a fault.

- recovered: the work is right, and the program need not notice the fault
- stopped: by an error that names the fault, in a correct stage, and with the brakes on
- misnamed: stopped, but by another error or in another stage
- unnoticed: the work is right, but the fault should have been noticed
- unbraked: stopped, but the brakes were not on
- silent: the work is wrong, but the program reported success
"""

UNDETECTED: tuple[Outcome, ...] = ("unnoticed", "unbraked", "silent")


PANIC: Final = FaultKind(
    name="panic",
    meaning="A person presses the panic button while the arm moves. The option --fault does not accept the panic "
    "button; to press it in a run, press Ctrl-C.",
    usual_stage=4,
    expected=ExpectedDetection(calls=("stopped by the panic button; the brakes are set",)),
)
"""The panic button. It is listed here although it is not a fault of the cell."""


def with_panic(catalogue: Catalogue) -> Catalogue:
    """Return the faults of a task, with the panic button as a further fault."""
    return Catalogue(*catalogue.kinds.values(), PANIC, matrix=(*catalogue.matrix, PANIC.name))


SOON: Final = 120  # Servo periods of a stage, two seconds, after which the button is hit


class PanicInStage(Observer):
    """Presses the panic button once, a number of servo periods after a stage has begun."""

    def __init__(self, stage: int, periods: int = SOON) -> None:
        """Press the button `periods` servo periods after the stage with the index `stage` has begun."""
        self._stage, self._left = stage, periods
        self._runner: Runner | None = None
        self._under_way = self._hit = False

    def watching(self, runner: Runner) -> Sequence[Observer]:
        """Observe a run. Returns this object as the run's only observer."""
        self._runner = runner
        return [self]

    def down(self) -> bool:
        """Return True once: at the first poll after the time at which the button must be pressed."""
        hit = self._under_way and self._left <= 0 and not self._hit
        self._hit = self._hit or hit
        return hit

    def event(self, event: AnyEvent) -> None:
        if isinstance(event, StageStarted) and self._runner is not None:
            self._under_way = self._runner.listing.stages.index(event.stage) == self._stage

    def tick(self, period: ServoPeriod) -> None:
        self._left -= self._under_way


class FaultTrial(Record, frozen=True, kw_only=True):
    """The result of a run with one fault."""

    name: str  # The fault, as it would be typed
    outcome: Outcome
    stage: str | None  # Stage in which the run stopped; None: the run finished, or never began
    message: str  # The call to the operator, or the referee’s complaints
    error: int | None
    line: str | None  # Line of the script at which the run stopped within a stage
    exit_code: Annotated[int, msgspec.Meta(ge=0)]


class FaultRow(TrialRow, frozen=True, kw_only=True):
    """The trial of one fault. The row's condition is the fault."""

    tried: FaultTrial | None = None  # None: it did not finish

    @property
    def outcome(self) -> str:
        assert self.tried is not None
        return self.tried.outcome

    @property
    def stage(self) -> str:
        return "" if self.tried is None else self.tried.stage or ""

    @property
    def line(self) -> str | None:
        return None if self.tried is None else self.tried.line

    @property
    def detail(self) -> str:
        return super().detail if self.tried is None else self.tried.message


def chosen(catalogue: Catalogue, names: Sequence[str]) -> list[FaultKind]:
    """Return the faults that `names` selects. A name is the name of a fault or of a group of faults. If `names` is
    empty, return the faults that are tried by default: the faults of the task's matrix. Raises InvalidInput for an
    unknown name.
    """
    found = [kind for name in names or catalogue.matrix for kind in catalogue.select(name)]
    return list({kind.name: kind for kind in found}.values())


@dataclass(frozen=True, slots=True, kw_only=True)
class FaultWork:
    """Executes a plan once for each fault. The condition of a case is the fault as users type it."""

    plan: Plan
    world: WorldSpec  # World of every case, without its seed and fault
    faults: Mapping[str, Fault]
    camera: str
    sound: Path | None = None
    """Folder of the fault-free runs. If a fault begins after the first stage, its run starts from a checkpoint of a
    fault-free run. If the folder is None, every run starts at its beginning.
    """

    def __call__(self, case: Case) -> list[FaultRow]:
        """Execute a run with the fault, or press the panic button during a run."""
        fault = self.faults[case.condition]
        world = msgspec.structs.replace(self.world, seed=case.seed)
        catalogue = with_panic(task(self.plan.task).faults(world))
        if fault.name == PANIC.name:
            button = PanicInStage((fault.stage or 1) - 1)
            done = run_on(self._start(world, (), fault.stage), halt=button.down, observers=button.watching)
        else:
            done = run_on(self._start(world, (fault,), fault.stage))
        braked = brakes_hold(done.runner.arm_cell)
        tried = trial_of(fault, catalogue, done.result, done.runner.events, braked=braked)
        return [FaultRow(trial=case.trials[0], seed=case.seed, condition=case.condition, tried=tried)]

    def _start(self, world: WorldSpec, faults: tuple[Fault, ...], stage: int | None) -> Checkpoint:
        """Return the start of a run with `faults`. If `stage` is given and fault-free runs are stored, the run starts
        from the stored state before this stage, in which the faults begin. If not, the run starts from the beginning.
        """
        setup = Setup(plan=self.plan, world=world, camera=self.camera)
        if self.sound is None or stage is None:
            return Checkpoint(
                setup=msgspec.structs.replace(setup, world=msgspec.structs.replace(world, faults=faults))
            )
        return with_faults(sound_run(self.sound, setup, world).before(stage), faults)


def usual(
    catalogue: Catalogue, kinds: Sequence[FaultKind], stage: int | None, stages: int
) -> dict[str, Fault]:
    """Return the faults at their usual sizes. The keys are the faults as users type them. If a fault
    can begin during a run, it begins at the stage `stage` or, if `stage` is None, at the usual stage of the fault.
    `stages` is the number of stages of the program.
    """
    first = [None if kind.from_start else stage or min(kind.usual_stage or 0, stages) for kind in kinds]
    found = [kind.usual(each or None) for kind, each in zip(kinds, first, strict=True)]
    return {catalogue.written(fault): fault for fault in found}


def trial_of(
    fault: Fault, catalogue: Catalogue, result: Result, events: Sequence[AnyEvent], *, braked: bool
) -> FaultTrial:
    """Return the result of a run with a fault, computed from the result and the events of the run."""
    begun = [event for event in events if isinstance(event, StepStarted)]
    stopped = not result.completed and begun
    complaints = (check.told for check in result.referee.values() if check.refuses)
    return FaultTrial(
        name=catalogue.written(fault),
        outcome=outcome(catalogue.kind(fault.name).expected, result, braked=braked),
        stage=result.stopped_at,
        message="; ".join(complaints) if result.completed else result.message,
        error=result.error,
        line=begun[-1].place if stopped else None,
        exit_code=result.exit_code,
    )


def outcome(expected: ExpectedDetection, result: Result, *, braked: bool) -> Outcome:
    """Return the outcome of a run with a fault. `braked` is True if the brakes were on at the end."""
    if result.exit_code == 3:
        return "silent"
    if result.exit_code == 0:
        return "recovered" if expected.harmless else "unnoticed"
    if not braked:
        return "unbraked"
    return "stopped" if _named(expected, result) and _placed(expected, result) else "misnamed"


def _named(expected: ExpectedDetection, result: Result) -> bool:
    """Return True if a run was stopped by an error or call that names the fault correctly."""
    if result.error is not None:
        return result.error in expected.errors
    return expected.at_setup if result.stopped_at is None else expected.called(result.message)


def _placed(expected: ExpectedDetection, result: Result) -> bool:
    """Return True if the run stopped in one of the stages in which the fault is expected to be detected. Also return
    True if the run was not stopped, or if `expected` names no stages.
    """
    return not expected.stages or result.stopped_at is None or result.stopped_at in expected.stages


def _sentence(row: FaultRow) -> str:
    tried = row.tried
    if tried is None:
        return f"{row.condition:32}  {row.verdict:9}  {row.detail}"
    where = "" if tried.line is None else f"“{tried.stage}”, line {tried.line}: "
    number = "" if tried.error is None else f"error {tried.error}: "
    return f"{row.condition:32}  {tried.outcome:9}  {where}{number}{tried.message}".rstrip()


def _summary(rows: Sequence[FaultRow]) -> list[str]:
    counts = Counter(row.verdict for row in rows)
    undetected = sum(counts[each] for each in UNDETECTED)
    told = ", ".join(f"{count} {outcome}" for outcome, count in counts.most_common())
    return [f"{counted(len(rows), 'fault')}: {told}; {undetected} undetected"]


def _more(rows: Sequence[FaultRow]) -> dict[str, object]:
    tried = sorted((row.tried for row in rows if row.tried), key=lambda each: each.name)
    return {"undetected": sum(each.outcome in UNDETECTED for each in tried), "faults": tried}


FAULTS: Final = Sweep(
    kind="faults",
    row=FaultRow,
    outcomes={
        "recovered": "right", "stopped": "right", "misnamed": "wrong",
        "unnoticed": "silent", "unbraked": "silent", "silent": "silent",
    },
    success="recovered, or stopped with the right fault named",
    noun="fault",
    sentence=_sentence,
    summary=_summary,
    more=_more,
)  # fmt: skip
"""Sweep of runs of a plan, with one fault in each run."""
