"""Reads the files of relays. Each line names a stage, and the file with the program for this stage:

; a comment
STAGE "insert the aligning pins"  pins.trig
"""

import re
from dataclasses import dataclass
from pathlib import PurePosixPath
from typing import Final

from handeye.core.diagnostics import Diagnostic, problem, quoted
from handeye.core.entries import PLANNED, entry_of_file
from handeye.core.source import Source, Span

PLANNED_ENDING: Final = ".al"
UNREADABLE: Final = "relay-line"
REPEATED: Final = "relay-stage-twice"
NO_SYSTEM: Final = "relay-language"
NO_LEGS: Final = "relay-empty"
MOST_LEGS: Final = 100
_LINE: Final = re.compile(r'\s*STAGE\s+"([^"\n]{1,80})"\s+([^\s;"]+)\s*(?:;.*)?', re.IGNORECASE)


@dataclass(frozen=True, slots=True, kw_only=True)
class LegLine:
    """A line of a relay."""

    line: int
    span: Span
    stage: str
    file: str
    system: str


def parsed(source: Source) -> tuple[list[LegLine], list[Diagnostic]]:
    """Return the legs of a relay, and the mistakes in the relay's text."""
    legs: list[LegLine] = []
    found: list[Diagnostic] = []
    start = 0
    for number, text in enumerate(source.text.split("\n"), 1):
        span = Span(start=start, end=start + len(text.rstrip()))
        start += len(text) + 1
        if not text.split(";")[0].strip():
            continue
        made = _leg(number, text, span, {leg.stage for leg in legs})
        if isinstance(made, LegLine):
            legs.append(made)
        else:
            found.append(made)
    if not legs and not found:
        found.append(_mistake(NO_LEGS, "the relay has no legs", Span(start=0, end=0)))
    if len(legs) > MOST_LEGS:
        found.append(_mistake(NO_LEGS, f"a relay has at most {MOST_LEGS} legs", legs[MOST_LEGS].span))
    return legs, found


def _leg(number: int, text: str, span: Span, stages: set[str]) -> LegLine | Diagnostic:
    match = _LINE.fullmatch(text.rstrip("\r"))
    if match is None:
        return _mistake(UNREADABLE, 'a line must be STAGE "name of the stage" FILE', span)
    stage, file = match[1].strip(), match[2]
    if not stage:
        return _mistake(UNREADABLE, "the stage has no name", span)
    if stage in stages:
        return _mistake(REPEATED, f"the stage {quoted(stage)} is done by an earlier leg", span)
    if PurePosixPath(file).is_absolute() or "\\" in file:
        return _mistake(UNREADABLE, f"{quoted(file)} must be a path from the folder of the relay", span)
    entry, _ = entry_of_file(file)
    if entry is None and not file.lower().endswith(PLANNED_ENDING):
        return _mistake(NO_SYSTEM, f"no system has a language for the file {quoted(file)}", span)
    system = PLANNED if entry is None else entry.name
    if entry is not None and "leg" not in entry.can:
        return _mistake(NO_SYSTEM, f"{entry.title} cannot run a leg of a relay", span)
    return LegLine(line=number, span=span, stage=stage, file=file, system=system)


def _mistake(code: str, message: str, span: Span) -> Diagnostic:
    return problem(code, message, span, own="error")
