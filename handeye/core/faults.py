"""Faults on demand: what can be broken in a run, each with a dotted name, such as `gap_potentiometer.stuck`.

A task has a catalogue of them. A run records those it was given with its world; handeye never draws one.
"""

from collections.abc import Iterable, Sequence
from dataclasses import dataclass
from typing import Annotated, Final, Literal

import msgspec

from handeye.core.diagnostics import quoted, suggestion
from handeye.core.errors import BadArgument, NoSuchName
from handeye.core.record import Record
from handeye.core.units import UNITS, Unit


class Fault(Record, frozen=True, kw_only=True):
    """One thing that is broken in a run."""

    name: str
    value: float | None = None
    """Its size, SI; None: it has none."""
    stage: Annotated[int, msgspec.Meta(ge=1)] | None = None
    """Number, from 1, of the stage with which it sets in; None: it is there when the cell is switched on."""

    def __str__(self) -> str:
        return self.name if self.stage is None else f"{self.name} from stage {self.stage} on"


@dataclass(frozen=True, slots=True, kw_only=True)
class Size:
    """How large a fault can be, in a unit."""

    unit: str
    """One of UNITS."""
    usual: float
    """Where nobody says how large."""
    limits: tuple[float, float]


@dataclass(frozen=True, slots=True, kw_only=True)
class Expected:
    """How a run with a fault should end, where the fault is of its usual size and there from the beginning."""

    errors: tuple[int, ...] = ()
    """Errors that call it by its right name: whichever it meets first."""
    calls: tuple[str, ...] = ()
    """Words with which the program calls the operator for what no error tells: likewise."""
    at_setup: bool = False
    """The arm cannot be measured or the camera not be calibrated, before the first stage."""
    stages: tuple[str, ...] = ()
    """Names of the stages in which such an error or call is the right one; none: in whichever it comes."""
    harmless: str = ""
    """Why a right pump may come out all the same; empty: it should be noticed."""


UNKNOWN: Final = Expected()
"""Nobody has said by which error it should be noticed."""


@dataclass(frozen=True, slots=True, kw_only=True)
class FaultKind:
    """One fault of a catalogue."""

    name: str
    meaning: str
    """What is broken, and what the program is given in its place: a sentence."""
    size: Size | None = None
    """None: it has no value."""
    when: Literal["before", "during"] = "during"
    """`before` the run: in the world from the start only; `during` it: from the start or with a stage."""
    usual_stage: int | None = None
    """Number of the stage with which it sets in where nobody names one; None: it is there from the beginning then."""
    expected: Expected = UNKNOWN

    @property
    def from_start(self) -> bool:
        """It can be there only from the beginning: nothing could bring it about while the cell works."""
        return self.when == "before"

    @property
    def limits(self) -> tuple[float, float]:
        """Its least and its largest value, in its unit."""
        assert self.size is not None
        return self.size.limits

    @property
    def unit(self) -> str:
        """The unit of its value."""
        assert self.size is not None
        return self.size.unit

    @property
    def measure(self) -> Unit:
        """That unit, with its size."""
        return UNITS[self.unit]

    def usual(self, stage: int | None = None) -> Fault:
        """The fault at its usual size, from a stage on, by its number, or from its usual one."""
        value = None if self.size is None else self.size.usual * self.measure.size
        fault = Fault(name=self.name, value=value, stage=stage or self.usual_stage)
        self.check(fault)
        return fault

    def check(self, fault: Fault) -> None:
        """Make sure that a fault of this name can be had."""
        if fault.stage is not None and self.from_start:
            raise BadArgument(
                f"the fault {quoted(self.name)} cannot set in while the cell works; leave out `@{fault.stage}`"
            )
        if self.size is None and fault.value is not None:
            raise BadArgument(f"the fault {quoted(self.name)} has no value")
        if self.size is not None:
            low, high = (limit * self.measure.size for limit in self.limits)
            if fault.value is None or not low <= fault.value <= high:
                raise BadArgument(
                    f"the fault {quoted(self.name)} cannot be of {fault.value!r}: it can be {low:g} to {high:g} in SI "
                    "units"
                )


class Catalogue:
    """The faults of a task, in the order they are listed."""

    def __init__(self, *kinds: FaultKind, matrix: Sequence[str] = ()) -> None:
        """Faults, and the names of those by which a program is tried where nobody names others."""
        self.kinds = {kind.name: kind for kind in kinds}
        """By name."""
        assert len(self.kinds) == len(kinds), "two faults have one name"
        self.matrix = tuple(matrix) or tuple(self.kinds)
        """Names of the faults by which a program is tried where nobody names others."""
        assert {*self.matrix} <= self.kinds.keys(), "the matrix names a fault that there is not"

    def kind(self, name: str) -> FaultKind:
        """The fault of a name."""
        if name in self.kinds:
            return self.kinds[name]
        inside = [known for known in self.kinds if known.startswith(f"{name}.")]
        if inside:
            raise BadArgument(f"{quoted(name)} is a group of faults: {', '.join(map(quoted, inside))}")
        first = dict.fromkeys(known.split(".")[0] for known in self.kinds)
        near = suggestion(name, self.kinds) or (
            f"there are {', '.join(map(quoted, first))}" if first else "this task has none"
        )
        raise NoSuchName(f"there is no fault {quoted(name)}; {near}")

    def select(self, name: str) -> tuple[FaultKind, ...]:
        """The fault of a name, or those of a group."""
        found = tuple(kind for kind in self.kinds.values() if f"{kind.name}.".startswith(f"{name}."))
        return found or (self.kind(name),)

    def check(self, faults: Sequence[Fault]) -> None:
        """Make sure that a run can be given these faults."""
        for fault in faults:
            self.kind(fault.name).check(fault)
        once(fault.name for fault in faults)

    def told(self, fault: Fault) -> str:
        """A fault as it is written on the command line, its value in its own unit."""
        kind = self.kind(fault.name)
        value = (
            "" if fault.value is None else f"={fault.value / kind.measure.size:g}{kind.unit.replace(' ', '')}"
        )
        return f"{fault.name}{value}" + ("" if fault.stage is None else f"@{fault.stage}")


def once(names: Iterable[str]) -> None:
    """Make sure that no name comes twice."""
    seen: set[str] = set()
    for name in names:
        if name in seen:
            raise BadArgument(f"the fault {quoted(name)} is given twice")
        seen.add(name)
