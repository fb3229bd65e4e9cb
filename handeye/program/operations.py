"""The operations of a program, in SI units, of no particular language. Each says itself what it reads, writes, raises
and guards, and where it may lead: a new one is a class here, and an action in the working phase.
"""

import math
from typing import Annotated, ClassVar, Final, Self

from msgspec import Meta
from msgspec.structs import replace

from handeye import errors
from handeye.ports.camera import LENSES
from handeye.program.guards import FORCE, Bounds, Guards, unmet
from handeye.program.operation import Branch, Operation, Use, action
from handeye.record import Record, Vector3

VIAS: Final = 4
"""Positions that a motion can be led by."""
_LENGTH: Final[Bounds] = (1e-6, 10.0)  # m
_GAP: Final[Bounds] = (0.0, 0.2)  # m


class Restore(Record, frozen=True, kw_only=True):
    """Shift a goal by a saved difference."""

    name: str
    level: bool = False
    """Use only the horizontal components."""


class ArmMotion(Operation, frozen=True, kw_only=True):
    """Base of the motions of the arm: guards may end them, and if none does, an error is raised."""

    family: ClassVar = "motion"
    moves: ClassVar = True
    takes_time: ClassVar = True
    raising: ClassVar = action(errors.JOINT_LIMIT, errors.NO_SOLUTION, errors.SERVO_LAG)

    @property
    def raises(self) -> frozenset[int]:
        """The numbers of the errors it can raise."""
        return self.raising | {unmet(self.guards)} if self.guards else self.raising


class Move(ArmMotion, frozen=True, kw_only=True):
    """Planned motion to a position, with departure upwards and approach from above."""

    planned: ClassVar = True
    reading: ClassVar = {"position": ("goal", "via")}
    writing: ClassVar = {"goal": ()}

    goal: str
    restore: tuple[Restore, ...] = ()
    searching: bool = False
    """Inside a search loop: the present search offset is added to the goal."""
    direct: bool = False
    """Without departure and approach."""
    via: Annotated[tuple[str, ...], Meta(max_length=VIAS)] = ()
    """Positions passed on the way, in this order, without stopping."""
    guards: Guards = ()

    @property
    def reads(self) -> tuple[Use, ...]:
        """Everything it is carried out by, what it is shifted by included."""
        shifts = [Use("difference", restore.name, restore.level) for restore in self.restore]
        search = [Use("search")] if self.searching else []
        return (*self.used(self.reading), *shifts, *search)

    @property
    def goal_position(self) -> str:
        """The goal, before anything shifts it."""
        return self.goal

    @property
    def knots(self) -> int | None:
        """Start, lift-off, what it passes, set-down and goal."""
        return 4 + len(self.via)


class Change(ArmMotion, frozen=True, kw_only=True):
    """Straight motion from the present place, orientation kept unless the hand is to be turned."""

    bounds: ClassVar = {"speed": (1e-4, 2.0), "displacement": _LENGTH, "press": FORCE, "moment": FORCE}
    writing: ClassVar = {"travel": ()}

    displacement: Vector3
    """m, table coordinates."""
    speed: float | None = None
    """m/s; None: the speed of guarded moves, or of free ones if nothing is to be met."""
    guards: Guards = ()
    press: Vector3 | None = None
    """Force to exert while moving (N, table coordinates): the hand follows what it presses on."""
    free: Vector3 | None = None
    """Axes of the table, 1 or 0, along which the hand gives way to force while moving."""
    spin: Vector3 | None = None
    """Axes of the table, 1 or 0, about which the hand gives way to a moment while moving."""
    moment: Vector3 | None = None
    """Moment to exert while moving (N m, table coordinates), the hand turning until it does."""

    @property
    def meets(self) -> bool:
        """True if it is meant to meet something: to stop on it, or to press on it or turn it."""
        return bool(self.guards) or self.press is not None or self.moment is not None

    @property
    def complies(self) -> bool:
        """True if force or moment moves the hand on the way."""
        return any(way is not None for way in (self.press, self.free, self.moment, self.spin))

    @property
    def knots(self) -> int | None:
        """Start and goal."""
        return 2


class Turn(ArmMotion, frozen=True, kw_only=True):
    """Motion of the hand on a circle about the vertical through a position, the hand turning with it."""

    bounds: ClassVar = {"angle": (-4 * math.pi, 4 * math.pi)}
    reading: ClassVar = {"position": ("centre",)}

    centre: str
    angle: float
    """rad, positive counter-clockwise seen from above."""
    guards: Guards = ()

    @property
    def knots(self) -> int | None:
        """Start and goal."""
        return 2


class Open(Operation, frozen=True, kw_only=True):
    """Drive the fingers to a gap."""

    family: ClassVar = "hand"
    needs: ClassVar = "hand"
    moves: ClassVar = True
    takes_time: ClassVar = True
    raising: ClassVar = action()
    bounds: ClassVar = {"gap": _GAP}

    gap: float


class Close(Operation, frozen=True, kw_only=True):
    """Close until both switches fire; error 2 below `minimum`, error 7 above `maximum` (m)."""

    family: ClassVar = "hand"
    needs: ClassVar = "hand"
    moves: ClassVar = True
    takes_time: ClassVar = True
    raising: ClassVar = action(errors.NOTHING_HELD)
    bounds: ClassVar = {"minimum": _GAP, "maximum": _GAP}

    minimum: float = 0.0
    maximum: float | None = None

    @property
    def raises(self) -> frozenset[int]:
        """The numbers of the errors it can raise."""
        return self.raising if self.maximum is None else self.raising | {errors.WRONG_THICKNESS}


class Center(Operation, frozen=True, kw_only=True):
    """Close, moving the hand so that the object is not pushed; error 2 below `minimum` (m)."""

    family: ClassVar = "hand"
    needs: ClassVar = "hand"
    moves: ClassVar = True
    takes_time: ClassVar = True
    raising: ClassVar = action(errors.NOTHING_HELD, errors.JOINT_LIMIT, errors.SERVO_LAG)
    bounds: ClassVar = {"minimum": _GAP}

    minimum: float = 0.0


class Search(Operation, frozen=True, kw_only=True):
    """Set up a spiral search with this step (m) and at most `limit` places; the present place is the first."""

    family: ClassVar = "search"
    bounds: ClassVar = {"step": (1e-5, 0.5), "limit": (1, 10_000)}
    writing: ClassVar = {"search": ()}

    step: float
    limit: int


class Advance(Operation, frozen=True, kw_only=True):
    """Go to the next place of the search (AOJ); error 6 when there is none."""

    family: ClassVar = "search"
    raising: ClassVar = action(errors.SEARCH_EXHAUSTED)
    reading: ClassVar = {"search": ()}


class Test(Operation, frozen=True, kw_only=True):
    """Ask whether the last action raised an error, and clear it.

    `raised`: next step when error `number` was raised (None ends the program); otherwise the step's `next`.
    """

    __test__ = False
    family: ClassVar = "test"
    branches: ClassVar = True

    number: int
    raised: int | None

    @property
    def branch(self) -> Branch | None:
        """The other way."""
        return Branch(self.raised, error=self.number)

    def leading_to(self, target: int | None) -> Self:
        """The same with another target of its branch."""
        return replace(self, raised=target)


class Assign(Operation, frozen=True, kw_only=True):
    """Set a counter."""

    bounds: ClassVar = {"value": (0, 1000)}
    writing: ClassVar = {"counter": ("counter",)}

    counter: str
    value: int


class Countdown(Operation, frozen=True, kw_only=True):
    """Subtract one from a counter (SOJG).

    `positive`: next step while it is still positive (None ends the program); otherwise the step's `next`.
    """

    branches: ClassVar = True
    reading: ClassVar = {"counter": ("counter",)}
    writing: ClassVar = {"counter": ("counter",)}

    counter: str
    positive: int | None

    @property
    def branch(self) -> Branch | None:
        """The other way."""
        return Branch(self.positive, counter=self.counter)

    def leading_to(self, target: int | None) -> Self:
        """The same with another target of its branch."""
        return replace(self, positive=target)


class Jump(Operation, frozen=True, kw_only=True):
    """Go on elsewhere (the step's `next`)."""


class Save(Operation, frozen=True, kw_only=True):
    """Keep the difference actual minus goal of the last Move; after Center only its part along the finger line.

    What a Restore of the same name had added to that goal counts to the difference, so that saving again under
    one name follows a datum that moves.
    """

    family: ClassVar = "search"
    reading: ClassVar = {"goal": ()}
    writing: ClassVar = {"difference": ("name",)}

    name: str


class Here(Operation, frozen=True, kw_only=True):
    """Define a position as where the hand is; one that belongs to a part keeps to it."""

    writing: ClassVar = {"position": ("position",)}

    position: str


class Where(Operation, frozen=True, kw_only=True):
    """Tell where the hand is."""


class Wait(Operation, frozen=True, kw_only=True):
    """Stop, set the brakes, tell the operator."""

    message: str

    @property
    def calls(self) -> str:
        """The message: the operator is always called."""
        return self.message


class Load(Operation, frozen=True, kw_only=True):
    """Declare the weight (N) of what the hand carries, so that the servo compensates it."""

    bounds: ClassVar = {"weight": (-1e3, 1e3)}

    weight: float


class Tool(Operation, frozen=True, kw_only=True):
    """Set the screwdriver's spindle speed, rad/s; 0 is off."""

    family: ClassVar = "hand"
    needs: ClassVar = "screwdriver"
    bounds: ClassVar = {"speed": (-1e3, 1e3)}

    speed: float


class Travel(Operation, frozen=True, kw_only=True):
    """Check how far the last Change went (m): error 8 outside the range."""

    family: ClassVar = "test"
    raising: ClassVar = action(errors.WRONG_TRAVEL)
    only_checks: ClassVar = True
    bounds: ClassVar = {"minimum": (-10.0, 10.0), "maximum": (-10.0, 10.0)}
    reading: ClassVar = {"travel": ()}

    minimum: float
    maximum: float


class Lens(Operation, frozen=True, kw_only=True):
    """Turn the lens turret; focal length in m."""

    family: ClassVar = "sight"
    needs: ClassVar = "camera"
    takes_time: ClassVar = True
    raising: ClassVar = action()
    choices: ClassVar = {"focal_length": LENSES}

    focal_length: float


class Aim(Operation, frozen=True, kw_only=True):
    """Point the camera at a position or part and focus there."""

    family: ClassVar = "sight"
    needs: ClassVar = "camera"
    takes_time: ClassVar = True
    raising: ClassVar = action()
    reading: ClassVar = {"target": ("target",)}

    target: str


class Look(Operation, frozen=True, kw_only=True):
    """Take a picture under a name."""

    family: ClassVar = "sight"
    needs: ClassVar = "camera"
    takes_time: ClassVar = True
    raising: ClassVar = action()
    writing: ClassVar = {"picture": ("picture",)}

    picture: str
    hold_target: bool = False
    """Keep the target voltage of the picture before, as differencing needs."""


class General(Operation, frozen=True, kw_only=True):
    """General location: find the part's outline in the picture; measures where it is, roughly. Else error 30."""

    family: ClassVar = "sight"
    raising: ClassVar = action(errors.PART_NOT_SEEN)
    reading: ClassVar = {"picture": ("picture",)}
    writing: ClassVar = {"part": ("part",)}

    part: str
    picture: str


class Specific(Operation, frozen=True, kw_only=True):
    """Specific location: find the part's holes in the picture; measures its pose. Else error 31."""

    family: ClassVar = "sight"
    raising: ClassVar = action(errors.FEATURES_NOT_SEEN)
    reading: ClassVar = {"part": ("part",), "picture": ("picture",)}
    writing: ClassVar = {"part": ("part",)}

    part: str
    picture: str


class Inspect(Operation, frozen=True, kw_only=True):
    """Difference pictures of a part before and after its gasket was put on; error 32 if that lies wrong."""

    family: ClassVar = "sight"
    raising: ClassVar = action(errors.GASKET_WRONG)
    reading: ClassVar = {"part": ("part",), "picture": ("before", "after")}

    part: str
    before: str
    after: str


AnyOperation = (
    Move | Change | Turn | Open | Close | Center | Search | Advance | Test | Assign | Countdown | Jump | Save
    | Here | Where | Wait | Load | Tool | Travel | Lens | Aim | Look | General | Specific | Inspect
)  # fmt: skip
