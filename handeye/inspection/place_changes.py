"""Changes of positions and parts between two plans."""

from typing import Final, Literal

import numpy as np

from handeye.core.pose import Pose, hand, planar
from handeye.core.record import Record
from handeye.program.program import Part, Position, Program

_ALIKE: Final = 1e-9
"""m: below this, two places differ by rounding."""
_LEAST_TURN: Final = 1e-6
"""rad: an arc cosine near 1 is no better."""


class PlaceChange(Record, frozen=True, kw_only=True):
    """A position or part that is new, gone, or elsewhere."""

    kind: Literal["added", "removed", "moved", "changed"]
    what: Literal["position", "part"]
    name: str
    shift: tuple[float, float, float] = (0.0, 0.0, 0.0)
    """m, in table coordinates or those of the part it belongs to."""
    turn: float = 0.0
    """rad"""


def place_changes(before: Program, after: Program) -> list[PlaceChange]:
    """The positions and parts that are new, gone, or elsewhere."""
    found = [
        _placed("part", n, before.parts.get(n), after.parts.get(n)) for n in {**before.parts, **after.parts}
    ]
    names = {**before.positions, **after.positions}
    found += [_placed("position", n, before.positions.get(n), after.positions.get(n)) for n in names]
    return [change for change in found if change is not None]


def _placed(
    what: Literal["position", "part"], name: str, one: Position | Part | None, other: Position | Part | None
) -> PlaceChange | None:
    if one == other:
        return None
    if one is None or other is None:
        return PlaceChange(kind="added" if one is None else "removed", what=what, name=name)
    X_one, X_other = _pose(one), _pose(other)
    shift = X_other[:3, 3] - X_one[:3, 3]
    x, y, z = (float(value) for value in np.where(np.abs(shift) > _ALIKE, shift, 0.0))
    R = X_one[:3, :3].T @ X_other[:3, :3]
    turn = float(np.arccos(np.clip((np.trace(R) - 1) / 2, -1, 1)))
    moved = (x, y, z) != (0, 0, 0) or turn > _LEAST_TURN
    if one.at == other.at or _part(one) != _part(other) or not moved:
        return PlaceChange(kind="changed", what=what, name=name)
    return PlaceChange(
        kind="moved", what=what, name=name, shift=(x, y, z), turn=turn if turn > _LEAST_TURN else 0.0
    )


def _part(place: Position | Part) -> str | None:
    """The part that a position belongs to."""
    return place.of if isinstance(place, Position) else None


def _pose(place: Position | Part) -> Pose:
    return planar(*place.at) if isinstance(place, Part) else hand(*place.at)
