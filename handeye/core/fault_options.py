"""Parsing of faults from the words typed: `NAME[=VALUE][@STAGE]`."""

from collections.abc import Callable, Iterable

from handeye.core.diagnostics import quoted
from handeye.core.errors import BadArgument
from handeye.core.faults import Catalogue, Fault, FaultKind
from handeye.core.world_options import value_of

StageNumber = Callable[[str], int]
"""The number, from 1, of a stage as written. Raises InvalidInput if there is none such."""


def faults(catalogue: Catalogue, texts: Iterable[str], stage: StageNumber) -> tuple[Fault, ...]:
    """Faults from their options, in the order of their names."""
    found = tuple(sorted((_fault(catalogue, text, stage) for text in texts), key=lambda fault: fault.name))
    catalogue.check(found)
    return found


def _fault(catalogue: Catalogue, text: str, stage: StageNumber) -> Fault:
    what, at, where = text.partition("@")
    name, equals, value = (part.strip() for part in what.partition("="))
    where = where.strip().strip('"').strip()
    if not name or (at and not where) or (equals and not value):
        raise BadArgument(f"{quoted(text)} names no fault; write NAME, NAME=VALUE or NAME@STAGE")
    kind = catalogue.kind(name)
    return Fault(name=name, value=_value(kind, value), stage=stage(where) if at else kind.usual_stage)


def _value(kind: FaultKind, text: str) -> float | None:
    """The value (SI) of a fault as written; if nothing is, its usual one."""
    if not text:
        return kind.usual().value
    if kind.size is None:
        raise BadArgument(f"the fault {quoted(kind.name)} has no value; leave out {quoted(f'={text}')}")
    return value_of(kind, text)


def by_number(text: str) -> int:
    """The number of a stage where no program is known whose stages have names."""
    if not (text.isascii() and text.isdigit() and len(text) < 10 and int(text) > 0):
        raise BadArgument(f"{quoted(text)} is no number of a stage, from 1 up")
    return int(text)


def from_start_only(text: str) -> int:
    """Where nothing has stages."""
    raise BadArgument(f"a fault is there from the beginning here; leave out {quoted(f'@{text}')}")
