"""Makes Ctrl-C the panic button of the cell. The button is polled in every servo period, so Ctrl-C does not interrupt
the program at an arbitrary place. `kill` has the same effect as Ctrl-C.
"""

import signal
from collections.abc import Iterator
from contextlib import contextmanager
from types import FrameType
from typing import Any, Self

from handeye.core.signals import ToldToEnd, break_in, heard


class PanicButton:
    """While the context is open, Ctrl-C presses the panic button. If the program has not yet noticed the first press,
    the second Ctrl-C interrupts the program as usual.
    """

    def __init__(self) -> None:
        self._pressed = False
        self._told = False
        self._asking = False
        self._hearing = heard(self._press)

    def __enter__(self) -> Self:
        self._hearing.__enter__()
        return self

    def __exit__(self, *how: Any) -> None:
        self._hearing.__exit__(*how)

    def __call__(self) -> bool:
        """True if the button was pressed since the last call."""
        pressed, self._pressed = self._pressed, False
        return pressed

    @contextmanager
    def aside(self) -> Iterator[None]:
        """While the context is open, the user is answering a question, and Ctrl-C interrupts as usual. Raises
        ToldToEnd if a `kill` has already asked the program to end.
        """
        if self._told:
            raise ToldToEnd
        with self.released():
            yield

    @contextmanager
    def released(self) -> Iterator[None]:
        """While the context is open, nothing moves, so Ctrl-C interrupts as usual."""
        self._asking = True
        try:
            yield
        finally:
            self._asking = False

    def _press(self, number: int, frame: FrameType | None) -> None:
        impatient = (
            self._pressed and number == signal.SIGINT
        )  # some systems send the signal twice, for example when a terminal closes
        self._pressed = True
        self._told |= number != signal.SIGINT
        if self._asking or impatient:
            break_in(number, frame)
