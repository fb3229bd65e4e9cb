"""A run that is watched, and steered from pages, is recorded as one that nobody looks at."""

from collections.abc import Iterator, Sequence
from contextlib import ExitStack, contextmanager
from pathlib import Path
from threading import Thread

import pytest
from short_runs import begin, traced
from websockets.exceptions import ConnectionClosed
from websockets.sync.client import connect

from handeye.debugger.stepper import Stepper
from handeye.runs.folder import TRACE, open_new
from handeye.runs.observer import Observer
from handeye.runs.runner import Runner
from handeye.view.link import Link
from handeye.view.moment import Newest
from handeye.view.server import Server
from handeye.view.stepping import drive

pytestmark = pytest.mark.slow
FEEL = """\
TRANS   ABOVE [25 38 .5 90 90 0]
        OPEN    1
        MOVE    ABOVE
        STOP    [0 0 -40]
        CHANGE  [0 0 -1] 1 .2
        OPEN    2
"""


def recorded(folder: Path, lines: Sequence[str], viewers: int) -> tuple[bytes, list[int]]:
    """The trace of a run in which lines were said, and how many moments each of so many viewers saw."""
    start, newest, seen = begin(FEEL), list[Newest](), [0] * viewers
    keeping = open_new(folder, start)

    def looking(runner: Runner) -> list[Observer]:
        newest.append(Newest(runner))
        return [keeping.watch(runner, start, again=False), *newest]

    with Server(Link()) as server:
        runner = Runner(start, observers=looking)
        server.show(b"", newest[0])
        watching = [Thread(target=watch, args=(server, seen, number)) for number in range(viewers)]
        for thread in watching:
            thread.start()
        rest = iter((*lines, "quit"))

        @contextmanager
        def asked() -> Iterator[None]:
            server.link.say(next(rest))
            yield

        drive(Stepper(runner), server.link, asked)
        runner.finish()
    for thread in watching:
        thread.join()
    keeping.close()
    return (folder / TRACE).read_bytes(), seen


def watch(server: Server, seen: list[int], number: int) -> None:
    """Look on until the run has been left."""
    own = f"127.0.0.1:{server.access.port}"
    target = f"ws://{own}/live?token={server.access.token}"
    with ExitStack() as open_:
        try:
            viewer = open_.enter_context(connect(target, origin=f"http://{own}", proxy=None))
            for message in viewer:
                seen[number] += isinstance(message, bytes)
        except ConnectionClosed:
            pass


def test_the_trace_of_a_watched_run_is_the_same_to_the_byte(tmp_path: Path) -> None:
    traced(begin(FEEL), tmp_path / "alone")  # no server, and no observer that copies for one
    steered = ["pace 100x", "step", "show", "back", "step 2", "break 5", "continue", "continue"]
    watched, seen = recorded(tmp_path / "watched", steered, 20)
    assert watched == (tmp_path / "alone" / TRACE).read_bytes()
    assert min(seen) > 0
