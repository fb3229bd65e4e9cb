"""Worker processes that execute many trials each. If a process is lost, only the trial that it was executing is
lost."""

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

_OVERDUE: Final = getattr(signal, "SIGPROF", 0)  # Signal that ends a process which has used too much CPU time
TRIES: Final = 2  # Times that a trial is begun if its process is killed
LONGEST_LIMIT_S: Final = 1e8  # Longest limit that a system is asked to enforce: three years
SHORTEST_LIMIT_S: Final = 1e-6  # Shortest limit that a system distinguishes from no limit


class WorkerLost(HandeyeError):
    """Raised if the process of a trial was killed, the trial was repeated, and the new process was killed too."""


@dataclass(frozen=True, slots=True, kw_only=True)
class Answer(Generic[Item, T]):
    """The outcome of one item."""

    item: Item
    value: T | None = None
    error: BaseException | None = None
    killed: int = 0  # How often its process was killed
    overdue: bool = False  # Its process was ended because it used too much CPU time
    wall_s: float = 0.0  # Duration of the last attempt

    @property
    def lost(self) -> bool:
        """True if the process that worked on the item was killed. The item is then repeated in another process. If
        this process is killed too, the item is not repeated again.
        """
        return self.value is None and self.error is None and not self.overdue


class Worker:
    """A process that executes one trial after another."""

    def __init__(self, trial: Callable[[Any], Any], limit_s: float | None = None) -> None:
        """Start the process. The process ignores Ctrl-C at the terminal; the parent process handles it."""
        self.here, there = get_context("spawn").Pipe()
        self.process = get_context("spawn").Process(target=_serve, args=(there, limit_s), daemon=True)
        with deaf_to_interrupts():
            self.process.start()
        there.close()  # so that each end notices when the other has closed
        self.given: _Assignment[Any] | None = None
        self._send(
            trial
        )  # not passed to `Process`: if the process were killed while it starts, `start` would never return

    def give(self, given: "_Assignment[Any]") -> None:
        """Send a trial to the process."""
        self.given, given.timer = given, HostTimer()
        self._send(given.item)

    def end(self) -> None:
        """Kill the process, even if it is executing a trial."""
        self.here.close()
        self.process.kill()
        self.process.join()

    def _send(self, what: Any) -> None:
        with suppress(OSError):  # the process has ended; the code that waits for its answer will notice
            self.here.send(what)


@dataclass(slots=True, kw_only=True)
class _Assignment(Generic[Item]):
    """A trial that waits for a worker or is being executed."""

    item: Item
    killed: int = 0
    timer: HostTimer = field(default_factory=HostTimer)


def answers(
    trial: Callable[[Item], T], items: Sequence[Item], count: int, *, limit_s: float | None = None
) -> Generator[Answer[Item, T], None, None]:
    """Yield the answers for all items, in the order in which the items end. The worker processes end when the
    caller ends.

    If the process of a trial is killed, the trial is repeated once in a new process. A trial is stopped when it has
    used more than `limit_s` seconds of CPU time. The time during which its process is paused or waits for the
    processor does not count.
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
                if worker.given is not None:  # its process is lost
                    worker.end()
                    workers.remove(worker)
    finally:  # above all after Ctrl-C, because a trial in progress may take minutes
        for worker in workers:
            worker.end()


def in_processes(trial: Callable[[Item], T], worlds: Sequence[Item], jobs: int) -> Iterator[T]:
    """Yield the results for many items, in the order in which they are ready. Raises WorkerLost, or the
    exception of a trial."""
    for answer in answers(trial, worlds, jobs):
        if answer.error is not None:
            raise answer.error
        if answer.value is None:
            raise WorkerLost(
                f"the process of a trial was killed {counted(answer.killed, 'time')}, probably for lack of memory: "
                "run fewer trials at the same time (--jobs)"
            )
        yield answer.value


@contextmanager
def deaf_to_interrupts() -> Iterator[None]:
    """Processes that are started within this context ignore Ctrl-C at the terminal. The parent process
    handles Ctrl-C, and ends these processes silently.

    Threads that are started in this context, and processes that these threads start, ignore Ctrl-C permanently. An
    interrupt of the parent is delayed until all processes have started, because the parent cannot end a partly started
    process. Such a process would print an error at Ctrl-C.
    """
    if not hasattr(signal, "pthread_sigmask"):  # as on Windows
        yield
        return
    resource_tracker.ensure_running()  # if it started by itself later, it would remove the mask
    masked = signal.pthread_sigmask(signal.SIG_BLOCK, {*ENDING} - {signal.SIGTERM})
    told: list[int] = []
    # A thread of a library may have no mask: it would still deliver Ctrl-C to our handler.
    with ExitStack() as hearing:
        if (
            threading.current_thread() is threading.main_thread()
        ):  # other threads cannot set handlers, and are not interrupted
            hearing.enter_context(heard(lambda number, _: told.append(number)))
        try:
            yield
        finally:
            signal.pthread_sigmask(signal.SIG_SETMASK, masked)
    if told:
        break_in(told[0], None)


def _heard(workers: list[Worker]) -> list[Worker]:
    """Wait until at least one worker has answered or is lost. Return these workers."""
    busy = [worker for worker in workers if worker.given is not None]
    told = connection.wait([worker.here for worker in busy])
    return [worker for worker in busy if worker.here in told]


def _answer(worker: Worker) -> Answer[Any, Any]:
    """Return the answer of a worker. Afterwards the worker is idle, unless its process was lost."""
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
    """Execute trials as they arrive, until the connection is closed."""
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
    """Limit the CPU time of this process. If the process uses more than `limit_s` seconds within this context, the
    operating system ends it.
    """
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
    except Exception as error:  # passed on to the caller
        return None, error


def _end_with_parent() -> None:
    """End this process when its parent process has ended, even if the parent was killed."""
    parent = parent_process()
    assert parent is not None
    connection.wait([parent.sentinel])
    os._exit(1)
