"""Ctrl-C while processes are begun that shall not hear it."""

import signal
import threading
from collections.abc import Iterator
from contextlib import contextmanager
from multiprocessing import resource_tracker


@contextmanager
def deaf_to_interrupts() -> Iterator[None]:
    """While processes are begun that shall not hear Ctrl-C at the terminal: we do, and end them without their words.

    Threads that begin here, and the processes that those begin, are deaf for good. We ourselves are interrupted, or
    told to end, when all have begun: half begun, one would not be known, and complain.

    Raises:
        KeyboardInterrupt: behind it, if we were interrupted or told to end meanwhile.
    """
    if not hasattr(signal, "pthread_sigmask"):  # as on Windows
        yield
        return
    resource_tracker.ensure_running()  # where it begins by itself, it takes the mask away
    masked = signal.pthread_sigmask(signal.SIG_BLOCK, {signal.SIGINT})
    told: list[int] = []
    handles = threading.current_thread() is threading.main_thread()  # no other thread may, or is interrupted
    # A thread of a library may be there that is not masked: it takes Ctrl-C to our handler all the same.
    before = {
        each: signal.signal(each, lambda number, _: told.append(number))
        for each in (signal.SIGINT, signal.SIGTERM)
        if handles
    }
    try:
        yield
    finally:
        signal.pthread_sigmask(signal.SIG_SETMASK, masked)
        for each, handler in before.items():
            signal.signal(each, handler)
    if told:
        raise KeyboardInterrupt
