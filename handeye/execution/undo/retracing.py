"""The reverse path of a step, from the end of the step to its beginning, and the guards that stop the arm on this
path.

The arm stops when the force on the hand has grown too much since the reversal began, in any direction. It also stops
when a closing finger touches an object too early. Closing fingers meet in the middle of the hand. If an object is not
in the middle, one finger touches the object first, while the gap is still too wide. If the fingers closed on such an
object, they would push the object to the middle, or push the arm, and the final gap would look right.
"""

from collections.abc import Callable
from dataclasses import dataclass
from typing import Final

import numpy as np

from handeye.arm.kinematics import forward
from handeye.arm.model import ArmModel
from handeye.arm.samples import Samples
from handeye.core.pose import Array
from handeye.core.units import INCH
from handeye.execution.context import ExecutionContext
from handeye.execution.state import ExecutedStep
from handeye.execution.undo.way import RecordedPath
from handeye.planning.motions import GUARDED_SPEED
from handeye.program.diagnosis.causes import MetEarly
from handeye.program.guards import GuardKind
from handeye.touch.guards import ActiveGuard, Reading, Trip
from handeye.touch.senses import too_early

ALLOWED: Final = 20.0
"""Smallest limit (N) of the guard that stops a reversal if the force on the hand is too great. When the arm lifted a
top off the pins, the sensed force was at most 11 N. When the screws of the top were still fastened, the sensed force
was 36 N in one step, and 108 N in the next.
"""
SHARE: Final = 1.5  # multiple of the force that the step itself met


def allowed(met: float) -> float:
    """Return the force (N) at which a reversal stops, given the greatest force (N) in the step itself."""
    return max(ALLOWED, SHARE * met)


@dataclass(frozen=True, slots=True, kw_only=True)
class Resistance:
    """Trips when the force on the hand exceeds `limit` (N)."""

    limit: float

    def active(self, direction: Array) -> tuple[ActiveGuard, ...]:
        return (ActiveGuard(guard=GuardKind.FORCE, limit=self.limit),)

    def check(self, reading: Reading) -> Trip | None:
        felt = float(np.linalg.norm(reading.force))
        return Trip(guard=GuardKind.FORCE, value=felt, limit=self.limit) if felt > self.limit else None


@dataclass(frozen=True, slots=True, kw_only=True)
class EarlyContact:
    """Trips when a finger touches an object while the gap is still too wide."""

    gap: Callable[[], float]  # present gap, in m
    kept: float  # gap when the step was executed, in m
    holding: bool  # True if the hand held an object at that time

    def active(self, direction: Array) -> tuple[ActiveGuard, ...]:
        return (ActiveGuard(guard=GuardKind.TOUCH, limit=3.0),)

    def check(self, reading: Reading) -> Trip | None:
        if not any(reading.touch) or not too_early(self.gap(), self.kept):
            return None
        first, second = reading.touch
        return Trip(guard=GuardKind.TOUCH, value=float(first + 2 * second), limit=3.0)

    def cause(self, trip: Trip) -> MetEarly:
        """Return the cause of a trip. The fingers must still be where the trip stopped them."""
        closed = int(trip.value)
        fingers = bool(closed & 1), bool(closed & 2)
        return MetEarly(fingers=fingers, gap=round(self.gap(), 6), kept=self.kept, holding=self.holding)


RAMP: Final = 8
"""Length of a ramp, in servo periods. The arm speeds up in one ramp at the start of the reverse path, and slows down
in another at the end. Our choice. A recorded path may lack such a ramp: if a force ended the recorded motion, this
motion did not slow down first.
"""
JOIN: Final = 5e-4
"""Speed (rad or m per servo period) at which the joints move from the present position to the end of the recorded
path, before they retrace this path. The arm can be beside the path if the brakes or a guard stopped the arm.
"""


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class ReturnPath:
    """A reverse path."""

    samples: Samples
    gap: Array  # finger set-points, (N,), in m
    left: Array  # number of set-points of the path left after each, (N,)


def retracing(
    arm: ArmModel, q: Array, gap: float, way: RecordedPath, *, slowly: bool, feeling: bool = False
) -> ReturnPath:
    """Make the reverse path from the present position of the arm and the fingers. If `slowly` is True, the motion
    is at most as fast as guarded motions.

    If `feeling` is True, the fingers close at most at the speed of centring. Faster fingers would push a loose object
    ahead of them, and the switches of the fingers would usually not report the contact.
    """
    rows = np.column_stack([way.q, way.gap])[::-1]
    here = np.append(q, gap)
    joining = max(
        1, int(np.ceil(np.abs(rows[0] - here)[:-1].max() / JOIN))
    )  # servo periods to the end of the path
    joined = here + np.linspace(0.0, 1.0, joining, endpoint=False)[:, None] * (rows[0] - here)
    path = np.vstack([joined, rows])
    last, period = len(path) - 1, arm.servo.period
    periods = np.ones(last)
    if slowly:
        went = np.linalg.norm(np.diff(forward(arm, path[:, :-1])[:, :3, 3], axis=0), axis=1)
        periods = np.maximum(1.0, went / (GUARDED_SPEED * period))
    if feeling:
        periods = np.maximum(periods, -np.diff(path[:, -1]) / (arm.hand.grasp.centring * period))
    whole, rise = float(periods.sum()), (np.arange(RAMP) + 1) / (RAMP + 1)
    gone = np.cumsum(np.concatenate([rise, np.ones(int(np.ceil(whole))), rise[::-1]]))
    clock = np.append(0.0, gone * (whole / gone[-1]))  # elapsed time, in periods, with smooth start and end
    places = np.interp(clock, np.append(0.0, np.cumsum(periods)), np.arange(last + 1))
    points = np.column_stack([np.interp(places, np.arange(last + 1), column) for column in path.T])
    at = points[1:, :-1]
    qd = np.gradient(points[:, :-1], period, axis=0)[1:]
    qd[-1] = 0.0
    left = np.minimum(np.floor(last - places[1:]).astype(int), len(way) - 1)
    return ReturnPath(samples=Samples(q=at, qd=qd, qdd=np.zeros_like(at)), gap=points[1:, -1], left=left)


FALLEN: Final = 0.31 * INCH
"""Greatest distance (m) from the place of the grasp at which resistance to a reversal means that the held object
stands on its support. The object may have fallen before the fingers held it again, and we allow for a fall by this
distance. The gasket of the pump determines the limit: the fingers reach .25 in through the gasket (`[gasket_stand]`),
which is .06 in thick. If the gasket had fallen much farther, the fingers could not hold it again. In the worlds of
seeds 8128 and 8124, the gasket fell by 6.0 and 6.7 mm. In the world of seed 8724, the gasket fell by 8.05 mm and the
fingers still held it, but the limit stops the reversal: it has no margin for the error in the height of the arm.
"""


def stands(run: ExecutionContext, way: RecordedPath, grasps: Callable[[ExecutedStep], bool]) -> bool:
    """After a guard has stopped a reversal, return True if the held object must be standing on a surface. This is the
    case if the path leads to the place where the object was grasped, and the hand has nearly reached this place.

    `grasps` returns True if a step grasps an object, or grips it more firmly.
    """
    if not run.state.grasping or not _grasped_before(run, grasps):
        return False
    ahead = forward(run.arm, run.drive.state.q)[:3, 3] - forward(run.arm, way.q[0])[:3, 3]
    return float(np.linalg.norm(ahead)) <= FALLEN


def where_the_hand_is(run: ExecutionContext, way: RecordedPath) -> RecordedPath:
    """Shift the path of a grasp to the present position of the arm. The arm may now be higher than the path."""
    return RecordedPath(q=way.q + (run.drive.state.q - way.q[-1]), gap=way.gap)


def _grasped_before(run: ExecutionContext, grasps: Callable[[ExecutedStep], bool]) -> bool:
    """Return True if only the fingers moved between the grasp and the last step."""
    for done in reversed(run.state.done[:-1]):
        if not done.way:
            continue
        if not grasps(done):
            return False
        if not done.grasping:
            return True
    return False
