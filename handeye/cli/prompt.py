"""Lines typed at a terminal, with history and completion, or lines from a pipe."""

import os
import select
import sys
from collections.abc import Callable, Iterable, Iterator
from contextlib import AbstractContextManager
from queue import Empty, SimpleQueue
from threading import Thread
from types import ModuleType

from handeye.core.signals import ToldToEnd

editing: ModuleType | None
try:  # at once, before the graphics driver of a cell can load a similar library that Python would mistake for this
    import readline as editing
except ImportError:  # not everywhere
    editing = None


def typed_lines(
    prompt: str,
    aside: Callable[[], AbstractContextManager[None]],
    words: Callable[[], Iterable[str]],
    *,
    droppable: bool = True,
) -> Iterator[str]:
    """The lines of standard input, without line endings; at a terminal, Ctrl-D ends the input.

    Args:
        aside: context that is entered while waiting for a line.
        words: the words offered as completions.
        droppable: at a terminal, Ctrl-C drops the line instead of interrupting the program.
    """
    terminal = sys.stdin.isatty()
    if terminal:
        _edit(words)
    while True:
        with aside():
            try:
                line = input(prompt) if terminal else sys.stdin.readline()
            except EOFError:
                return
            except KeyboardInterrupt as told:
                if isinstance(told, ToldToEnd) or not (terminal and droppable):
                    raise
                sys.stdout.write("\n")
                continue
        if not line and not terminal:
            return
        yield line.rstrip("\r\n")


def typed_already() -> str | None:
    """A line typed at the terminal before the prompt; None if no line was typed, or if the terminal does not show
    whether a line was typed.
    """
    if sys.platform == "win32":
        return None
    if not select.select([sys.stdin], [], [], 0)[0]:
        return None
    return sys.stdin.readline().rstrip("\r\n") or None


class PipedLines:
    """Reads the lines of a file in the background; the caller can wait for the next line, or ask for it without
    waiting.
    """

    def __init__(self, file: int) -> None:
        """Start to read a file, given by its descriptor."""
        self._lines = SimpleQueue[str | None]()
        Thread(target=self._read, args=(file,), daemon=True).start()

    def wait(self, aside: Callable[[], AbstractContextManager[None]]) -> Iterator[str]:
        """Yield each line that `come` has not taken. While no line has arrived, the context `aside` is open."""
        while True:
            with aside():
                line = self._lines.get()
            if line is None:
                return
            yield line

    def come(self) -> str | None:
        """Take a waiting line. Returns None if no line is waiting."""
        try:
            line = self._lines.get_nowait()
        except Empty:
            return None
        if line is None:
            self._lines.put(None)  # after the end of the input there are no more lines
        return line

    def _read(self, file: int) -> None:
        """Read lines without the buffer of `sys.stdin`. If this thread held the lock of the buffer, Python would wait
        for the lock at exit.
        """
        rest = b""
        while more := os.read(file, 65536):
            *lines, rest = (rest + more).split(b"\n")
            for line in lines:
                self._lines.put(line.decode(errors="replace").rstrip("\r"))
        if rest:
            self._lines.put(rest.decode(errors="replace"))
        self._lines.put(None)


def _edit(words: Callable[[], Iterable[str]]) -> None:
    """Set up history, editing and completion, if the platform supports them."""
    if editing is not None:
        editing.set_completer(lambda start, number: completion(start, number, words()))
        editing.set_completer_delims(" \t[],")
        editing.parse_and_bind("tab: complete")


def completion(start: str, number: int, words: Iterable[str]) -> str | None:
    """Return one completion of the typed text `start`: the completion with the number `number`, from 0. Returns None
    if there are fewer completions.
    """
    found = sorted({word for word in words if word.upper().startswith(start.upper())})
    return f"{found[number]} " if number < len(found) else None
