"""The state of the background level of one arm."""

from typing import Annotated, Final, Literal

import msgspec
from msgspec import field

from handeye.core.mutable_records import MutableRecord
from handeye.systems.ml.language.syntax import LAST
from handeye.systems.ml.level import Side

Wait = Literal["", "post", "until", "joy"]  # for nothing, the end of a motion, a cycle, a function key
Number = Annotated[int, msgspec.Meta(ge=0, le=LAST)]
KEPT: Final = 100  # lines of the trace and of the session


class BackgroundMemory(MutableRecord, kw_only=True):
    """Where the program is, and what it waits for. The registers of the background level are in the table RG."""

    at: Number = 0  # the statement to be executed next; 0: no program runs
    executing: Number = 0  # the statement that is executed, or was executed last; 0: a typed line
    waits: Wait = ""
    until: int = 0  # cycle in which a wait ends
    joy: Number = 0  # POINT that the joystick fills
    side: Side = "right"  # the arm that commands refer to
    tracing: bool = False
    trying: bool = False  # each statement waits for a key
    cycle: int = 0  # the cycle in which statements were counted last
    share: int = 0  # statements executed in that cycle
    stopped: str = ""  # why the program was stopped, as a sentence; empty: it was not
    onward: Number = 0  # after a stop: the statement that would have been next
    closed: bool = False  # True: the session with the host is closed
    sent: int = 0  # commands that were sent to the host
    received: int = 0  # programs that were read from the host
    traced: list[tuple[int, ...]] = field(
        default_factory=list
    )  # number of the statement, number of the command, and values
    typed: list[str] = field(default_factory=list)
    left: bool = False  # True after EXIT
