"""The gap of the hand and the object in the hand, as far as the program determines them."""

from dataclasses import dataclass, field

from handeye.arm.model import HandModel
from handeye.core.obb import Box
from handeye.core.record import Record
from handeye.program.motion_operations import Center, Close, Move, Open
from handeye.program.program import Program, Step


@dataclass(slots=True)
class GraspState:
    """The state of the hand after a sequence of steps. At first the hand is closed and empty."""

    program: Program
    hand: HandModel
    gap: float = 0.0  # m; after a grasp, its minimum
    closed_at: str | None = None  # position at which it has closed since it was last opened
    held: str | None = None
    taken: int | None = None  # the step that grasped it
    _goal: str = ""
    _holds: dict[str, str] = field(init=False)

    def __post_init__(self) -> None:
        self._holds = {at: name for name, held in self.program.held.items() for at in held.positions}

    def follow(self, number: int, step: Step) -> None:
        """Apply the effect of a step."""
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
        """Boxes of the hand, in the tool frame T."""
        return self.hand.boxes(self.gap)

    @property
    def load(self) -> tuple[Box, ...]:
        """Boxes of the held object, in the tool frame T; empty if the hand is empty."""
        return () if self.held is None else self.program.held[self.held].boxes


class FirstGrasp(Record, frozen=True, kw_only=True):
    """A grasp at a position, and the gap (m) of the fingers before the grasp."""

    position: str
    gap: float


def first_grasp(program: Program, hand: HandModel, after: int, part: str) -> FirstGrasp | None:
    """Find the first grasp at a position of a part. A grasp counts only if its step comes after step `after` in the
    text. Returns None if there is no such grasp.
    """
    state = GraspState(program, hand)
    for number, step in enumerate(program.steps):
        gap, grasped = state.gap, state.closed_at is not None
        state.follow(number, step)
        position = state.closed_at
        if number > after and position and not grasped and program.positions[position].of == part:
            return FirstGrasp(position=position, gap=gap)
    return None
