"""Describes kinds of steps that would notice a wrong state of the work. A kind is given by the place of the step, by
what the step senses, and by the limits of the sensed value.

A kind of evidence describes steps, but names no step of a program. The kind therefore applies to every program of a
task. It does not matter how a program names its labels and macros.
"""

import math
from typing import ClassVar, Final, Literal, NamedTuple

from handeye.core.record import Record, Vector3
from handeye.program.flow_operations import Tool
from handeye.program.guards import Against, Force, Guards, Torque
from handeye.program.motion_operations import (
    ArmMotion,
    Center,
    Change,
    Close,
    Height,
    Move,
    Open,
    Travel,
    Turn,
)
from handeye.program.operation import Operation
from handeye.program.vision_operations import Inspect, Look, Match
from handeye.proof.hand_places import Block, HandPlaces, Situation
from handeye.proof.outcomes import SUCCESS

Answer = Literal["yes", "maybe", "no"]
ALIGNED: Final = 0.99  # least cosine of the angle between a motion and the direction that is asked for
SLACK: Final = 1e-6  # m, N, N m or rad: rounding


class Limits(Record, frozen=True):
    """A range of a measured value (SI)."""

    low: float
    high: float

    def holds(self, low: float, high: float) -> bool:
        """Return True if another range lies within this range."""
        return self.low - SLACK <= low and high <= self.high + SLACK


class Region(Record, frozen=True, kw_only=True):
    """An upright cylinder in the table frame (m)."""

    at: tuple[float, float]
    radius: float
    height: Limits

    def meets(self, block: Block) -> Answer:
        """Say whether a place lies in the region. The answer is `maybe` if the place may lie inside or outside."""
        corners = [(x, y) for x in (block.low[0], block.high[0]) for y in (block.low[1], block.high[1])]
        inside = all(math.dist(corner, self.at) <= self.radius + SLACK for corner in corners)
        if inside and self.height.holds(block.low[2], block.high[2]):
            return "yes"
        nearest = [
            min(max(c, low), high)
            for c, low, high in zip(self.at, block.low[:2], block.high[:2], strict=True)
        ]
        apart = block.high[2] < self.height.low - SLACK or block.low[2] > self.height.high + SLACK
        return "no" if apart or math.dist(nearest, self.at) > self.radius + SLACK else "maybe"


class Passed(NamedTuple):
    """A step on a path, and the outcome with which the path passes the step."""

    places: HandPlaces
    node: int
    outcome: int | None

    @property
    def operation(self) -> Operation:
        return self.places.graph.step(self.node).operation

    @property
    def situations(self) -> frozenset[Situation]:
        return self.places.before[self.node]

    def motion(self, situation: Situation) -> Operation | None:
        """Return the last motion of a situation."""
        return None if situation.motion is None else self.places.program.steps[situation.motion].operation


def every(answers: list[Answer]) -> Answer:
    """Combine answers that must all be yes."""
    if not answers or "no" in answers:
        return "no"
    return "maybe" if "maybe" in answers else "yes"


def among(answers: list[Answer]) -> Answer:
    """Combine the answers for several situations. One of these situations is the true one, but we do not know which."""
    if answers and all(answer == "yes" for answer in answers):
        return "yes"
    return "no" if all(answer == "no" for answer in answers) else "maybe"


class Evidence(Record, frozen=True, kw_only=True, tag=True):
    """Base class of the kinds of evidence."""

    operations: ClassVar[tuple[type[Operation], ...]]  # to which the kind can apply

    def shown(self, passed: Passed) -> Answer:
        """Say whether the executed step `passed`, with its outcome, is evidence of this kind."""
        raise NotImplementedError

    def failed(self, passed: Passed) -> Answer:
        """Say whether an executed step disproves what this kind of evidence shows. It does if the step is of this
        kind, but did not succeed.
        """
        if passed.outcome in (None, SUCCESS):
            return "no"
        return self.shown(passed._replace(outcome=SUCCESS))


def touches(guards: Guards, along: Vector3, force: Limits) -> bool:
    """Return True if there is at least one guard, and if each guard trips when a force opposes a motion in the
    direction `along`. The force at which a guard trips must be within the limits `force`.
    """
    felt = [guard.exerted(along) for guard in guards if isinstance(guard, Force | Against)]
    return bool(felt) and len(felt) == len(guards) and all(
        load is not None
        and _aligned(load.vector, along)
        and force.holds(math.hypot(*load.vector), math.hypot(*load.vector))
        for load in felt
    )  # fmt: skip


def _aligned(one: Vector3, other: Vector3) -> bool:
    product = sum(a * b for a, b in zip(one, other, strict=True))
    return product >= ALIGNED * math.hypot(*one) * math.hypot(*other)


class Contact(Record, frozen=True, kw_only=True):
    """A straight motion that ended on contact: where the motion began, its direction, and the force (N) of the guard
    that ended it. If `torque` (N m) is given, a torque of the screwdriver ended the motion instead.
    """

    where: Region
    along: Vector3 = (0.0, 0.0, -1.0)
    force: Limits | None = None
    torque: Limits | None = None

    def ended(self, passed: Passed, situation: Situation) -> Answer:
        """Say whether the last motion of a situation was a motion of this kind."""
        operation = passed.motion(situation)
        if operation is None:
            return "maybe"
        if situation.outcome != SUCCESS or not self.describes(operation):
            return "no"
        return self.where.meets(situation.start)

    def describes(self, operation: Operation) -> bool:
        """Return True if an operation is a motion of this kind. The place of the hand does not matter."""
        if not isinstance(operation, Change) or not _aligned(operation.displacement, self.along):
            return False
        if self.torque is not None:
            driven = [guard.torque for guard in operation.guards if isinstance(guard, Torque)]
            return (
                bool(driven)
                and len(driven) == len(operation.guards)
                and self.torque.holds(min(driven), max(driven))
            )
        return self.force is not None and touches(operation.guards, self.along, self.force)


class HeightWithin(Evidence, frozen=True, kw_only=True):
    """A HEIGHT that compares the heights of the hand at two contacts: it measures how much higher the hand is at the
    contact `of`, where the program executes the HEIGHT, than at the contact `over`, where the difference was saved.
    The range (m) that this HEIGHT allows lies within `limits`.
    """

    operations: ClassVar = (Height,)

    of: Contact
    over: Contact
    limits: Limits

    def shown(self, passed: Passed) -> Answer:
        operation = passed.operation
        if not isinstance(operation, Height) or passed.outcome != SUCCESS:
            return "no"
        if not self.limits.holds(operation.minimum, operation.maximum):
            return "no"
        here = among([self.of.ended(passed, one) for one in passed.situations])
        if here == "no":
            return "no"
        saved = [one for found in passed.places.references(passed.node) for one in found]
        return every([here, among([self.over.ended(passed, one) for one in saved])])


class TravelWithin(Evidence, frozen=True, kw_only=True):
    """A TRAVEL after a contact. The range (m) of the TRAVEL lies within limits."""

    operations: ClassVar = (Travel,)

    of: Contact
    limits: Limits

    def shown(self, passed: Passed) -> Answer:
        operation = passed.operation
        if not isinstance(operation, Travel) or passed.outcome != SUCCESS:
            return "no"
        if not self.limits.holds(operation.minimum, operation.maximum):
            return "no"
        return among([self.of.ended(passed, one) for one in passed.situations])


class Contacted(Evidence, frozen=True, kw_only=True):
    """A motion that a contact has ended."""

    operations: ClassVar = (Change,)

    of: Contact

    def shown(self, passed: Passed) -> Answer:
        if passed.outcome != SUCCESS or not self.of.describes(passed.operation):
            return "no"
        return among([self.of.where.meets(one.at) for one in passed.situations])


class FreeTurn(Evidence, frozen=True, kw_only=True):
    """A turn about an axis, through at least a given arc, in which the resisting force stayed below a given limit (N).

    The arc is given by its ends (rad from table x, counter-clockwise) and by the direction of the turn: 1 for
    counter-clockwise, -1 for clockwise.
    """

    operations: ClassVar = (Turn,)

    axis: Region
    arc: Limits
    sense: Literal[1, -1]
    force: Limits

    def shown(self, passed: Passed) -> Answer:
        operation = passed.operation
        if not isinstance(operation, Turn) or not operation.guards:
            return "no"
        if passed.outcome != operation.guards[0].error or operation.angle * self.sense <= 0:
            return "no"
        along = (1.0, 0.0, 0.0)
        felt = [guard.exerted(along) for guard in operation.guards if isinstance(guard, Against)]
        sizes = [math.hypot(*load.vector) for load in felt if load is not None]
        if len(sizes) != len(operation.guards) or not self.force.holds(min(sizes), max(sizes)):
            return "no"
        centre = passed.places.centre(passed.node)
        swept = [self._sweeps(one.at, centre, operation.angle) for one in passed.situations]
        return every([self.axis.meets(centre), among(swept)])

    def failed(self, passed: Passed) -> Answer:
        operation = passed.operation
        if (
            not isinstance(operation, Turn)
            or not operation.guards
            or passed.outcome == operation.guards[0].error
        ):
            return "no"
        return self.shown(passed._replace(outcome=operation.guards[0].error))

    def _sweeps(self, at: Block, centre: Block, angle: float) -> Answer:
        if not at.upright or not centre.upright:
            return "maybe"
        first = math.atan2(at.low[1] - centre.low[1], at.low[0] - centre.low[0])
        low, high = sorted((first, first + angle))
        turns = (self.arc.low - low) // math.tau * math.tau  # whole turns between the two
        return "yes" if any(
            low + turns + k * math.tau <= self.arc.low + 1e-3
            and high + turns + k * math.tau >= self.arc.high - 1e-3
            for k in (0, 1)
        ) else "no"  # fmt: skip


class Taken(Evidence, frozen=True, kw_only=True):
    """One of two pictures that are compared, the earlier or the later. `picture` is the name of the picture; the
    prover fills in this name.
    """

    operations: ClassVar = (Look,)

    role: Literal["before", "after"]
    picture: str = ""

    def shown(self, passed: Passed) -> Answer:
        operation = passed.operation
        right = isinstance(operation, Look) and operation.picture == self.picture
        return "yes" if right and passed.outcome == SUCCESS else "no"


class Compared(Evidence, frozen=True, kw_only=True):
    """An INSPECT or a MATCH, which compares two pictures of a part. The part is in the region `part` (m, table frame).
    `before` and `after` are the names of the two pictures; the prover fills in these names.
    """

    operations: ClassVar = (Inspect, Match)

    by: Literal["inspect", "match"]
    part: Region
    before: str = ""
    after: str = ""

    def shown(self, passed: Passed) -> Answer:
        operation = passed.operation
        kind = Inspect if self.by == "inspect" else Match
        if not isinstance(operation, kind) or passed.outcome != SUCCESS:
            return "no"
        if (operation.before, operation.after) != (self.before, self.after):
            return "no"
        x, y, z, _ = passed.places.program.parts[operation.part].at
        return self.part.meets(Block((x, y, z), (x, y, z)))


class Gripped(Evidence, frozen=True, kw_only=True):
    """A step that closes the fingers at a place."""

    operations: ClassVar = (Close, Center)

    where: Region | None = None  # None: anywhere

    def shown(self, passed: Passed) -> Answer:
        if not isinstance(passed.operation, Close | Center):
            return "no"
        return _somewhere(self.where, passed)


class Released(Evidence, frozen=True, kw_only=True):
    """A step that opens the fingers at a place, to a gap of at least `least` (m)."""

    operations: ClassVar = (Open,)

    where: Region | None = None
    least: float = 0.0

    def shown(self, passed: Passed) -> Answer:
        operation = passed.operation
        if not isinstance(operation, Open) or passed.outcome != SUCCESS or operation.gap < self.least:
            return "no"
        return _somewhere(self.where, passed)


def _somewhere(where: Region | None, passed: Passed) -> Answer:
    return "yes" if where is None else among([where.meets(one.at) for one in passed.situations])


class Went(Evidence, frozen=True, kw_only=True):
    """A MOVE that has reached a place."""

    operations: ClassVar = (Move,)

    where: Region

    def shown(self, passed: Passed) -> Answer:
        if not isinstance(passed.operation, Move) or passed.outcome != SUCCESS:
            return "no"
        ends = passed.places.after(passed.node, SUCCESS, passed.situations)
        return among([self.where.meets(one.at) for one in ends])


class Motion(Evidence, frozen=True, kw_only=True):
    """Any motion of the arm."""

    operations: ClassVar = (Move, Change, Turn, Center)

    def shown(self, passed: Passed) -> Answer:
        return "yes" if isinstance(passed.operation, ArmMotion | Center) else "no"


class Turned(Evidence, frozen=True, kw_only=True):
    """Any turn about an axis."""

    operations: ClassVar = (Turn,)

    axis: Region

    def shown(self, passed: Passed) -> Answer:
        if not isinstance(passed.operation, Turn):
            return "no"
        return self.axis.meets(passed.places.centre(passed.node))


class ToolSet(Evidence, frozen=True, kw_only=True):
    """A step that sets the speed of the screwdriver: off, on, or backwards."""

    operations: ClassVar = (Tool,)

    to: Literal["off", "on", "backwards"]
    where: Region | None = None

    def shown(self, passed: Passed) -> Answer:
        operation = passed.operation
        if not isinstance(operation, Tool):
            return "no"
        speed = operation.speed
        right = {"off": speed == 0, "on": speed != 0, "backwards": speed < 0}[self.to]
        return _somewhere(self.where, passed) if right else "no"
