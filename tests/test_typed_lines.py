"""Lines of standard input that are taken while nobody asks for one."""

import os
import pty
from contextlib import nullcontext

import pytest

from handeye.cli.prompt import PipedLines, typed_already


def test_a_line_is_taken_from_a_terminal_only_when_it_is_there_whole(monkeypatch: pytest.MonkeyPatch) -> None:
    ours, theirs = pty.openpty()
    with open(theirs, encoding="utf-8") as terminal:
        monkeypatch.setattr("sys.stdin", terminal)
        assert typed_already() is None
        os.write(ours, b"pau")
        assert typed_already() is None
        os.write(ours, b"se\nstep\n")
        assert [typed_already() for _ in range(3)] == ["pause", "step", None]
    os.close(ours)


def test_lines_of_a_pipe_are_waited_for_or_taken_as_they_have_come() -> None:
    reader, writer = os.pipe()
    lines = PipedLines(reader)
    assert lines.come() is None
    os.write(writer, "step\r\nshow ✓".encode())
    waited = lines.wait(nullcontext)
    assert (next(waited), lines.come()) == ("step", None)
    os.close(writer)
    assert [*waited, lines.come()] == ["show ✓", None]
    os.close(reader)
