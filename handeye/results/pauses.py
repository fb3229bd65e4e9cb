"""Describes in sentences why a run pauses."""

from handeye.core.errors import ERRORS
from handeye.core.plain_text import counted
from handeye.core.source import line_name
from handeye.program.diagnosis.cause_text import call_sentence
from handeye.runs import advance as stops
from handeye.runs.advance import AnyStop, Pause


def pause_sentence(pause: Pause) -> str:
    """Return a sentence, without a full stop, that says why a run pauses."""
    if pause.met is not None:
        return _met(pause.met)
    if pause.kind == "panic":
        return f"stopped by the panic button{' while going back' if pause.back else ''}; the brakes are set"
    if pause.kind == "end":
        return (
            "the arm has undone all the steps that it was asked to undo"
            if pause.undone
            else "the program finished"
        )
    return call_sentence(pause.message, pause.error, pause.cause)


def stop_name(stop: AnyStop) -> str:
    """Return the name of a stop condition in the form in which users type it, such as `line 58`, `label L1`,
    `AOJ`, `stage 4, ...` or `error 23`."""
    match stop:
        case stops.AtLine():
            return f"line {line_name(stop.line, stop.file)}"
        case stops.AtLabel():
            return f"label {stop.label}"
        case stops.AtInstruction():
            return stop.word
        case stops.BeforeStep():
            return f"step {stop.step}"
        case stops.AtStage() | stops.AfterStage():
            return f"stage {stop.stage + 1}, {stop.name}"
        case stops.OnError():
            return f"error {stop.number}"
        case stops.ReversalEnd():
            return "undone"
        case stops.AfterSteps():
            return counted(stop.count, "step")
        case stops.PauseRequest():
            return "on request"
        case stops.ByHand():
            return "by hand"
        case stops.DriverFailure():
            return stop.exception


def _met(stop: AnyStop) -> str:
    match stop:
        case stops.BeforeStep():
            return f"paused before {stop_name(stop)}"
        case stops.AfterStage():
            return f"{stop_name(stop)}, has ended"
        case stops.OnError():
            return f"breakpoint on {stop_name(stop)}: {ERRORS[stop.number]}"
        case stops.AfterSteps():
            return f"{stop_name(stop)} done"
        case stops.ReversalEnd():
            return "undone; the program can continue from here"
        case stops.PauseRequest():
            return "paused on request"
        case stops.ByHand():
            return "ended by the user"
        case stops.DriverFailure():
            return f"stopped by {stop_name(stop)} in the calling program"
        case _:
            return f"breakpoint at {stop_name(stop)}"
