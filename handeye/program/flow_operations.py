"""Operations on searches, errors, counters and memory, and on load, tool and operator."""

from typing import ClassVar, Self

from msgspec.structs import replace

from handeye.core import errors
from handeye.program.operation import Branch, Operation, action


class Search(Operation, frozen=True, kw_only=True):
    """Set up a search with this step (m) and at most `limit` places, the first being the present one.

    The places lie on a square spiral, or on a line if it is `along` a direction (rad from table x).
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
    """Test for error `number` of the last action, and clear it; `raised` is the next step then (None: the end)."""

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
    """Subtract one from a counter (SOJG); `positive` is the next step while it is positive (None: the end)."""

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
    """Continue at the step's `next`."""


class Save(Operation, frozen=True, kw_only=True):
    """Save the difference actual minus goal of the last Move; after Center only its part along the finger line.

    A Restore of the same name in that goal counts to the difference, so that saving again under one name
    follows a datum that moves.
    """

    family: ClassVar = "search"
    reading: ClassVar = {"goal": ()}
    writing: ClassVar = {"difference": ("name",)}

    name: str


class Here(Operation, frozen=True, kw_only=True):
    """Define a position as the present hand pose, relative to its part if it has one."""

    writing: ClassVar = {"position": ("position",)}

    position: str


class Where(Operation, frozen=True, kw_only=True):
    """Show the hand pose."""


class Wait(Operation, frozen=True, kw_only=True):
    """Stop, set the brakes and call the operator."""

    message: str

    @property
    def calls(self) -> str:
        return self.message


class Undo(Operation, frozen=True, kw_only=True):
    """Reverse the stage and repeat it; after `times` reversals since the stage began, continue."""

    bounds: ClassVar = {"times": (1, 100)}

    times: int

    @property
    def undoes(self) -> int:
        return self.times


class Load(Operation, frozen=True, kw_only=True):
    """Declare the weight (N) in the hand, for the servo to compensate."""

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
