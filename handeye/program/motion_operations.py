"""Operations that move the arm or the hand, and operations that check how far the hand moved."""

import math
from typing import Annotated, ClassVar, Final

from msgspec import Meta

from handeye.core import errors
from handeye.core.record import Record, Vector3
from handeye.program.guards import FORCE, Bounds, GuardKind, Guards, unmet
from handeye.program.operation import Operation, Use, action

VIAS: Final = 4  # via points of a motion, at most
_LENGTH: Final[Bounds] = (1e-6, 10.0)  # m
_GAP: Final[Bounds] = (0.0, 0.2)  # m


class Restore(Record, frozen=True, kw_only=True):
    """Shifts the goal of a motion by a saved difference. If `level` is True, the shift is only horizontal."""

    name: str
    level: bool = False  # horizontal components only


class ArmMotion(Operation, frozen=True, kw_only=True):
    """Base class of arm motions. A motion with guards raises an error if none of its guards trips."""

    family: ClassVar = "motion"
    moves: ClassVar = True
    takes_time: ClassVar = True
    raising: ClassVar = action(
        errors.JOINT_LIMIT,
        errors.NO_SOLUTION,
        errors.SERVO_LAG,
        errors.FORCE_WRONG,
        errors.JOINT_SENSE_WRONG,
        errors.JOINT_STIFF,
    )

    @property
    def raises(self) -> frozenset[int]:
        found = set(self.raising)
        if self.guards:
            found.add(unmet(self.guards))
        if any(guard.kind is GuardKind.TORQUE for guard in self.guards):
            found.add(errors.CURRENT_WRONG)
        return frozenset(found)


class Move(ArmMotion, frozen=True, kw_only=True):
    """Make a planned motion to a position. The hand departs upwards and approaches from above."""

    planned: ClassVar = True
    reading: ClassVar = {"position": ("goal", "via")}
    writing: ClassVar = {"goal": ()}

    goal: str
    restore: tuple[Restore, ...] = ()
    searching: bool = False  # in a search loop: adds the search offset to the goal
    direct: bool = False  # without departure and approach
    via: Annotated[tuple[str, ...], Meta(max_length=VIAS)] = ()  # via points, passed without stopping
    guards: Guards = ()

    @property
    def reads(self) -> tuple[Use, ...]:
        """All values on which the motion depends, including the values of its shifts."""
        shifts = [Use("difference", restore.name, restore.level) for restore in self.restore]
        search = [Use("search")] if self.searching else []
        return (*self.used(self.reading), *shifts, *search)

    @property
    def goal_position(self) -> str:
        return self.goal

    @property
    def knots(self) -> int | None:
        return 4 + len(self.via)


class Change(ArmMotion, frozen=True, kw_only=True):
    """Move straight from the present place. The orientation stays the same unless a moment turns the hand."""

    bounds: ClassVar = {"speed": (1e-4, 2.0), "displacement": _LENGTH, "press": FORCE, "moment": FORCE}
    writing: ClassVar = {"travel": ()}

    displacement: Vector3  # m, table axes
    speed: float | None = None  # m/s; None: the usual speed, slower if it meets something
    guards: Guards = ()
    press: Vector3 | None = None  # force to exert, N, table axes
    free: Vector3 | None = None  # 1 for each table axis along which the hand complies
    spin: Vector3 | None = None  # 1 for each table axis about which the hand complies
    moment: Vector3 | None = None  # moment to exert, N m, table axes

    @property
    def meets(self) -> bool:
        """True if the motion should make contact, because it has guards, presses or turns."""
        return bool(self.guards) or self.press is not None or self.moment is not None

    @property
    def complies(self) -> bool:
        """True if the hand yields to a force or a moment."""
        return any(way is not None for way in (self.press, self.free, self.moment, self.spin))

    @property
    def knots(self) -> int | None:
        return 2


class Turn(ArmMotion, frozen=True, kw_only=True):
    """Move on a circle about a vertical axis through a position, by `angle` (rad, counter-clockwise seen from
    above).
    """

    bounds: ClassVar = {"angle": (-4 * math.pi, 4 * math.pi)}
    reading: ClassVar = {"position": ("centre",)}

    centre: str
    angle: float
    guards: Guards = ()

    @property
    def knots(self) -> int | None:
        return 2


class Open(Operation, frozen=True, kw_only=True):
    """Drive the fingers to a gap."""

    family: ClassVar = "hand"
    needs: ClassVar = "hand"
    moves: ClassVar = True
    takes_time: ClassVar = True
    raising: ClassVar = action(errors.SWITCH_WRONG, errors.GAP_WRONG)
    bounds: ClassVar = {"gap": _GAP}

    gap: float


class Close(Operation, frozen=True, kw_only=True):
    """Close the fingers until both switches close. Raises error 2 if the gap is below `minimum` (m), and error 7 if
    the gap is above `maximum` (m). If `minimum` is 0, error 2 is raised only when the hand is empty.
    """

    family: ClassVar = "hand"
    needs: ClassVar = "hand"
    moves: ClassVar = True
    takes_time: ClassVar = True
    raising: ClassVar = action(errors.NOTHING_HELD, errors.SWITCH_WRONG, errors.GAP_WRONG)
    bounds: ClassVar = {"minimum": _GAP, "maximum": _GAP}

    minimum: float = 0.0
    maximum: float | None = None

    @property
    def raises(self) -> frozenset[int]:
        return self.raising if self.maximum is None else self.raising | {errors.WRONG_THICKNESS}


class Center(Operation, frozen=True, kw_only=True):
    """Close the fingers and move the hand so that the object is not pushed. Raises error 2 if the gap is below
    `minimum` (m). If `minimum` is 0, error 2 is raised only when the hand is empty.
    """

    family: ClassVar = "hand"
    needs: ClassVar = "hand"
    moves: ClassVar = True
    takes_time: ClassVar = True
    raising: ClassVar = action(
        errors.NOTHING_HELD, errors.JOINT_LIMIT, errors.SERVO_LAG, errors.SWITCH_WRONG, errors.GAP_WRONG
    )
    writing: ClassVar = {"travel": ()}
    bounds: ClassVar = {"minimum": _GAP}

    minimum: float = 0.0


class Travel(Operation, frozen=True, kw_only=True):
    """Check how far (m) the hand moved in the last Change or Center. Raises error 8 if the distance is outside the
    range.
    """

    family: ClassVar = "test"
    raising: ClassVar = action(errors.WRONG_TRAVEL)
    only_checks: ClassVar = True
    bounds: ClassVar = {"minimum": (-10.0, 10.0), "maximum": (-10.0, 10.0)}
    reading: ClassVar = {"travel": ()}

    minimum: float
    maximum: float


class Height(Operation, frozen=True, kw_only=True):
    """Compare the hand's height after the last motion with its height when the difference `name` was last saved.
    Raises error 9 if the rise (m) is outside the range from `minimum` to `maximum`.
    """

    family: ClassVar = "test"
    raising: ClassVar = action(errors.WRONG_HEIGHT)
    only_checks: ClassVar = True
    bounds: ClassVar = {"minimum": (-10.0, 10.0), "maximum": (-10.0, 10.0)}
    reading: ClassVar = {"difference": ("name",)}

    name: str
    minimum: float
    maximum: float


MotionOperation = Move | Change | Turn | Open | Close | Center | Travel | Height
