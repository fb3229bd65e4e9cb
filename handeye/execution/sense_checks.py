"""Cross-checks of senses and drives: what one device says of a quantity that another one says, too.

A check needs no device of its own. It knows the cell through its ports, allows for the stated errors of both devices,
and returns the error that names the one which is out of its range, with the cause as a value. Those here are called as
a stage begins, in its first step, so that what has set in since is found there and not by what it spoils later. An
action checks what only it can compare.

A check that finds nothing wrong leaves the run as it was: time may pass in it (at most some servo periods, in which
the arm holds its set-point), and it may keep what it has measured in the state of the run.
"""

from collections.abc import Callable
from typing import Final

from handeye.execution.context import ExecutionContext
from handeye.execution.state import Fault

SenseCheck = Callable[[ExecutionContext], Fault | None]

CHECKS: Final[tuple[SenseCheck, ...]] = ()
"""In the order in which they are made; the first that finds a device wrong ends the stage."""


def doubted(run: ExecutionContext) -> Fault | None:
    """The error of the first check that does not hold; None: all hold."""
    return next((fault for check in CHECKS if (fault := check(run)) is not None), None)
