"""Lines that a person types, with history and completion, or that are piped in."""

import sys
from collections.abc import Callable, Iterable, Iterator
from contextlib import AbstractContextManager
from types import ModuleType

editing: ModuleType | None
try:  # at once: the graphics driver of a cell may bring a library that looks like this one, and would be taken for it
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
    """The lines of standard input, without their ends. At a terminal, Ctrl-D ends them.

    Args:
        prompt: put out before each line, on a terminal.
        aside: entered while a line is waited for.
        words: what a word may be completed to.
        droppable: at a terminal, Ctrl-C drops the line instead of breaking in.
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
            except KeyboardInterrupt:
                if not (terminal and droppable):
                    raise
                sys.stdout.write("\n")
                continue
        if not line and not terminal:
            return
        yield line.rstrip("\r\n")


def _edit(words: Callable[[], Iterable[str]]) -> None:
    """History, editing and completion, where the platform has them."""
    if editing is not None:
        editing.set_completer(lambda start, number: completion(start, number, words()))
        editing.set_completer_delims(" \t[],")
        editing.parse_and_bind("tab: complete")


def completion(start: str, number: int, words: Iterable[str]) -> str | None:
    """The word, by its number from 0, that a beginning can be completed to; None behind the last."""
    found = sorted({word for word in words if word.upper().startswith(start.upper())})
    return f"{found[number]} " if number < len(found) else None
