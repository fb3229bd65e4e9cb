"""Runs tasks together under one clock. Each task waits for a time or a condition, and the order of the tasks is
deterministic.

Time is counted exactly, in rational seconds or whole microseconds. Rounding errors therefore do not accumulate when
one task has a period of 10 ms and another has a period of 1/60 s.
"""

from collections.abc import Callable, Generator, Sequence
from contextlib import ExitStack
from dataclasses import dataclass
from fractions import Fraction
from functools import lru_cache
from math import ceil, isfinite
from typing import Final, Generic, TypeVar

import msgspec

from handeye.core.errors import BadArgument, HandeyeError
from handeye.core.mutable_records import MutableRecord
from handeye.ports.clock import Clock

Time = TypeVar("Time", int, Fraction)
T = TypeVar("T")
_FINEST: Final = 1_000_000  # largest denominator of a duration, in s, that is given in floating point
_ROUNDING_S: Final = 1e-12
_MOST_AT_ONCE: Final = 1_000_000  # turns of a task at one moment


@dataclass(frozen=True, slots=True, kw_only=True)
class Until:
    """A wait for a condition. The condition is tested whenever another task has acted, time has passed, or an
    event of the clock has been handled.
    """

    met: Callable[[], bool]
    name: str  # the condition in words, for a deadlock: `flag 2`


Wait = float | Fraction | Until  # a duration in s (`microseconds` makes exact ones), or a condition
Task = Generator[Wait, None, T]


class Deadlock(HandeyeError):
    """Raised when all remaining tasks wait for conditions, and no condition is met."""

    def __init__(self, waiting: dict[str, str]) -> None:
        said = ", ".join(f"{task} waits for {what}" for task, what in waiting.items())
        super().__init__(f"no task can continue: {said}")
        self.waiting = waiting


class Agenda(MutableRecord, Generic[Time], kw_only=True):
    """The order and times at which tasks continue, as a record that a system can keep in its state.

    The task with the earliest due time continues. If several tasks have the same due time, they continue in the order
    of `due`, and no task continues twice before the others have continued.
    """

    now: Time
    due: dict[str, tuple[Time, int]] = msgspec.field(default_factory=dict)
    """For each task, two values: the time at which the task became due or began to wait, and how often the task has
    continued at this time without a delay.
    """
    waits: dict[str, str] = msgspec.field(default_factory=dict)
    """The tasks that wait for a condition, each with the name of its condition."""

    def add(self, task: str) -> None:
        """Add a task that begins now, after the tasks already due."""
        self.due[task] = self.now, 0

    def turn(
        self,
        met: Callable[[str], bool],
        pass_until: Callable[[Time], Time],
        next_event: Callable[[], Time | None] = lambda: None,
    ) -> str | None:
        """Return the task that continues next, or None if all tasks have ended. The caller executes the task, and must
        then call `sleep`, `wait` or `end` for it.

        `met` returns True if the condition of a waiting task is met. `pass_until` lets time pass at least until the
        given time, and returns the new time. `next_event` returns the time of the next event for which tasks may
        wait.
        """
        while self.due:
            ready = [
                (max(at, (self.now, 0)) if task in self.waits else at, number, task)
                for number, (task, at) in enumerate(self.due.items())
                if (met(task) if task in self.waits else at[0] <= self.now)
            ]
            if ready:
                since, _, task = min(ready)
                self.due[task] = since
                self.waits.pop(task, None)
                return task
            times = [time for task, (time, _) in self.due.items() if task not in self.waits]
            if self.waits and (event := next_event()) is not None:
                times.append(event)
            if not times:
                raise Deadlock(dict(self.waits))
            self.now = pass_until(min(times))
        return None

    def sleep(self, task: str, duration: Time) -> None:
        """Make a task due again. The new time is `duration` after the time at which the task was last due, even if the
        task was executed late.
        """
        time, again = self.due[task]
        if duration < 0:
            raise BadArgument(f"{task} cannot wait for a negative time")
        if again == _MOST_AT_ONCE:
            raise Deadlock({task: f"0 s, {_MOST_AT_ONCE} times in succession"})
        self.due[task] = (time + duration, 0) if duration else (time, again + 1)

    def wait(self, task: str, name: str) -> None:
        """Let a task wait for the condition `name`."""
        self.sleep(task, self.now - self.now)
        self.waits[task] = name

    def end(self, task: str) -> None:
        """Remove a task that has ended."""
        del self.due[task]


def microseconds(count: int) -> Fraction:
    """Convert a whole number of microseconds to a duration, in s."""
    return Fraction(count, 1_000_000)


def run(clock: Clock, tasks: Sequence[Task[T]], names: Sequence[str] = ()) -> list[T]:
    """Run tasks together under one clock, each when it is due. Returns the result of each task.

    When the motion of an arm has ended, this arm is no longer driven while other arms move, so its watchdog sets the
    brakes. `names` are the names of the tasks in the message of a deadlock, by default `task 1`, `task 2` and so on.
    """
    names = names or [f"task {number + 1}" for number in range(len(tasks))]
    running = dict(zip(names, tasks, strict=True))
    if len(running) < len(tasks):
        raise BadArgument(f"tasks need different names; the given names are {', '.join(names)}")
    agenda: Agenda[Fraction] = Agenda(now=Fraction(0))
    until: dict[str, Until] = {}
    ended: dict[str, T] = {}

    def pass_until(time: Fraction) -> Fraction:
        passed, tick = time - agenda.now, clock.tick
        if tick is not None:
            passed = ceil(passed / tick) * tick
        clock.advance(float(passed))
        return agenda.now + passed

    def next_event() -> Fraction | None:
        event = clock.next_event
        return None if event is None else agenda.now + event

    with ExitStack() as stack:  # an error in one task ends all
        for name, task in running.items():
            stack.callback(task.close)
            agenda.add(name)
        while (turn := agenda.turn(lambda task: until[task].met(), pass_until, next_event)) is not None:
            try:
                wait = next(running[turn])
            except StopIteration as end:
                ended[turn] = end.value
                agenda.end(turn)
                continue
            if isinstance(wait, Until):
                until[turn] = wait
                agenda.wait(turn, wait.name)
            else:
                agenda.sleep(turn, _exact(wait))
    return [ended[name] for name in running]


@lru_cache(maxsize=64)
def _exact(seconds: float | Fraction) -> Fraction:
    """Return the exact duration that a floating-point number stands for: 1/60 s for 0.016666666666666666."""
    if isinstance(seconds, Fraction):
        return seconds
    if not isfinite(seconds):
        raise BadArgument(f"a task cannot wait for {seconds:g} s")
    exact = Fraction(seconds)
    near = exact.limit_denominator(_FINEST)
    return near if abs(float(near) - seconds) < _ROUNDING_S else exact
