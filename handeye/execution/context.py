"""The context of a working phase: plan, arm and cell, and the state that all operations share."""

from collections.abc import Callable, Iterator
from contextlib import contextmanager
from dataclasses import dataclass, field
from typing import Any

from handeye.arm.arithmetic import ArmArithmetic, Formulas
from handeye.arm.friction import felt_friction
from handeye.arm.model import ArmModel
from handeye.core.mutable_records import put_back
from handeye.core.pose import Array
from handeye.execution.drive import ArmDrive
from handeye.execution.state import DriveState, ExecutionState, Fault, check_fits
from handeye.planfile.plan import Plan, PlannedMotion
from handeye.ports.workcell import Workcell
from handeye.program.events import AnyEvent
from handeye.program.guards import Guards
from handeye.program.world_model import WorldModel
from handeye.touch.spiral import SearchPattern, spiral
from handeye.vision.camera_model import CameraModel
from handeye.vision.replaceable import BUILT_IN, VisionFunctions


@dataclass(slots=True)
class Stopwatch:
    """A stopwatch that uses a given clock. It adds up the seconds during which it runs. Without a clock, the sum stays
    at zero.
    """

    clock: Callable[[], float] = lambda: 0.0
    seconds: float = 0.0

    @contextmanager
    def running(self) -> Iterator[None]:
        """Run the stopwatch while the context is open."""
        begun = self.clock()
        try:
            yield
        finally:
            self.seconds += self.clock() - begun


@dataclass(slots=True, kw_only=True)
class ExecutionContext:
    """Plan, arm and cell of a working phase. The drive and the world model store what they remember in the field
    `state`.
    """

    plan: Plan
    arm: ArmModel
    cell: Workcell
    camera: CameraModel | None  # calibrated; None in a cell without one
    emit: Callable[[AnyEvent], None]
    search: SearchPattern = spiral  # places that a search tries
    seeing: VisionFunctions = BUILT_IN  # what GENERAL, SPECIFIC and INSPECT call
    without: frozenset[str] = frozenset()  # senses not used; see `program.senses`
    arithmetic: Callable[[ArmModel], ArmArithmetic] = Formulas  # computes an arm at one configuration
    vision: Stopwatch = field(default_factory=Stopwatch)
    """CPU time of vision, in s. The runner gives the stopwatch its clock; the execution itself reads no clock of the
    computer.
    """
    state: ExecutionState = field(init=False)
    drive: ArmDrive = field(init=False)
    world: WorldModel = field(init=False)

    def __post_init__(self) -> None:
        self.state = ExecutionState(drive=DriveState.holding(self.cell.sense(), self.arm))
        self.drive = ArmDrive(
            cell=self.cell, arm=self.arm, state=self.state.drive, arithmetic=self.arithmetic
        )
        self.world = WorldModel.of(self.plan.program, self.state.world)

    @property
    def time(self) -> float:
        """Time on the cell's clock, in s, rounded to the period of the clock so that it is printed the same on every
        computer.
        """
        period = self.arm.servo.period
        return round(round(self.drive.sensed.time / period) * period, 6)

    @property
    def felt_friction(self) -> Array:
        """The wrenches that the measured friction of the joints causes the arm to sense at the present configuration:
        one column for each joint, shape (6, n). See `arm.friction`.
        """
        return felt_friction(self.arm, self.drive.state.q, self.drive.state.friction)

    def watching(self, guards: Guards) -> Guards:
        """Return the guards whose sensors are switched on."""
        return tuple(guard for guard in guards if guard.sense() not in self.without)

    @property
    def part_here(self) -> str:
        """The name of the part to which the goal of the last MOVE belongs. The hand should be at this part. The name
        is empty if the goal belongs to no part.
        """
        place = self.plan.program.positions.get(self.state.place)
        return "" if place is None or place.of is None else place.of

    @property
    def planned(self) -> PlannedMotion:
        """The planned motion of the present step. Steps without a motion have no planned motion."""
        assert self.state.at is not None
        return self.plan.motions[self.state.at]

    def restore(self, state: ExecutionState) -> None:
        """Restore a state. The cell must already have been restored to the same moment. Raises BadFile if the state
        does not fit the plan.
        """
        check_fits(state, self.plan, self.arm)
        put_back(self.state, state)


Action = Callable[[ExecutionContext, Any], Fault | None]
"""Function that executes an operation. It returns the error that the operation raises, or None."""
Decision = Callable[[ExecutionContext, Any], bool]  # True if the step takes its branch
