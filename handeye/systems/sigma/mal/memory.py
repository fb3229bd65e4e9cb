"""Defines the complete state of the virtual machine between two statements, as one record."""

from typing import Annotated, Literal

from msgspec import Meta, field

from handeye.core.mutable_records import MutableRecord
from handeye.core.record import Record
from handeye.ports.microbus import Command

Address = Annotated[int, Meta(ge=0)]


class Flags(Record, frozen=True, kw_only=True, tag=True):
    """Wait until flags are set. If `take` is True, the task waits for a single flag, and the act that ends the wait
    clears this flag.
    """

    names: tuple[str, ...]
    take: bool


class Motors(Record, frozen=True, kw_only=True, tag=True):
    """Wait until axes and devices are not busy."""

    names: tuple[str, ...]


class Moment(Record, frozen=True, kw_only=True, tag=True):
    """Wait until a time on the machine's clock (microseconds)."""

    until: int


class TypedNumber(Record, frozen=True, kw_only=True, tag=True):
    """Wait until the user types a number for a variable at the console."""

    name: str


Waiting = Flags | Motors | Moment | TypedNumber


class Loop(Record, frozen=True, kw_only=True):
    """A FOR loop in progress: its variable, the value at which it ends, its step, and the address at which its
    lines begin."""

    name: str
    last: float
    step: float
    begin: Address


class Outgoing(Record, frozen=True, kw_only=True):
    """A command that waits to be sent. For a motion, `target` is the goal position; for any other command, `command`
    holds the five bytes.
    """

    to: str  # the axis or device that has to be free
    target: int | None = None  # steps
    slow: float = 0.0  # mm/s; 0: the profile of the motor
    command: Command | None = None
    after: tuple[str, ...] = ()  # these have to be free, too


class TaskMemory(MutableRecord, kw_only=True):
    """The state of a task."""

    pc: Address
    amid: bool = False  # True: the task waits in the middle of a statement
    stack: list[float] = field(default_factory=list)
    returns: list[int] = field(default_factory=list)  # for each GOSUB under way, the address after it
    loops: list[Loop] = field(default_factory=list)
    waits: Waiting | None = None
    outgoing: list[Outgoing] = field(default_factory=list)
    handlers: dict[str, int] = field(default_factory=dict)  # addresses, by axis; empty: for all axes
    resume: int | None = None  # the address after the statement that was aborted last


class Fault(Record, frozen=True, kw_only=True):
    """The reason why a program has stopped."""

    kind: Literal["trap", "abort", "deadlock", "input", "break", "fail"]
    task: str
    address: Address  # address of the statement
    told: str


class Owner(Record, frozen=True, kw_only=True):
    """The task and statement that commanded the present motion of an axis."""

    task: str
    address: Address


class MalMemory(MutableRecord, kw_only=True):
    """The state of a running program."""

    tasks: dict[str, TaskMemory] = field(default_factory=dict)  # unfinished tasks, in order of start
    turn: str = ""  # the task that goes on next; empty: none
    last: str = ""  # the task that had its turn last
    flags: tuple[str, ...] = ()  # the flags that are set, in the order of their names
    variables: dict[str, float] = field(default_factory=dict)
    counts: dict[str, int] = field(default_factory=dict)  # steps, by axis
    originated: tuple[str, ...] = ()
    certain: tuple[str, ...] = ()  # axes that ORIGIN moves, whose counts nothing had made doubtful
    curves: dict[str, int] = field(default_factory=dict)
    owners: dict[str, Owner] = field(default_factory=dict)
    stopped: dict[str, int] = field(
        default_factory=dict
    )  # status of axes that were aborted, until they move again
    doubtful: tuple[str, ...] = ()  # axes whose counts may be wrong, until ORIGIN
    printed: str = ""  # the line of the console that is not ended
    fault: Fault | None = None
    began: int = 0  # microseconds: time of the machine when the program began
    worked: int = 0  # microseconds in which the central computer had something to do
    commands: int = 0
    questions: int = 0  # questions; `commands` includes them
