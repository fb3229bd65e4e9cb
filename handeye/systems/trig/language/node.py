"""Node: one step of a program, with its sons and fathers."""

from collections.abc import Mapping
from dataclasses import dataclass, field
from typing import Final, Literal, get_args

from handeye.core.record import Vector3

NodeType = Literal["top", "none", "normal", "guarded", "grasp", "ungrasp", "savpos", "loop", "bloop"]
TYPES: Final[tuple[NodeType, ...]] = get_args(NodeType)
TOP: Final = 0
"""The node above the first step."""
NONE: Final = -1
"""The son of every branch that leads nowhere: the end."""
NORMAL: Final = 0
"""The branch of a guarded move that has reached its goal, and the only one of other steps."""
GUARDED: Final = 1
"""The branch of a guarded move that a force has stopped."""
UNNAMED: Final = "***"
"""What stands in the place of the name of a step that has none."""
TOP_NAME: Final = "**TOP**"


@dataclass(slots=True, kw_only=True, eq=False)
class Node:
    """One step. What it means for the arm stands in it; how it hangs together with others is the graph's to change."""

    id: int
    type: NodeType
    name: str | None = None
    position: str | None = None
    negate: bool = False
    """It goes the other way of its relative position."""
    threshold: float | None = None
    """N; a force beyond it, weighed by the vector, stops a guarded move."""
    vector: Vector3 | None = None
    """Weights of the force on the finger, along the arm's X, Y and Z."""
    partner: int = NONE
    """The bloop of a loop, the loop of a bloop."""
    wanted: int = 0
    """How often a loop goes back."""
    count: int = 0
    """How often it has."""
    sons: list[int] = field(default_factory=lambda: [NONE])
    """One a branch."""
    links: set[int] = field(default_factory=set)
    """Branches that lead to a step which is drawn elsewhere."""
    fathers: list[int] = field(default_factory=list)
    last_father: int = NONE
    """The father that was last active, in a run or in editing."""
    comment: str | None = None
    unread: Mapping[str, object] = field(default_factory=dict)
    """What a file says of it that this version does not know."""

    @property
    def shown(self) -> bool:
        """It is a step that people see: neither a bloop nor one of the two ends."""
        return self.type not in ("top", "none", "bloop")

    @property
    def moves(self) -> bool:
        """It takes the arm to a position."""
        return self.type in ("normal", "guarded")

    @property
    def recent_father(self) -> int:
        """The father that was last active; where that is none any more, the one that came last."""
        if self.last_father in self.fathers:
            return self.last_father
        return self.fathers[-1] if self.fathers else NONE
