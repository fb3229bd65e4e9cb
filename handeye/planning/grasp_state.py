"""The state of the hand, as far as the program tells: how wide it is open, and what it holds."""

from dataclasses import dataclass, field

from handeye.arm.hand import HandModel
from handeye.core.obb import Box
from handeye.program.motion_operations import Center, Close, Move, Open
from handeye.program.program import Program, Step


@dataclass(slots=True)
class GraspState:
    """The hand after the steps it has followed; at first closed and empty."""

    program: Program
    hand: HandModel
    gap: float = 0.0
    """m; after a grasp the least thickness that the program asks of the thing, for it says no more."""
    closed_at: str | None = None
    """The position at which it has closed since it was last opened; empty: none."""
    held: str | None = None
    taken: int | None = None
    """The step by which it is held."""
    _goal: str = ""
    _holds: dict[str, str] = field(init=False)

    def __post_init__(self) -> None:
        self._holds = {at: name for name, held in self.program.held.items() for at in held.positions}

    def follow(self, number: int, step: Step) -> None:
        """Take over what a step does to the hand, and to what is in it."""
        match step.operation:
            case Move(goal=goal):
                self._goal = goal
            case Open(gap=gap):
                self.gap, self.closed_at, self.held, self.taken = gap, None, None, None
            case Close(minimum=least) | Center(minimum=least):
                self.gap = least
                if self.closed_at is None:
                    self.closed_at = self._goal
                if self.held is None and self._goal in self._holds:
                    self.held, self.taken = self._holds[self._goal], number

    @property
    def fingers(self) -> tuple[Box, ...]:
        """The hand, as boxes in T."""
        return self.hand.boxes(self.gap)

    @property
    def load(self) -> tuple[Box, ...]:
        """The thing it holds, as boxes in T."""
        return () if self.held is None else self.program.held[self.held].boxes
