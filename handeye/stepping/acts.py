"""What the commands of the stepper do to a session; each is given what stands behind its word."""

import re
from collections.abc import Callable
from pathlib import Path
from typing import Final

from handeye.diagnostics import quoted
from handeye.errors import InvalidInput
from handeye.stepping.advance import Pause
from handeye.stepping.breakpoints import ToStage, breakpoint
from handeye.stepping.checkpoint_file import read_head, write_checkpoint
from handeye.stepping.experiments import set_position, set_saved
from handeye.stepping.places import named_place, text_of
from handeye.stepping.reply import Break, Told
from handeye.stepping.session import Session
from handeye.stepping.showing import show
from handeye.work.executor import Choice

WIDE: Final = 8
"""Lines that `list` tells before and behind a line."""

# -- going on -------------------------------------------------------------------------------------------


def step(session: Session, rest: str) -> Told:
    """Do so many steps."""
    count = _count(rest, "step takes a number from 1 up")
    pause = session.go(steps=count)
    as_asked = pause.kind == "break" and pause.sentence.startswith(f"{count} step")
    return Told(pause=pause, source=session.source()) if as_asked else _told(session, pause)


def stage(session: Session, _: str) -> Told:
    """Go on to the end of the stage."""
    present = session.stage
    return _told(session, session.go([] if present is None else [ToStage(present)]))


def go_on(session: Session, _: str) -> Told:
    """Go on to a break."""
    return _told(session, session.go())


def until(session: Session, rest: str) -> Told:
    """Go on to a place."""
    return _told(session, session.go([breakpoint(rest, session.runner.setup.plan)]))


def _told(session: Session, pause: Pause) -> Told:
    """How far a command came, and why no farther."""
    said = session.at_its_end() or pause.sentence
    if pause.kind == "panic":
        said += "; the step that was broken off is undone"
    return Told(pause=pause, source=session.source(), said=said)


def _count(text: str, expected: str) -> int:
    if not text:
        return 1
    if not re.fullmatch(r"0*[1-9][0-9]{0,6}", text):
        raise InvalidInput(f"{expected}; {quoted(text)} is none")
    return int(text)


# -- going back -----------------------------------------------------------------------------------------


def back(session: Session, rest: str) -> Told:
    """Be again where a step, some steps or a stage had not been done."""
    done = session.runner.position
    if rest.casefold() == "stage":
        position = session.stage_began()
    else:
        position = done - _count(rest, "back takes a number from 1 up, or `stage`")
    if position is None or not done:
        raise InvalidInput("this is the beginning; nothing lies before it")
    if position < 0:
        raise InvalidInput(f"only {done} step{'' if done == 1 else 's'} can be gone back")
    session.back_to(position)
    undone = done - position
    return Told(source=session.source(), said=f"{undone} step{'' if undone == 1 else 's'} undone")


# -- breaks ---------------------------------------------------------------------------------------------


def set_break(session: Session, rest: str) -> Told:
    """Set a break."""
    return Told(breaks=(session.add_break(rest),))


def breaks(session: Session, _: str) -> Told:
    """Tell which are set."""
    return Told(breaks=tuple(Break(number=n, at=str(stop)) for n, stop in session.breaks.items()))


def delete(session: Session, rest: str) -> Told:
    """Take a break away."""
    number = int(rest) if re.fullmatch(r"[0-9]{1,7}", rest) else 0
    if number not in session.breaks:
        there = ", ".join(map(str, session.breaks)) or "none"
        raise InvalidInput(f"no break has the number {quoted(rest)}; those that are set: {there}")
    del session.breaks[number]
    return breaks(session, "")


# -- looking --------------------------------------------------------------------------------------------


def script(session: Session, rest: str) -> Told:
    """Tell the script around a line."""
    if not rest:
        return Told(source=session.source(None, WIDE))
    file, line = named_place(rest, session.program) or ("", 0)
    last = text_of(session.program, file).removesuffix("\n").count("\n") + 1
    if not 1 <= line <= last:
        raise InvalidInput(f"list takes a line from 1 to {last}; {quoted(rest)} is none")
    return Told(source=session.source((file, line), WIDE))


def look(session: Session, rest: str) -> Told:
    """Show what there is to see."""
    return Told(show=show(session.runner, rest, session.pictures))


# -- interfering ----------------------------------------------------------------------------------------


def experiment(session: Session, rest: str) -> Told:
    """Give what the program remembers another value."""
    kind, _, values = rest.partition(" ")
    act = {"saved": set_saved, "position": set_position}.get(kind.casefold())
    if act is None:
        raise InvalidInput("an experiment is `set saved NAME x y z` or `set position NAME x y z [o a t]`")
    if session.runner.trouble is not None:
        raise InvalidInput("nothing can be tried from here; go back first")
    act(session.runner, values)
    return Told()


def answer(choice: Choice) -> Callable[[Session, str], Told]:
    """Answer for the operator."""

    def act(session: Session, _: str) -> Told:
        _check_called(session, choice)
        session.runner.answer(choice)
        return _told(session, session.pause) if session.runner.ended else Told(source=session.source())

    return act


def abort(session: Session, _: str) -> Told:
    """End the run where the operator was called."""
    _check_called(session, "abort")
    session.over = True
    return Told(said="the run ends here")


def _check_called(session: Session, word: str) -> None:
    if not session.runner.called:
        raise InvalidInput(f"`{word}` is for when the operator is called, and nobody has called")


# -- keeping and leaving --------------------------------------------------------------------------------


def checkpoint(session: Session, rest: str) -> Told:
    """Keep the present state."""
    if rest:
        try:
            path = Path(rest).expanduser()
            _check_replaceable(path)
            write_checkpoint(path, session.runner.checkpoint())
        except (OSError, RuntimeError, ValueError):  # too long a name, nobody's home, a NUL
            raise InvalidInput(f"{quoted(rest)} cannot be a file's name") from None
        return Told(file=str(path), said=f"kept in {path}")
    kept = session.keep(session.runner.checkpoint())
    if kept is None:
        raise InvalidInput("the checkpoints of this run are kept nowhere; name a file")
    return Told(file=str(kept), said=f"kept in {kept}")


def _check_replaceable(path: Path) -> None:
    """Raises InvalidInput for a file that is something else than a checkpoint."""
    if path.exists():
        try:
            read_head(path)
        except InvalidInput:
            raise InvalidInput(f"{path} is there already and is no checkpoint; it is left alone") from None


def leave(session: Session, _: str) -> Told:
    """Keep the present state, and end."""
    session.over = True
    if session.runner.ended and not session.runner.called:
        return Told(said="nothing is left to go on with")
    path = session.keep(session.runner.checkpoint())
    if path is None:
        return Told(said="nothing is kept")
    return Told(file=str(path), said=f"kept: `handeye resume {path}` goes on from here")
