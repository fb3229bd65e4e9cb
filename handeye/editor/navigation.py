"""From a name to where it is made and used, and to another name."""

import re
from collections.abc import Iterable
from dataclasses import dataclass
from typing import Final

from handeye.al.definition import AXES
from handeye.al.includes import key_of, own_key, required_by
from handeye.al.instructions import INSTRUCTIONS, OPERAND_WORDS
from handeye.core.diagnostics import quoted
from handeye.core.errors import BadArgument, Refused
from handeye.core.source import Span
from handeye.editor.document import Document
from handeye.editor.occurrences import LABEL, MACRO, PARAMETER, PARK, PART, POSITION, Occurrence, same

_NAME: Final = re.compile(r"[A-Za-z_]\w*", re.ASCII)


@dataclass(frozen=True, slots=True, kw_only=True)
class Found:
    """A place in the script, in the file of what was taught, or in a required one."""

    span: Span
    taught: bool = False
    file: str = ""
    """The key of a required file."""


@dataclass(frozen=True, slots=True, kw_only=True)
class Edit:
    """Characters to be replaced."""

    span: Span
    text: str
    taught: bool = False
    """In the file of what was taught."""
    file: str = ""
    """In the required file of that key."""


def definition(document: Document, offset: int) -> list[Found]:
    """Definitions of the name at an offset: each place where a difference is saved; the beginning of a file."""
    for file in required_by(document.text):
        key = key_of(file.text, own_key(document.source))
        if file.span.start <= offset <= file.span.end:
            there = [text for text in document.whole.required if text.key == key and not text.problem]
            return [Found(span=Span(start=0, end=0), file=text.key) for text in there]
    name = document.name_at(offset)
    return [] if name is None else [f for o, f in _all(document, name) if o.makes]


def references(document: Document, offset: int) -> list[Found]:
    """Occurrences of the name at an offset."""
    name = document.name_at(offset)
    return [] if name is None else [found for _, found in _all(document, name)]


def renamable(document: Document, offset: int) -> Occurrence:
    """The name at an offset, if it can be renamed."""
    name = document.name_at(offset)
    if name is None:
        raise Refused("there is no name here")
    places = [occurrence for occurrence, _ in _all(document, name)]
    if any(place.fixed for place in places) or (name.kind, name.name) == (POSITION, PARK):
        raise Refused(f"{quoted(name.name)} is a word of the language")
    if not any(place.makes for place in places):
        where = "in the taught file" if _is_taught(document, name) else "anywhere"
        raise Refused(f"the definition of {name.kind} {quoted(name.name)} is not found {where}")
    return name


def rename(document: Document, offset: int, new: str) -> list[Edit]:
    """Edits of the script, the taught file and the required files that rename a thing."""
    name = renamable(document, offset)
    if _NAME.fullmatch(new) is None:
        raise BadArgument(
            f"{quoted(new)} is not a name: names consist of letters, digits and `_`, and do not start with a digit"
        )
    if (
        name.kind in (MACRO, LABEL, PARAMETER) and new.upper() in (*INSTRUCTIONS, "DEFINE")
    ) or new.upper() in OPERAND_WORDS:
        raise BadArgument(f"{quoted(new)} is a word of the language")
    if name.kind == PARAMETER and new in AXES:
        raise BadArgument(f"{quoted(new)} is an axis of the table")
    others = [*document.names, *document.taught_names, *(o for _, o in document.required_names)]
    if new != name.name and any(_meets(other, name, new) for other in others):
        raise Refused(f"there is a {name.kind} {quoted(new)} already")
    if new != name.name and (macro := _hidden(others, name, new)):
        raise Refused(f"in macro {quoted(macro)} {quoted(new)} stands for something else")
    return [Edit(span=f.span, text=new, taught=f.taught, file=f.file) for _, f in _all(document, name)]


def _meets(other: Occurrence, name: Occurrence, new: str) -> bool:
    """True if a name clashes with the new one; AIM takes positions and parts alike."""
    if name.kind == PARAMETER:
        return False
    if name.kind == LABEL:
        return other.kind == LABEL and other.name == new
    kinds = (POSITION, PART) if name.kind in (POSITION, PART) else (name.kind,)
    called = new.upper() if name.kind == MACRO else new
    return other.kind in kinds and other.name == called and not same(other, name)


def _hidden(others: Iterable[Occurrence], name: Occurrence, new: str) -> str | None:
    """A macro in which the new name of a thing is a parameter, or that of a parameter a thing; None if none is."""
    used = {other.macro for other in others if same(other, name)} - {""}
    for other in others:
        if other.name == new and other.macro in used and PARAMETER in (other.kind, name.kind):
            return other.macro
    return None


def _is_taught(document: Document, name: Occurrence) -> bool:
    return name.name in document.taught_of(name.kind)


def _all(document: Document, name: Occurrence) -> list[tuple[Occurrence, Found]]:
    """Every occurrence of a name, with its place."""
    own = [(o, Found(span=o.span)) for o in document.names]
    taught = [(o, Found(span=o.span, taught=True)) for o in document.taught_names]
    required = [(o, Found(span=o.span, file=text.key)) for text, o in document.required_names]
    return [place for place in (*own, *taught, *required) if same(place[0], name)]
