"""Faults that can be injected in a run, each with a dotted name such as `gap_potentiometer.stuck`.

Each task has a catalogue of faults. A run records its faults with its world. Faults are never drawn at random.
"""

import re
from collections.abc import Iterable, Sequence
from dataclasses import dataclass
from typing import Annotated, Final, Literal

import msgspec

from handeye.core.diagnostics import quoted, suggestion
from handeye.core.errors import BadArgument, NoSuchName
from handeye.core.record import Record
from handeye.core.units import UNITS, Unit


class Fault(Record, frozen=True, kw_only=True):
    """One injected fault of a run. The fault is present from the start, unless `stage` or `after` is given."""

    name: str
    value: float | None = None  # size, in SI units; None if the kind has none
    stage: Annotated[int, msgspec.Meta(ge=1)] | None = None  # number of the stage at which it begins, from 1
    after: Annotated[float, msgspec.Meta(gt=0)] | None = None  # s of simulated time after which it begins

    def __str__(self) -> str:
        if self.after is not None:
            return f"{self.name} from {self.after:g} s on"
        return self.name if self.stage is None else f"{self.name} from stage {self.stage} on"


@dataclass(frozen=True, slots=True, kw_only=True)
class Size:
    """The possible sizes of a fault, in a unit that `UNITS` lists."""

    unit: str
    usual: float
    limits: tuple[float, float]


@dataclass(frozen=True, slots=True, kw_only=True)
class ExpectedDetection:
    """The expected end of a run in which a fault of usual size is present from the start."""

    errors: tuple[int, ...] = ()  # errors that identify it
    calls: tuple[str, ...] = ()
    """Messages to the operator that identify the fault. In a message, `{...}` stands for the name or the number of any
    part.
    """
    at_setup: bool = False  # measuring the arm or calibrating the camera fails
    stages: tuple[str, ...] = ()  # stages in which these errors and messages are right; empty if all are
    harmless: str = ""  # why the work may come out right all the same; empty if the fault must be noticed

    def called(self, message: str) -> bool:
        """Return True if a message to the operator identifies the fault."""
        return any(is_call(call, message) for call in self.calls)


def is_call(call: str, message: str) -> bool:
    """Return True if a message to the operator matches the pattern `call`, in which `{...}` stands for the name or the
    number of any part.
    """
    return re.fullmatch(".+".join(map(re.escape, re.split(r"\{[^}]*\}", call))), message) is not None


UNKNOWN: Final = ExpectedDetection()  # no expectation stated


@dataclass(frozen=True, slots=True, kw_only=True)
class SpoiledWork:
    """Finished work that a fault spoils even if the arm does not move. If the fault spoils the work after the
    program's last step that senses this work, the program cannot notice the fault.
    """

    findings: tuple[str, ...]  # beginnings of the names of the referee's findings on this work
    where: str = ""  # its place, as the claims of the task's obligations name it; empty: no single place
    delay: float = 0.0  # s from the beginning of the fault until it spoils the work


@dataclass(frozen=True, slots=True, kw_only=True)
class FaultKind:
    """A fault that a catalogue offers: its name, its meaning, its possible sizes and its expected detection."""

    name: str
    meaning: str  # a sentence: what is broken, and what the program gets instead
    size: Size | None = None  # None if the fault has no size
    when: Literal["before", "during", "later"] = "during"
    """`before` if the fault can only be present from the start of the run. `during` if the fault can be present from
    the start or begin at a stage. `later` if the fault can be present from the start or begin after a given time.
    """
    usual_stage: int | None = None  # stage at which the fault begins by default, from 1; None for the start
    expected: ExpectedDetection = UNKNOWN
    spoils: SpoiledWork | None = None  # None: the fault spoils no finished work by itself

    @property
    def from_start(self) -> bool:  # the fault cannot begin during the work
        return self.when == "before"

    @property
    def limits(self) -> tuple[float, float]:
        """Least and greatest size of the fault, in its unit."""
        assert self.size is not None
        return self.size.limits

    @property
    def unit(self) -> str:
        assert self.size is not None
        return self.size.unit

    @property
    def measure(self) -> Unit:
        return UNITS[self.unit]

    def usual(self, stage: int | None = None) -> Fault:
        """Make the fault at its usual size. The fault begins at the given stage or, if no stage is given, at its
        default stage.
        """
        value = None if self.size is None else self.size.usual * self.measure.size
        fault = Fault(name=self.name, value=value, stage=stage or self.usual_stage)
        self.check(fault)
        return fault

    def check(self, fault: Fault) -> None:
        """Raise BadArgument if the size of a fault or its beginning is impossible."""
        if (fault.stage is not None or fault.after is not None) and self.from_start:
            raise BadArgument(
                f"the fault {quoted(self.name)} cannot begin during a run, only before it; leave out `{_begun(fault)}`"
            )
        if fault.stage is not None and self.when != "during":
            raise BadArgument(
                f"the fault {quoted(self.name)} begins after a time, not at a stage; write for example `@30s`, not "
                f"`{_begun(fault)}`"
            )
        if fault.after is not None and self.when != "later":
            raise BadArgument(
                f"the fault {quoted(self.name)} begins at a stage, not after a time; write for example `@2`, not "
                f"`{_begun(fault)}`"
            )
        if fault.after is not None and not 0 < fault.after < float("inf"):
            raise BadArgument(
                f"the fault {quoted(self.name)} must begin after a time of more than 0 s, not {fault.after:g} s"
            )
        if self.size is None and fault.value is not None:
            raise BadArgument(f"the fault {quoted(self.name)} takes no value")
        if self.size is not None:
            low, high = (limit * self.measure.size for limit in self.limits)
            if fault.value is None or not low <= fault.value <= high:
                raise BadArgument(
                    f"the fault {quoted(self.name)} must have a value between {low:g} and {high:g} in SI units, not "
                    f"{fault.value!r}"
                )


class Catalogue:
    """The faults of a task, in the order in which they are listed."""

    def __init__(self, *kinds: FaultKind, matrix: Sequence[str] = ()) -> None:
        """`matrix` names the faults with which a program is tested by default; if `matrix` is empty, all faults are
        used.
        """
        self.kinds = {kind.name: kind for kind in kinds}
        assert len(self.kinds) == len(kinds), "two faults have the same name"
        self.matrix = tuple(matrix) or tuple(self.kinds)
        assert {*self.matrix} <= self.kinds.keys(), "the matrix names a fault that does not exist"

    def kind(self, name: str) -> FaultKind:
        """Return the kind of fault called `name`. Raises NoSuchName if no kind has this name."""
        if name in self.kinds:
            return self.kinds[name]
        inside = [known for known in self.kinds if known.startswith(f"{name}.")]
        if inside:
            raise BadArgument(f"{quoted(name)} is a group of faults: {', '.join(map(quoted, inside))}")
        first = dict.fromkeys(known.split(".")[0] for known in self.kinds)
        near = suggestion(name, self.kinds) or (
            f"choose from {', '.join(map(quoted, first))}" if first else "this task has no faults"
        )
        raise NoSuchName(f"there is no fault {quoted(name)}; {near}")

    def select(self, name: str) -> tuple[FaultKind, ...]:
        """Return the kind of fault called `name`, or all kinds in the group of that name. Raises NoSuchName if neither
        a kind nor a group has that name.
        """
        found = tuple(kind for kind in self.kinds.values() if f"{kind.name}.".startswith(f"{name}."))
        return found or (self.kind(name),)

    def check(self, faults: Sequence[Fault]) -> None:
        """Raise BadArgument unless all of `faults` can occur in one run."""
        for fault in faults:
            self.kind(fault.name).check(fault)
        once(fault.name for fault in faults)

    def written(self, fault: Fault) -> str:
        """Write a fault as it is typed on the command line, with its size in the fault's unit."""
        kind = self.kind(fault.name)
        value = (
            "" if fault.value is None else f"={fault.value / kind.measure.size:g}{kind.unit.replace(' ', '')}"
        )
        return f"{fault.name}{value}{_begun(fault)}"


def _begun(fault: Fault) -> str:
    """Return the time or stage at which a fault begins, in the form in which users type it, such as `@30s`. The text
    is empty if the fault is present from the start.
    """
    if fault.after is not None:
        return f"@{fault.after:g}s"
    return "" if fault.stage is None else f"@{fault.stage}"


def once(names: Iterable[str]) -> None:
    """Raise BadArgument if the name of a fault occurs twice."""
    seen: set[str] = set()
    for name in names:
        if name in seen:
            raise BadArgument(f"the fault {quoted(name)} is given twice")
        seen.add(name)
