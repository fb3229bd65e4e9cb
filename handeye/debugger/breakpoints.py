"""Breakpoints in the form in which users name them: an error, a line, a label, an instruction, a stage or a
step."""

import re
from collections.abc import Iterable
from typing import Final

from handeye.al.instructions import INSTRUCTIONS
from handeye.core.diagnostics import nearest, quoted
from handeye.core.errors import BadArgument, NoSuchName, Refused
from handeye.core.source import line_name
from handeye.debugger.listing import Place, named_place
from handeye.program.graph import reachable
from handeye.program.stage_names import stage_called, stage_index
from handeye.runs.advance import AnyStop, AtInstruction, AtLabel, AtLine, AtStage, AtSteps, OnError
from handeye.runs.snapshot import Checkpoint
from handeye.runs.system import Listing
from handeye.runs.systems import listing_of

_NUMBER: Final = re.compile(r"[0-9]{1,9}")
_ERROR: Final = re.compile(r"error\s*:\s*(?P<any>.*)|error\s+(?P<number>\d+)", re.IGNORECASE)


def breakpoint(text: str, listing: Listing) -> AnyStop:
    """Return the breakpoint that a text names. Raises InvalidInput if the place that the text names does not exist, or
    if the text names an error that no step can raise.

    The text names an error (`error:23`), a label, or a stage (by its name or a part of the name). A line of the
    source, such as `12` or `pins.al:3`, means the first step on the line or after it. An instruction word means every
    step that begins with that word.
    """
    text = text.strip()
    if not text:
        raise BadArgument("give an error (error:23), a line, a label, an instruction or a stage")
    if error := _ERROR.fullmatch(text):
        if not listing.errors:
            raise Refused(
                "no step of this program raises an error, so no breakpoint can wait for an error; even without a "
                "breakpoint, the run pauses if the program calls the operator"
            )
        return _on_error(error["number"] or error["any"], listing)
    place = named_place(text, listing)
    if place is not None:
        return _at_line(place, listing)
    stop = _at_label(text, listing) or _at_word(text, listing) or _at_stage(text, listing)
    if stop is None and text.upper() in INSTRUCTIONS:
        raise NoSuchName(f"no step of the program begins with {text.upper()}")
    if stop is None:
        known = [*listing.labels, *_words(listing), *listing.stages]
        raise NoSuchName(f"the program has no label, instruction or stage {quoted(text)}{meant(text, known)}")
    return stop


def stage_number(text: str, listing: Listing) -> int:
    """Return the index of a stage. The user gives the stage's number (counted from 1), its name, or a part of the
    name that no other stage's name contains. Raises InvalidInput if `text` does not name exactly one stage.
    """
    return stage_index(text, listing.stages)


def step_number(text: str, listing: Listing) -> int:
    """Return the index of a step. The user gives the step's number in the plan, or a label that no other step has.
    Raises InvalidInput if `text` does not name exactly one step.
    """
    text, steps = text.strip(), listing.steps
    if _NUMBER.fullmatch(text):
        if int(text) >= len(steps):
            raise NoSuchName(f"there is no step {int(text)}; the program has steps 0 to {len(steps) - 1}")
        return int(text)
    found = listing.labels.get(text)
    if found is None:
        known = listing.labels
        raise BadArgument(f"{quoted(text)} is neither the number of a step nor a label{meant(text, known)}")
    if len(found) > 1:
        where = ", ".join(map(str, found))
        raise BadArgument(
            f"several steps have the label {quoted(text)}: {where}; give the number of one of them"
        )
    return found[0]


def meant(name: str, known: Iterable[str]) -> str:
    """Return `; did you mean ...` with the nearest known name. The text is empty if more than half of the characters
    of `name` would have to be changed.

    Names typed at the stepper are short, so half of the characters may be wrong: a user who types `L9` may mean `L1`.
    """
    near = nearest(name, known, (len(name) + 1) // 2)
    return f"; did you mean {quoted(near)}?" if near else ""


# -- one kind each --------------------------------------------------------------------------------------


def _on_error(number: str, listing: Listing) -> AnyStop:
    if not _NUMBER.fullmatch(number) or int(number) not in listing.errors:
        raise NoSuchName(
            f"no step raises error {quoted(number)}; the steps raise {', '.join(map(str, listing.errors))}"
        )
    return OnError(number=int(number))


def _at_line(place: Place, listing: Listing) -> AnyStop:
    file, line = place
    lines = {i: step.line for i, step in enumerate(listing.steps) if step.file == file}
    if not lines:
        raise BadArgument(f"{quoted(file or listing.name)} contains no step")
    last = max(lines.values())
    if line > last:
        wanted, on = line_name(line, file), line_name(last, file)
        raise BadArgument(f"line {wanted} is after the last step, which is on line {on}")
    first = min(number for number in lines.values() if number >= line)
    steps = tuple(i for i, number in lines.items() if number == first)
    return AtLine(steps=steps, file=file, line=first)


def _at_label(text: str, listing: Listing) -> AnyStop | None:
    known = listing.labels
    label = text if text in known else text.upper()
    return AtLabel(steps=tuple(known[label]), label=label) if label in known else None


def _words(listing: Listing) -> list[str]:
    return [step.word.upper() for step in listing.steps]


def _at_word(text: str, listing: Listing) -> AnyStop | None:
    steps = tuple(i for i, word in enumerate(_words(listing)) if word == text.upper())
    return AtInstruction(steps=steps, word=text.upper()) if steps else None


def _at_stage(text: str, listing: Listing) -> AnyStop | None:
    stage = stage_called(text, listing.stages)
    return None if stage is None else AtStage(stage=stage, name=listing.stages[stage])


# -- reaching one ---------------------------------------------------------------------------------------


def is_ahead(stop: AnyStop, start: Checkpoint) -> bool:
    """Return True if one of the tasks of a run that begins at `start` can still reach the place of a stop. Stops
    without a place, such as errors, count as reachable.
    """
    listing = listing_of(start.setup)
    wanted, ways = _steps(stop, listing), [step.ways for step in listing.steps]
    if wanted is None:
        return True
    places = [0] if start.snapshot is None else [place.step for place in start.snapshot.state.places]
    return any(not wanted.isdisjoint(reachable(ways[step], ways)) for step in places)


def _steps(stop: AnyStop, listing: Listing) -> frozenset[int] | None:
    """Return the steps before which a condition stops the run, or None if the condition names no step and no stage."""
    match stop:
        case AtSteps():
            return frozenset(stop.steps)
        case AtStage():
            return frozenset(i for i, step in enumerate(listing.steps) if step.stage == stop.stage)
    return None
