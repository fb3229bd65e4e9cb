"""The functions that execute the stepper's commands on a session. Each function gets the text after the command word.

`command_table.COMMANDS` describes each command.
"""

import math
import re
from collections.abc import Callable
from pathlib import Path
from typing import Final

from msgspec import UNSET

from handeye.core.diagnostics import quoted
from handeye.core.errors import BadArgument, NoSuchName, Refused
from handeye.core.files import check_new, check_place
from handeye.core.plain_text import counted
from handeye.debugger.breakpoints import breakpoint, meant
from handeye.debugger.listing import lines_of, named_place
from handeye.debugger.live import factor
from handeye.debugger.reply import Break, CommandResult
from handeye.debugger.session import DebugSession
from handeye.debugger.views import show, write_picture
from handeye.program.events import Choice
from handeye.results.pauses import pause_sentence
from handeye.runs.advance import AfterStage, AfterSteps, Pause
from handeye.runs.checkpoint_file import CHECKPOINT, write_checkpoint
from handeye.runs.runner import Runner, reach
from handeye.runs.system import Settable

LISTED_AROUND: Final = 8  # lines that `list` shows before and after one

# -- running --------------------------------------------------------------------------------------------


def step(session: DebugSession, rest: str) -> CommandResult:
    count = _count(rest, "`step` takes a number of 1 or more")
    pause = session.go(steps=count)
    as_asked = isinstance(pause.met, AfterSteps)
    return CommandResult(pause=pause, source=session.source()) if as_asked else _told(session, pause)


def stage(session: DebugSession, _: str) -> CommandResult:
    present = session.stage
    stops = (
        [] if present is None else [AfterStage(stage=present, name=session.runner.listing.stages[present])]
    )
    return _told(session, session.go(stops))


def go_on(session: DebugSession, _: str) -> CommandResult:
    return _told(session, session.go())


def until(session: DebugSession, rest: str) -> CommandResult:
    return _told(session, session.go([breakpoint(rest, session.program)]))


def pause(session: DebugSession, _: str) -> CommandResult:
    session.ask_pause()
    return CommandResult(said="the run will pause after the current step")


def pace(session: DebugSession, rest: str) -> CommandResult:
    if rest:
        session.pace.factor = factor(rest)
    return CommandResult(said=f"pace: {session.pace}")


def _told(session: DebugSession, pause: Pause) -> CommandResult:
    said = session.at_its_end() or pause_sentence(pause)
    if pause.kind == "panic":
        said += "; the simulator is back at the start of the interrupted step"
    return CommandResult(pause=pause, source=session.source(), said=said)


def _count(text: str, expected: str) -> int:
    if not text:
        return 1
    if not re.fullmatch(r"0*[1-9][0-9]{0,6}", text):
        raise BadArgument(f"{expected}, not {quoted(text)}")
    return int(text)


# -- going back -----------------------------------------------------------------------------------------


def back(session: DebugSession, rest: str) -> CommandResult:
    done = session.runner.position
    if rest.casefold() == "stage":
        position = session.stage_began()
    else:
        position = done - _count(rest, "`back` takes a number of 1 or more, or `stage`")
    if position is None or not done:
        raise Refused("the run is at its first step: there is no earlier state to go back to")
    first = session.first()
    if position < first:
        raise Refused(reach(first) if first else f"`back` can go back at most {counted(done, 'step')}")
    session.back_to(position)
    undone = done - position
    return CommandResult(source=session.source(), said=f"{counted(undone, 'step')} undone")


def undo(session: DebugSession, rest: str) -> CommandResult:
    session.runner.require("undo")
    done = session.runner.system.executed
    if rest.casefold() == "stage":
        left = next((n for n in reversed(range(len(done))) if done[n].enters), 0)
    else:
        left = len(done) - _count(rest, "`undo` takes a number of 1 or more, or `stage`")
    if not done:
        raise Refused("there is nothing for the arm to undo")
    if left < 0:
        raise Refused(f"`undo` can undo only {counted(len(done), 'step')}")
    return _told(session, session.have_undone(left))


# -- breaks ---------------------------------------------------------------------------------------------


def set_break(session: DebugSession, rest: str) -> CommandResult:
    before = len(session.breaks)
    made = session.add_break(rest)
    return CommandResult(
        breaks=(made,), said="this breakpoint is already set" if len(session.breaks) == before else UNSET
    )


def breaks(session: DebugSession, _: str) -> CommandResult:
    return CommandResult(breaks=tuple(Break(number=n, stop=stop) for n, stop in session.breaks.items()))


def delete(session: DebugSession, rest: str) -> CommandResult:
    there = f"breakpoints: {', '.join(map(str, session.breaks)) or 'none'}"
    if not re.fullmatch(r"[0-9]{1,7}", rest):
        wrong = f", not {quoted(rest)}" if rest else ""
        raise BadArgument(f"`delete` takes the number of a breakpoint{wrong}; {there}")
    if int(rest) not in session.breaks:
        raise NoSuchName(f"there is no breakpoint {int(rest)}; {there}")
    del session.breaks[int(rest)]
    return breaks(session, "")


# -- looking --------------------------------------------------------------------------------------------


def script(session: DebugSession, rest: str) -> CommandResult:
    if not rest:
        return CommandResult(source=session.source(None, LISTED_AROUND))
    file, line = named_place(rest, session.program) or ("", 0)
    last = max(lines_of(session.program, file))
    if not 1 <= line <= last:
        raise BadArgument(f"`list` takes a line from 1 to {last}, not {quoted(rest)}")
    return CommandResult(source=session.source((file, line), LISTED_AROUND))


def look(session: DebugSession, rest: str) -> CommandResult:
    return CommandResult(show=show(session.runner, rest, session.pictures))


def picture(session: DebugSession, rest: str) -> CommandResult:
    if not rest:
        raise BadArgument("give `picture` the name of a new file, such as `picture base.png`")
    path = _file(rest)
    check_new(path)
    name = write_picture(session.runner, path)
    return CommandResult(file=str(path), said=f"{name}, in {path}")


# -- interfering ----------------------------------------------------------------------------------------


def experiment(session: DebugSession, rest: str) -> CommandResult:
    _set(session.runner, rest)
    return CommandResult()


def type_line(session: DebugSession, rest: str) -> CommandResult:
    task, _, text = rest.partition(" ")
    session.runner.type_line(text, task)
    return CommandResult(source=session.source())


def answer(choice: Choice) -> Callable[[DebugSession, str], CommandResult]:
    def act(session: DebugSession, _: str) -> CommandResult:
        _check_called(session, choice)
        session.runner.answer(choice)
        return (
            _told(session, session.pause) if session.runner.ended else CommandResult(source=session.source())
        )

    return act


def abort(session: DebugSession, _: str) -> CommandResult:
    _check_called(session, "abort")
    session.over = True
    return CommandResult(said="the run ends here")


def _check_called(session: DebugSession, word: str) -> None:
    if session.runner.call is None:
        raise Refused(f"`{word}` answers a call to the operator, but no call is waiting for an answer")


# -- keeping and leaving --------------------------------------------------------------------------------


def checkpoint(session: DebugSession, rest: str) -> CommandResult:
    if rest:
        path = _file(rest)
        check_place(path, CHECKPOINT)
        check_new(path)
        write_checkpoint(path, session.runner.checkpoint())
        return CommandResult(file=str(path), said=f"saved to {path}")
    kept = session.keep(session.runner.checkpoint())
    if kept is None:
        raise Refused(
            "this run has no folder for checkpoints; `checkpoint FILE` writes a checkpoint to a file"
        )
    return CommandResult(file=str(kept), said=f"saved to {kept}")


def _file(name: str) -> Path:
    """Return the path of a file. Raises InvalidInput if the text cannot be a file name."""
    try:
        path = Path(name).expanduser()
        path.exists()
    except (OSError, RuntimeError, ValueError):  # a name that is too long or contains NUL, or an unknown user
        raise BadArgument(f"{quoted(name)} cannot be a file name") from None
    return path


def leave(session: DebugSession, _: str) -> CommandResult:
    session.over = True
    if session.runner.ended and session.runner.call is None:
        return CommandResult(said="the run has ended, so there is no state to save for `handeye resume`")
    if session.idle:
        return CommandResult(said="no step has run, so there is no state to save")
    path = session.keep(session.runner.checkpoint())
    if path is None:
        return CommandResult(said="nothing was saved, because this run has no folder for checkpoints")
    return CommandResult(file=str(path), said=f"saved to {path}")


MAX_NUMBER: Final = 1000.0


def _set(runner: Runner, text: str) -> None:
    """Set a value. The user gives the kind, name and numbers of the value, such as `saved H 0 0 .1`. Raises
    InvalidInput if the value cannot be set.
    """
    kind, _, rest = text.strip().partition(" ")
    settables = runner.system.settables()
    settable = settables.get(kind.casefold())
    if settable is None:
        known = " or ".join(f"`set {name} {each.usage}`" for name, each in settables.items())
        raise BadArgument(f"write {known}" if known else "this run has no values to set")
    if runner.trouble is not None:
        raise Refused(
            "no value can be set, because the run cannot continue from here; first go back with `back`"
        )
    name, numbers = _read(rest, settable, kind.casefold())
    values = tuple(number * unit for number, unit in zip(numbers, settable.units, strict=False))
    runner.experiment(kind.casefold(), name, values + settable.present(name)[len(values) :])


def _read(text: str, settable: Settable, kind: str) -> tuple[str, list[float]]:
    """Return the name and the numbers in a text. Brackets and commas are ignored."""
    name, *words = re.sub(r"[\[\](),]", " ", text).split() or [""]
    if not name or len(words) not in (settable.fewest, len(settable.units)):
        raise BadArgument(f"write `set {kind} {settable.usage}`")
    numbers = [_number(word) for word in words]
    return _known(name, settable), numbers


def _number(word: str) -> float:
    try:
        value = float(word)
    except ValueError:
        value = math.nan
    if not abs(value) <= MAX_NUMBER:
        raise BadArgument(f"{quoted(word)} is not a number from {-MAX_NUMBER:g} to {MAX_NUMBER:g}")
    return value


def _known(name: str, settable: Settable) -> str:
    for choice in (name, name.upper()):
        if choice in settable.names:
            return choice
    raise NoSuchName(f"the program has no {settable.noun} {quoted(name)}{meant(name, settable.names)}")
