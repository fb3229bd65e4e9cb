"""Which errors an operation can raise: what the acting and the looking of the working phase come back with."""

from typing import Final

from handeye import errors
from handeye.program import program as op

_MOTION: Final = frozenset({errors.JOINT_LIMIT, errors.NO_SOLUTION, errors.SERVO_LAG})
_BY_KIND: Final[dict[type, frozenset[int]]] = {
    op.Move: _MOTION,
    op.Change: _MOTION,
    op.Turn: _MOTION,
    op.Close: frozenset({errors.NOTHING_HELD}),
    op.Center: frozenset({errors.NOTHING_HELD, errors.JOINT_LIMIT, errors.SERVO_LAG}),
    op.Advance: frozenset({errors.SEARCH_EXHAUSTED}),
    op.Travel: frozenset({errors.WRONG_TRAVEL}),
    op.General: frozenset({errors.PART_NOT_SEEN}),
    op.Specific: frozenset({errors.FEATURES_NOT_SEEN}),
    op.Inspect: frozenset({errors.GASKET_WRONG}),
}


def unmet(stop: op.Stop) -> int:
    """The error of a motion that ends without meeting what was to stop it."""
    if stop.touch is not None:
        return errors.NO_TOUCH
    return errors.NO_FORCE if stop.torque is None else errors.NO_TORQUE


def raises(operation: op.AnyOperation) -> frozenset[int]:
    """The error numbers an operation can raise; none for what is no action."""
    if not isinstance(operation, op.ACTIONS):
        return frozenset()
    found = {errors.WATCHDOG, *_BY_KIND.get(type(operation), ())}
    stop = getattr(operation, "stop", None)
    if stop is not None:
        found.add(unmet(stop))
    if isinstance(operation, op.Close) and operation.maximum is not None:
        found.add(errors.WRONG_THICKNESS)
    return frozenset(found)
