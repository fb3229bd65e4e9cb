"""Planning findings: facts in SI units, each at a step; a language words them."""

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
    """No joint positions exist for a goal, or at a distance `along` (m) on the way to it."""

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
    """The hand, or what it holds, would pass through a fixture or the table."""

    step: int
    position: str | None  # the goal, if deepest there
    fixture: str | None  # None: the table
    depth: float  # m, at most
    along: float  # m travelled when deepest
    at_end: bool  # deepest at the end of the motion
    held: str | None  # what the hand holds there; None: the hand itself
    grasp: int | None  # the step that grasped it

    @property
    def code(self) -> str:
        who = "hand" if self.held is None else "carries"
        return f"{who}-through-{'table' if self.fixture is None else 'fixture'}"


class TooHeavy(Record, frozen=True, kw_only=True):
    """A load of `weight` (N) cannot be held up; `joint`, from 0, fails first, at `most` (N)."""

    step: int
    weight: float
    declared: int  # the step that declares the load
    joint: int
    most: float
    position: None = None
    code: str = "load-beyond-arm"


class TooWeak(Record, frozen=True, kw_only=True):
    """A force or moment is beyond the arm; `joint`, from 0, fails first, at `most` (N, N m)."""

    step: int
    exerted: HandLoad
    guard: bool  # a guard waits for it, and can never trip
    joint: int
    most: float
    position: None = None

    @property
    def code(self) -> str:
        return "stop-beyond-arm" if self.guard else "force-beyond-arm"


class TooFaint(Record, frozen=True, kw_only=True):
    """A guard's threshold is hard to distinguish from joint friction: `felt` (N, N m) can be felt there in free air."""

    step: int
    exerted: HandLoad
    felt: float
    position: None = None

    @property
    def code(self) -> str:
        return "faint-moment" if self.exerted.turning else "faint-force"


PlanFinding = NoConfiguration | GoalBelowTable | RunsInto | TooHeavy | TooWeak | TooFaint
