"""What the commands of the stepper do to a run in hand; each is given what stands behind its word."""

import re
from collections.abc import Callable
from pathlib import Path
from typing import Final

from msgspec import UNSET

from handeye.diagnostics import quoted
from handeye.errors import InvalidInput
from handeye.files import check_place
from handeye.stepping.advance import Pause
from handeye.stepping.breakpoints import ToStage, breakpoint
from handeye.stepping.checkpoint_file import CHECKPOINT, write_checkpoint
from handeye.stepping.experiments import set_position, set_saved
from handeye.stepping.hands import Hands
from handeye.stepping.places import named_place, text_of
from handeye.stepping.reply import Break, Told
from handeye.stepping.runner import reach
from handeye.stepping.showing import show, write_picture
from handeye.work.executor import Choice

WIDE: Final = 8
"""Lines that `list` tells before and behind a line."""

# -- going on -------------------------------------------------------------------------------------------


def step(hands: Hands, rest: str) -> Told:
    """Do so many steps."""
    count = _count(rest, "step takes a number from 1 up")
    pause = hands.go(steps=count)
    as_asked = pause.kind == "break" and pause.sentence.startswith(f"{count} step")
    return Told(pause=pause, source=hands.source()) if as_asked else _told(hands, pause)


def stage(hands: Hands, _: str) -> Told:
    """Go on to the end of the stage."""
    present = hands.stage
    return _told(hands, hands.go([] if present is None else [ToStage(present)]))


def go_on(hands: Hands, _: str) -> Told:
    """Go on to a break."""
    return _told(hands, hands.go())


def until(hands: Hands, rest: str) -> Told:
    """Go on to a place."""
    return _told(hands, hands.go([breakpoint(rest, hands.runner.setup.plan)]))


def _told(hands: Hands, pause: Pause) -> Told:
    """How far a command came, and why no farther."""
    said = hands.at_its_end() or pause.sentence
    if pause.kind == "panic":
        said += "; the step that was broken off is undone"
    return Told(pause=pause, source=hands.source(), said=said)


def _count(text: str, expected: str) -> int:
    if not text:
        return 1
    if not re.fullmatch(r"0*[1-9][0-9]{0,6}", text):
        raise InvalidInput(f"{expected}; {quoted(text)} is none")
    return int(text)


# -- going back -----------------------------------------------------------------------------------------


def back(hands: Hands, rest: str) -> Told:
    """Be again where a step, some steps or a stage had not been done."""
    done = hands.runner.position
    if rest.casefold() == "stage":
        position = hands.stage_began()
    else:
        position = done - _count(rest, "back takes a number from 1 up, or `stage`")
    if position is None or not done:
        raise InvalidInput("this is the beginning; nothing lies before it")
    first = hands.first()
    if position < first:
        raise InvalidInput(
            reach(first) if first else f"only {done} step{'' if done == 1 else 's'} can be gone back"
        )
    hands.back_to(position)
    undone = done - position
    return Told(source=hands.source(), said=f"{undone} step{'' if undone == 1 else 's'} undone")


# -- breaks ---------------------------------------------------------------------------------------------


def set_break(hands: Hands, rest: str) -> Told:
    """Set a break."""
    before = len(hands.breaks)
    made = hands.add_break(rest)
    return Told(breaks=(made,), said="it is set already" if len(hands.breaks) == before else UNSET)


def breaks(hands: Hands, _: str) -> Told:
    """Tell which are set."""
    return Told(breaks=tuple(Break(number=n, at=str(stop)) for n, stop in hands.breaks.items()))


def delete(hands: Hands, rest: str) -> Told:
    """Take a break away."""
    there = f"those that are set: {', '.join(map(str, hands.breaks)) or 'none'}"
    if not re.fullmatch(r"[0-9]{1,7}", rest):
        wrong = f"; {quoted(rest)} is none" if rest else ""
        raise InvalidInput(f"delete takes the number of a break{wrong}; {there}")
    if int(rest) not in hands.breaks:
        raise InvalidInput(f"no break has the number {int(rest)}; {there}")
    del hands.breaks[int(rest)]
    return breaks(hands, "")


# -- looking --------------------------------------------------------------------------------------------


def script(hands: Hands, rest: str) -> Told:
    """Tell the script around a line."""
    if not rest:
        return Told(source=hands.source(None, WIDE))
    file, line = named_place(rest, hands.program) or ("", 0)
    last = text_of(hands.program, file).removesuffix("\n").count("\n") + 1
    if not 1 <= line <= last:
        raise InvalidInput(f"list takes a line from 1 to {last}; {quoted(rest)} is none")
    return Told(source=hands.source((file, line), WIDE))


def look(hands: Hands, rest: str) -> Told:
    """Show what there is to see."""
    return Told(show=show(hands.runner, rest, hands.pictures))


def picture(hands: Hands, rest: str) -> Told:
    """Write the last picture to a file that is not there yet."""
    if not rest:
        raise InvalidInput("picture takes the name of a file to write")
    path = _file(rest)
    if path.exists():
        raise InvalidInput(f"{path} is there already; it is left alone")
    name = write_picture(hands.runner, path)
    return Told(file=str(path), said=f"{name}, in {path}")


# -- interfering ----------------------------------------------------------------------------------------


def experiment(hands: Hands, rest: str) -> Told:
    """Give what the program remembers another value."""
    kind, _, values = rest.partition(" ")
    act = {"saved": set_saved, "position": set_position}.get(kind.casefold())
    if act is None:
        raise InvalidInput("an experiment is `set saved NAME x y z` or `set position NAME x y z [o a t]`")
    if hands.runner.trouble is not None:
        raise InvalidInput("nothing can be tried from here; go back first")
    act(hands.runner, values)
    return Told()


def answer(choice: Choice) -> Callable[[Hands, str], Told]:
    """Answer for the operator."""

    def act(hands: Hands, _: str) -> Told:
        _check_called(hands, choice)
        hands.runner.answer(choice)
        return _told(hands, hands.pause) if hands.runner.ended else Told(source=hands.source())

    return act


def abort(hands: Hands, _: str) -> Told:
    """End the run where the operator was called."""
    _check_called(hands, "abort")
    hands.over = True
    return Told(said="the run ends here")


def _check_called(hands: Hands, word: str) -> None:
    if not hands.runner.called:
        raise InvalidInput(f"`{word}` is for when the operator is called, and nobody has called")


# -- keeping and leaving --------------------------------------------------------------------------------


def checkpoint(hands: Hands, rest: str) -> Told:
    """Keep the present state."""
    if rest:
        path = _file(rest)
        check_place(path, CHECKPOINT)
        write_checkpoint(path, hands.runner.checkpoint())
        return Told(file=str(path), said=f"kept in {path}")
    kept = hands.keep(hands.runner.checkpoint())
    if kept is None:
        raise InvalidInput("the checkpoints of this run are kept nowhere; name a file")
    return Told(file=str(kept), said=f"kept in {kept}")


def _file(name: str) -> Path:
    """Raises InvalidInput for a name that no file can have."""
    try:
        path = Path(name).expanduser()
        path.exists()
    except (OSError, RuntimeError, ValueError):  # too long a name, nobody's home, a NUL
        raise InvalidInput(f"{quoted(name)} cannot be a file's name") from None
    return path


def leave(hands: Hands, _: str) -> Told:
    """Keep the present state, and end."""
    hands.over = True
    if hands.runner.ended and not hands.runner.called:
        return Told(said="nothing is left to go on with")
    if hands.idle:
        return Told(said="nothing was done, so that nothing is kept")
    path = hands.keep(hands.runner.checkpoint())
    if path is None:
        return Told(said="nothing is kept")
    return Told(file=str(path), said=f"kept in {path}")
