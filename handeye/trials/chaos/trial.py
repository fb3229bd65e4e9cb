"""One schedule tried: carried out with its interruptions and without, and what of it is broken."""

import tempfile
from collections.abc import Callable, Iterator
from pathlib import Path

from handeye.core.record import Record
from handeye.program.events import OperatorAnswered, StageFinished
from handeye.results.judging import findings_so_far
from handeye.runs.advance import StopCondition, advance
from handeye.runs.runner import Runner
from handeye.runs.snapshot import Checkpoint
from handeye.runs.systems import listing_of
from handeye.tasks import any_task
from handeye.trials.chaos.carrying_out import ReachedPosition, ScheduleRun, ScheduleRunner
from handeye.trials.chaos.invariants import after_resuming, in_trace, on_disk, wrong
from handeye.trials.chaos.schedule import MOST_STEPS, Schedule
from handeye.trials.chaos.sound_run import SoundRun, with_faults


class EndOfStage(StopCondition, frozen=True, kw_only=True):
    """Pause between two stages, past a number of steps."""

    after: int

    def met_before(self, runner: Runner) -> bool:
        return runner.between_stages and runner.position > self.after


class Violation(Record, frozen=True):
    """An invariant that did not hold."""

    invariant: str
    what: str
    """What was violated, a sentence."""

    def __str__(self) -> str:
        return f"{self.invariant}: {self.what}"


class ScheduleResult(Record, frozen=True, kw_only=True):
    """Result of a schedule."""

    schedule: str
    ended: str
    """The kind of its last pause; `error`: it raised what nothing should."""
    broken: tuple[Violation, ...]
    """None if all is well."""

    @property
    def names(self) -> frozenset[str]:
        """Names of the invariants that did not hold."""
        return frozenset(each.invariant for each in self.broken)


def try_schedule(schedule: Schedule, sound: SoundRun) -> ScheduleResult:
    """Carry a schedule out, and check what must hold.

    Raises:
        InvalidInput: it cannot be carried out: there is no such fault, or no such state to begin with.
    """
    begun = sound.at(schedule.start)
    start = with_faults(begun, schedule.given(any_task(begun.setup.task).faults(schedule.seed)))
    ended, broken = "error", list[Violation]()
    with tempfile.TemporaryDirectory(prefix="handeye-chaos-") as name:
        try:
            unbroken = _carried(schedule, start, Path(name) / "unbroken", broken=False)
            ended = unbroken.pause.kind
            broken += [*_sound(unbroken), *_named("silent", _silent(unbroken, start))]
            if schedule.breaks:
                carried = _carried(schedule, start, Path(name) / "broken", broken=True)
                broken += [*_sound(carried), *_named("resume", after_resuming(carried, unbroken))]
        except Exception as error:
            broken.append(Violation("error", f"{type(error).__name__}: {error}"))
    return ScheduleResult(schedule=str(schedule), ended=ended, broken=tuple(dict.fromkeys(broken)))


def _carried(schedule: Schedule, start: Checkpoint, folder: Path, *, broken: bool) -> ScheduleRun:
    stops: list[StopCondition] = [EndOfStage(after=start.position)]
    stages = listing_of(start.setup).stages
    if schedule.steps is not None or len(stages) < 2:
        stops.append(ReachedPosition(position=start.position + (schedule.steps or MOST_STEPS)))
    return ScheduleRunner(schedule, start, folder).carry_out(stops, broken=broken)


def _named(invariant: str, sentences: Iterator[str]) -> Iterator[Violation]:
    return (Violation(invariant, sentence) for sentence in sentences)


def _sound(carried: ScheduleRun) -> Iterator[Violation]:
    """Violations of what holds for every run, stopped or not."""
    yield from _named("brakes", iter(carried.unbraked))
    yield from _named("trace", in_trace(carried))
    yield from _named("disk", on_disk(carried))


# -- silence ------------------------------------------------------------------------------------------


def _silent(carried: ScheduleRun, start: Checkpoint) -> Iterator[str]:
    """Failed findings on work that the program takes for right.

    A stage that the program has done is judged by those findings that must hold from its end on. If one does not, the
    program goes on, for a later check may notice that: it is silent only if it comes to its end with a wrong pump.
    """
    happened = carried.runner.events[len(start.events) :]
    overruled = any(isinstance(event, OperatorAnswered) and event.choice != "retry" for event in happened)
    done = [e.stage for e in happened if isinstance(e, StageFinished) and e.status == "done"]
    if overruled or not done or not (carried.runner.between_stages or carried.pause.kind == "end"):
        return
    stages = len(carried.runner.listing.stages)
    number = carried.runner.listing.stages.index(done[-1]) + 1
    if carried.pause.kind == "end":
        yield from wrong(findings_so_far(carried.runner), stages, stages, {})
    elif wrong(findings_so_far(carried.runner), number, stages, carried.runner.task.holds_from):
        runner = Runner(carried.runner.checkpoint())
        if advance(runner).kind == "end":
            yield from wrong(findings_so_far(runner), stages, stages, {})


# -- shrinking ----------------------------------------------------------------------------------------


def shrunk(
    failing: ScheduleResult, schedule: Schedule, fails: Callable[[Schedule], ScheduleResult]
) -> tuple[Schedule, ScheduleResult]:
    """Shrink a failing schedule by removing one event at a time while it still fails."""
    for fewer in schedule.without():
        tried = fails(fewer)
        if tried.names & failing.names:
            return shrunk(tried, fewer, fails)
    return schedule, failing
