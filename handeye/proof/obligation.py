"""Obligations of a task. For each finding of the task's referee, an obligation says what every program must show."""

from msgspec.structs import replace

from handeye.core.record import Record
from handeye.proof.evidence import Compared, Evidence, Taken


class Phase(Record, frozen=True, kw_only=True):
    """One part of a claim. A step of any of the kinds in `by` shows this part."""

    by: tuple[Evidence, ...] = ()
    undone: tuple[Evidence, ...] = ()
    """Kinds of steps that may undo what has been shown. After such a step, the phase must be shown again, even if the
    step raises an error.
    """


class Claim(Record, frozen=True, kw_only=True):
    """A statement about the work. Some steps of a program show that the statement is true. The claim has phases, and
    the steps must show the phases in this order. If `at_first` is True, the claim holds when the program begins. In
    this case, the program need not show the claim, except after a step that undoes the claim.
    """

    says: str  # clause, such as `the fingers feel the head`
    where: str = ""  # where, if other claims say the same of another place, such as `hole 3`
    phases: tuple[Phase, ...]
    at_first: bool = False

    def with_pictures(self, before: str, after: str) -> "Claim":
        """Fill in the names of the two pictures of a comparison."""

        def filled(evidence: Evidence) -> Evidence:
            if isinstance(evidence, Taken):
                return replace(evidence, picture=before if evidence.role == "before" else after)
            return (
                replace(evidence, before=before, after=after) if isinstance(evidence, Compared) else evidence
            )

        phases = tuple(
            Phase(by=tuple(map(filled, phase.by)), undone=tuple(map(filled, phase.undone)))
            for phase in self.phases
        )
        return replace(self, phases=phases)

    @property
    def compares(self) -> bool:
        """True if the claim rests on two pictures."""
        return any(isinstance(each, Compared) for phase in self.phases for each in phase.by)


class Obligation(Record, frozen=True, kw_only=True):
    """A finding of the referee, with the claims that a program must show for it. A program that shows these claims
    would notice if the finding did not hold. If there are no claims, a program need not show the finding, and `rests`
    gives the reason.
    """

    finding: str
    claims: tuple[Claim, ...] = ()
    rests: str  # sentence: on what the argument rests besides the claims, or how much may remain unnoticed
    unnoticed: float | None = None
    """The largest value of the finding (in the finding's unit) at which a failure may remain unnoticed; None if this
    value is not stated as a number.
    """
