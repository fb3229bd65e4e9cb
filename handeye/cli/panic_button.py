"""Ctrl-C as the panic button of the cell: asked at every servo period instead of breaking in anywhere."""

import signal
from collections.abc import Iterator
from contextlib import contextmanager
from types import FrameType
from typing import Self


class PanicButton:
    """While entered, Ctrl-C presses it; the second time without an effect, it interrupts as usual."""

    def __init__(self) -> None:
        self._pressed = False
        self._asking = False

    def __enter__(self) -> Self:
        self._before = signal.signal(signal.SIGINT, self._press)
        return self

    def __exit__(self, *_: object) -> None:
        signal.signal(signal.SIGINT, self._before)

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
