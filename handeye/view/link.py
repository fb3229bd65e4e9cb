"""The link between the thread that executes a run and the server: lines for the run, and messages from the run."""

from collections.abc import Callable, Iterator
from contextlib import AbstractContextManager
from queue import Empty, SimpleQueue
from threading import Lock
from typing import Final

MAX_WAITING_LINES: Final = 100  # the run takes them in less than a servo period


class Link:
    """Lines and the panic button for a run, from any thread; the run collects them when it can."""

    def __init__(self) -> None:
        self.tell: Callable[[str], None] = lambda _: None
        """Sends a message to all viewers; set by the server."""
        self._lines = SimpleQueue[str | None]()
        self._lock = Lock()
        self._goes = False
        self._panic = False

    # -- the side of the viewers ----------------------------------------------------------------------

    def say(self, line: str) -> bool:
        """Send a line to the run; False if too many lines are waiting."""
        if self._lines.qsize() >= MAX_WAITING_LINES:
            return False
        self._lines.put(line)
        return True

    def press(self) -> bool:
        """Press the panic button; False if nothing is in progress that it could stop."""
        with self._lock:
            self._panic = self._goes
            return self._goes

    # -- the side of the run --------------------------------------------------------------------------

    def lines(self, aside: Callable[[], AbstractContextManager[None]]) -> Iterator[str]:
        """Lines for a paused run; each pause clears the panic button."""
        while True:
            self._set_going(False)
            with aside():
                line = self._lines.get()
            if line is None:
                return
            self._set_going(True)
            yield line

    def come(self) -> str | None:
        """A line that has already been received; None if there is none."""
        try:
            return self._lines.get_nowait()
        except Empty:
            return None

    def panic(self) -> bool:
        """True if the panic button was pressed since the last call."""
        pressed, self._panic = self._panic, False
        return pressed

    def _set_going(self, goes: bool) -> None:
        with self._lock:
            self._goes, self._panic = goes, False
