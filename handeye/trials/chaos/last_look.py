"""Decides whether a fault spoiled finished work too late to be noticed. No program can notice a fault that comes after
the program's last look at the spoiled work. The proof of the program (`handeye.proof`) names the steps that look at
the work. Each of these steps shows a claim on which a finding of the referee rests.
"""

from collections.abc import Iterable, Mapping, Sequence
from dataclasses import dataclass

from handeye.core.faults import SpoiledWork
from handeye.judge.finding import Finding
from handeye.program.events import AnyEvent, StepStarted
from handeye.program.program import Program
from handeye.proof.obligation import Obligation
from handeye.proof.proof import ClaimProof, prove


@dataclass(frozen=True, slots=True, kw_only=True)
class LastLook:
    """The steps of a program that look at finished work."""

    claims: Mapping[str, tuple[ClaimProof, ...]]  # by the finding that rests on them
    unnoticed: Mapping[str, float]  # by finding: the largest value at which a failure may remain unnoticed

    def passed(
        self,
        name: str,
        finding: Finding,
        spoiled: Iterable[SpoiledWork],
        events: Sequence[AnyEvent],
        begun: float,
    ) -> bool:
        """Return True if one of the faults spoiled the work that a failed finding concerns, and the program could not
        notice this. The program cannot notice a change that comes after its last look at this work, or that is too
        small. The faults began at `begun` (s); `events` are those of the run since then.
        """
        return any(
            name.startswith(work.findings) and self._unseen(name, finding, work, events, begun + work.delay)
            for work in spoiled
        )

    def _unseen(
        self, name: str, finding: Finding, work: SpoiledWork, events: Sequence[AnyEvent], since: float
    ) -> bool:
        if finding.relation == "at most" and finding.value <= self.unnoticed.get(name, finding.limit):
            return True
        claims = self.claims.get(name, ())
        there = [claim for claim in claims if claim.where == work.where] or claims
        if any(claim.verdict != "shown" for claim in there):
            return False  # the program need not look at all
        looks = {step for claim in there for step in claim.phases[-1]}
        return not any(
            isinstance(event, StepStarted) and event.step in looks and event.time >= since for event in events
        )


def last_look(program: Program, obligations: Sequence[Obligation]) -> LastLook:
    """Find the steps of a program that look at the work of its task. `obligations` are the obligations of this task."""
    proof = prove(program, obligations)
    return LastLook(
        claims={one.finding: tuple(proof.claims[number] for number in one.claims) for one in proof.findings},
        unnoticed={one.finding: one.unnoticed for one in obligations if one.unnoticed is not None},
    )
