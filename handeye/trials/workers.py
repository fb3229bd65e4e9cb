"""Processes that are kept from trial to trial, and that may be lost: each then costs the trial it was at."""

import os
import signal
import threading
from collections import deque
from collections.abc import Callable, Generator, Iterator, Sequence
from contextlib import ExitStack, contextmanager, suppress
from dataclasses import dataclass, field
from multiprocessing import connection, get_context, parent_process, resource_tracker
from multiprocessing.connection import Connection
from typing import Any, Final, Generic, TypeVar

from handeye.core.errors import HandeyeError
from handeye.core.host_time import HostTimer
from handeye.core.plain_text import counted
from handeye.core.signals import ENDING, break_in, heard

Item = TypeVar("Item")
T = TypeVar("T")

_OVERDUE: Final = getattr(signal, "SIGPROF", 0)  # Ends a process that has had the processor for too long
TRIES: Final = 2  # Times that a trial is begun whose process is killed
LONGEST_LIMIT_S: Final = 1e8  # Longest limit that a system is asked to keep: three years
SHORTEST_LIMIT_S: Final = 1e-6  # Shortest that it knows from none


class WorkerLost(HandeyeError):
    """The process of a trial was killed, and again when the trial was tried once more."""


@dataclass(frozen=True, slots=True, kw_only=True)
class Answer(Generic[Item, T]):
    """Outcome of one item."""

    item: Item
    value: T | None = None
    error: BaseException | None = None
    killed: int = 0  # How often its process was killed
    overdue: bool = False  # Its process was ended because it took too much of the processor
    wall_s: float = 0.0  # Duration of the last attempt

    @property
    def lost(self) -> bool:
        """Its process was killed under it; it may be tried once more."""
        return self.value is None and self.error is None and not self.overdue


class Worker:
    """A process that runs one trial after the other."""

    def __init__(self, trial: Callable[[Any], Any], limit_s: float | None = None) -> None:
        """Begin the process. Ctrl-C at the terminal is for us: it does not hear it."""
        self.here, there = get_context("spawn").Pipe()
        self.process = get_context("spawn").Process(target=_serve, args=(there, limit_s), daemon=True)
        with deaf_to_interrupts():
            self.process.start()
        there.close()  # so that each end notices when the other is gone
        self.given: _Assignment[Any] | None = None
        self._send(
            trial
        )  # not with the process: the starter of one writes for ever if it is killed meanwhile

    def give(self, given: "_Assignment[Any]") -> None:
        """Let it run a trial."""
        self.given, given.timer = given, HostTimer()
        self._send(given.item)

    def end(self) -> None:
        """End the process, whatever it is at."""
        self.here.close()
        self.process.kill()
        self.process.join()

    def _send(self, what: Any) -> None:
        with suppress(OSError):  # it is gone, as the reader of its answer will see
            self.here.send(what)


@dataclass(slots=True, kw_only=True)
class _Assignment(Generic[Item]):
    """A trial that is waiting or running."""

    item: Item
    killed: int = 0
    timer: HostTimer = field(default_factory=HostTimer)


def answers(
    trial: Callable[[Item], T], items: Sequence[Item], count: int, *, limit_s: float | None = None
) -> Generator[Answer[Item, T], None, None]:
    """Answers for each item, in the order they end, from processes, which end with the caller.

    A trial whose process is killed is begun once more in a new one; one that takes `limit_s` seconds of the processor
    is ended. Time in which the process is paused, or another has the processor, is not counted.
    """
    todo = deque(_Assignment[Item](item=item) for item in items)
    workers: list[Worker] = []
    try:
        while todo or any(worker.given for worker in workers):
            while todo and len(workers) < count:
                workers.append(Worker(trial, limit_s))
            for worker in workers:
                if worker.given is None and todo:
                    worker.give(todo.popleft())
            for worker in _heard(workers):
                answer = _answer(worker)
                if answer.lost and answer.killed < TRIES:
                    todo.appendleft(_Assignment(item=answer.item, killed=answer.killed))
                else:
                    yield answer
                if worker.given is not None:  # it is lost
                    worker.end()
                    workers.remove(worker)
    finally:  # Ctrl-C first of all: a trial under way may take minutes
        for worker in workers:
            worker.end()


def in_processes(trial: Callable[[Item], T], worlds: Sequence[Item], jobs: int) -> Iterator[T]:
    """Values for many items, in the order they end; raises WorkerLost, or what a trial raised."""
    for answer in answers(trial, worlds, jobs):
        if answer.error is not None:
            raise answer.error
        if answer.value is None:
            raise WorkerLost(
                f"the process of a trial was killed {counted(answer.killed, 'time')}, probably for lack of memory: "
                f"run fewer at a time"
            )
        yield answer.value


@contextmanager
def deaf_to_interrupts() -> Iterator[None]:
    """While processes are begun that shall not hear Ctrl-C at the terminal: we do, and end them without their words.

    Threads that begin here, and the processes that those begin, are deaf for good. We ourselves are interrupted when
    all have begun: half begun, one would not be known, and complain.
    """
    if not hasattr(signal, "pthread_sigmask"):  # as on Windows
        yield
        return
    resource_tracker.ensure_running()  # where it begins by itself, it takes the mask away
    masked = signal.pthread_sigmask(signal.SIG_BLOCK, {*ENDING} - {signal.SIGTERM})
    told: list[int] = []
    # A thread of a library may be there that is not masked: it takes Ctrl-C to our handler all the same.
    with ExitStack() as hearing:
        if (
            threading.current_thread() is threading.main_thread()
        ):  # no other thread may hear, or is interrupted
            hearing.enter_context(heard(lambda number, _: told.append(number)))
        try:
            yield
        finally:
            signal.pthread_sigmask(signal.SIG_SETMASK, masked)
    if told:
        break_in(told[0], None)


def _heard(workers: list[Worker]) -> list[Worker]:
    """Wait for workers that have answered or were lost."""
    busy = [worker for worker in workers if worker.given is not None]
    told = connection.wait([worker.here for worker in busy])
    return [worker for worker in busy if worker.here in told]


def _answer(worker: Worker) -> Answer[Any, Any]:
    """The answer of a worker, which is idle afterwards unless it is lost."""
    given = worker.given
    assert given is not None
    wall_s = given.timer.wall_s
    try:
        value, error = worker.here.recv()
    except (EOFError, OSError):
        worker.process.join()
        if worker.process.exitcode == -_OVERDUE:
            return Answer(item=given.item, killed=given.killed, overdue=True, wall_s=wall_s)
        return Answer(item=given.item, killed=given.killed + 1, wall_s=wall_s)
    worker.given = None
    return Answer(item=given.item, value=value, error=error, killed=given.killed, wall_s=wall_s)


# -- in the process -----------------------------------------------------------------------------------


def _serve(there: Connection, limit_s: float | None) -> None:
    """Run what arrives, until nothing more does."""
    threading.Thread(target=_end_with_parent, daemon=True).start()
    try:
        trial = there.recv()
        while True:
            item = there.recv()
            with _limited(limit_s):
                answer = _tried(trial, item)
            there.send(answer)
    except (EOFError, OSError):
        return


@contextmanager
def _limited(limit_s: float | None) -> Iterator[None]:
    """During a trial: let the system end this process when it has used this much CPU time."""
    if limit_s is None or not hasattr(signal, "setitimer"):  # as on Windows
        yield
        return
    signal.setitimer(signal.ITIMER_PROF, max(min(limit_s, LONGEST_LIMIT_S), SHORTEST_LIMIT_S))
    try:
        yield
    finally:
        signal.setitimer(signal.ITIMER_PROF, 0)


def _tried(trial: Callable[[Any], Any], item: Any) -> tuple[Any, BaseException | None]:
    try:
        return trial(item), None
    except Exception as error:  # it is for the caller
        return None, error


def _end_with_parent() -> None:
    """End this process when the one that began it is gone, also where that was killed."""
    parent = parent_process()
    assert parent is not None
    connection.wait([parent.sentinel])
    os._exit(1)
