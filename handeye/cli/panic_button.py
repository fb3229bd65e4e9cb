"""Ctrl-C as the panic button of the cell: asked at every servo period instead of breaking in anywhere.

To be told to end, as by `kill`, is the same as Ctrl-C.
"""

import signal
from collections.abc import Iterator
from contextlib import contextmanager
from types import FrameType
from typing import Final, Self

from handeye.core.errors import BadFile

ENDING: Final = (signal.SIGINT, signal.SIGTERM)


@contextmanager
def terminable() -> Iterator[None]:
    """While being told to end interrupts as Ctrl-C does, so that nothing half done stays behind.

    It does so within an import too: modules written in C make an ImportError of a KeyboardInterrupt, and the loader of
    commands a BadFile of that.
    """
    heard = []

    def interrupt(number: int, frame: FrameType | None) -> None:
        heard.append(number)
        raise KeyboardInterrupt

    before = {signal.SIGTERM: signal.signal(signal.SIGTERM, interrupt)}
    if signal.getsignal(signal.SIGINT) is signal.default_int_handler:  # not where Ctrl-C is ignored
        before[signal.SIGINT] = signal.signal(signal.SIGINT, interrupt)
    try:
        yield
    except (ImportError, BadFile):
        if heard:
            raise KeyboardInterrupt from None
        raise
    finally:
        for number, handler in before.items():
            signal.signal(number, handler)


class PanicButton:
    """While entered, Ctrl-C presses it; the second time without an effect, it interrupts as usual."""

    def __init__(self) -> None:
        self._pressed = False
        self._asking = False

    def __enter__(self) -> Self:
        self._before = {number: signal.signal(number, self._press) for number in ENDING}
        return self

    def __exit__(self, *_: object) -> None:
        for number, handler in self._before.items():
            signal.signal(number, handler)

    def __call__(self) -> bool:
        """True if it was pressed since the last call."""
        pressed, self._pressed = self._pressed, False
        return pressed

    @contextmanager
    def aside(self) -> Iterator[None]:
        """While nothing moves and a person is asked: Ctrl-C interrupts as usual."""
        self._asking = True
        try:
            yield
        finally:
            self._asking = False

    def _press(self, number: int, frame: FrameType | None) -> None:
        if self._asking or self._pressed:
            raise KeyboardInterrupt
        self._pressed = True
