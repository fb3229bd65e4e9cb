"""The world model: the planned pose of each part and, if vision or touch has measured the part, the measured pose."""

from dataclasses import dataclass, field

import msgspec

from handeye.core.errors import NoSuchName
from handeye.core.mutable_records import MutableRecord
from handeye.core.pose import Pose, hand, hand_angles, inverse, planar
from handeye.program.program import Part, Position, Program


def planned_pose(part: Part) -> Pose:
    """Return the planned pose `X_WP` of a part."""
    return planar(*part.at)


def rounded_place(X: Pose) -> tuple[float, float, float, float, float, float]:
    """Return x, y, z (m) and the angles O, A, T (rad) of a hand pose, rounded to 1e-6."""
    x, y, z, o, a, t = (round(float(value), 6) + 0.0 for value in (*X[:3, 3], *hand_angles(X)))
    return x, y, z, o, a, t


class WorldState(MutableRecord, kw_only=True):
    """How the cell differs from the plan: measured part poses `X_WP`, and redefined positions."""

    measured: dict[str, Pose] = msgspec.field(default_factory=dict)
    moved: dict[str, Position] = msgspec.field(default_factory=dict)


@dataclass(slots=True, kw_only=True)
class WorldModel:
    """The cell as the program believes it to be. Only the executor changes this model."""

    parts: dict[str, Part]
    positions: dict[str, Position]
    state: WorldState = field(default_factory=WorldState)

    @classmethod
    def of(cls, program: Program, state: WorldState | None = None) -> "WorldModel":
        """Make the model of a program. `state` gives the differences from the plan. By default, there are no
        differences.
        """
        return cls(parts=program.parts, positions=program.positions, state=state or WorldState())

    def measure(self, part: str, X_WP: Pose) -> None:
        if part not in self.parts:
            raise NoSuchName(f"there is no part {part}; the parts are {', '.join(self.parts)}")
        self.state.measured[part] = X_WP

    def part(self, name: str) -> Pose:
        """Return the pose `X_WP` of a part: the measured pose, or else the planned pose."""
        measured = self.state.measured.get(name)
        return planned_pose(self.parts[name]) if measured is None else measured

    def position(self, name: str) -> Pose:
        """Return the pose `X_WT` of a hand position. It is computed from the present pose of the part to which the
        position belongs.
        """
        position = self.state.moved.get(name) or self.positions[name]
        X_PT = hand(*position.at)
        return X_PT if position.of is None else self.part(position.of) @ X_PT

    def seen_from(self, part: str | None, X_WT: Pose) -> Position:
        """Express the hand pose `X_WT` as a position relative to a part, or in table coordinates if `part` is None."""
        return Position(at=rounded_place(X_WT if part is None else inverse(self.part(part)) @ X_WT), of=part)

    def planned_position(self, name: str) -> Pose:
        """Return the planned pose `X_WT` of a hand position. It is computed from planned poses only."""
        position = self.positions[name]
        X_PT = hand(*position.at)
        return X_PT if position.of is None else planned_pose(self.parts[position.of]) @ X_PT
