"""Operations that do not move the arm. These operations control searches, test for errors, change counters, save
differences and positions, declare the load, set the tool and call the operator.
"""

from typing import ClassVar, Self

from msgspec.structs import replace

from handeye.core import errors
from handeye.program.operation import Branch, Operation, action


class Search(Operation, frozen=True, kw_only=True):
    """Start a search with steps of `step` (m) and at most `limit` places. The present place is the first place of the
    search.

    Without `along`, the places lie on a square spiral. If `along` (rad from table x) is given, the places lie on a
    line in that direction.
    """

    family: ClassVar = "search"
    bounds: ClassVar = {"step": (1e-5, 0.5), "limit": (1, 10_000)}
    writing: ClassVar = {"search": ()}

    step: float
    limit: int
    along: float | None = None


class Advance(Operation, frozen=True, kw_only=True):
    """Go to the next place of the search (AOJ). Raises error 6 if there is no next place."""

    family: ClassVar = "search"
    raising: ClassVar = action(errors.SEARCH_EXHAUSTED)
    reading: ClassVar = {"search": ()}


class Test(Operation, frozen=True, kw_only=True):
    """Test if the last action raised error `number`, and clear the error. If the error was raised, the program
    continues with step `raised`, or ends if `raised` is None. If the error was not raised, the program continues with
    the next step.
    """

    __test__ = False
    family: ClassVar = "test"
    branches: ClassVar = True

    number: int
    raised: int | None

    @property
    def branch(self) -> Branch | None:
        return Branch(self.raised, error=self.number)

    def leading_to(self, target: int | None) -> Self:
        return replace(self, raised=target)


class Assign(Operation, frozen=True, kw_only=True):
    """Set a counter."""

    bounds: ClassVar = {"value": (0, 1000)}
    writing: ClassVar = {"counter": ("counter",)}

    counter: str
    value: int


class Countdown(Operation, frozen=True, kw_only=True):
    """Decrement a counter (SOJG). If the counter is still positive, the program continues with step `positive`, or
    ends if `positive` is None.
    """

    branches: ClassVar = True
    reading: ClassVar = {"counter": ("counter",)}
    writing: ClassVar = {"counter": ("counter",)}

    counter: str
    positive: int | None

    @property
    def branch(self) -> Branch | None:
        return Branch(self.positive, counter=self.counter)

    def leading_to(self, target: int | None) -> Self:
        return replace(self, positive=target)


class Jump(Operation, frozen=True, kw_only=True):
    """Continue at the step `next`."""


class Save(Operation, frozen=True, kw_only=True):
    """Save the difference between the actual position of the hand and the goal of the last Move. After a Center, save
    only the component of the difference along the finger line (the line through both finger tips).

    If the goal already contains a Restore of the difference `name`, the restored shift is part of the new difference.
    A program can therefore follow a place that moves, if it saves the same difference repeatedly.
    """

    family: ClassVar = "search"
    reading: ClassVar = {"goal": ()}
    writing: ClassVar = {"difference": ("name",)}

    name: str


class Here(Operation, frozen=True, kw_only=True):
    """Give a position the present pose of the hand. If the position belongs to a part, the pose is stored relative to
    the part.
    """

    writing: ClassVar = {"position": ("position",)}

    position: str


class Where(Operation, frozen=True, kw_only=True):
    """Report the hand pose."""


class Wait(Operation, frozen=True, kw_only=True):
    """Stop, set the brakes and call the operator."""

    message: str

    @property
    def calls(self) -> str:
        return self.message


class Undo(Operation, frozen=True, kw_only=True):
    """Reverse the present stage, and then repeat the stage. The program can do this `times` times after a stage has
    begun. After that, it continues with the next step instead.
    """

    bounds: ClassVar = {"times": (1, 100)}

    times: int

    @property
    def undoes(self) -> int:
        return self.times


class Load(Operation, frozen=True, kw_only=True):
    """Declare the weight (N) in the hand. The servo then compensates the weight."""

    bounds: ClassVar = {"weight": (-1e3, 1e3)}

    weight: float


class Tool(Operation, frozen=True, kw_only=True):
    """Set the speed of the screwdriver's spindle (rad/s); 0 switches it off."""

    family: ClassVar = "hand"
    needs: ClassVar = "screwdriver"
    bounds: ClassVar = {"speed": (-1e3, 1e3)}

    speed: float


FlowOperation = (
    Search | Advance | Test | Assign | Countdown | Jump | Save | Here | Where | Wait | Undo | Load | Tool
)
