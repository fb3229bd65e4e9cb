"""Invariants that hold after every schedule."""

from collections.abc import Iterator, Mapping
from pathlib import Path

import msgspec

from handeye.core.errors import InvalidInput
from handeye.judge.finding import Findings
from handeye.results.result import Result
from handeye.runs.checkpoint_store import CheckpointStore
from handeye.runs.folder import CHECKPOINTS, EVENTS, RESULT, TRACE
from handeye.runs.snapshot import Snapshot
from handeye.trace.eventlist import effective, read_events
from handeye.trace.reading import read_trace
from handeye.trials.chaos.carrying_out import ScheduleRun


def on_disk(carried: ScheduleRun) -> Iterator[str]:
    """Sentences on what is lost or unsound on disk."""
    yield from carried.lost
    yield from CheckpointStore(carried.folder / CHECKPOINTS).damaged()
    try:
        if list(effective(read_events(carried.folder / EVENTS))) != carried.runner.events:
            yield "the event list is not what happened"
        msgspec.json.decode((carried.folder / RESULT).read_bytes(), type=Result)
    except (InvalidInput, OSError, msgspec.DecodeError) as fault:
        yield str(fault)


def in_trace(carried: ScheduleRun) -> Iterator[str]:
    """Sentences on what is unsound in the trace."""
    try:
        trace = read_trace(carried.folder / TRACE)
    except InvalidInput as fault:
        yield str(fault)
        return
    if list(trace.events) != carried.runner.events:
        yield "the trace does not tell what happened"
    if trace.head.world != carried.runner.setup.world:
        yield "the trace is of another world"


def after_resuming(carried: ScheduleRun, unbroken: ScheduleRun) -> Iterator[str]:
    """Differences of a run that was interrupted from the same without interruptions, a sentence each."""
    if carried.runner.events != unbroken.runner.events:
        yield "other events than without interruptions"
    if _bytes(carried.folder) != _bytes(unbroken.folder):
        yield "another trace than without interruptions"
    if _plain(carried.runner.history[-1]) != _plain(unbroken.runner.history[-1]):
        yield "another state than without interruptions"
    if carried.pause != unbroken.pause and carried.pause.kind != unbroken.pause.kind:
        yield f"it ended with {carried.pause.kind}, and without interruptions with {unbroken.pause.kind}"


def wrong(findings: Findings, done: int, stages: int, holds_from: Mapping[str, int]) -> list[str]:
    """Findings that fail although they must hold once a number of stages is done.

    Args:
        stages: stages of the program, after which all must hold.
        holds_from: stages after which a finding must hold already, by how its name begins.
    """
    return [
        f"{name}: {finding.subject} {finding.value:.3g} {finding.unit}"
        for name, finding in findings.items()
        if not finding.ok
        and not finding.caution
        and done >= next((stage for words, stage in holds_from.items() if name.startswith(words)), stages)
    ]


def _bytes(folder: Path) -> bytes:
    return (folder / TRACE).read_bytes()


def _plain(snapshot: Snapshot) -> bytes:
    return msgspec.msgpack.encode(
        (snapshot.position, snapshot.happened, snapshot.cell, snapshot.state),
        enc_hook=lambda array: array.tobytes(),
    )
