"""Interrupts runs, resumes them, and compares them with an uninterrupted run."""

import random
import signal
import subprocess
import sys
import time
from collections.abc import Callable, Iterator, Sequence
from concurrent.futures import ThreadPoolExecutor, as_completed
from dataclasses import dataclass
from pathlib import Path
from typing import Final

import msgspec
import numpy as np

from handeye.core.errors import HandeyeError
from handeye.program.events import AnyEvent, PanicStopped, StageFinished, StageStarted
from handeye.runs.checkpoint_store import CheckpointStore
from handeye.runs.folder import CHECKPOINTS, EVENTS, TRACE
from handeye.runs.snapshot import Snapshot
from handeye.tasks import task
from handeye.trace.eventlist import effective, read_events
from handeye.trace.reading import read_trace

POLL: Final = 0.002
"""s between two checks of what a run has written."""
LIMIT: Final = 900.0
"""s after which a run counts as hanging."""


class TrialFailed(HandeyeError):
    """Raised if a run fails even without an interruption, so that there is nothing to compare with."""


@dataclass(frozen=True, slots=True, kw_only=True)
class Verdict:
    """The verdict on one trial."""

    name: str
    faults: tuple[str, ...]
    """Faults in words; empty if there are none."""


@dataclass(frozen=True, slots=True, kw_only=True)
class UnbrokenRun:
    """An uninterrupted run with which other runs are compared."""

    folder: Path
    seed: int
    world: tuple[str, ...]
    """The command-line options that select its world."""
    command: tuple[str, ...]
    """The words of the command that executes it, without its folder."""
    events: tuple[AnyEvent, ...]
    stages: tuple[str, ...]
    first: int = 0
    """Number of events that had already happened when it began, in the run that it continues."""

    @property
    def trace(self) -> bytes:
        """The bytes of the run's trace."""
        return (self.folder / TRACE).read_bytes()


def whole_run(folder: Path, seed: int, world: Sequence[str]) -> UnbrokenRun:
    """Execute the script of the task from beginning to end, without an interruption.

    Args:
        world: command-line options that select the world.

    Raises:
        TrialFailed: the referee does not accept the work.
    """
    return _unbroken(folder, seed, world, ("assemble", *world), f"seed {seed} is not assembled")


def whole_undo(whole: UnbrokenRun, folder: Path) -> UnbrokenRun:
    """Let the arm undo all the work of a run, without an interruption.

    Raises:
        TrialFailed: the referee finds that not everything is back in its place.
    """
    words = ("dismantle", str(whole.folder))
    what = f"the pump of seed {whole.seed} is not taken apart"
    return _unbroken(folder, whole.seed, whole.world, words, what, first=len(whole.events))


def _unbroken(
    folder: Path, seed: int, world: Sequence[str], command: tuple[str, ...], failed: str, *, first: int = 0
) -> UnbrokenRun:
    """Execute a command. `failed` begins the error message if its exit code is not 0."""
    done = handeye(*command, "--out", str(folder))
    if done.returncode != 0:
        raise TrialFailed(f"{failed} even without an interruption (exit {done.returncode})")
    events = tuple(effective(read_events(folder / EVENTS)))
    stages = tuple(event.stage for event in events if isinstance(event, StageStarted))
    return UnbrokenRun(
        folder=folder,
        seed=seed,
        world=tuple(world),
        command=command,
        events=events,
        stages=stages,
        first=first,
    )


def killed(whole: UnbrokenRun, folder: Path, jobs: int) -> Iterator[Verdict]:
    """Kill a run in the middle of each stage, resume it, and compare the traces byte for byte.

    A run that undoes another run is killed at ten evenly spaced moments instead.
    """
    if not whole.first:
        moments = [(stage, _middle(whole, stage)) for stage in whole.stages]
    else:
        lines = np.linspace(whole.first + 1, len(whole.events) - 4, 12).round().astype(int)[1:-1].tolist()
        moments = [(f"after event {line}", line) for line in lines]

    def one(number: int) -> Verdict:
        (name, line), place = moments[number], folder / f"killed-{number + 1}"
        process = _started(whole, place)
        _wait_for(place / EVENTS, line, process)
        process.kill()
        process.wait()
        return Verdict(name=name, faults=tuple(_resumed(whole, place)))

    yield from _each(one, range(len(moments)), jobs)


def interrupted(whole: UnbrokenRun, folder: Path, count: int, jobs: int) -> Iterator[Verdict]:
    """Press Ctrl-C at random moments of a run. Check the exit code, the brakes, and the resumed run."""
    moments = random.Random(whole.seed)  # noqa: S311 - moments, not secrets
    lines = range(whole.first + 1, len(whole.events) - 4)
    plans = [(n, moments.choice(lines), moments.uniform(0, 0.1)) for n in range(count)]

    def one(plan: tuple[int, int, float]) -> Verdict:
        number, line, later = plan
        place = folder / f"interrupted-{number + 1}"
        process = _started(whole, place)
        _wait_for(place / EVENTS, line, process)
        time.sleep(later)
        process.send_signal(signal.SIGINT)
        code = _ended(process)
        faults = [] if code == 130 else [f"exit code {code} instead of 130"]
        faults += _brakes(place)
        faults += _resumed(whole, place)
        return Verdict(name=f"after event {line}", faults=tuple(faults))

    yield from _each(one, plans, jobs)


def alone(whole: UnbrokenRun, folder: Path, jobs: int) -> Iterator[Verdict]:
    """Execute each stage separately from its checkpoint. It must end in the same state as in the whole run."""

    def one(number: int) -> Verdict:
        place = folder / f"alone-{number + 1}"
        done = handeye(
            "run", str(whole.folder / "plan.json"), *whole.world,
            "--stage", str(number + 1), "--checkpoints", str(whole.folder), "--out", str(place),
        )  # fmt: skip
        faults = [] if done.returncode == 0 else [f"exit code {done.returncode}"]
        mine, theirs = (_end(f, whole.stages, number) for f in (place, whole.folder))
        if mine is None or theirs is None:
            faults.append("there is no checkpoint of its end")
        elif not _same(mine, theirs):
            faults.append("it ends in a different state")
        return Verdict(name=whole.stages[number], faults=tuple(faults))

    yield from _each(one, range(len(whole.stages)), jobs)


def _each(
    one: Callable[..., Verdict], what: "range | list[tuple[int, int, float]]", jobs: int
) -> Iterator[Verdict]:
    with ThreadPoolExecutor(jobs) as pool:
        verdicts = [pool.submit(one, item) for item in what]
        try:
            for verdict in as_completed(verdicts):
                yield verdict.result()
        finally:  # after Ctrl-C, wait only for the trials in progress
            pool.shutdown(wait=False, cancel_futures=True)


# -- interrupting -------------------------------------------------------------------------------------


def handeye(*words: str, said: str = "") -> subprocess.CompletedProcess[str]:
    """Execute a command of handeye. `said` is its standard input.

    Raises:
        TrialFailed: the command does not end.
    """
    try:
        return subprocess.run(  # noqa: S603 - our own program
            [sys.executable, "-m", "handeye", *words],
            input=said, capture_output=True, text=True, timeout=LIMIT, check=False,
        )  # fmt: skip
    except subprocess.TimeoutExpired:
        raise TrialFailed(f"`handeye {words[0]}` had not ended after {LIMIT:.0f} s") from None


def _started(whole: UnbrokenRun, place: Path) -> "subprocess.Popen[bytes]":
    return subprocess.Popen(  # noqa: S603 - our own program
        [sys.executable, "-m", "handeye", *whole.command, "--out", str(place)],
        stdin=subprocess.DEVNULL, stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL,
    )  # fmt: skip


def _ended(process: "subprocess.Popen[bytes]") -> int:
    """Return the exit code of a run after Ctrl-C."""
    try:
        return process.wait(LIMIT)
    except subprocess.TimeoutExpired:
        process.kill()
        raise TrialFailed(f"a run did not stop within {LIMIT:.0f} s of Ctrl-C") from None


def _wait_for(journal: Path, lines: int, process: "subprocess.Popen[bytes]") -> None:
    """Wait until a run has written a number of events."""
    end = time.monotonic() + LIMIT
    while process.poll() is None:
        if journal.exists() and journal.read_bytes().count(b"\n") >= lines:
            return
        if time.monotonic() > end:
            process.kill()
            break
        time.sleep(POLL)
    raise TrialFailed(f"the run ended before it could be interrupted (exit {process.wait()})")


def _middle(whole: UnbrokenRun, stage: str) -> int:
    """Return the number of the event in the middle of a stage."""
    first = next(n for n, e in enumerate(whole.events) if isinstance(e, StageStarted) and e.stage == stage)
    last = next(n for n, e in enumerate(whole.events) if isinstance(e, StageFinished) and e.stage == stage)
    return (first + last) // 2


# -- judging ------------------------------------------------------------------------------------------


def _resumed(whole: UnbrokenRun, place: Path) -> list[str]:
    """Resume an interrupted run, and return its differences from the uninterrupted one."""
    done = handeye("resume", str(place))
    if done.returncode != 0:
        return [f"resume ended with {done.returncode}: {done.stderr.strip().splitlines()[-1:]}"]
    faults = []
    if tuple(effective(read_events(place / EVENTS))) != whole.events:
        faults.append("different events")
    if (place / TRACE).read_bytes() != whole.trace:
        faults.append("a different trace")
    return faults


def _brakes(place: Path) -> list[str]:
    """Return faults in the way in which an interrupted run stopped, according to its trace."""
    trace = read_trace(place / TRACE)
    last = trace.events[-1]
    if not isinstance(last, PanicStopped):
        return [f"its last event is {type(last).__name__}"]
    before, end = trace.times[-2:]
    period = task(trace.head.task).arm.servo.period
    stopped = round((end - before) / period) == 1 and abs(last.time - end) < period / 2
    return [] if stopped and not trace.efforts[-1].any() else ["the brakes were not set at the next tick"]


def _end(folder: Path, stages: tuple[str, ...], number: int) -> Snapshot | None:
    """Return the state in which a stage ended, or None if it is not stored."""
    following = stages[number + 1] if number + 1 < len(stages) else None
    for path, head in CheckpointStore(folder / CHECKPOINTS).heads():
        if head.stage == following and (head.between_stages or following is None) and head.position > 0:
            return _snapshot(path)
    return None


def _snapshot(path: Path) -> Snapshot | None:
    from handeye.runs.checkpoint_file import read_checkpoint

    return read_checkpoint(path).snapshot


def _same(one: Snapshot, other: Snapshot) -> bool:
    """Return True if the states of cell and working phase are equal, byte for byte."""

    def plain(snapshot: Snapshot) -> bytes:
        return msgspec.msgpack.encode(
            (snapshot.position, snapshot.happened, snapshot.cell, snapshot.state),
            enc_hook=lambda array: array.tobytes(),
        )

    return plain(one) == plain(other)
