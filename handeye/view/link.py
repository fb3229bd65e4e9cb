"""Passes lines from the server to the thread that executes a run, and messages from this thread to the server."""

from collections.abc import Callable, Iterator
from contextlib import AbstractContextManager
from queue import Empty, SimpleQueue
from threading import Lock
from typing import Final

MAX_WAITING_LINES: Final = 100  # a run that moves fetches them in less than a servo period


class Link:
    """Passes lines and the panic button to a run. Any thread may send a line or press the button. The run fetches
    lines and button presses when it can.
    """

    def __init__(self) -> None:
        self.tell: Callable[[str], None] = lambda _: None
        """Sends a message to all viewers; set by the server."""
        self._lines = SimpleQueue[str | None]()
        self._lock = Lock()
        self._goes = False
        self._panic = False

    # -- the side of the viewers ----------------------------------------------------------------------

    def say(self, line: str) -> bool:
        """Send a line to the run. Returns False if too many lines are waiting."""
        if self._lines.qsize() >= MAX_WAITING_LINES:
            return False
        self._lines.put(line)
        return True

    def press(self) -> bool:
        """Press the panic button. Returns False if nothing moves, so that the button has nothing to stop."""
        with self._lock:
            self._panic = self._goes
            return self._goes

    # -- the side of the run --------------------------------------------------------------------------

    def lines(self, aside: Callable[[], AbstractContextManager[None]]) -> Iterator[str]:
        """Yield the lines that viewers send to a paused run. Each pause resets the panic button."""
        while True:
            self._set_going(False)
            with aside():
                line = self._lines.get()
            if line is None:
                return
            self._set_going(True)
            yield line

    def come(self) -> str | None:
        """Take the next received line from the queue and return it; return None if no line is waiting."""
        try:
            return self._lines.get_nowait()
        except Empty:
            return None

    def panic(self) -> bool:
        """Return True if the panic button was pressed since the last call."""
        pressed, self._panic = self._panic, False
        return pressed

    def _set_going(self, goes: bool) -> None:
        with self._lock:
            self._goes, self._panic = goes, False
