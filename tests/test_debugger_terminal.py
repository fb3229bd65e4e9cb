"""The stepper at a terminal: what somebody sees there who types."""

import os
import pty
import select
import signal
import subprocess
import sys
from collections.abc import Callable, Iterator

import pytest
from conftest import Command

pytestmark = pytest.mark.slow

PROMPT = "handeye> "
SCRIPT = """TRANS HERE_ [20 30 8 90 90 0]
        STAGE   "to and fro"
        OPEN    1
        MOVE    HERE_
        STAGE   "once more"
        OPEN    2
"""
ERASE = "\x1b[2K"
"""How a bar is taken away from a terminal."""


class Terminal:
    """`handeye` with a terminal for its input and output."""

    def __init__(self, *words: str) -> None:
        self.ours, theirs = pty.openpty()
        command = [sys.executable, "-m", "handeye", *words]
        environment = {**os.environ, "TERM": "xterm", "COLUMNS": "100", "LINES": "40"}
        self.process = subprocess.Popen(command, stdin=theirs, stdout=theirs, stderr=theirs, env=environment)
        os.close(theirs)

    def until(self, end: str | None) -> str:
        """What is put out until then; None: until it ends."""
        seen = b""
        while end is None or end.encode() not in seen:
            assert select.select([self.ours], [], [], 120)[0], seen.decode()
            try:
                more = os.read(self.ours, 65536)
            except OSError:  # Linux tells the end so
                break
            if not more:
                break
            seen += more
        return seen.decode()

    def interrupt(self) -> None:
        """Ctrl-C, again if nothing comes of it: just before it waits for a key, the line editor does not notice."""
        for _ in range(100):
            self.process.send_signal(signal.SIGINT)
            if select.select([self.ours], [], [], 1)[0]:
                return

    def say(self, line: str, end: str | None = PROMPT) -> str:
        """What is put out for a line, the line and the next prompt left out."""
        os.write(self.ours, line.encode() + b"\n")
        return self.until(end).removeprefix(line).removesuffix(PROMPT).replace("\r\n", "\n").strip()


@pytest.fixture
def stepping(command: Command, planned: Callable[[str], str]) -> Iterator[Terminal]:
    """A run that is stepped at a terminal and waits for the first command."""
    terminal = Terminal("run", planned(SCRIPT), "--step")
    begun = terminal.until(PROMPT)
    assert "setting up the cell" in begun
    assert begun.rindex(ERASE) < begun.index("── stage 1, to and fro")
    yield terminal
    terminal.process.kill()
    terminal.process.wait()
    os.close(terminal.ours)


def test_no_bar_stands_between_the_answers(stepping: Terminal) -> None:
    answers = [stepping.say(line) for line in ("step", "show gap", "stpe", "continue")]
    assert not any(ERASE in answer or "setting up" in answer for answer in answers)
    assert answers[2] == "there is no command `stpe`; did you mean `step`?"
    assert answers[3].endswith("the program has ended: `back` goes back from here, `quit` leaves")


def test_what_is_typed_while_the_run_goes_is_heard_then_and_not_later(stepping: Terminal) -> None:
    refused, paused = stepping.say("stage\nback"), stepping.say("back 2\nstep")
    assert "`back` was ignored: while the run moves" in refused
    assert "2 steps done" in refused
    assert "2 steps undone" in paused
    stepping.until(PROMPT)
    paused = stepping.say("continue\npause")
    assert "the run will pause after the current step" in paused
    assert paused.endswith("paused on request")


def test_a_wrong_command_at_a_terminal_is_no_failure(stepping: Terminal) -> None:
    stepping.say("stpe")
    left = stepping.say("exit", end=None)
    assert (stepping.process.wait(), ERASE in left) == (0, False)
    assert "Ended by the user." in left


def test_control_c_at_the_prompt_drops_the_line_and_nothing_else(stepping: Terminal) -> None:
    os.write(stepping.ours, b"step 2")
    stepping.until("step 2")
    stepping.interrupt()
    assert stepping.until(PROMPT).strip() == PROMPT.strip()
    assert "step 1; 1 step done" in stepping.say("step")
