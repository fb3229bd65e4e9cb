"""Tasks under one clock: none drifts, all are served in one order, and a deadlock says who waits for what."""

from collections.abc import Callable, Iterator
from fractions import Fraction

import msgspec
import pytest
from hypothesis import given
from hypothesis import strategies as st

from handeye.core.errors import HandeyeError
from handeye.core.units import JIFFY
from handeye.execution import scheduler
from handeye.execution.scheduler import Agenda, Deadlock, Task, Until, Wait, microseconds, run
from handeye.ports.clock import Clock

Log = list[tuple[int, int]]
Steps = list[tuple[str, int]]
"""What a task does: `("sleep", us)`, `("set", flag)` or `("wait", flag)`."""


class Watch(Clock):
    """Counts what passes, exactly."""

    def __init__(self, tick: Fraction | None = None) -> None:
        self.passed, self._tick, self.times = Fraction(0), tick, 0

    @property
    def now(self) -> float:
        return float(self.passed)

    @property
    def tick(self) -> Fraction | None:
        return self._tick

    def advance(self, seconds: float) -> None:
        self.passed += Fraction(seconds).limit_denominator(10_000_000)
        self.times += 1


def scripted(number: int, steps: Steps, flags: set[int], clock: Watch, log: Log) -> Task[None]:
    for what, value in steps:
        log.append((round(clock.passed * 1_000_000), number))
        if what == "sleep":
            yield microseconds(value)
        elif what == "set":
            flags.add(value)
        else:
            yield Until(met=lambda value=value: value in flags, name=f"flag {value}")  # type: ignore[misc]


def reference(scripts: list[Steps]) -> tuple[Log, list[int]]:
    """The same a microsecond at a time: the log, and the tasks that wait for ever."""
    log: Log = []
    flags: set[int] = set()
    left = {number: list(steps) for number, steps in enumerate(scripts)}
    due, served, blocked = dict.fromkeys(left, 0), dict.fromkeys(left, 0), dict[int, int]()
    for now in range(1_000):
        while True:
            ready = [n for n in left if (blocked[n] in flags if n in blocked else due[n] <= now)]
            if not ready:
                break
            for n in ready:
                if n in blocked and due[n] < now:
                    due[n], served[n] = now, 0
            n = min(ready, key=lambda n: (due[n], served[n], n))
            blocked.pop(n, None)
            while left[n] and left[n][0][0] == "set":
                log.append((now, n))
                flags.add(left[n].pop(0)[1])
            if not left[n]:
                del left[n]
                continue
            what, value = left[n].pop(0)
            log.append((now, n))
            if what == "sleep" and value:
                due[n], served[n] = due[n] + value, 0
                continue
            served[n] += 1
            if what == "wait":
                blocked[n] = value
    return log, sorted(left)


STEPS = st.tuples(st.sampled_from(["sleep", "set", "wait"]), st.integers(0, 3))


@given(st.lists(st.lists(STEPS, max_size=8), min_size=1, max_size=4))
def test_tasks_are_served_as_a_reference_serves_them(scripts: list[Steps]) -> None:
    log: Log = []
    flags: set[int] = set()
    clock = Watch()
    stuck: list[int] = []
    try:
        run(
            clock,
            [scripted(n, s, flags, clock, log) for n, s in enumerate(scripts)],
            list("0123")[: len(scripts)],
        )
    except Deadlock as deadlock:
        stuck = sorted(map(int, deadlock.waiting))
    assert (log, stuck) == reference(scripts)


def periodic(period: Wait, times: int) -> Task[None]:
    for _ in range(times):
        yield period


def test_an_hour_of_ten_milliseconds_beside_a_sixtieth_of_a_second_has_no_drift() -> None:
    clock = Watch()
    run(clock, [periodic(0.01, 360_000 // 60), periodic(JIFFY, 216_000 // 60)])
    assert (clock.passed, clock.times) == (
        60,
        6_000 + 3_600 - 60 * 20,
    )  # a minute of the hour: they meet 20 times a s


def test_what_falls_between_two_ticks_waits_for_the_next_and_does_not_lag() -> None:
    clock, log = Watch(tick=Fraction(1, 1000)), list[float]()

    def task() -> Task[None]:
        for _ in range(5):
            yield microseconds(400)
            log.append(clock.now)

    run(clock, [task()])
    assert log == [0.001, 0.001, 0.002, 0.002, 0.002]


def test_a_deadlock_names_who_waits_for_what() -> None:
    def waiting(flag: int) -> Task[None]:
        yield Until(met=lambda: False, name=f"flag {flag}")

    with pytest.raises(
        Deadlock, match=r"^no task can continue: LEFT waits for flag 2, RIGHT waits for flag 1$"
    ):
        run(Watch(), [waiting(2), waiting(1)], ["LEFT", "RIGHT"])


@pytest.mark.parametrize(
    ("wait", "told"),
    [
        (-1.0, "^A cannot wait for a negative time$"),
        (float("nan"), "^a task cannot wait for nan s$"),
        (float("inf"), "^a task cannot wait for inf s$"),
        (0.0, "^no task can continue: A waits for 0 s, 100 times in succession$"),
        (
            Until(met=lambda: True, name="it"),
            "^no task can continue: A waits for 0 s, 100 times in succession$",
        ),
    ],
)
def test_a_wait_without_end_or_sense_is_told_and_ends_all_tasks(
    monkeypatch: pytest.MonkeyPatch, wait: Wait, told: str
) -> None:
    monkeypatch.setattr(scheduler, "_MOST_AT_ONCE", 100)
    ended: list[bool] = []

    def other() -> Task[None]:
        try:
            yield 1.0
        finally:
            ended.append(True)

    with pytest.raises(HandeyeError, match=told):
        run(Watch(), [other(), periodic(wait, 10**9)], ["B", "A"])
    assert ended == [True]


def test_tasks_have_names_of_their_own() -> None:
    with pytest.raises(HandeyeError, match=r"^tasks need different names; the given names are A, A$"):
        run(Watch(), [periodic(1.0, 1), periodic(1.0, 1)], ["A", "A"])


def test_an_agenda_that_was_kept_goes_on_as_it_would_have() -> None:
    def walk(agenda: Agenda[int]) -> Iterator[tuple[int, str]]:
        pass_until: Callable[[int], int] = lambda time: time  # noqa: E731
        while (task := agenda.turn(lambda _: agenda.now >= 30, pass_until)) is not None:
            yield agenda.now, task
            if agenda.now >= 60:
                agenda.end(task)
            elif task == "B" and agenda.now < 30:
                agenda.wait(task, "thirty")
            else:
                agenda.sleep(task, 10 if task == "A" else 7)

    agenda: Agenda[int] = Agenda(now=0)
    agenda.add("A")
    agenda.add("B")
    steps = walk(agenda)
    begun = [next(steps) for _ in range(4)]
    kept = msgspec.json.decode(msgspec.json.encode(agenda), type=Agenda[int])
    again: Agenda[int] = Agenda(now=0)
    again.add("A")
    again.add("B")
    whole = list(walk(again))
    del agenda
    # the fourth turn was given but not used: what was kept is before its `sleep`
    assert whole[:4] == begun
    kept.sleep(begun[-1][1], 10 if begun[-1][1] == "A" else 7)
    assert list(walk(kept)) == whole[4:]
