"""Events of a run, as plain records. The only time in these events is simulated time, so that two runs with the same
seed give the same bytes.
"""

from typing import ClassVar, Literal

import msgspec
from msgspec import UNSET, UnsetType

from handeye.core.errors import BadArgument
from handeye.core.record import Record
from handeye.core.source import line_name
from handeye.core.units import Measures
from handeye.core.variation import WorldSpec
from handeye.ports.camera import Renderer
from handeye.program.diagnosis.cause_record import JointName
from handeye.program.diagnosis.causes import Cause, InspectionCause
from handeye.program.guards import GuardKind

AskedBy = Literal["person", "program", "job"]  # a job orders a reversal when its program has ended
Importance = Literal["debug", "info", "warning", "error"]
Choice = Literal["proceed", "retry", "skip"]  # continue after a stop, retry the stage, or skip the rest of it


class Event(Record, frozen=True, kw_only=True, tag_field="event", tag=True):
    """Base class of all events. `time` is the clock of the run (s), which is 0 when the program begins."""

    time: float


class SystemEvent(Event, frozen=True, kw_only=True):
    """Base class of the events that a system adds to the events that all systems have. `System.events` lists the added
    events of a system.
    """

    importance: ClassVar[Importance] = "info"

    def sentence(self, measures: Measures) -> str:
        """Write the event as a sentence, without the time, in the units of the system's task."""
        raise NotImplementedError


class RunStarted(Event, frozen=True, kw_only=True):
    """The working phase, in which the plan is executed, begins at time 0. The event contains everything that
    determines the later events, except the actions of the operator.
    """

    system: str = "program"  # name of the system that executes the run
    program: str
    steps: int
    plan: str  # digest that identifies the plan
    content: str | UnsetType = UNSET  # digest of the plan's bytes, which differs if any number differs
    arm: str
    arm_digest: str
    world: WorldSpec
    task: str = "water_pump"
    camera: Renderer  # how pictures are made
    versions: dict[str, str]
    processor: str | UnsetType = UNSET  # kind of processor, on which last digits of numbers depend
    replaced: dict[str, str] | UnsetType = UNSET  # parts replaced by the caller's code
    without: tuple[str, ...] | UnsetType = UNSET
    prepared: float = 0.0  # simulated seconds of preparation before time 0, such as calibration and teaching

    @property
    def made_alike(self) -> "RunStarted":
        """A copy of the event without three facts: the versions, the processor, and the renderer's platform. Use these
        copies to compare runs from different computers.
        """
        camera = msgspec.structs.replace(self.camera, platform="")
        return msgspec.structs.replace(self, versions={}, processor=UNSET, camera=camera)

    @property
    def lacking(self) -> tuple[str, ...]:
        """Senses that were switched off in the program; empty if all senses were on."""
        return self.without or ()

    @property
    def own_parts(self) -> dict[str, str]:
        """The parts of handeye that the caller replaced, by name; empty if no part was replaced."""
        return self.replaced or {}


class StageStarted(Event, frozen=True, kw_only=True):
    """A stage begins."""

    stage: str


class StageFinished(Event, frozen=True, kw_only=True):
    """A stage ended."""

    stage: str
    status: Literal["done", "stopped", "skipped"]


class StepStarted(Event, frozen=True, kw_only=True, omit_defaults=True):
    """A step begins. `line` and `text` are from the script, or from a required file."""

    step: int
    file: str = ""
    line: int
    text: str

    @property
    def place(self) -> str:
        """The line of the step, such as `12` or `pins.al:12`."""
        return line_name(self.line, self.file)


class StepFinished(Event, frozen=True, kw_only=True):
    """A step ended. `hand` is the position of the hand (m), measured by the sensors of the arm, and `gap` is the
    finger gap (m).
    """

    step: int
    hand: tuple[float, float, float] | None  # None: the system has no hand
    planned: tuple[float, float, float] | None
    """Planned end of a motion (m). A guard or a measured pose may end the motion at another place."""
    gap: float | None


class Adjusted(Event, frozen=True, kw_only=True):
    """A goal was shifted by `shift` (m) from its planned position before the motion began."""

    goal: str
    shift: tuple[float, float, float]


class JointFriction(Record, frozen=True, kw_only=True):
    """Coulomb friction of a joint: N m, or N for a prismatic joint."""

    joint: JointName
    friction: float


class FrictionMeasured(Event, frozen=True, kw_only=True, omit_defaults=True):
    """The arm measured the friction of its joints and weighed its links, before the program began. `seconds` is
    simulated time.
    """

    joints: tuple[JointFriction, ...]
    links: tuple[float, ...] = ()  # measured weight of each link, divided by the model's; empty: not weighed
    seconds: float


class GuardFaint(Event, frozen=True, kw_only=True):
    """The limit of a guard is so low that friction could trip it. At the start of the motion, the arm may sense up to
    `friction` (N or N m) in free air.
    """

    guard: GuardKind
    limit: float
    friction: float


class GuardTripped(Event, frozen=True, kw_only=True):
    """A guard tripped and ended a motion."""

    guard: GuardKind
    value: float
    limit: float


class ErrorRaised(Event, frozen=True, kw_only=True):
    """An action raised an error."""

    number: int
    cause: Cause | None  # the cause in this case; None if the error number is enough


class ErrorTested(Event, frozen=True, kw_only=True):
    """The program tested for an error. `occurred` is True if the error had been raised."""

    number: int
    occurred: bool


class SearchAdvanced(Event, frozen=True, kw_only=True):
    """The search went on to place number `count`; the first place is number 0."""

    count: int
    offset: tuple[float, float]


class Saved(Event, frozen=True, kw_only=True):
    """A difference (m) was saved."""

    name: str
    difference: tuple[float, float, float]


class HandTold(Event, frozen=True, kw_only=True):
    """WHERE reported the pose of the hand: x, y, z (m) and the angles O, A, T (rad), measured by the sensors of the
    arm.
    """

    at: tuple[float, float, float, float, float, float]


class PositionDefined(Event, frozen=True, kw_only=True):
    """HERE defined a position: x, y, z (m) and the angles O, A, T (rad), measured by the sensors of the arm. If the
    part `of` is given, the position is relative to this part.
    """

    name: str
    at: tuple[float, float, float, float, float, float]
    of: str | None


class Restored(Event, frozen=True, kw_only=True):
    """A saved difference (m) was added to a goal."""

    name: str
    goal: str
    difference: tuple[float, float, float]


class PictureTaken(Event, frozen=True, kw_only=True):
    """A picture was taken through a lens. `lens` is the focal length of the lens (m)."""

    picture: str
    lens: float


class PartSeen(Event, frozen=True, kw_only=True):
    """Vision measured the place of a part: x, y (m) and yaw (rad). The instruction GENERAL gives no yaw."""

    part: str
    x: float
    y: float
    yaw: float | None


class PartInspected(Event, frozen=True, kw_only=True):
    """Vision inspected a part by comparing two pictures."""

    part: str
    ok: bool
    cause: InspectionCause | None  # why the part is not in place; None if it is


class PartMatched(Event, frozen=True, kw_only=True):
    """Vision compared the place of a part in two pictures. `off` is the displacement of the part (m), and `unlike` is
    the fraction of the part that looks different.
    """

    part: str
    ok: bool  # it has not moved
    off: float  # displacement relative to its surroundings, m
    unlike: float  # fraction of the part that looks different, 0 to 1


class CameraStarted(Event, frozen=True, kw_only=True):
    """The program gave the mechanism of the camera a new action: `lens`, `aim` or `focus`. The action takes `seconds`
    (s).

    The action begins when the present movement of the mechanism ends. While the mechanism moves, the arm continues.
    """

    action: str
    seconds: float


class CameraBusy(Event, frozen=True, kw_only=True):
    """The arm stood still for `seconds` (s) because of the camera. The `action` is `wait` if the arm waited for the
    camera's mechanism, and `digitise` if it waited for a picture.
    """

    action: str
    seconds: float


class OperatorCalled(Event, frozen=True, kw_only=True):
    """The brakes were set and the operator was called. The event gives the reason: a message of the program, an error
    or a cause.
    """

    message: str = ""  # the program's own words
    error: int | None = None
    cause: Cause | None = None


class OperatorAnswered(Event, frozen=True, kw_only=True):
    """The operator chose how to continue after a stop. The program continues with step `step`, or ends if `step` is
    None.
    """

    choice: Choice
    step: int | None


class ExperimentMade(Event, frozen=True, kw_only=True):
    """A person at the stepper changed the memory of the program (values in m and rad). After this event, the plan
    alone no longer determines the run.
    """

    what: str  # kind of value: `saved`, `position`, or another kind of the system
    name: str
    value: tuple[float, ...]


class CommandedPeriod(Record, frozen=True, kw_only=True, array_like=True):
    """The commands of the calling program for one servo period."""

    torque: tuple[float, ...] | None  # of each joint, N m, or N if prismatic; None: the brakes were set
    gap: float  # goal of the finger gap, m
    grip: float  # greatest force of each finger, N
    driver: float  # speed of the screwdriver, rad/s
    magnet: bool  # the magnet of the screwdriver is on


class PeriodsCommanded(Event, frozen=True, kw_only=True):
    """Between two steps, a controller of the calling program commanded the arm. After this event, the plan alone no
    longer determines the run.
    """

    by: str  # name of the controller
    periods: tuple[CommandedPeriod, ...]


class LineTyped(Event, frozen=True, kw_only=True):
    """A person typed a line at the console of a system, for one of the system's tasks. After this event, the program
    alone no longer determines the run.
    """

    text: str
    task: str = ""  # the task it was typed to; empty: the only one, or the one that reads the console


class PanicStopped(Event, frozen=True, kw_only=True):
    """The operator pressed the panic button. From this servo period on, the drives are off and the brakes are set."""


class WentBack(Event, frozen=True, kw_only=True):
    """The run went back: only its first `events` events remain, and the later ones were undone. This event occurs only
    in a journal, because a trace contains no undone events.
    """

    events: int
    why: Literal["back", "resumed"]


class UndoOrdered(Event, frozen=True, kw_only=True):
    """A reversal was ordered: the arm undoes executed steps until only `left` of them remain."""

    left: int
    halts: bool  # True if the run ends there; False if the program can continue
    asked_by: AskedBy = "person"


class UndoStarted(StepStarted, frozen=True, kw_only=True, omit_defaults=True):
    """The arm begins to undo a step, or several executed steps together, such as the rounds of a loop. `steps` is the
    number of steps to undo.
    """

    steps: int = 1  # executed steps that are undone together


class UndoFinished(StepFinished, frozen=True, kw_only=True):
    """A step has been undone. `force` (N) is the greatest force that was sensed while the step was undone."""

    force: float  # greatest force on the hand during the undoing, N


class StageUndone(Event, frozen=True, kw_only=True):
    """The arm has undone all steps that were executed since the stage last began."""

    stage: str


class UndoEnded(Event, frozen=True, kw_only=True):
    """The reversal is complete. If the program continues, it continues with step `step`."""

    step: int


class RunFinished(Event, frozen=True, kw_only=True):
    """The working phase ended."""

    completed: bool


CommonEvent = (
    RunStarted | FrictionMeasured | StageStarted | StageFinished | StepStarted | StepFinished | Adjusted
    | GuardFaint | GuardTripped
    | ErrorRaised | ErrorTested | SearchAdvanced | Saved | HandTold | PositionDefined | Restored
    | PictureTaken | PartSeen | PartInspected | PartMatched | CameraStarted | CameraBusy
    | OperatorCalled | OperatorAnswered | ExperimentMade | PeriodsCommanded | LineTyped | PanicStopped
    | WentBack
    | UndoOrdered | UndoStarted | UndoFinished | StageUndone | UndoEnded | RunFinished
)  # fmt: skip
AnyEvent = CommonEvent | SystemEvent


_encoder = msgspec.json.Encoder()


def to_line(event: Event) -> bytes:
    """Write an event as one line of JSON. Raises BadArgument if a number is NaN. JSON would write NaN as null, which
    could not be read back as a number.
    """
    try:
        line = _encoder.encode(event)
        msgspec.json.decode(line, type=type(event))
    except (TypeError, msgspec.ValidationError) as error:
        raise BadArgument(f"an event {type(event).__name__} cannot be written: {error}") from None
    return line + b"\n"
