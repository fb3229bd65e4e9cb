"""Invariants that hold after every schedule."""

from collections.abc import Iterator
from pathlib import Path
from typing import Final

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

HELD_FROM: Final = {
    "base": 3,
    "gasket": 5,
    "top": 7,
    "screws_depth": 8,
    "screws_place": 8,
    "screws_crossed": 8,
    "pins": 9,
}
"""By the first words of the referee's findings, the stages of the pump's program from whose end on they must hold."""


LAST: Final = 12
"""Number of the last stage, at whose end all must hold."""


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


def wrong(findings: Findings, stages: int) -> list[str]:
    """Findings that fail after a number of stages."""
    return [
        f"{name}: {finding.subject} {finding.value:.3g} {finding.unit}"
        for name, finding in findings.items()
        if not finding.ok and not finding.caution and stages >= _from(name)
    ]


def _from(name: str) -> int:
    """Number of the stage from whose end a finding must hold; by default the last."""
    return next((stage for words, stage in HELD_FROM.items() if name.startswith(words)), LAST)


def _bytes(folder: Path) -> bytes:
    return (folder / TRACE).read_bytes()


def _plain(snapshot: Snapshot) -> bytes:
    return msgspec.msgpack.encode(
        (snapshot.position, snapshot.happened, snapshot.cell, snapshot.state),
        enc_hook=lambda array: array.tobytes(),
    )
