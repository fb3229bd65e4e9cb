"""A checked program: labelled operations with symbolic goals, in SI units, of no particular language.

This is the first waist of the system: every arm language ends here, and the planner starts here. The same
operations, joined by planned motions, make the plan.
"""

from collections.abc import Collection

from msgspec import field

from handeye.core.errors import ERRORS
from handeye.core.obb import Box
from handeye.core.record import Record
from handeye.core.source import Source, line_name
from handeye.program.operation import Device, Kind
from handeye.program.operations import AnyOperation

Columns = tuple[int, int]
"""Characters of a line, from 0: the first, and the one behind the last. They are those of the line, so that a change in
one line of a script leaves what the others have become as it was."""


class SourcePlace(Record, frozen=True, kw_only=True, omit_defaults=True):
    """Where some words of the source stand."""

    file: str = ""
    """The required file they stand in; empty: the source itself."""
    line: int
    """Line of that text, from 1."""
    span: Columns


class Step(Record, frozen=True, kw_only=True, omit_defaults=True):
    """One step of the graph. Steps are numbered by their place in the list."""

    operation: AnyOperation
    stage: int
    """Index of the stage it belongs to."""
    labels: tuple[str, ...] = ()
    """Labels that jumps to it name."""
    macro: str = ""
    """The macro whose call it comes from; empty: none."""
    file: str = ""
    """The required file it stands in; empty: the source itself."""
    line: int
    """Line of that text, from 1."""
    span: Columns = (0, 0)
    """Where on that line its statement stands."""
    text: str
    """That statement, for people."""
    modifiers: tuple[SourcePlace, ...] = ()
    """The statements that say more of its operation."""
    next: int | None
    """Step that follows; None ends the program."""

    @property
    def ways(self) -> tuple[int | None, ...]:
        """The steps that may follow, `next` first."""
        branch = self.operation.branch
        return (self.next,) if branch is None else (self.next, branch.target)

    @property
    def needs(self) -> Device | None:
        """The device that its operation works, if there is one besides the arm."""
        return self.operation.needs

    @property
    def place(self) -> str:
        """Its line, as people are told: `12`, or `pins.al:12`."""
        return line_name(self.line, self.file)

    @property
    def examines(self) -> str | None:
        """The picture that its operation looks at, if it looks at one."""
        return self.operation.examines

    @property
    def word(self) -> str:
        """The word that its statement begins with."""
        return next(iter(self.text.split()), "")


class Position(Record, frozen=True, kw_only=True):
    """A taught or written hand position."""

    at: tuple[float, float, float, float, float, float]
    """x, y, z (m) of the tool centre point and the angles O, A, T (rad); relative to the part if `of`."""
    of: str | None = None


class Hole(Record, frozen=True, kw_only=True):
    """A round hole in a part's upper face, in part coordinates."""

    x: float
    y: float
    diameter: float


class Part(Record, frozen=True, kw_only=True):
    """A part as the program knows it: where it is planned to be, and what it looks like from above."""

    at: tuple[float, float, float, float]
    """Planned x, y, z (m) and yaw (rad) of its reference point and reference direction."""
    face: float = 0.0
    """Height (m) of its upper face over its reference point."""
    holes: tuple[Hole, ...] = ()
    """Large convex holes, largest first; the reference point is the centre of the first, and the reference
    direction points from it to the second."""
    screw_holes: tuple[Hole, ...] = ()
    region: tuple[float, float] | None = None
    """Half width and half depth (m) of where its reference point may be, about the planned place."""
    outline: tuple[float, float, float, float] | None = None
    """Box around it in part coordinates: x from, y from, x to, y to (m)."""


class Fixture(Record, frozen=True, kw_only=True):
    """A thing that stands fast in the cell, as boxes."""

    at: tuple[float, float, float, float]
    """x, y, z (m) and yaw (rad) of its frame on the table."""
    boxes: tuple[Box, ...]


class Held(Record, frozen=True, kw_only=True):
    """A thing that the hand holds when it has closed at one of some positions, as boxes in the hand's frame T."""

    positions: tuple[str, ...]
    boxes: tuple[Box, ...]


class Program(Record, frozen=True, kw_only=True, omit_defaults=True):
    """A checked program."""

    name: str
    language: str
    """The language it was written in, by the name that this has (`program/language.py`)."""
    source: str
    """The text it was made from."""
    required: dict[str, str] = field(default_factory=dict)
    """Texts of the files that it requires, by their paths from its folder."""
    stages: tuple[str, ...]
    steps: tuple[Step, ...]
    positions: dict[str, Position]
    parts: dict[str, Part]
    fixtures: dict[str, Fixture] = field(default_factory=dict)
    """Things that no motion may lead through."""
    held: dict[str, Held] = field(default_factory=dict)
    """Things that are carried, by name."""

    @property
    def whole(self) -> Source:
        """The text with those it requires."""
        required = tuple(Source(name=key, key=key, text=text) for key, text in self.required.items())
        return Source(name=self.name, text=self.source, required=required)

    @property
    def labels(self) -> dict[str, list[int]]:
        """The steps of each label; a label in a macro has one for each call."""
        found: dict[str, list[int]] = {}
        for number, step in enumerate(self.steps):
            for label in step.labels:
                found.setdefault(label, []).append(number)
        return found

    @property
    def errors(self) -> Collection[int]:
        """Numbers of the errors that steps may raise."""
        return ERRORS

    @property
    def feels(self) -> bool:
        """True if a step goes by the force or moment of the hand."""
        return any(step.operation.feels for step in self.steps)

    def written(self, kind: Kind) -> set[str]:
        """The names of what its steps write of a kind."""
        return {use.name for step in self.steps for use in step.operation.writes if use.kind == kind}
