"""Writes a page for the terminal, or one JSON object, with the faults of a task and the expected outcome of each
fault.
"""

import re
from collections.abc import Sequence
from itertools import groupby
from textwrap import fill
from typing import Final

import msgspec
from rich.console import Group, RenderableType
from rich.text import Text

from handeye.core.errors import ERRORS
from handeye.core.faults import Catalogue, ExpectedDetection, FaultKind, Size

_PLACEHOLDER: Final = re.compile(r"\{[^}]*\}")  # such as `{number}`, for which a call can have several words


class FaultReport(msgspec.Struct, frozen=True, kw_only=True):
    """A fault of a task's catalogue."""

    name: str
    meaning: str
    size: Size | None  # None: the fault has no size
    from_start: bool  # True if the fault can only be present from the start
    later: bool  # True if the fault can also begin after a time
    usual_stage: int | None
    """Number of the stage at which the fault begins by default; None if the fault is present from the start."""
    expected: ExpectedDetection
    must: str  # Sentence that says what must happen in a run with this fault
    matrix: bool


class FaultsReport(msgspec.Struct, frozen=True, kw_only=True):
    """Some or all faults of a task's catalogue."""

    faults: tuple[FaultReport, ...]


def report(catalogue: Catalogue, kinds: Sequence[FaultKind]) -> FaultsReport:
    """Make the report on the given faults of a catalogue."""
    return FaultsReport(faults=tuple(_reported(kind, catalogue) for kind in kinds))


def faults_json(catalogue: Catalogue, kinds: Sequence[FaultKind]) -> bytes:
    """Return faults of a catalogue as one JSON object."""
    return msgspec.json.format(msgspec.json.encode(report(catalogue, kinds)), indent=1) + b"\n"


def faults_page(catalogue: Catalogue, kinds: Sequence[FaultKind], columns: int) -> RenderableType:
    """Return faults of a catalogue as a page for a terminal that is `columns` wide."""
    found = report(catalogue, kinds).faults
    parts: list[RenderableType] = []
    for device, faults in groupby(found, lambda fault: fault.name.split(".")[0]):
        parts += [Text(), Text(device, "bold")] if parts else [Text(device, "bold")]
        for fault in faults:
            parts += [
                _head(fault),
                Text(_filled(fault.meaning, columns)),
                Text(_filled(fault.must, columns), "dim"),
            ]
    return Group(*parts)


def _filled(sentence: str, columns: int) -> str:
    return fill(sentence, columns, initial_indent="    ", subsequent_indent="    ")


def _reported(kind: FaultKind, catalogue: Catalogue) -> FaultReport:
    return FaultReport(
        name=kind.name,
        meaning=kind.meaning,
        size=kind.size,
        from_start=kind.from_start,
        later=kind.when == "later",
        usual_stage=kind.usual_stage,
        expected=kind.expected,
        must=_must(kind.expected),
        matrix=kind.name in catalogue.matrix,
    )


def _must(expected: ExpectedDetection) -> str:
    """Return a sentence that says how a fault must be detected."""
    errors = " or ".join(f"{number} ({ERRORS[number]})" for number in expected.errors)
    ways = [
        *(["before the first stage"] if expected.at_setup else []),
        *([f"with error {errors}"] if errors else []),
        *(f"with “{_PLACEHOLDER.sub('…', call)}”" for call in expected.calls),
    ]
    stops = f"stops {', or '.join(ways)}" if ways else ""
    if stops and expected.stages:
        stops += f", in {' or '.join(f'“{stage}”' for stage in expected.stages)}"
    if not expected.harmless:
        return f"The program {stops}." if stops else "No outcome is specified."
    return f"The program {stops}, or it ends and the work is right." if stops else "The work is right."


def _head(fault: FaultReport) -> Text:
    """Return the name of a fault with its possible sizes."""
    row = Text(f"  {fault.name}")
    if fault.size is not None:
        low, high = fault.size.limits
        row.append(f"={fault.size.usual:g}{fault.size.unit.replace(' ', '')}", "cyan").append(
            f"  ({low:g} to {high:g})", "dim"
        )
    if fault.matrix:
        row.append("  in the standard set", "green")
    if fault.usual_stage is not None:
        row.append(f"  @{fault.usual_stage} by default", "dim")
    if fault.later:
        row.append("  or later, as with @30s", "dim")
    return row.append("  from the start only", "dim") if fault.from_start else row
