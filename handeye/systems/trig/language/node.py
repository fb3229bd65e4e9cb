"""A step of a program, with its sons and fathers."""

from collections.abc import Mapping
from dataclasses import dataclass, field
from typing import Final, Literal, get_args

from handeye.core.record import Vector3

NodeType = Literal["top", "none", "normal", "guarded", "grasp", "ungrasp", "savpos", "loop", "bloop"]
TYPES: Final[tuple[NodeType, ...]] = get_args(NodeType)
TOP: Final = 0  # id of the node above the first step
NONE: Final = -1  # son of a branch that ends
NORMAL: Final = 0  # branch of a completed move, and the only one of other steps
GUARDED: Final = 1  # branch of a move stopped by a force
UNNAMED: Final = "***"  # shown for a step without a name
TOP_NAME: Final = "**TOP**"


@dataclass(slots=True, kw_only=True, eq=False)
class Node:
    """One step. Its edges are changed by the graph only."""

    id: int
    type: NodeType
    name: str | None = None
    position: str | None = None
    negate: bool = False  # opposite of its relative position
    threshold: float | None = None  # N; a greater weighted force stops a guarded move
    vector: Vector3 | None = None  # weights of the finger force along the arm's X, Y and Z
    partner: int = NONE  # bloop of a loop, loop of a bloop
    wanted: int = 0  # rounds of a loop
    count: int = 0  # rounds done
    sons: list[int] = field(default_factory=lambda: [NONE])  # one per branch
    links: set[int] = field(default_factory=set)  # branches to a step drawn elsewhere
    fathers: list[int] = field(default_factory=list)
    last_father: int = NONE  # the last active one, in a run or in editing
    comment: str | None = None
    unread: Mapping[str, object] = field(default_factory=dict)  # file fields unknown to this version

    @property
    def shown(self) -> bool:
        """True if it is visible: neither a bloop nor an end."""
        return self.type not in ("top", "none", "bloop")

    @property
    def moves(self) -> bool:
        """True if it moves the arm."""
        return self.type in ("normal", "guarded")

    @property
    def recent_father(self) -> int:
        """The last active father, else the newest one."""
        if self.last_father in self.fathers:
            return self.last_father
        return self.fathers[-1] if self.fathers else NONE
