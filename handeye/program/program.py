"""A checked program. It consists of labelled operations, whose goals are names and whose numbers are in SI units. It
is independent of the language and of the arm.

Every arm language compiles to a program. The program is the input of the planner. The plan consists of the same
operations, together with planned motions.
"""

from collections.abc import Collection, Mapping
from typing import Annotated, ClassVar

from msgspec import Meta, field

from handeye.core.errors import ERRORS
from handeye.core.obb import Box
from handeye.core.record import Record
from handeye.core.source import Source, line_name
from handeye.program.operation import Device, Kind
from handeye.program.operations import AnyOperation

Columns = tuple[int, int]  # first column, and the column after the last, counted from 0


class SourcePlace(Record, frozen=True, kw_only=True, omit_defaults=True):
    """A place in the source. `file` is empty for the main text, and `line` counts from 1."""

    file: str = ""
    line: int
    span: Columns


class Step(Record, frozen=True, kw_only=True, omit_defaults=True):
    """One step of a program. The number of a step is its index."""

    operation: AnyOperation
    stage: int  # index
    labels: tuple[str, ...] = ()  # labels to which jumps lead
    macro: str = ""  # the macro it comes from, if any
    call: str = ""  # the macro that the stage calls, if `macro` is called within it
    file: str = ""  # a required file; empty: the main text
    line: int
    span: Columns = (0, 0)  # columns of its statement
    text: str  # its statement
    modifiers: tuple[SourcePlace, ...] = ()  # places of its modifiers
    next: int | None  # the next step; None ends the program

    @property
    def ways(self) -> tuple[int | None, ...]:
        """Steps that may follow: first `next`, then the branch target, if there is one."""
        branch = self.operation.branch
        return (self.next,) if branch is None else (self.next, branch.target)

    @property
    def called(self) -> str:
        """The macro that the stage calls at this step; empty if the step is not from a macro."""
        return self.call or self.macro

    @property
    def needs(self) -> Device | None:
        """The device that the step needs in addition to the arm."""
        return self.operation.needs

    @property
    def place(self) -> str:
        """The line of the step, such as `12` or `pins.al:12`."""
        return line_name(self.line, self.file)

    @property
    def examines(self) -> str | None:
        """The picture that the operation of the step examines; None if it examines no picture."""
        return self.operation.examines

    @property
    def guarded(self) -> bool:
        """True if the motion of the step has guards."""
        return bool(self.operation.guards)

    @property
    def begins_search(self) -> bool:
        return any(use.kind == "search" for use in self.operation.writes)

    @property
    def word(self) -> str:
        return next(iter(self.text.split()), "")


class Position(Record, frozen=True, kw_only=True):
    """A taught or written position of the hand: x, y, z (m) and the angles O, A, T (rad). If the part `of` is given,
    the position is relative to this part.
    """

    at: tuple[float, float, float, float, float, float]
    of: str | None = None


class Hole(Record, frozen=True, kw_only=True):
    """A round hole in the upper face of a part, in part coordinates (m)."""

    x: float
    y: float
    diameter: float


class Part(Record, frozen=True, kw_only=True):
    """A part as the program knows it: its planned place, and what it looks like from above.

    The reference point is the centre of the first hole. The reference direction points from the first hole to the
    second hole.
    """

    at: tuple[float, float, float, float]  # planned x, y, z (m), yaw (rad)
    face: float = 0.0  # height of the upper face over the reference point, m
    holes: tuple[Hole, ...] = ()  # large convex holes, largest first
    screw_holes: tuple[Hole, ...] = ()
    region: tuple[float, float] | None = None  # half width and half depth of the area where it may be, m
    outline: tuple[float, float, float, float] | None = None  # box, m: least x, y; greatest x, y


class Fixture(Record, frozen=True, kw_only=True):
    """A fixed obstacle in the cell: boxes in a frame at x, y, z (m) and yaw (rad)."""

    at: tuple[float, float, float, float]
    boxes: tuple[Box, ...]


class Held(Record, frozen=True, kw_only=True, omit_defaults=True):
    """An object that the hand holds after it has closed at one of `positions`. The object's shape is given as boxes in
    the hand frame T.
    """

    positions: tuple[str, ...]
    boxes: tuple[Box, ...]
    thickness: Annotated[float, Meta(gt=0)] | None = None
    """Gap (m) between fingers that hold the object, if the object has its nominal size; None if not known."""


class Program(Record, frozen=True, kw_only=True, omit_defaults=True):
    """A checked program."""

    name: str
    language: str  # name of its language
    source: str  # its text
    required: dict[str, str] = field(default_factory=dict)  # required texts, by path from the script's folder
    stages: tuple[str, ...]
    steps: tuple[Step, ...]
    positions: dict[str, Position]
    parts: dict[str, Part]
    fixtures: dict[str, Fixture] = field(default_factory=dict)  # obstacles
    held: dict[str, Held] = field(default_factory=dict)  # carried objects by name
    numbered: ClassVar[Mapping[int, str]] = {}  # lines have no numbers of their own

    @property
    def whole(self) -> Source:
        """The main text of the script together with the texts that it requires."""
        required = tuple(Source(name=key, key=key, text=text) for key, text in self.required.items())
        return Source(name=self.name, text=self.source, required=required)

    @property
    def labels(self) -> dict[str, list[int]]:
        """For each label, the numbers of the steps that have this label. A label in a macro marks one step in each
        call of the macro.
        """
        found: dict[str, list[int]] = {}
        for number, step in enumerate(self.steps):
            for label in step.labels:
                found.setdefault(label, []).append(number)
        return found

    @property
    def calls(self) -> frozenset[str]:
        """Names of macros that the stages call. These are the macros that can be left out in a run."""
        return frozenset(step.called for step in self.steps if step.macro)

    @property
    def errors(self) -> Collection[int]:
        """Numbers of the errors that steps may raise."""
        return ERRORS

    @property
    def feels(self) -> bool:
        """True if a step depends on the force or moment on the hand."""
        return any(step.operation.feels for step in self.steps)

    def written(self, kind: Kind) -> set[str]:
        """Return the names of all values of one kind that the steps write."""
        return {use.name for step in self.steps for use in step.operation.writes if use.kind == kind}
