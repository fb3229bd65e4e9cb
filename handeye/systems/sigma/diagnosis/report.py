"""Shows the results of diagnoses, one fault after the other."""

from collections.abc import Iterator, Sequence
from typing import Final

from handeye.core.plain_text import counted
from handeye.core.record import Record
from handeye.systems.sigma.diagnosis.bench import Bench
from handeye.systems.sigma.diagnosis.faults import FAULTS, planted
from handeye.systems.sigma.diagnosis.strategy import Strategy, Verdict

LEAST_FOUND: Final = 17


class Diagnosed(Record, frozen=True, kw_only=True):
    """A planted fault, and the verdict of the diagnosis."""

    fault: str
    told: str
    part: str  # the part that has the fault
    verdict: Verdict

    @property
    def right(self) -> bool:
        """True if the diagnosis named the faulty part."""
        return self.verdict.part == self.part

    @property
    def undecided(self) -> bool:
        """True if the diagnosis named no part."""
        return not self.verdict.part


def diagnosed(name: str, seed: int | None) -> Diagnosed:
    """Plant a fault and diagnose it."""
    fault = planted(name, seed)
    verdict = Strategy(Bench(fault, seed or 0)).diagnose()
    return Diagnosed(fault=name, told=fault.told, part=fault.part, verdict=verdict)


def all_diagnosed(seed: int | None) -> list[Diagnosed]:
    """Plant and diagnose all faults, one after the other."""
    return [diagnosed(name, seed) for name in FAULTS]


def good(found: Sequence[Diagnosed]) -> bool:
    """Return True if no part was wrongly accused, and enough faulty parts were found."""
    wrong = any(not each.right and not each.undecided for each in found)
    return not wrong and sum(each.right for each in found) >= LEAST_FOUND


def told(found: Sequence[Diagnosed]) -> str:
    """Say in a sentence how many faulty parts the diagnosis named."""
    right = sum(each.right for each in found)
    return f"the diagnosis named the right part for {right} of {counted(len(found), 'fault')}"


def lines(found: Sequence[Diagnosed]) -> Iterator[str]:
    """Yield the results as a table in text."""
    yield f"{'fault':13} tests  {'named part':26}  what is wrong"
    for each in found:
        verdict = each.verdict
        led = verdict.part if each.right else "not decidable" if each.undecided else f"WRONG: {verdict.part}"
        yield f"{each.fault:13} {verdict.tests:5}  {led:26}  {each.told}"
    yield told(found)
    for each in found:
        if each.undecided:
            yield f"{each.fault}: no test can show which part is faulty: {each.verdict.why}"
