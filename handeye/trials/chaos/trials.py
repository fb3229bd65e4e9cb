"""Executes schedules, and checks invariants after each. If a schedule fails, its elements are removed one by one. An
element is put back if the schedule no longer fails without it.
"""

import tempfile
from collections.abc import Callable, Iterable, Iterator, Mapping, Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import Final

import msgspec

from handeye.core.errors import InvalidInput
from handeye.core.record import Record
from handeye.core.variation import Level, WorldSpec
from handeye.judge.finding import Findings
from handeye.planfile.plan import Plan
from handeye.program.events import OperatorAnswered, StageFinished
from handeye.results.judging import findings_so_far
from handeye.results.result import Result
from handeye.runs.advance import StopCondition, advance
from handeye.runs.checkpoint_store import CheckpointStore
from handeye.runs.folder import CHECKPOINTS, EVENTS, RESULT, TRACE
from handeye.runs.runner import Runner
from handeye.runs.setup import Setup
from handeye.runs.snapshot import Checkpoint, Snapshot
from handeye.runs.systems import listing_of
from handeye.tasks import any_task
from handeye.tasks.interface import AnyTask, Task
from handeye.trace.eventlist import effective, read_events
from handeye.trace.reading import read_trace
from handeye.trials.chaos.carrying_out import ReachedPosition, ScheduleRun, ScheduleRunner
from handeye.trials.chaos.last_look import last_look
from handeye.trials.chaos.schedule import MOST_STEPS, Schedule, draw, parse_schedule
from handeye.trials.sound_run import SoundRun, sound_run, with_faults
from handeye.trials.sweep import Case, Sweep, TrialRow


def on_disk(carried: ScheduleRun) -> Iterator[str]:
    """Yield a sentence for each file on disk that is lost or invalid."""
    yield from carried.lost
    yield from CheckpointStore(carried.folder / CHECKPOINTS).damaged()
    try:
        if list(effective(read_events(carried.folder / EVENTS))) != carried.runner.events:
            yield "the events in the event list differ from those of the run"
        msgspec.json.decode((carried.folder / RESULT).read_bytes(), type=Result)
    except (InvalidInput, OSError, msgspec.DecodeError) as fault:
        yield str(fault)


def in_trace(carried: ScheduleRun) -> Iterator[str]:
    """Yield a sentence for each inconsistency in the trace."""
    try:
        trace = read_trace(carried.folder / TRACE)
    except InvalidInput as fault:
        yield str(fault)
        return
    if list(trace.events) != carried.runner.events:
        yield "the events in the trace differ from those of the run"
    if trace.head.world != carried.runner.setup.world:
        yield "the trace belongs to another world"


def after_resuming(carried: ScheduleRun, unbroken: ScheduleRun) -> Iterator[str]:
    """Yield the differences between an interrupted run and the same run without interruptions, one sentence
    each."""
    if carried.runner.events != unbroken.runner.events:
        yield "the events differ from those of the uninterrupted run"
    if _bytes(carried.folder) != _bytes(unbroken.folder):
        yield "the trace differs from that of the uninterrupted run"
    if _plain(carried.runner.history[-1]) != _plain(unbroken.runner.history[-1]):
        yield "the last state differs from that of the uninterrupted run"
    if carried.pause != unbroken.pause and carried.pause.kind != unbroken.pause.kind:
        kind = unbroken.pause.kind
        yield f"the run ended with {carried.pause.kind}; the uninterrupted run ended with {kind}"


def wrong(findings: Findings, done: int, stages: int, holds_from: Mapping[str, int]) -> Findings:
    """Return the findings that should hold after a number of stages of the program (`done`), but do not hold. All
    findings must hold after the last stage; `holds_from` names the findings that must already hold after an earlier
    stage.
    """
    return {
        name: finding
        for name, finding in findings.items()
        if finding.refuses
        and done >= next((stage for words, stage in holds_from.items() if name.startswith(words)), stages)
    }


def _bytes(folder: Path) -> bytes:
    return (folder / TRACE).read_bytes()


def _plain(snapshot: Snapshot) -> bytes:
    return msgspec.msgpack.encode(
        (snapshot.position, snapshot.happened, snapshot.cell, snapshot.state),
        enc_hook=lambda array: array.tobytes(),
    )


class EndOfStage(StopCondition, frozen=True, kw_only=True):
    """Pause when a stage ends and the run has done more than `after` steps."""

    after: int

    def met_before(self, runner: Runner) -> bool:
        return runner.between_stages and runner.position > self.after


class Violation(Record, frozen=True):
    """An invariant that does not hold."""

    invariant: str
    what: str

    def __str__(self) -> str:
        return f"{self.invariant}: {self.what}"


class ScheduleResult(Record, frozen=True, kw_only=True):
    """The result of executing a schedule."""

    schedule: str
    ended: str  # The kind of its last pause; `error`: an exception that should never occur
    broken: tuple[Violation, ...]
    unseen: tuple[Violation, ...] = ()
    """The program reported the pump as right, but these findings failed, and the program could not notice this. Either
    a scheduled fault spoiled the pump after the program had last looked at it, or the damage was too small to notice.
    """

    @property
    def names(self) -> frozenset[str]:
        """Names of the violated invariants."""
        return frozenset(each.invariant for each in self.broken)


def try_schedule(schedule: Schedule, sound: SoundRun) -> ScheduleResult:
    """Execute a schedule and check the invariants. Raises InvalidInput if a fault is unknown or the run cannot
    begin at the start of the schedule."""
    begun = sound.at(schedule.start)
    start = with_faults(begun, schedule.given(any_task(begun.setup.task).faults(begun.setup.world)))
    ended, broken, unseen = "error", list[Violation](), list[Violation]()
    with tempfile.TemporaryDirectory(prefix="handeye-chaos-") as name:
        try:
            unbroken = _carried(schedule, start, Path(name) / "unbroken", broken=False)
            ended = unbroken.pause.kind
            silent, late = _silent(schedule, unbroken, start)
            broken += [*_sound(unbroken), *_named("silent", silent)]
            unseen += _named("unseen", late)
            if schedule.breaks:
                carried = _carried(schedule, start, Path(name) / "broken", broken=True)
                broken += [*_sound(carried), *_named("resume", after_resuming(carried, unbroken))]
        except Exception as error:
            broken.append(Violation("error", f"{type(error).__name__}: {error}"))
    return ScheduleResult(
        schedule=str(schedule), ended=ended, broken=tuple(dict.fromkeys(broken)), unseen=tuple(unseen)
    )


def _carried(schedule: Schedule, start: Checkpoint, folder: Path, *, broken: bool) -> ScheduleRun:
    stops: list[StopCondition] = [EndOfStage(after=start.position)]
    stages = listing_of(start.setup).stages
    if schedule.steps is not None or len(stages) < 2:
        stops.append(ReachedPosition(position=start.position + (schedule.steps or MOST_STEPS)))
    return ScheduleRunner(schedule, start, folder).carry_out(stops, broken=broken)


def _named(invariant: str, sentences: Iterable[str]) -> Iterator[Violation]:
    return (Violation(invariant, sentence) for sentence in sentences)


def _sound(carried: ScheduleRun) -> Iterator[Violation]:
    """Yield violations of the invariants that hold for every run, whether it was stopped or not."""
    yield from _named("brakes", iter(carried.unbraked))
    yield from _named("trace", in_trace(carried))
    yield from _named("disk", on_disk(carried))


# -- silence ------------------------------------------------------------------------------------------


def _silent(schedule: Schedule, carried: ScheduleRun, start: Checkpoint) -> tuple[list[str], list[str]]:
    """Return two lists of sentences on failed findings, if the program considers the work right. The first list has
    the failures that the program should have noticed. The second list has the failures that faults of the schedule
    caused after the program's last look.

    A completed stage is judged by the findings that must hold from the end of this stage on. If such a finding
    fails, the run continues, because a later check of the program may notice the failure. The failure is silent only
    if the program ends with a wrong pump.
    """
    runner = carried.runner
    happened = runner.events[len(start.events) :]
    overruled = any(isinstance(event, OperatorAnswered) and event.choice != "retry" for event in happened)
    done = [e.stage for e in happened if isinstance(e, StageFinished) and e.status == "done"]
    if overruled or not done or not (runner.between_stages or carried.pause.kind == "end"):
        return [], []
    stages = len(runner.listing.stages)
    number = runner.listing.stages.index(done[-1]) + 1
    if carried.pause.kind != "end":
        if not wrong(findings_so_far(runner), number, stages, runner.task.holds_from):
            return [], []
        runner = Runner(runner.checkpoint())
        if advance(runner).kind != "end":
            return [], []
    failed = wrong(findings_so_far(runner), stages, stages, {})
    late = _late(failed, schedule, runner, start)
    told = {name: f"{name}: {each.subject} {each.value:.3g} {each.unit}" for name, each in failed.items()}
    return [told[name] for name in failed if name not in late], [
        told[name] for name in failed if name in late
    ]


def _late(failed: Findings, schedule: Schedule, runner: Runner, start: Checkpoint) -> set[str]:
    """Return the names of the findings that failed because faults of the schedule spoiled the work when the program no
    longer sensed it.
    """
    task, plan, world = runner.task, runner.setup.plan, runner.setup.world
    kinds = [task.faults(world).kind(fault.name) for fault in schedule.given(task.faults(world))]
    spoiled = [kind.spoils for kind in kinds if kind.spoils is not None]
    if not failed or not spoiled or not isinstance(task, Task) or not isinstance(plan, Plan):
        return set()
    look = last_look(plan.program, task.obligations(world))
    begun = start.events[-1].time if start.events else 0.0
    since = runner.events[len(start.events) :]
    return {name for name, each in failed.items() if look.passed(name, each, spoiled, since, begun)}


# -- shrinking ----------------------------------------------------------------------------------------


def shrunk(
    failing: ScheduleResult, schedule: Schedule, fails: Callable[[Schedule], ScheduleResult]
) -> tuple[Schedule, ScheduleResult]:
    """Reduce a failing schedule. Each element is removed in turn, and put back if the schedule no longer fails without
    it. Returns the reduced schedule and its result.
    """
    for fewer in schedule.without():
        tried = fails(fewer)
        if tried.names & failing.names:
            return shrunk(tried, fewer, fails)
    return schedule, failing


LEVELS: Final[tuple[Level, ...]] = ("nominal", "low", "high")


class ChaosRow(TrialRow, frozen=True, kw_only=True):
    """The trial of one schedule. The row's condition is the schedule."""

    drawn: ScheduleResult | None = None  # Its result; None: it did not finish
    shrunk: ScheduleResult | None = None
    """The same trial with the shortest failing schedule that was found; None if the trial
    does not fail.
    """

    @property
    def outcome(self) -> str:
        if self.drawn is None or self.drawn.broken:
            return "did not hold"
        return "unseen" if self.drawn.unseen else "held"

    @property
    def detail(self) -> str:
        if self.shrunk is not None:
            return "; ".join(map(str, self.shrunk.broken))
        return super().detail if self.drawn is None else "; ".join(map(str, self.drawn.unseen))


@dataclass(frozen=True, slots=True, kw_only=True)
class ChaosWork:
    """Executes schedules. Each schedule starts from the fault-free run of its world. A folder keeps these runs."""

    setup: Setup  # The setup of the runs without their worlds
    folder: Path

    def __call__(self, case: Case) -> list[ChaosRow]:
        """Execute a schedule. If the schedule fails, reduce it as far as possible while it still fails."""
        schedule = parse_schedule(case.condition)
        sound = sound_run(self.folder, self.setup, WorldSpec(seed=schedule.seed, level=schedule.level))
        drawn = try_schedule(schedule, sound)
        least = shrunk(drawn, schedule, lambda fewer: try_schedule(fewer, sound))[1] if drawn.broken else None
        return [
            ChaosRow(
                trial=case.trials[0], seed=case.seed, condition=case.condition, drawn=drawn, shrunk=least
            )
        ]


def worlds(seed: int, count: int, *, levels: bool = True) -> list[WorldSpec]:
    """Return the worlds for the schedules of a seed: the world of this seed and the worlds of the seeds that follow.
    If `levels` is True, successive worlds have different levels of error.
    """
    chosen = LEVELS if levels else LEVELS[:1]
    return [WorldSpec(seed=seed + number, level=chosen[number % len(chosen)]) for number in range(count)]


def schedules(seed: int, count: int, runs: Sequence[SoundRun], work: AnyTask) -> Iterator[Schedule]:
    """Yield the first `count` schedules in the series of a seed."""
    for number in range(count):
        yield draw(
            number,
            seed,
            [(run.world.seed, run.world.level) for run in runs],
            [run.starts for run in runs],
            work.faults(runs[0].world),
            [run.stages for run in runs],
        )


def _sentence(row: ChaosRow) -> str:
    """Describe the violations of a failing schedule, and give the command that reproduces them."""
    if row.drawn is None:
        return f"{row.condition}: {row.detail}"
    if row.shrunk is None:
        told = "\n".join(map(str, row.drawn.unseen))
        return f'{told}\n  handeye trials chaos --schedule "{row.condition}"' if told else ""
    whole = "" if row.shrunk.schedule == row.condition else f"\n  shrunk from: {row.condition}"
    told = "\n".join(map(str, row.shrunk.broken))
    return f'{told}\n  handeye trials chaos --schedule "{row.shrunk.schedule}"{whole}'


def _more(rows: Sequence[ChaosRow]) -> dict[str, object]:
    failing = sorted((row for row in rows if row.drawn and row.drawn.broken), key=lambda row: row.condition)
    return {
        "broken": len(failing),
        "unseen": sum(row.outcome == "unseen" for row in rows),
        "failing": [{"drawn": row.drawn, "shrunk": row.shrunk} for row in failing],
    }


CHAOS: Final = Sweep(
    kind="chaos",
    row=ChaosRow,
    outcomes={"held": "right", "unseen": "wrong", "did not hold": "silent"},
    success="held",
    noun="schedule",
    sentence=_sentence,
    more=_more,
)
