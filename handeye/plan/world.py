"""The world as the program believes it: for each part a planned pose and, once seen or felt, a measured one."""

from dataclasses import dataclass, field

from handeye.errors import InvalidInput
from handeye.plan.program import Part, Position, Program
from handeye.pose import Pose, hand, planar


def planned_pose(part: Part) -> Pose:
    """`X_WP` as the drawing has it."""
    return planar(*part.at)


@dataclass(slots=True, kw_only=True)
class WorldModel:
    """The one mutable picture of the cell; only the executor writes to it."""

    parts: dict[str, Part]
    positions: dict[str, Position]
    measured: dict[str, Pose] = field(default_factory=dict)
    moved: dict[str, Position] = field(default_factory=dict)
    """Positions that somebody has put elsewhere for an experiment."""

    @classmethod
    def of(cls, program: Program) -> "WorldModel":
        """The world as planned, nothing measured yet."""
        return cls(parts=program.parts, positions=program.positions)

    def measure(self, part: str, X_WP: Pose) -> None:
        """A part has been seen or felt at this pose."""
        if part not in self.parts:
            raise InvalidInput(f"no part {part}; there are {', '.join(self.parts)}")
        self.measured[part] = X_WP

    def part(self, name: str) -> Pose:
        """`X_WP`, measured if it has been, else planned."""
        measured = self.measured.get(name)
        return planned_pose(self.parts[name]) if measured is None else measured

    def position(self, name: str) -> Pose:
        """`X_WT` of a hand position, by the measured pose of the part it belongs to."""
        position = self.moved.get(name) or self.positions[name]
        X_PT = hand(*position.at)
        return X_PT if position.of is None else self.part(position.of) @ X_PT

    def planned_position(self, name: str) -> Pose:
        """`X_WT` of a hand position, by planned poses alone."""
        position = self.positions[name]
        X_PT = hand(*position.at)
        return X_PT if position.of is None else planned_pose(self.parts[position.of]) @ X_PT
