"""A checked program: labelled operations with symbolic goals, in SI units, of no particular language.

This is the first waist of the system: every arm language ends here, and the planner starts here. The same
operations, joined by planned motions, make the plan.
"""

from typing import Final, Literal

import msgspec

from handeye.boxes import Box
from handeye.source import Source, line_name

Vector = tuple[float, float, float]


VIAS: Final = 4
"""Positions that a motion can be led by."""


class Record(msgspec.Struct, frozen=True, gc=False, kw_only=True, forbid_unknown_fields=True):
    """Base of everything that goes to disk."""


class Operation(Record, frozen=True, kw_only=True, tag_field="op", tag=lambda name: name.lower()):
    """Base of the operations; the class name in lower case is the tag on disk."""


class Stop(Record, frozen=True, kw_only=True):
    """End the motion when a force, torque or touch is met; if it ends without, an error is raised.

    Exactly one of `force`, `against`, `torque`, `touch` and `moment` is set; but `moment` may stand beside `force` or
    `against`, and then whichever is met first ends the motion.
    """

    force: Vector | None = None
    """Direction and size (N, table coordinates) of the force *the hand exerts*: the motion ends when the hand
    presses on something along this vector with more than its length. Else error 23."""
    against: float | None = None
    """The motion ends when it is opposed with more than this force (N), in whatever direction it goes. Else
    error 23."""
    torque: float | None = None
    """The motion ends when the screwdriver's motor exerts this torque (N m). Else error 24."""
    moment: Vector | None = None
    """Axis and size (N m, table coordinates) of the moment *the hand exerts* about its tool centre point: the motion
    ends when it exceeds the vector's length about the vector. Else error 23."""
    touch: int | None = None
    """The motion ends when one of these finger switches closes: 1 of the finger on the +y side of the hand frame, 2 of
    the other, 3 of either. Else error 25."""


class Restore(Record, frozen=True, kw_only=True):
    """Shift a goal by a saved difference."""

    name: str
    level: bool = False
    """Use only the horizontal components."""


class Move(Operation, frozen=True, kw_only=True):
    """Planned motion to a position, with departure upwards and approach from above."""

    goal: str
    restore: tuple[Restore, ...] = ()
    searching: bool = False
    """Inside a search loop: the present search offset is added to the goal."""
    direct: bool = False
    """Without departure and approach."""
    via: tuple[str, ...] = ()
    """Positions passed on the way, in this order, without stopping."""
    stop: Stop | None = None


class Change(Operation, frozen=True, kw_only=True):
    """Straight motion from the present place, orientation kept unless the hand is to be turned."""

    displacement: Vector
    """m, table coordinates."""
    speed: float | None = None
    """m/s; None: the speed of guarded moves, or of free ones without a stop."""
    stop: Stop | None = None
    press: Vector | None = None
    """Force to exert while moving (N, table coordinates): the hand follows what it presses on."""
    free: Vector | None = None
    """Axes of the table, 1 or 0, along which the hand gives way to force while moving."""
    spin: Vector | None = None
    """Axes of the table, 1 or 0, about which the hand gives way to a moment while moving."""
    moment: Vector | None = None
    """Moment to exert while moving (N m, table coordinates), the hand turning until it does."""


class Turn(Operation, frozen=True, kw_only=True):
    """Motion of the hand on a circle about the vertical through a position, the hand turning with it."""

    centre: str
    angle: float
    """rad, positive counter-clockwise seen from above."""
    stop: Stop | None = None


class Open(Operation, frozen=True, kw_only=True):
    """Drive the fingers to a gap."""

    gap: float


class Close(Operation, frozen=True, kw_only=True):
    """Close until both switches fire; error 2 below `minimum`, error 7 above `maximum` (m)."""

    minimum: float = 0.0
    maximum: float | None = None


class Center(Operation, frozen=True, kw_only=True):
    """Close, moving the hand so that the object is not pushed; error 2 below `minimum` (m)."""

    minimum: float = 0.0


class Search(Operation, frozen=True, kw_only=True):
    """Set up a spiral search with this step (m) and at most `limit` places; the present place is the first."""

    step: float
    limit: int = 49


class Advance(Operation, frozen=True, kw_only=True):
    """Go to the next place of the search (AOJ); error 6 when there is none."""


class Test(Operation, frozen=True, kw_only=True):
    """Ask whether the last action raised an error, and clear it.

    `raised`: next step when error `number` was raised (None ends the program); otherwise the step's `next`.
    """

    __test__ = False

    number: int
    raised: int | None


class Assign(Operation, frozen=True, kw_only=True):
    """Set a counter."""

    counter: str
    value: int


class Countdown(Operation, frozen=True, kw_only=True):
    """Subtract one from a counter (SOJG).

    `positive`: next step while it is still positive (None ends the program); otherwise the step's `next`.
    """

    counter: str
    positive: int | None


class Jump(Operation, frozen=True, kw_only=True):
    """Go on elsewhere (the step's `next`)."""


class Save(Operation, frozen=True, kw_only=True):
    """Keep the difference actual minus goal of the last Move; after Center only its part along the finger line.

    What a Restore of the same name had added to that goal counts to the difference, so that saving again under
    one name follows a datum that moves.
    """

    name: str


class Here(Operation, frozen=True, kw_only=True):
    """Define a position as where the hand is; one that belongs to a part keeps to it."""

    position: str


class Where(Operation, frozen=True, kw_only=True):
    """Tell where the hand is."""


class Wait(Operation, frozen=True, kw_only=True):
    """Stop, set the brakes, tell the operator."""

    message: str


class Load(Operation, frozen=True, kw_only=True):
    """Declare the weight (N) of what the hand carries, so that the servo compensates it."""

    weight: float


class Tool(Operation, frozen=True, kw_only=True):
    """Set the screwdriver's spindle speed, rad/s; 0 is off."""

    speed: float


class Travel(Operation, frozen=True, kw_only=True):
    """Check how far the last Change went (m): error 8 outside the range."""

    minimum: float
    maximum: float


class Lens(Operation, frozen=True, kw_only=True):
    """Turn the lens turret; focal length in m."""

    focal_length: float


class Aim(Operation, frozen=True, kw_only=True):
    """Point the camera at a position or part and focus there."""

    target: str


class Look(Operation, frozen=True, kw_only=True):
    """Take a picture under a name."""

    picture: str
    hold_target: bool = False
    """Keep the target voltage of the picture before, as differencing needs."""


class General(Operation, frozen=True, kw_only=True):
    """General location: find the part's outline in the picture; measures where it is, roughly. Else error 30."""

    part: str
    picture: str


class Specific(Operation, frozen=True, kw_only=True):
    """Specific location: find the part's holes in the picture; measures its pose. Else error 31."""

    part: str
    picture: str


class Inspect(Operation, frozen=True, kw_only=True):
    """Difference pictures of a part before and after its gasket was put on; error 32 if that lies wrong."""

    part: str
    before: str
    after: str


AnyOperation = (
    Move | Change | Turn | Open | Close | Center | Search | Advance | Test | Assign | Countdown | Jump | Save
    | Here | Where | Wait | Load | Tool | Travel | Lens | Aim | Look | General | Specific | Inspect
)  # fmt: skip

ACTIONS = (
    Move, Change, Turn, Open, Close, Center, Advance, Travel, Lens, Aim, Look, General, Specific, Inspect
)  # fmt: skip
"""Operations that can raise an error, or clear the one before."""


class Step(Record, frozen=True, kw_only=True, omit_defaults=True):
    """One step of the graph. Steps are numbered by their place in the list."""

    operation: AnyOperation
    stage: int
    """Index of the stage it belongs to."""
    file: str = ""
    """The required file it stands in; empty: the source itself."""
    line: int
    """Line of that text, from 1."""
    text: str
    """The source statement, for people."""
    next: int | None
    """Step that follows; None ends the program."""

    @property
    def ways(self) -> tuple[int | None, ...]:
        """The steps that may follow, `next` first."""
        match self.operation:
            case Test(raised=elsewhere) | Countdown(positive=elsewhere):
                return self.next, elsewhere
        return (self.next,)

    @property
    def place(self) -> str:
        """Its line, as people are told: `12`, or `pins.al:12`."""
        return line_name(self.line, self.file)


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
    """What the program knows of a part: where it is planned to be, and what it looks like from above."""

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
    """What stands fast in the cell, as boxes."""

    at: tuple[float, float, float, float]
    """x, y, z (m) and yaw (rad) of its frame on the table."""
    boxes: tuple[Box, ...]


class Held(Record, frozen=True, kw_only=True):
    """What the hand holds when it has closed at one of some positions, as boxes in the hand's frame T."""

    positions: tuple[str, ...]
    boxes: tuple[Box, ...]


class Program(Record, frozen=True, kw_only=True, omit_defaults=True):
    """A checked program."""

    name: str
    language: Literal["wave"]
    source: str
    """The text it was made from."""
    required: dict[str, str] = {}
    """Texts of the files that it requires, by their paths from its folder."""
    stages: tuple[str, ...]
    steps: tuple[Step, ...]
    positions: dict[str, Position]
    parts: dict[str, Part]
    fixtures: dict[str, Fixture] = {}
    """What no motion may lead through."""
    held: dict[str, Held] = {}
    """What is carried, by name."""

    @property
    def whole(self) -> Source:
        """The text with those it requires."""
        required = tuple(Source(name=key, key=key, text=text) for key, text in self.required.items())
        return Source(name=self.name, text=self.source, required=required)
