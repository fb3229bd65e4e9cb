"""The state of a working phase: one record that executor, actions, servo loop and world model live in.

The plan, the arm and the cell are no part of it: they are given anew when a run is taken up again. A snapshot is a
copy of the record (`handeye.core.mutable_records`).
"""

from dataclasses import dataclass, fields, is_dataclass

import msgspec
import numpy as np

from handeye.arm.model import ArmModel
from handeye.core.errors import BadFile, Refused
from handeye.core.mutable_records import MutableRecord, put_back
from handeye.core.pose import Array
from handeye.core.record import Record
from handeye.execution.undo.done import Done, Undoing
from handeye.planfile.plan import Plan
from handeye.ports.camera import COLUMNS, FIRST_LENS, ROWS, Picture
from handeye.ports.workcell import Sensed
from handeye.program.causes import Cause
from handeye.program.system_state import Natural, SystemState
from handeye.program.world_model import WorldState
from handeye.touch.spiral import SearchPattern, line
from handeye.vision.base import GeneralLocation, SpecificLocation
from handeye.vision.calibration import Calibration
from handeye.vision.camera_model import View
from handeye.vision.gasket import GasketInspection
from handeye.vision.grasp_line import GraspLine
from handeye.vision.marks import Mark, marks
from handeye.vision.part_match import PartMatch


class Fault(Record, frozen=True, kw_only=True):
    """An error number that an action raises, and what led to it this time."""

    number: int
    cause: Cause | None = None


class SearchState(MutableRecord, kw_only=True):
    """A search under way."""

    step: float
    limit: Natural
    count: Natural = 0
    around: str = ""
    """The position to which the last motion of it went."""
    along: float | None = None
    """Direction of its line (rad from the table's x), if its places are on one."""

    def offset(self, pattern: SearchPattern) -> tuple[float, float]:
        """Horizontal offset of the present place in a pattern, m.

        Raises:
            InvalidInput: the pattern has no such place.
        """
        found = self.place(pattern, self.count)
        if found is None:
            raise Refused(f"the search has no place {self.count}, to which it has come")
        return found

    def place(self, pattern: SearchPattern, number: int) -> tuple[float, float] | None:
        """Horizontal offset of a place on the line or in a pattern, m; None: there are no more."""
        if number >= self.limit:
            return None
        found = pattern(number) if self.along is None else line(number, self.along)
        return None if found is None else (found[0] * self.step, found[1] * self.step)


@dataclass(frozen=True, slots=True, kw_only=True)
class Shot:
    """A picture and how it was taken."""

    picture: Picture
    view: View


@dataclass(frozen=True, slots=True, kw_only=True)
class Found:
    """Findings of vision in a picture."""

    general: GeneralLocation | None = None
    specific: SpecificLocation | None = None
    grasp: GraspLine | None = None
    """Of the first grasp of the part that was located."""
    inspection: GasketInspection | None = None
    match: PartMatch | None = None

    def marks(self) -> list[Mark]:
        """The same as marks on the picture."""
        return marks(
            general=self.general,
            specific=self.specific,
            grasp=self.grasp,
            inspection=self.inspection,
            match=self.match,
        )


class DriveState(MutableRecord, kw_only=True):
    """Set-points and senses of the servo loop."""

    q: Array
    """Set-point the arm holds, shape (n,), rad and m."""
    here: Array
    """Where the arm is by potentiometers and tachometers together, shape (n,), rad and m."""
    friction: Array
    """Coulomb friction of each joint as far as it is known, shape (n,), N m and N; 0: unknown."""
    gap: float
    """Set-point of the finger gap, m."""
    grip: float
    """The most force each finger may press with, N."""
    load: float = 0.0
    """Weight that the servo bears, N."""
    links: Array | None = None
    """How heavy the links are by the arm's own weighing, over the model's, shape (n,); None: not weighed."""
    tool: float = 0.0
    """Speed of the screwdriver, rad/s."""
    current: float = 0.0
    """Greatest torque that its motor has shown since it was told that speed, N m."""
    magnet: bool = True
    """The magnet of its bit is on."""
    lamp: bool = False
    cut: bool = False
    """The watchdog has cut the drives: the brakes are set, and nobody asked for them."""
    met: Array | None = None
    """Set-point of the hand in W (m) when a guard ended the motion that brought it where it is."""
    rest: Array | None = None
    """What the potentiometers read when the arm came to rest under its brakes, shape (n,), rad and m; None: it moves,
    or is driven."""
    crept: Array | None = None
    """By how much they then changed until it was driven again, likewise; None: a motion has seen to it."""
    in_air: bool = False
    """A MOVE has brought the hand where it is, and met nothing."""
    tare: Array = msgspec.field(default_factory=lambda: np.zeros(6))
    wrench: Array = msgspec.field(default_factory=lambda: np.zeros(6))
    """External force and moment on the hand in W, less the tare."""

    @classmethod
    def holding(cls, sensed: Sensed, arm: ArmModel) -> "DriveState":
        """Hold the arm and the fingers where they are, with all the grip its hand has."""
        q = sensed.q
        return cls(q=q.copy(), here=q.copy(), friction=np.zeros(len(q)), gap=sensed.gap, grip=arm.hand.grip)

    def hold_anew(self, sensed: Sensed, arm: ArmModel) -> None:
        """Be as one that begins to hold the arm; what it has measured of itself stays known."""
        anew = DriveState.holding(sensed, arm)
        anew.friction, anew.links = self.friction, self.links
        put_back(self, anew)


class ExecutionState(SystemState, kw_only=True):
    """All that a working phase remembers from step to step."""

    pending: Fault | None = None
    """An error raised, which the next step tests."""
    idle: int = 0
    """Steps since time last passed."""
    clock: float = -1.0
    """When the last step ended, s."""
    saved: dict[str, Array] = msgspec.field(default_factory=dict)
    heights: dict[str, float] = msgspec.field(default_factory=dict)
    """Height in W (m) at which each difference was saved."""
    counters: dict[str, int] = msgspec.field(default_factory=dict)
    search: SearchState | None = None
    restored: dict[str, Array] = msgspec.field(default_factory=dict)
    """Differences that RESTOREs added to the goal of the last Move."""
    goal: Array = msgspec.field(default_factory=lambda: np.zeros(3))
    """Goal of the last Move without its search offset, in W (m)."""
    travel: float = 0.0
    """How far the last straight motion went (m)."""
    finger_line: Array | None = None
    """Unit vector of the finger line when the last action was a Center."""
    grasping: bool = False
    """The fingers were last told to close."""
    calibration: Calibration | None = None
    """Of the camera, if the plan takes pictures."""
    unable: str | None = None
    """Why the camera could not be calibrated."""
    lens: float = FIRST_LENS
    camera_ready: float = 0.0
    """When the camera's mechanism is, or was, ready for a picture, s by the cell's clock."""
    shots: dict[str, Shot] = msgspec.field(default_factory=dict)
    general: dict[str, GeneralLocation] = msgspec.field(default_factory=dict)
    found: dict[str, Found] = msgspec.field(default_factory=dict)
    """Findings of vision in each picture."""
    world: WorldState = msgspec.field(default_factory=WorldState)
    faint: list[str] = msgspec.field(default_factory=list)
    """Places of the statements whose guards were told to be hard to tell from friction."""
    done: list[Done] = msgspec.field(default_factory=list)
    """Steps that were executed and not undone by the arm, in order."""
    undoing: Undoing | None = None
    """The arm undoes what it did; None: the program goes on."""
    lets_go: Natural | None = None
    """The index of the executed step that took the screw which the arm has turned out: undone, it leaves it there."""
    held: float | None = None
    """Finger gap with which the arm, undoing, took what it holds or held it when it began to undo, m; None: it holds
    nothing, or the program has gone on since."""
    unwound: dict[int, int] = msgspec.field(default_factory=dict)
    """How often each step of the stage under way has had it undone; undoing does not take that back."""
    drive: DriveState


def check_fits(state: ExecutionState, plan: Plan, arm: ArmModel) -> None:
    """See that a state can be that of a plan, before anything in it is used.

    Raises:
        InvalidInput: it tells of steps, stages, parts, pictures or positions that the plan does not have, or its
            vectors and pictures are of another size, or a number in it is not finite.
    """
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
    vectors = [state.goal, *state.saved.values(), *state.restored.values()]
    vectors += [vector for vector in (state.finger_line, state.drive.met) if vector is not None]
    return (
        all(vector.shape == (3,) for vector in vectors)
        and all(values.shape == (len(arm.joints),) for values in (*_joints(state.drive), *_measured(state)))
        and all(values.shape == (6,) for values in (state.drive.tare, state.drive.wrench))
        and all(X.shape == (4, 4) for X in state.world.measured.values())
        and all(shot.picture.shape == (ROWS, COLUMNS) for shot in state.shots.values())
    )


def _joints(drive: DriveState) -> tuple[Array, ...]:
    return drive.q, drive.here, drive.friction


def _measured(state: ExecutionState) -> list[Array]:
    drive = state.drive
    return [values for values in (drive.links, drive.rest, drive.crept) if values is not None]


def _finite(value: object) -> bool:
    """True if every number in a state, or in a part of one, is finite."""
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
    """A vector for an event, to the micrometre."""
    x, y, z = (round(float(c), 6) + 0.0 for c in p)
    return x, y, z
