"""Findings of the planner, as facts in SI units. Each finding belongs to a step. The sentences for the findings are
part of each language.
"""

from handeye.core.record import Record
from handeye.program.diagnosis.reach import (
    BelowTable,
    InLine,
    JointLimit,
    ReachFailure,
    TooFast,
)
from handeye.program.guards import HandLoad


class NoConfiguration(Record, frozen=True, kw_only=True):
    """There are no joint positions for a goal, or for a point on the way to the goal. `along` (m) is the distance of
    this point from the start.
    """

    step: int
    position: str | None  # the goal or via point; None: the finding is about the motion
    reason: ReachFailure
    along: float | None = None

    @property
    def code(self) -> str:
        on_the_way = self.along is not None
        match self.reason:
            case JointLimit():
                return "joint-limit"
            case InLine() if on_the_way:
                return "wrist-in-line"
            case TooFast() if on_the_way:
                return "joint-too-fast"
            case BelowTable() if not on_the_way:
                return "hand-through-table"
        return "path-leaves-reach" if on_the_way else "unreachable-position"


class GoalBelowTable(Record, frozen=True, kw_only=True):
    """A goal is `depth` (m) below the table top."""

    step: int
    position: str
    depth: float
    code: str = "hand-through-table"


class RunsInto(Record, frozen=True, kw_only=True):
    """The hand, or the object that it holds, would collide with a fixture or the table."""

    step: int
    position: str | None  # the goal, if deepest there
    fixture: str | None  # None: the table
    depth: float  # m, at most
    along: float  # m travelled up to the deepest point
    at_end: bool  # True if the deepest point is the end of the motion
    held: str | None  # the held object that would collide; None: the hand itself
    grasp: int | None  # the step that grasped it

    @property
    def code(self) -> str:
        who = "hand" if self.held is None else "carries"
        return f"{who}-through-{'table' if self.fixture is None else 'fixture'}"


class TooHeavy(Record, frozen=True, kw_only=True):
    """The arm cannot hold a load of `weight` (N). The joint `joint` (from 0) limits the load to `most` (N)."""

    step: int
    weight: float
    declared: int  # the step that declares the load
    joint: int
    most: float
    position: None = None
    code: str = "load-beyond-arm"


class TooWeak(Record, frozen=True, kw_only=True):
    """The arm cannot exert a force or moment. The joint `joint` (from 0) limits the force or moment to `most` (N or N
    m).
    """

    step: int
    exerted: HandLoad
    guard: bool  # True if a guard waits for this force or moment; it could never trip
    joint: int
    most: float
    position: None = None

    @property
    def code(self) -> str:
        return "stop-beyond-arm" if self.guard else "force-beyond-arm"


class TooFaint(Record, frozen=True, kw_only=True):
    """The limit of a guard is so low that the arm can hardly distinguish it from joint friction. At the start of the
    motion, friction alone may make the arm sense up to `felt` (N or N m).
    """

    step: int
    exerted: HandLoad
    felt: float
    position: None = None

    @property
    def code(self) -> str:
        return "faint-moment" if self.exerted.turning else "faint-force"


PlanFinding = NoConfiguration | GoalBelowTable | RunsInto | TooHeavy | TooWeak | TooFaint
