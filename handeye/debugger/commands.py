"""Commands of the stepper, as they act on a run in hand; each is given what follows its word."""

import re
from collections.abc import Callable
from pathlib import Path
from typing import Final

from msgspec import UNSET

from handeye.core.diagnostics import quoted
from handeye.core.errors import BadArgument, CannotWrite, NoSuchName, Refused
from handeye.core.files import check_place
from handeye.core.plain_text import counted
from handeye.debugger import experiments
from handeye.debugger.breakpoints import breakpoint
from handeye.debugger.pace import factor
from handeye.debugger.reply import Break, CommandResult
from handeye.debugger.session import DebugSession
from handeye.debugger.source_places import named_place, text_of
from handeye.debugger.views import show, write_picture
from handeye.program.events import Choice
from handeye.results.pauses import pause_sentence
from handeye.runs.advance import Pause
from handeye.runs.checkpoint_file import CHECKPOINT, write_checkpoint
from handeye.runs.runner import reach
from handeye.runs.stops import AfterStage, AfterSteps

WIDE: Final = 8
"""Lines that `list` shows before and after a line."""

# -- going on -------------------------------------------------------------------------------------------


def step(hands: DebugSession, rest: str) -> CommandResult:
    """Do so many steps."""
    count = _count(rest, "step takes a number from 1 up")
    pause = hands.go(steps=count)
    as_asked = isinstance(pause.met, AfterSteps)
    return CommandResult(pause=pause, source=hands.source()) if as_asked else _told(hands, pause)


def stage(hands: DebugSession, _: str) -> CommandResult:
    """Go on to the end of the stage."""
    present = hands.stage
    stops = [] if present is None else [AfterStage(stage=present, name=hands.runner.stages[present])]
    return _told(hands, hands.go(stops))


def go_on(hands: DebugSession, _: str) -> CommandResult:
    """Go on to a break."""
    return _told(hands, hands.go())


def until(hands: DebugSession, rest: str) -> CommandResult:
    """Go on to a place."""
    return _told(hands, hands.go([breakpoint(rest, hands.program)]))


def pause(hands: DebugSession, _: str) -> CommandResult:
    """Ask a run that goes on to pause."""
    hands.ask_pause()
    return CommandResult(said="the run pauses behind this step")


def pace(hands: DebugSession, rest: str) -> CommandResult:
    """Set how fast the run goes, or tell it."""
    if rest:
        hands.pace.factor = factor(rest)
    return CommandResult(said=f"the run goes {hands.pace}")


def _told(hands: DebugSession, pause: Pause) -> CommandResult:
    """Result of a command: how far it came, and why no farther."""
    said = hands.at_its_end() or pause_sentence(pause)
    if pause.kind == "panic":
        said += "; the interrupted step is undone"
    return CommandResult(pause=pause, source=hands.source(), said=said)


def _count(text: str, expected: str) -> int:
    if not text:
        return 1
    if not re.fullmatch(r"0*[1-9][0-9]{0,6}", text):
        raise BadArgument(f"{expected}, not {quoted(text)}")
    return int(text)


# -- going back -----------------------------------------------------------------------------------------


def back(hands: DebugSession, rest: str) -> CommandResult:
    """Be again where a step, some steps or a stage had not been done."""
    done = hands.runner.position
    if rest.casefold() == "stage":
        position = hands.stage_began()
    else:
        position = done - _count(rest, "back takes a number from 1 up, or `stage`")
    if position is None or not done:
        raise Refused("this is the beginning of the run")
    first = hands.first()
    if position < first:
        raise Refused(reach(first) if first else f"`back` can undo only {counted(done, 'step')}")
    hands.back_to(position)
    undone = done - position
    return CommandResult(source=hands.source(), said=f"{counted(undone, 'step')} undone")


def undo(hands: DebugSession, rest: str) -> CommandResult:
    """Have the arm undo a step, some steps, or what it did since a stage began."""
    hands.runner.require("undo")
    done = hands.runner.system.executed
    if rest.casefold() == "stage":
        left = next((n for n in reversed(range(len(done))) if done[n].enters), 0)
    else:
        left = len(done) - _count(rest, "undo takes a number from 1 up, or `stage`")
    if not done:
        raise Refused("the arm has done nothing that it could undo")
    if left < 0:
        raise Refused(f"`undo` can undo only {counted(len(done), 'step')}")
    return _told(hands, hands.have_undone(left))


# -- breaks ---------------------------------------------------------------------------------------------


def set_break(hands: DebugSession, rest: str) -> CommandResult:
    """Set a break."""
    before = len(hands.breaks)
    made = hands.add_break(rest)
    return CommandResult(
        breaks=(made,), said="this breakpoint is already set" if len(hands.breaks) == before else UNSET
    )


def breaks(hands: DebugSession, _: str) -> CommandResult:
    """Tell which are set."""
    return CommandResult(breaks=tuple(Break(number=n, stop=stop) for n, stop in hands.breaks.items()))


def delete(hands: DebugSession, rest: str) -> CommandResult:
    """Take a break away."""
    there = f"breakpoints: {', '.join(map(str, hands.breaks)) or 'none'}"
    if not re.fullmatch(r"[0-9]{1,7}", rest):
        wrong = f", not {quoted(rest)}" if rest else ""
        raise BadArgument(f"delete takes the number of a breakpoint{wrong}; {there}")
    if int(rest) not in hands.breaks:
        raise NoSuchName(f"there is no breakpoint {int(rest)}; {there}")
    del hands.breaks[int(rest)]
    return breaks(hands, "")


# -- looking --------------------------------------------------------------------------------------------


def script(hands: DebugSession, rest: str) -> CommandResult:
    """Tell the script around a line."""
    if not rest:
        return CommandResult(source=hands.source(None, WIDE))
    file, line = named_place(rest, hands.program) or ("", 0)
    last = text_of(hands.program, file).removesuffix("\n").count("\n") + 1
    if not 1 <= line <= last:
        raise BadArgument(f"list takes a line from 1 to {last}, not {quoted(rest)}")
    return CommandResult(source=hands.source((file, line), WIDE))


def look(hands: DebugSession, rest: str) -> CommandResult:
    """Show what there is to see."""
    return CommandResult(show=show(hands.runner, rest, hands.pictures))


def picture(hands: DebugSession, rest: str) -> CommandResult:
    """Write the last picture to a file that is not there yet."""
    if not rest:
        raise BadArgument("picture takes the name of a file to write")
    path = _file(rest)
    if path.exists():
        raise CannotWrite(f"{path} already exists; nothing was written")
    name = write_picture(hands.runner, path)
    return CommandResult(file=str(path), said=f"{name}, in {path}")


# -- interfering ----------------------------------------------------------------------------------------


def experiment(hands: DebugSession, rest: str) -> CommandResult:
    """Give what the program remembers another value."""
    experiments.experiment(hands.runner, rest)
    return CommandResult()


def type_line(hands: DebugSession, rest: str) -> CommandResult:
    """Type a line at the console of a task."""
    task, _, text = rest.partition(" ")
    hands.runner.type_line(text, task)
    return CommandResult(source=hands.source())


def answer(choice: Choice) -> Callable[[DebugSession, str], CommandResult]:
    """Answer for the operator."""

    def act(hands: DebugSession, _: str) -> CommandResult:
        _check_called(hands, choice)
        hands.runner.answer(choice)
        return _told(hands, hands.pause) if hands.runner.ended else CommandResult(source=hands.source())

    return act


def abort(hands: DebugSession, _: str) -> CommandResult:
    """End the run where the operator was called."""
    _check_called(hands, "abort")
    hands.over = True
    return CommandResult(said="the run ends here")


def _check_called(hands: DebugSession, word: str) -> None:
    if hands.runner.call is None:
        raise Refused(f"`{word}` answers a call of the operator, and there is none")


# -- keeping and leaving --------------------------------------------------------------------------------


def checkpoint(hands: DebugSession, rest: str) -> CommandResult:
    """Keep the present state."""
    if rest:
        path = _file(rest)
        check_place(path, CHECKPOINT)
        write_checkpoint(path, hands.runner.checkpoint())
        return CommandResult(file=str(path), said=f"saved to {path}")
    kept = hands.keep(hands.runner.checkpoint())
    if kept is None:
        raise Refused("this run has no folder to keep checkpoints in: `checkpoint FILE` writes one")
    return CommandResult(file=str(kept), said=f"saved to {kept}")


def _file(name: str) -> Path:
    """Raises InvalidInput for a name that no file can have."""
    try:
        path = Path(name).expanduser()
        path.exists()
    except (OSError, RuntimeError, ValueError):  # too long a name, nobody's home, a NUL
        raise BadArgument(f"{quoted(name)} cannot be a file name") from None
    return path


def leave(hands: DebugSession, _: str) -> CommandResult:
    """Keep the present state, and end."""
    hands.over = True
    if hands.runner.ended and hands.runner.call is None:
        return CommandResult(said="the run has ended; nothing was saved")
    if hands.idle:
        return CommandResult(said="nothing was done; nothing was saved")
    path = hands.keep(hands.runner.checkpoint())
    if path is None:
        return CommandResult(said="nothing was saved")
    return CommandResult(file=str(path), said=f"saved to {path}")
