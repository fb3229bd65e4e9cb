"""Handles signals that end the program: Ctrl-C, `kill`, a closed terminal, the warning of a batch system."""

import os
import signal
import stat
import sys
from collections.abc import Callable, Iterator
from contextlib import contextmanager, suppress
from types import FrameType
from typing import Any, Final, NoReturn

_NAMES: Final = ("SIGINT", "SIGTERM", "SIGHUP", "SIGUSR1", "SIGUSR2", "SIGXCPU", "SIGBREAK")
ENDING: Final = tuple(getattr(signal, name) for name in _NAMES if hasattr(signal, name))
"""The signals of this platform that end the program."""

_IMPORTING: Final = (
    "importlib._bootstrap",
    "_frozen_importlib",
)  # names of the import system's module, before and after `importlib` is loaded

Handler = Callable[[int, FrameType | None], None]


class ToldToEnd(KeyboardInterrupt):
    """Raised when a signal other than Ctrl-C ends the program. At a prompt, Ctrl-C only drops the typed line; the
    other signals end the program.
    """


@contextmanager
def heard(handler: Handler) -> Iterator[None]:
    """While the context is open, let `handler` handle the signals that end the program. A signal that the process
    ignores, as after `nohup`, stays ignored.
    """
    before = {}

    def hear(number: int, frame: FrameType | None) -> None:
        if number == getattr(signal, "SIGHUP", None):
            _leave_closed_terminal()
        handler(number, frame)

    for number in ENDING:
        if signal.getsignal(number) not in (signal.SIG_IGN, None):  # None if it was not set by Python
            before[number] = signal.signal(number, hear)
    try:
        yield
    finally:
        for number, known in before.items():
            signal.signal(number, known)


def break_in(number: int, frame: FrameType | None) -> None:
    """Handle a signal by raising KeyboardInterrupt. During an import, wait until the import is over.

    Interrupting an import is unsafe: some modules written in C turn the exception into an ImportError, and others
    swallow it.
    """
    importer = None
    while frame is not None:
        if frame.f_globals.get("__name__") in _IMPORTING:
            importer = frame.f_back
        frame = frame.f_back
    if importer is None:
        _interrupt(number)

    def goes_on(*_: Any) -> NoReturn:
        _interrupt(number)

    importer.f_trace = goes_on
    sys.settrace(lambda *_: None)  # without which no frame is traced


def _interrupt(number: int) -> NoReturn:
    raise KeyboardInterrupt if number == signal.SIGINT else ToldToEnd


def _leave_closed_terminal() -> None:
    """Redirect a closed terminal to the null device, because writing to the terminal would raise OSError."""
    for file in range(3):
        with suppress(OSError):
            if stat.S_ISCHR(os.fstat(file).st_mode) and not os.isatty(file):
                with open(os.devnull, "r+b") as nothing:
                    os.dup2(nothing.fileno(), file)
