"""Declares a fault of the pump's cell: its name, size, time, expected detection and effect."""

from collections.abc import Iterable, Sequence
from dataclasses import dataclass
from typing import Generic, TypeVar

from handeye.core.faults import ExpectedDetection, Fault, FaultKind, Size, SpoiledWork

B = TypeVar("B")


@dataclass(frozen=True, slots=True, kw_only=True)
class PumpFault(FaultKind, Generic[B]):
    """A fault of the catalogue with its effect: a change to the scene, a defect of device lines, or a mishap."""

    breaks: B


def declared(
    name: str,
    meaning: str,
    breaks: B,
    expected: ExpectedDetection,
    size: Size | None = None,
    *,
    stage: int | None = None,
    spoils: SpoiledWork | None = None,
) -> PumpFault[B]:
    """Declare a fault that begins during a run. By default, the fault begins with `stage`, or at the start of the run
    if `stage` is None. `spoils` is the finished work that the fault can spoil without any other fault, or None.
    """
    return PumpFault(
        name=name,
        meaning=meaning,
        size=size,
        usual_stage=stage,
        expected=expected,
        spoils=spoils,
        breaks=breaks,
    )


def broken(those: Iterable[PumpFault[B]], faults: Sequence[Fault]) -> list[tuple[Fault, B]]:
    """Return the faults of a run (`faults`) that are also among the declared faults (`those`), each with its declared
    effect.
    """
    known = {fault.name: fault.breaks for fault in those}
    return [(fault, known[fault.name]) for fault in faults if fault.name in known]
