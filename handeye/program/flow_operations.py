"""Operations of search, errors, counters and memory, and those that call for load, tool or operator."""

from typing import ClassVar, Self

from msgspec.structs import replace

from handeye.core import errors
from handeye.program.operation import Branch, Operation, action


class Search(Operation, frozen=True, kw_only=True):
    """Set up a search with this step (m) and at most `limit` places, of which the present one is the first.

    The places lie on a square spiral; or on a line, if it is `along` a direction (rad from the table's x).
    """

    family: ClassVar = "search"
    bounds: ClassVar = {"step": (1e-5, 0.5), "limit": (1, 10_000)}
    writing: ClassVar = {"search": ()}

    step: float
    limit: int
    along: float | None = None


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


class Undo(Operation, frozen=True, kw_only=True):
    """Have the arm undo its stage and begin it anew; when that was done `times` since the stage began, go on."""

    bounds: ClassVar = {"times": (1, 100)}

    times: int

    @property
    def undoes(self) -> int:
        """How often."""
        return self.times


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


FlowOperation = (
    Search | Advance | Test | Assign | Countdown | Jump | Save | Here | Where | Wait | Undo | Load | Tool
)
