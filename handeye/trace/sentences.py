"""Describes events in sentences, in the units of the arm language: inches, ounces, degrees."""

import math
from collections.abc import Callable, Sequence
from typing import Final

from foxglove_schemas_protobuf.Log_pb2 import Log

from handeye.core.plain_text import counted, distinct_digits, printable
from handeye.core.units import DEGREE, INCH, INCHES, MILLIMETRE, OUNCE_FORCE, OUNCE_INCH, Measures
from handeye.ports.camera import Renderer
from handeye.program import events as happened
from handeye.program.diagnosis.cause_text import (
    call_sentence,
    error_sentence,
    inspection_sentence,
    match_sentence,
)
from handeye.program.events import Event, SystemEvent
from handeye.program.guards import GuardKind
from handeye.tasks import known_any

_IMPORTANCE: Final[dict[happened.Importance, Log.Level.ValueType]] = {
    "debug": Log.DEBUG,
    "info": Log.INFO,
    "warning": Log.WARNING,
    "error": Log.ERROR,
}
_WARNED: Final = (
    happened.GuardFaint, happened.ErrorRaised, happened.ExperimentMade, happened.PeriodsCommanded,
    happened.LineTyped, happened.UndoOrdered
)  # fmt: skip
_INFORMED: Final = (
    happened.RunStarted, happened.StageStarted, happened.StageFinished, happened.FrictionMeasured,
    happened.GuardTripped, happened.SearchAdvanced, happened.HandTold, happened.PositionDefined,
    happened.PictureTaken, happened.PartSeen, happened.PartInspected, happened.PartMatched,
    happened.OperatorAnswered, happened.StageUndone, happened.UndoEnded, happened.RunFinished,
)  # fmt: skip
LEVELS: Final[dict[type[Event], Log.Level.ValueType]] = {
    **dict.fromkeys((happened.StepStarted, happened.UndoStarted), Log.DEBUG),
    **dict.fromkeys(_INFORMED, Log.INFO),
    **dict.fromkeys(_WARNED, Log.WARNING),
    **dict.fromkeys((happened.OperatorCalled, happened.PanicStopped), Log.ERROR),
}  # log levels of the events that are logged


def level_of(event: Event) -> Log.Level.ValueType | None:
    """Return the log level of an event, or None if the event is not logged."""
    return _IMPORTANCE[event.importance] if isinstance(event, SystemEvent) else LEVELS.get(type(event))


_CAMERA: Final = {
    "lens": "turns its lenses",
    "aim": "turns to its aim",
    "focus": "is focused",
}
_WAITING: Final = {"digitise": "the picture"}  # what the arm waits for, if not for the camera's mechanism
_CHOICES: Final = {
    "proceed": "to proceed",
    "retry": "to retry the stage",
    "skip": "to skip the rest of the stage",
}


_ASKING: Final[dict[happened.AskedBy, str]] = {
    "person": "the arm is asked to undo",
    "program": "the program makes the arm undo",
    "job": "the job makes the arm undo",
}
_PLACES: Final = ("saved", "position")  # kinds of experiments whose values are differences or places


def measures_of(task: str) -> Measures:
    """Return the display units for runs of the task called `task`. An unknown task has the units of the arm
    language."""
    found = known_any(task)
    return INCHES if found is None else found.measures


def inches(vector: Sequence[float], places: int = 2) -> str:
    """Return a vector (m) as text in inches, as the arm language writes it."""
    return "(" + ", ".join(f"{c / INCH:z.{places}f}" for c in vector) + ") in"


def renderer_name(renderer: Renderer) -> str:
    """Return the name of a renderer, such as `OpenGL (EGL)`, `ray casting`, `none` or `the caller's code
    (fog.Foggy)`."""
    named = {"opengl": "OpenGL", "rays": "ray casting", "none": "none", "replaced": "the caller's code"}[
        renderer.method
    ]
    return f"{named} ({renderer.platform})" if renderer.platform else named


def sentence(event: Event, measures: Measures = INCHES) -> str:
    """Describe an event in a sentence, without the time. The sentence uses the units of `measures` if the event is the
    end of a step or an event of the run's system.
    """
    match event:
        case happened.RunStarted():
            pictures = "" if event.camera.method == "none" else f", pictures by {renderer_name(event.camera)}"
            world = f"the world of {event.world}{pictures}"
            world += "".join(
                f", {part} by {name}" for part, name in event.own_parts.items() if part != "camera"
            )
            world += f", without {', '.join(event.lacking)}" if event.lacking else ""
            steps = counted(event.steps, "step")
            return (
                f"{event.program}: {steps} on the {event.arm} arm, {world}"
                if event.arm
                else f"{event.program}: {steps}"
            )
        case happened.StageStarted():
            return f"stage “{event.stage}”"
        case happened.StageFinished():
            return f"stage “{event.stage}” {event.status}"
        case happened.UndoStarted():
            rounds = f", and {counted(event.steps - 1, 'step')} of the same loop" if event.steps > 1 else ""
            return f"undo: {event.text.strip()}{rounds}"
        case happened.StepStarted():
            return event.text
        case happened.StepFinished():
            if event.hand is None or event.gap is None:
                return "the step is done"
            return f"the hand is at {measures.place(event.hand)}, open {measures.distance(event.gap)}"
        case happened.Adjusted():
            return f"{event.goal} is {inches(event.shift, 3)} from its planned place"
        case happened.FrictionMeasured():
            return _rubbing(event)
        case happened.GuardFaint():
            return _faint(event)
        case happened.GuardTripped():
            return f"stopped: {_MET[event.guard](event)}"
        case happened.ErrorRaised():
            return f"error {event.number}: {error_sentence(event.number, event.cause)}"
        case happened.ErrorTested():
            return f"error {event.number} {'occurred' if event.occurred else 'did not occur'}"
        case happened.SearchAdvanced():
            return f"the search tries place {event.count + 1}, {inches(event.offset)} from the first"
        case happened.Saved():
            return f"{event.name} is {inches(event.difference, 3)}"
        case happened.HandTold():
            return f"the hand is at {_value(event.at)}"
        case happened.PositionDefined():
            return f"{event.name} is {_value(event.at)}" + (f", of {event.of}" if event.of else "")
        case happened.Restored():
            return f"{event.name} shifts {event.goal} by {inches(event.difference, 3)}"
        case happened.PictureTaken():
            return f"picture {event.picture}, {event.lens / MILLIMETRE:.0f} mm lens"
        case happened.PartSeen():
            return _seen(event)
        case happened.PartInspected():
            return f"{event.part}: {inspection_sentence(event.cause)}"
        case happened.PartMatched():
            return f"{event.part}: {match_sentence(event.off, event.unlike)}"
        case happened.CameraStarted():
            return f"the camera {_CAMERA.get(event.action, event.action)}, in {event.seconds:.1f} s"
        case happened.CameraBusy():
            return f"the arm waits for {_WAITING.get(event.action, 'the camera')}: {event.seconds:.1f} s"
        case happened.OperatorCalled():
            number = "" if event.error is None else f" (error {event.error})"
            called = call_sentence(event.message, event.error, event.cause)
            return f"brakes set, operator called: {called}{number}"
        case happened.OperatorAnswered():
            return f"the operator chooses {_CHOICES[event.choice]}"
        case happened.ExperimentMade():
            value = _value(event.value) if event.what in _PLACES else ", ".join(f"{x:g}" for x in event.value)
            return f"experiment: {event.what} {event.name} is set to {value}"
        case happened.PeriodsCommanded():
            return f"the controller {event.by} commanded {counted(len(event.periods), 'servo period')}"
        case happened.LineTyped():
            return f"typed{f' to {event.task}' if event.task else ''}: {printable(event.text)}"
        case happened.PanicStopped():
            return "panic button: drives off, brakes set"
        case happened.UndoOrdered():
            but = f", except for the first {counted(event.left, 'step')}" if event.left else ""
            return f"{_ASKING[event.asked_by]} what it did{but}"
        case happened.StageUndone():
            return f"stage “{event.stage}” undone"
        case happened.UndoEnded():
            return "undone as far as requested"
        case happened.WentBack():
            return f"back to event {event.events}: later events are dropped"
        case happened.RunFinished():
            return "the program finished" if event.completed else "the run ended before the program did"
        case SystemEvent():
            return event.sentence(measures)
    raise AssertionError(event)


def _rubbing(event: happened.FrictionMeasured) -> str:
    def told(found: happened.JointFriction) -> str:
        slides = found.joint.kind == "prismatic"
        si, unit = (OUNCE_FORCE, "oz") if slides else (OUNCE_INCH, "oz-in")
        return f"{found.joint.name} {found.friction / si:.1f} {unit}"

    return f"friction of the joints: {', '.join(map(told, event.joints))}, measured in {event.seconds:.1f} s"


def _faint(event: happened.GuardFaint) -> str:
    moment = event.guard is GuardKind.MOMENT
    si, unit = (OUNCE_INCH, "ounce-inches") if moment else (OUNCE_FORCE, "ounces")
    limit, felt = f"{event.limit / si:.1f}", f"{event.friction / si:.1f}"
    hard = f"a stop at a {'moment' if moment else 'force'} of {limit} {unit} is hard to distinguish from joint friction"
    return f"{hard}: up to {felt} {unit} can be felt here in free air"


def _beyond(said: str, si: float, unit: str) -> Callable[[happened.GuardTripped], str]:
    """Return a function that makes a sentence about a tripped guard: a sensed value exceeds its limit."""

    def sentence(event: happened.GuardTripped) -> str:
        felt, limit = distinct_digits([event.value / si, event.limit / si], 1)
        return f"{said} {felt} {unit}, over {limit}"

    return sentence


_FINGERS: Final = {1: "finger 1 touches", 2: "finger 2 touches"}
_MET: Final[dict[GuardKind, Callable[[happened.GuardTripped], str]]] = {
    GuardKind.FORCE: _beyond("the hand presses with", OUNCE_FORCE, "ounces"),
    GuardKind.AGAINST: _beyond("the hand meets", OUNCE_FORCE, "ounces"),
    GuardKind.MOMENT: _beyond("the hand turns with", OUNCE_INCH, "ounce-inches"),
    GuardKind.TORQUE: _beyond("the driver holds", OUNCE_INCH, "ounce-inches"),
    GuardKind.TOUCH: lambda event: _FINGERS.get(round(event.value), "both fingers touch"),
}


def _seen(event: happened.PartSeen) -> str:
    place = inches((event.x, event.y))
    if event.yaw is None:
        return f"{event.part} lies around {place}"
    return f"{event.part} lies at {place}, turned {event.yaw / DEGREE:.1f} degrees"


def _value(value: tuple[float, ...]) -> str:
    """Return a difference or position as text. The angles of a position come last."""
    angles = "".join(f" {math.degrees(angle):.1f}" for angle in value[3:])
    return inches(value[:3], 3) + (f", angles{angles}" if angles else "")
