"""Findings of the planner against a program: facts in SI units, each at a step. A language puts them into its words."""

from dataclasses import dataclass

from handeye.program.guards import Exerted
from handeye.program.reasons import (
    BelowTable,
    InLine,
    JointLimit,
    Reason,
    TooFast,
)


@dataclass(frozen=True, slots=True, kw_only=True)
class NoConfiguration:
    """There are no joint positions for a goal, or for the way to it."""

    step: int
    position: str | None
    """The goal, or what the motion is led by; None: it is about the motion."""
    reason: Reason
    along: float | None = None
    """How far along the way of the hand it is, m; None: at the position."""

    @property
    def code(self) -> str:
        """Code of its diagnostic."""
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


@dataclass(frozen=True, slots=True, kw_only=True)
class GoalBelowTable:
    """A goal is below the table top."""

    step: int
    position: str
    depth: float
    """m"""
    code: str = "hand-through-table"


@dataclass(frozen=True, slots=True, kw_only=True)
class RunsInto:
    """The hand, or what it holds, would go through something."""

    step: int
    position: str | None
    """The goal, if it is there that it is deepest."""
    fixture: str | None
    """None: the table."""
    depth: float
    """How deep at most, m."""
    along: float
    """How far the hand has gone when it is deepest, m."""
    at_end: bool
    """It is deepest at the end of the motion."""
    held: str | None
    """Name of what the hand holds and leads there; None: the hand itself."""
    grasp: int | None
    """The step that took it."""

    @property
    def code(self) -> str:
        """Code of its diagnostic."""
        who = "hand" if self.held is None else "carries"
        return f"{who}-through-{'table' if self.fixture is None else 'fixture'}"


@dataclass(frozen=True, slots=True, kw_only=True)
class TooHeavy:
    """A load cannot be held up on a motion."""

    step: int
    weight: float
    """N"""
    declared: int
    """The step that says what the load weighs."""
    joint: int
    """The one that gives out first, from 0."""
    most: float
    """The most that could be held up, N."""
    position: None = None
    code: str = "load-beyond-arm"


@dataclass(frozen=True, slots=True, kw_only=True)
class TooWeak:
    """A force or moment that the hand is to exert, or that a guard waits for, is beyond the arm."""

    step: int
    exerted: Exerted
    guard: bool
    """A guard waits for it, and would never be met."""
    joint: int
    """The one that gives out first, from 0."""
    most: float
    """How large it could be, N or N m."""
    position: None = None

    @property
    def code(self) -> str:
        """Code of its diagnostic."""
        return "stop-beyond-arm" if self.guard else "force-beyond-arm"


@dataclass(frozen=True, slots=True, kw_only=True)
class TooFaint:
    """A guard waits for a force or moment that is hard to tell from the friction expected of the joints."""

    step: int
    exerted: Exerted
    friction: float
    """What friction can be felt as there, N or N m."""
    margin: float
    """So many times that would be clear of it."""
    position: None = None

    @property
    def code(self) -> str:
        """Code of its diagnostic."""
        return "faint-moment" if self.exerted.turning else "faint-force"


PlanningFinding = NoConfiguration | GoalBelowTable | RunsInto | TooHeavy | TooWeak | TooFaint
