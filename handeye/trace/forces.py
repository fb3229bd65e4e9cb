"""The forces that the hand exerts on its surroundings during a run, as arrays."""

from collections.abc import Iterable, Sequence
from dataclasses import dataclass, fields, replace
from typing import Any, Final

import numpy as np
from msgspec import UNSET
from numpy.typing import NDArray

from handeye.core.brief import Brief
from handeye.core.pose import Array
from handeye.program.guards import GuardKind
from handeye.trace.hand_message import Axes, GuardMessage, HandMessage, read_hand
from handeye.trace.records import RawMessage
from handeye.trace.stages import Span

NO_VECTOR: Final = (np.nan, np.nan, np.nan)


@dataclass(frozen=True, slots=True, kw_only=True, eq=False, repr=False)
class Forces(Brief):
    """The force that the hand exerts on its surroundings in n servo periods, and the guard of the motion.

    Vectors are in the axes that the task names (`AnyTask.force_axes`). The program estimates forces only during
    guarded and compliant motions. The zero of the estimate is the force at the beginning of the motion. In all other
    periods the values are NaN.
    """

    times: Array  # ends of the servo periods, shape (n,), s
    force: Array  # force that the hand exerts on the world, shape (n, 3), N
    moment: Array  # moment that the hand exerts on the world, about its tool centre point, shape (n, 3), N m
    estimated: NDArray[np.bool_]  # True where force was estimated, shape (n,)
    guard: NDArray[np.str_]
    """Kind of the active guard (the first, if there are several), shape (n,): `force`, `against`, `moment`,
    `torque`, `touch`; empty if there is no guard.
    """
    axis: Array
    """Unit vector along the watched force, or along the axis of the watched moment, shape (n, 3); NaN if the guard
    watches no force or moment.
    """
    value: Array
    """Reading of the guard, shape (n,): force along the axis (N), moment about the axis (N m), torque of the
    screwdriver (N m), or finger switches as a mask; NaN if there is no guard or no record of the reading.
    """
    limit: Array  # limit of the guard, shape (n,); NaN if there is no guard

    def within(self, spans: Sequence[Span]) -> "Forces":
        """Return the forces within the given time spans."""
        inside = np.zeros(len(self.times), dtype=np.bool_)
        for span in spans:
            inside[span.rows(self.times)] = True
        return self._rows(inside)

    def motions(self) -> "tuple[Forces, ...]":
        """Split the forces into motions. Each motion in which forces were estimated gets its own `Forces`, the
        earliest first."""
        known = np.concatenate([[False], self.estimated, [False]])
        borders = np.flatnonzero(known[1:] != known[:-1])
        return tuple(
            self._rows(slice(first, last)) for first, last in zip(borders[::2], borders[1::2], strict=True)
        )

    def _rows(self, rows: "slice | NDArray[np.bool_]") -> "Forces":
        names = [field.name for field in fields(self)]
        columns: dict[str, Any] = {name: getattr(self, name)[rows] for name in names}
        return replace(self, **columns)


def recorded_forces(times: Array, messages: Iterable[RawMessage]) -> Forces:
    """Make the arrays of a `Forces` from messages about the hand. There is one message for each servo period. Raises
    ValueError if messages are missing.
    """
    told = [read_hand(message.data) for message in messages]
    if len(told) != len(times):
        raise ValueError("the number of servo periods and the number of hand forces differ")
    first = [message.guards[0] if message.guards else None for message in told]
    guard = np.array(["" if one is None else one.guard.value for one in first], dtype="<U7")
    force, moment = _vectors(message.force for message in told), _vectors(message.moment for message in told)
    axis = _vectors(UNSET if one is None else one.axis for one in first)
    sensed = [_sensed(message, one) for message, one in zip(told, first, strict=True)]
    return Forces(
        times=times,
        force=force,
        moment=moment,
        estimated=np.array([message.estimated for message in told], dtype=np.bool_),
        guard=guard,
        axis=axis,
        value=looked_at(guard, axis, force, moment, np.array(sensed, dtype=np.float64)),
        limit=np.array([np.nan if one is None else one.limit for one in first], dtype=np.float64),
    )


def looked_at(guard: NDArray[np.str_], axis: Array, force: Array, moment: Array, sensed: Array) -> Array:
    """Return the reading of each guard, shape (n,): a component of force or moment, or another sensed value."""
    pressing = (guard == GuardKind.FORCE) | (guard == GuardKind.AGAINST)
    components = [(force * axis).sum(axis=1), (moment * axis).sum(axis=1)]
    return np.select([pressing, guard == GuardKind.MOMENT], components, default=sensed)


def _sensed(message: HandMessage, guard: GuardMessage | None) -> float:
    """Return the sensed value of a guard that watches neither a force nor a moment."""
    if guard is not None and guard.guard == GuardKind.TORQUE:
        return abs(message.driver_torque)
    if guard is not None and guard.guard == GuardKind.TOUCH:
        return float(message.finger_1 + 2 * message.finger_2)
    return float("nan")


def _vectors(vectors: Iterable[Any]) -> Array:
    """Return vectors as an array of shape (n, 3), with NaN for missing vectors."""
    rows = [(v.x, v.y, v.z) if isinstance(v, Axes) else NO_VECTOR for v in vectors]
    return np.array(rows, dtype=np.float64).reshape(len(rows), 3)
