"""The state of a working phase: one record for the executor, actions, servo loop and world model.

Plan, arm and cell are not part of the state: they are given again when a run is resumed. A snapshot is a copy of
the record (`handeye.core.mutable_records`).
"""

from dataclasses import dataclass, fields, is_dataclass

import msgspec
import numpy as np

from handeye.arm.joint_agreement import Disagreement
from handeye.arm.model import ArmModel
from handeye.core.errors import BadFile, Refused
from handeye.core.mutable_records import MutableRecord, put_back
from handeye.core.pose import Array
from handeye.core.record import Record
from handeye.planfile.plan import Plan
from handeye.ports.camera import COLUMNS, FIRST_LENS, ROWS, Picture
from handeye.ports.workcell import Sensed
from handeye.program.diagnosis.causes import Cause
from handeye.program.diagnosis.sense_causes import GapJumped
from handeye.program.events import AskedBy
from handeye.program.guards import GuardKind
from handeye.program.system_state import Natural, SystemState
from handeye.program.world_model import WorldState
from handeye.touch.spiral import SearchPattern, line
from handeye.vision.base import GeneralLocation, PartMatch, SpecificLocation
from handeye.vision.calibration import Calibration
from handeye.vision.camera_model import View
from handeye.vision.gasket import GasketInspection
from handeye.vision.marks import GraspLine, Mark, marks


class ExecutedStep(Record, frozen=True, kw_only=True, omit_defaults=True):
    """An executed step. A field that holds a pair gives the values before and after the step."""

    step: Natural
    way: bytes = b""  # set-points, see `undo.way`; empty if nothing moved
    gap: tuple[float, float]  # sensed before and after, in m
    fingers: float  # gap set-point before, in m
    grasping: bool = False  # fingers closed before
    load: float  # compensated weight before, in N; no default: msgspec omits defaults by identity
    tool: float  # screwdriver speed before, in rad/s; no default, as for `load`
    force: float = 0.0  # greatest force felt, in N; 0 if none was estimated
    ended: GuardKind | None = None  # the guard that ended it
    risen: float = 0.0  # rise (m) of the hand while its screw was being turned out, if that was interrupted
    remembered: dict[str, bytes] = msgspec.field(default_factory=dict)
    """Fields of the program's memory that the step changed, with their values before the step; see `undo.memory`.
    """
    enters: bool = False  # first of its stage
    called: bool = False  # called the operator


class ReversalOrder(Record, frozen=True, kw_only=True):
    """An order to reverse executed steps until only `left` of them remain."""

    left: Natural
    halts: bool = False  # the run ends there
    asked_by: AskedBy = "person"


class Fault(Record, frozen=True, kw_only=True):
    """An error raised by an action, with its cause."""

    number: int
    cause: Cause | None = None


class SearchState(MutableRecord, kw_only=True):
    """A search in progress."""

    step: float
    limit: Natural
    count: Natural = 0
    around: str = ""  # position of its last motion
    along: float | None = None  # direction of its line (rad from table x); None for a pattern

    def offset(self, pattern: SearchPattern) -> tuple[float, float]:
        """Return the horizontal offset (m) of the present place of the search."""
        found = self.place(pattern, self.count)
        if found is None:
            raise Refused(f"the search is at place {self.count}, which does not exist in the search pattern")
        return found

    def place(self, pattern: SearchPattern, number: int) -> tuple[float, float] | None:
        """Return the horizontal offset (m) of a place of the search. If the search follows a line, the place is on
        this line. If not, `pattern` gives the place. Returns None after the last place.
        """
        if number >= self.limit:
            return None
        found = pattern(number) if self.along is None else line(number, self.along)
        return None if found is None else (found[0] * self.step, found[1] * self.step)


@dataclass(frozen=True, slots=True, kw_only=True)
class Shot:
    """A picture, and the view in which it was taken."""

    picture: Picture
    view: View


@dataclass(frozen=True, slots=True, kw_only=True)
class VisionResult:
    """The objects and places that vision found in a picture."""

    general: GeneralLocation | None = None
    specific: SpecificLocation | None = None
    grasp: GraspLine | None = None  # first grasp of the located part
    inspection: GasketInspection | None = None
    match: PartMatch | None = None

    def marks(self) -> list[Mark]:
        """Return marks for the findings in the picture."""
        return marks(
            general=self.general,
            specific=self.specific,
            grasp=self.grasp,
            inspection=self.inspection,
            match=self.match,
        )


class DriveState(MutableRecord, kw_only=True):
    """State of the servo loop. Joint arrays have shape (n,), in rad and m."""

    q: Array  # set-point
    here: Array  # position by potentiometers and tachometers
    friction: Array  # Coulomb friction, in N m and N; 0 if unknown
    gap: float  # set-point of the finger gap, in m
    grip: float  # finger force limit, in N
    load: float = 0.0  # compensated weight, in N
    links: Array | None = None
    """Link weights that the arm has measured, divided by the weights in the model, shape (n,); None if not
    measured.
    """
    weights: Array | None = None
    """Estimated errors of links and drives, and the covariance of this estimate; together, the shape is (3n, 1 + 3n).
    See `arm.torque_balance`. The estimate is made after `links` was measured. None if there is no estimate yet.
    """
    tool: float = 0.0  # screwdriver speed, in rad/s
    current: float = 0.0  # its greatest torque since that speed was set, in N m
    starting: list[float] = msgspec.field(default_factory=list)
    """Torques of the screwdriver (N m) in the first servo periods since its speed was set."""
    lately: list[float] = msgspec.field(default_factory=list)
    """Torques of the screwdriver (N m) in the last second, but only those since its speed was set."""
    leapt: GapJumped | None = None  # the first jump of the gap since the last step
    magnet: bool = True  # the magnet of its bit is on
    lamp: bool = False
    cut: bool = False  # the watchdog has cut the drives and set the brakes
    met: Array | None = None  # hand set-point in W (m) where a guard ended the last motion
    rest: Array | None = None
    """Potentiometer readings at rest under the brakes. None while the arm moves or is driven."""
    crept: Array | None = None  # their change until the arm was driven; None once a motion has checked it
    jump: Disagreement | None = None
    """A jump of a reading since the last motion. None once a motion has reported it."""
    in_air: bool = False  # the last motion was a MOVE without contact
    clear: bool = True
    """True if neither the hand nor an object in the hand should touch anything. This state begins when a MOVE or CHANGE
    that was not meant to make contact reaches its end, and ends when the hand grasps an object.
    """
    tare: Array = msgspec.field(default_factory=lambda: np.zeros(6))
    wrench: Array = msgspec.field(default_factory=lambda: np.zeros(6))
    """External wrench on the hand in W after taring: force (N) and moment (N m), shape (6,)."""

    @classmethod
    def holding(cls, sensed: Sensed, arm: ArmModel) -> "DriveState":
        """Return the state in which the servo holds the arm and the fingers in place, with full grip."""
        q = sensed.q
        return cls(q=q.copy(), here=q.copy(), friction=np.zeros(len(q)), gap=sensed.gap, grip=arm.hand.grip)

    def hold_anew(self, sensed: Sensed, arm: ArmModel) -> None:
        """Reset the state to hold the arm in place, but keep the arm's measurements of itself."""
        anew = DriveState.holding(sensed, arm)
        anew.friction, anew.links, anew.weights = self.friction, self.links, self.weights
        put_back(self, anew)


class ExecutionState(SystemState, kw_only=True):
    """The whole memory of a working phase between two steps."""

    pending: Fault | None = None  # an error that the next step may test
    idle: int = 0  # steps since time last passed
    clock: float = -1.0  # end of the last step, in s
    saved: dict[str, Array] = msgspec.field(default_factory=dict)
    heights: dict[str, float] = msgspec.field(default_factory=dict)  # height in W (m) of each SAVE
    counters: dict[str, int] = msgspec.field(default_factory=dict)
    search: SearchState | None = None
    restored: dict[str, Array] = msgspec.field(default_factory=dict)  # added to the goal of the last Move
    goal: Array = msgspec.field(default_factory=lambda: np.zeros(3))
    """Goal of the last Move in W (m), without the offset of the search."""
    place: str = ""  # its name
    travel: float = 0.0  # length (m) of the last straight motion
    finger_line: Array | None = None  # unit vector, if the last action was a Center
    grasping: bool = False  # the fingers were last closed
    unlike: float | None = None  # gap (m) of the last hold that was not as thick as specified
    calibration: Calibration | None = None  # of the camera, if the plan takes pictures
    unable: str | None = None  # why calibration failed
    lens: float = FIRST_LENS
    camera_ready: float = 0.0  # time (s on the cell's clock) at which the camera is ready
    shots: dict[str, Shot] = msgspec.field(default_factory=dict)
    general: dict[str, GeneralLocation] = msgspec.field(default_factory=dict)
    found: dict[str, VisionResult] = msgspec.field(default_factory=dict)  # by picture
    world: WorldState = msgspec.field(default_factory=WorldState)
    faint: list[str] = msgspec.field(default_factory=list)  # statements whose guards were reported as faint
    done: list[ExecutedStep] = msgspec.field(default_factory=list)
    """Executed steps that have not been reversed, in order."""
    undoing: ReversalOrder | None = None  # the reversal in progress
    lets_go: Natural | None = None
    """Index of the step in which the hand picked up the screw that has just been turned out. When this step is
    reversed, the hand leaves the screw at the place where it picked the screw up.
    """
    held: float | None = None
    """Gap (m) at which the hand holds an object during a reversal. None if the hand holds no object, or after the
    program has continued.
    """
    unwound: dict[int, int] = msgspec.field(default_factory=dict)
    """For each step of the present stage, the number of reversals that began at the step. A reversal restores the
    earlier values of the other fields, but it keeps these numbers.
    """
    drive: DriveState


def check_fits(state: ExecutionState, plan: Plan, arm: ArmModel) -> None:
    """Raise BadFile unless all references, sizes and numbers of a state fit the plan and the arm."""
    if not _finite(state):
        raise BadFile("the state of the run holds a value that is not a finite number")
    if not (_fits_program(state, plan) and _fits_sizes(state, arm)):
        raise BadFile("the state of the run does not fit this plan")


def _fits_program(state: ExecutionState, plan: Plan) -> bool:
    program, world = plan.program, state.world
    return (
        all(step is None or step < len(program.steps) for step in (state.at, state.onward))
        and (state.stage is None or state.stage < len(program.stages))
        and (state.stopped is None or (state.stage is not None and state.at is None))
        and all(done.step < len(program.steps) for done in state.done)
        and all(step < len(program.steps) for step in state.unwound)
        and (state.undoing is None or state.undoing.left < len(state.done))
        and {*world.measured, *state.general} <= set(program.parts)
        and {*state.shots, *state.found} <= program.written("picture")  # names that become file names
        and set(world.moved) <= set(program.positions)
        and all(p.of is None or p.of in program.parts for p in world.moved.values())
    )


def _fits_sizes(state: ExecutionState, arm: ArmModel) -> bool:
    drive, vectors = state.drive, [state.goal, *state.saved.values(), *state.restored.values()]
    joints = (drive.q, drive.here, drive.friction, drive.links, drive.rest, drive.crept)
    vectors += [vector for vector in (state.finger_line, state.drive.met) if vector is not None]
    return (
        all(vector.shape == (3,) for vector in vectors)
        and all(values.shape == (len(arm.joints),) for values in joints if values is not None)
        and (drive.weights is None or drive.weights.shape == (3 * len(arm.joints), 1 + 3 * len(arm.joints)))
        and all(values.shape == (6,) for values in (state.drive.tare, state.drive.wrench))
        and all(X.shape == (4, 4) for X in state.world.measured.values())
        and all(shot.picture.shape == (ROWS, COLUMNS) for shot in state.shots.values())
    )


def _finite(value: object) -> bool:
    """Return True if all numbers in a value are finite."""
    match value:
        case float() | np.ndarray():
            return bool(np.isfinite(value).all())
        case dict():
            return all(map(_finite, value.values()))
        case tuple() | list():
            return all(map(_finite, value))
        case msgspec.Struct():
            return all(_finite(getattr(value, name)) for name in value.__struct_fields__)
    return not is_dataclass(value) or all(_finite(getattr(value, field.name)) for field in fields(value))


def vector(p: Array) -> tuple[float, float, float]:
    """Return a vector (m) as three numbers for an event, each rounded to a micrometre."""
    x, y, z = (round(float(c), 6) + 0.0 for c in p)
    return x, y, z
