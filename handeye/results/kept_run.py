"""Reads the result of a run, or its progress so far, from the run's folder. The folder is not changed."""

from collections.abc import Sequence
from dataclasses import dataclass
from pathlib import Path

from msgspec import UNSET

from handeye.core.diagnostics import quoted
from handeye.core.errors import BadFile, InvalidInput
from handeye.core.files import read_whole
from handeye.planfile.store import is_plan_of
from handeye.program.diagnosis.cause_text import call_sentence
from handeye.program.events import (
    AnyEvent,
    OperatorCalled,
    PanicStopped,
    RunFinished,
    RunStarted,
    StageFinished,
    StageStarted,
)
from handeye.results.result import Result, read_result
from handeye.results.summary import camera_report, interventions, stage_times, timing, warnings
from handeye.runs.checkpoint_store import CheckpointStore
from handeye.runs.folder import CHECKPOINTS, EVENTS, HOST, PLAN, RESULT, check_holds_run
from handeye.runs.host_seconds import HostSeconds, read_host_seconds
from handeye.runs.parts import deciding
from handeye.runs.snapshot import Checkpoint
from handeye.runs.systems import system_named
from handeye.trace.eventlist import effective, read_events


@dataclass(frozen=True, slots=True, kw_only=True)
class KeptRun:
    """A run as recorded in its folder."""

    result: Result
    faults: tuple[str, ...] = ()
    left: bool = True


def kept_run(path: Path) -> KeptRun:
    """Read a run from its folder. Raises InvalidInput if the folder cannot be read, or if the run has not
    begun."""
    check_holds_run(path)
    faults = []
    if (path / RESULT).exists():
        result = read_result(path / RESULT)
        if _belongs(result, _readable_events(path)):
            return KeptRun(result=result)
        faults.append(
            f"{path / RESULT} belongs to another run, of the program {quoted(result.program)} in the world of "
            f"{result.world}"
        )
    if not (path / EVENTS).exists() and not (path / PLAN).exists():
        raise BadFile(f"the run in {path} cannot be shown: its {PLAN} is missing")
    events = effective(read_events(path / EVENTS, growing=True)) if (path / EVENTS).exists() else []
    if not events:
        raise BadFile(f"the run in {path} has not begun")
    return _so_far(path, events, faults)


def _readable_events(path: Path) -> list[AnyEvent]:
    """Return the events in the folder of a run; the list is empty if the events cannot be read."""
    try:
        return effective(read_events(path / EVENTS, growing=True))
    except InvalidInput:
        return []


def _belongs(result: Result, events: Sequence[AnyEvent]) -> bool:
    """Return True if `result` and `events` have the same program, task and world, so that they can belong to the same
    run.
    """
    begun = next((event for event in events if isinstance(event, RunStarted)), None)
    return begun is None or (
        (result.program, result.task, result.world, result.seed)
        == (begun.program, begun.task, begun.world, begun.world.seed)
    )


def has_ended(path: Path, newest: Checkpoint, *, judged: bool) -> bool:
    """Return True if the run in a folder has ended and its result exists. If `judged` is True, the result must also
    contain the referee's verdict.

    Args:
        newest: the newest checkpoint in the folder.
    """
    if not newest.ended or not (path / RESULT).exists():
        return False
    try:
        result = read_result(path / RESULT)
    except InvalidInput:  # the result is made again
        return False
    own = _belongs(result, newest.events)
    told = result.assembled is not None or result.apart is not UNSET
    return own and result.completed and (told or not judged)


def _so_far(path: Path, events: Sequence[AnyEvent], faults: Sequence[str]) -> KeptRun:
    """Make the record of a run that has no result, from the run's events. `faults` are the flaws already found in the
    folder.
    """
    begun, last = events[0], events[-1]
    if not isinstance(begun, RunStarted):
        raise BadFile(f"{path / EVENTS} does not begin with the start of a run")
    kind, data = system_named(begun.system), read_whole(path / PLAN)
    plan = kind.decode(data, str(path / PLAN))
    if not is_plan_of(begun, kind.encode(plan)):
        raise BadFile(f"{path / PLAN} is not the plan of this run")
    listing = kind.listing(plan)
    stages = {event.stage for event in events if isinstance(event, StageStarted | StageFinished)}
    if not stages <= set(listing.stages):
        raise BadFile(f"{path / EVENTS} has stages that are not in the plan next to it")
    host, unread = _host(path)
    checkpoint, damaged = CheckpointStore(path / CHECKPOINTS).newest()
    state = None if checkpoint is None or checkpoint.snapshot is None else checkpoint.snapshot.state
    calibration = None if state is None else system_named(begun.system).calibration(state)
    call = _call(events)
    turn = next((e for e in reversed(events) if isinstance(e, StageStarted | StageFinished)), None)
    done = turn is None or (isinstance(turn, StageFinished) and turn.status != "stopped")
    result = Result(
        assembled=None,
        completed=isinstance(last, RunFinished) and last.completed,
        paused=not isinstance(last, RunFinished),
        stopped_at=None if done or turn is None else turn.stage,
        error=None if call is None else call.error,
        message=_message(events, call),
        interventions=tuple(interventions(events)),
        warnings=tuple(warnings(events)),
        stages=stage_times(listing.stages, events),
        timing=timing(events, last.time, host),
        referee={},
        task=begun.task,
        program=begun.program,
        seed=begun.world.seed,
        world=begun.world,
        camera=camera_report(begun.camera, calibration),
        versions=begun.versions,
        replaced=deciding(begun.own_parts) or UNSET,
        without=begun.without,
    )
    return KeptRun(result=result, faults=(*faults, *unread, *damaged), left=False)


def _host(path: Path) -> tuple[HostSeconds, list[str]]:
    """Return the recorded host time of a run, and the flaws that were found in the recording of the host time."""
    try:
        return read_host_seconds(path / HOST) or HostSeconds(), []
    except InvalidInput as fault:
        return HostSeconds(), [str(fault)]


def _call(events: Sequence[AnyEvent]) -> OperatorCalled | None:
    """Return the call to the operator at which a run has stopped, or None if the run has not stopped at a call."""
    standing = [event for event in events if not isinstance(event, StageFinished | RunFinished)]
    return standing[-1] if standing and isinstance(standing[-1], OperatorCalled) else None


def _message(events: Sequence[AnyEvent], call: OperatorCalled | None) -> str:
    """Describe the state of a run without a result, in a sentence without a full stop."""
    last = events[-1]
    when = f"at {last.time:.1f} s"
    if call is not None:
        return call_sentence(call.message, call.error, call.cause)
    if isinstance(last, RunFinished):
        return "the run has ended without a result"
    if isinstance(last, PanicStopped):
        return f"stopped by the panic button {when}"
    return f"running or interrupted {when}"
