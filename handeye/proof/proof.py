"""Proves that a program meets the obligations of a task. If an obligation cannot be proved, the proof contains a path
through the program that does not meet the obligation.
"""

from collections.abc import Iterable, Sequence
from typing import Literal

from handeye.core.record import Record
from handeye.program.program import Program
from handeye.program.vision_operations import Comparison
from handeye.proof.hand_places import HandPlaces
from handeye.proof.obligation import Claim, Obligation
from handeye.proof.outcomes import END, OutcomeGraph
from handeye.proof.progress import UNREACHED, Effects, least_shown
from handeye.proof.ways import Leg, TooMany, way_without

Verdict = Literal["shown", "avoided", "undecided"]


class WayStep(Record, frozen=True, kw_only=True):
    """A step on a path: its number, and the outcome of its action or test."""

    step: int
    raised: int | None = None  # the error that its action raised
    taken: bool | None = None  # for a test: its error was raised; for a count: the counter was positive


class ClaimProof(Record, frozen=True, kw_only=True):
    """The verdict on one claim."""

    says: str
    where: str
    verdict: Verdict
    phases: tuple[tuple[int, ...], ...] = ()  # for each phase, the steps that show it
    passed: tuple[int | None, ...] = ()
    """For each phase, the step that shows the phase on every path to the end. If several steps do so, the entry is the
    last of them before the step of the next phase. The entry is None if different paths show the phase at different
    steps. The tuple is empty unless the claim is shown.
    """
    way: tuple[WayStep, ...] = ()  # a shortest path to the end that avoids the claim
    leaves: int | None = None
    """Index, in `way`, of the last step from which the program can still reach a step that shows the last phase of the
    claim. None if there is no such step.
    """
    undone: int | None = None
    """Index, in the path, of the last step that undoes a shown phase of the claim; None if no step does so."""
    unknown: tuple[int, ...] = ()  # steps whose place the program does not fix
    too_many: bool = False  # True if the search for a path was given up because it became too large


class FindingProof(Record, frozen=True, kw_only=True):
    """The verdict on one finding of the referee. A finding without claims is one that no program needs to show."""

    finding: str
    rests: str
    claims: tuple[int, ...]  # numbers of its claims in the proof


class Proof(Record, frozen=True, kw_only=True):
    """The verdicts on the findings and claims of a task, for one program."""

    program: str
    task: str
    steps: int
    ends: bool  # False if no path leads to the end
    claims: tuple[ClaimProof, ...]
    findings: tuple[FindingProof, ...]

    def verdict(self, finding: FindingProof) -> Verdict | None:
        """Return the verdict on a finding; None if a program need not show the finding."""
        verdicts = {self.claims[number].verdict for number in finding.claims}
        order: tuple[Verdict, ...] = ("avoided", "undecided", "shown")
        return next((verdict for verdict in order if verdict in verdicts), None)

    @property
    def holds(self) -> bool:
        """True if every claim is shown on every path to the end."""
        return self.ends and all(claim.verdict == "shown" for claim in self.claims)


def prove(program: Program, obligations: Sequence[Obligation], task: str = "") -> Proof:
    """Prove the obligations of a task for a program."""
    graph = OutcomeGraph(program.steps)
    places = HandPlaces(program, graph)
    claims = list(dict.fromkeys(claim for one in obligations for claim in one.claims))
    return Proof(
        program=program.name, task=task, steps=len(program.steps), ends=bool(graph.ends),
        claims=tuple(_Prover(program, graph, places).proved(claims)),
        findings=tuple(
            FindingProof(
                finding=one.finding, rests=one.rests, claims=tuple(claims.index(claim) for claim in one.claims)
            )
            for one in obligations
        ),
    )  # fmt: skip


class _Prover:
    def __init__(self, program: Program, graph: OutcomeGraph, places: HandPlaces) -> None:
        self.graph, self.places = graph, places
        self.live = graph.live_counters()
        self.avoidable: dict[int, bool] = {}
        self.pairs = list(
            dict.fromkeys(
                (step.operation.before, step.operation.after)
                for step in program.steps
                if isinstance(step.operation, Comparison)
            )
        )

    def proved(self, claims: Sequence[Claim]) -> Iterable[ClaimProof]:
        """Yield the verdicts on the given claims."""
        forms = [self._forms(claim) for claim in claims]
        strict = [[Effects(form, self.places, generous=False) for form in some] for some in forms]
        least = iter(least_shown(self.graph, [one for some in strict for one in some]))
        for some in strict:
            shown = [one for one in some if next(least) in (one.whole, UNREACHED)]
            yield self._shown(shown[0]) if shown else self._searched(some)

    def _forms(self, claim: Claim) -> list[Claim]:
        """Return the claim itself if it does not rest on pictures. If it rests on pictures, return one claim for each
        pair of pictures that the program compares, with the names of these pictures filled in.
        """
        return (
            [claim.with_pictures(*pair) for pair in self.pairs] if claim.compares and self.pairs else [claim]
        )

    def _searched(self, forms: list[Effects]) -> ClaimProof:
        found: ClaimProof | None = None
        for form in forms:
            one = self._decided(form)
            if one.verdict == "shown":
                return one
            if found is None or (found.verdict == "avoided" and one.verdict == "undecided"):
                found = one
        assert found is not None
        return found

    def _decided(self, form: Effects) -> ClaimProof:
        try:
            way = way_without(self.graph, form, self.live)
            if way is None:
                return self._shown(form)
            generous = Effects(form.claim, self.places, generous=True)
            clear = way_without(self.graph, generous, self.live) if generous.tables != form.tables else way
        except TooMany:
            return ClaimProof(
                says=form.claim.says, where=form.claim.where, verdict="undecided", too_many=True
            )
        if clear is None:
            differing = {key for key, table in generous.tables.items() if form.tables.get(key) != table}
            differing |= form.tables.keys() - generous.tables.keys()
            unknown = tuple(sorted({self.graph.nodes[node][0] for node, _ in differing}))
            return ClaimProof(
                says=form.claim.says, where=form.claim.where, verdict="undecided", unknown=unknown
            )
        return ClaimProof(
            says=form.claim.says, where=form.claim.where, verdict="avoided", phases=self._phases(form),
            way=self._steps(clear), leaves=self._leaves(generous, clear), undone=_undone(generous, clear),
        )  # fmt: skip

    def _shown(self, form: Effects) -> ClaimProof:
        phases = self._phases(form)
        passed: list[int | None] = []
        later = len(self.graph.steps)
        for steps in reversed(phases):
            sure = [number for number in steps if number < later and not self._avoidable(number)]
            passed.append(sure[-1] if sure else None)
            later = sure[-1] if sure else later
        return ClaimProof(
            says=form.claim.says, where=form.claim.where, verdict="shown", phases=phases,
            passed=tuple(passed[::-1]),
        )  # fmt: skip

    def _phases(self, form: Effects) -> tuple[tuple[int, ...], ...]:
        return tuple(
            tuple(
                sorted({self.graph.nodes[node][0] for (node, _), of in form.showing.items() if of == phase})
            )
            for phase in range(form.whole)
        )

    def _avoidable(self, step: int) -> bool:
        """Return True if some path to the end does not pass step `step`."""
        if step not in self.avoidable:
            self.avoidable[step] = self._passed_by(step)
        return self.avoidable[step]

    def _passed_by(self, step: int) -> bool:
        seen, waiting = {0}, [0]
        if self.graph.nodes[0][0] == step:
            return False
        while waiting:
            for edge in self.graph.edges[waiting.pop()]:
                if edge.to == END:
                    return True
                if edge.to not in seen and self.graph.nodes[edge.to][0] != step:
                    seen.add(edge.to)
                    waiting.append(edge.to)
        return False

    def _steps(self, way: list[Leg]) -> tuple[WayStep, ...]:
        return tuple(self._way_step(leg) for leg in way)

    def _way_step(self, leg: Leg) -> WayStep:
        number = self.graph.nodes[leg.node][0]
        edge = self.graph.edges[leg.node][leg.edge]
        branches = self.graph.step(leg.node).operation.branches
        return WayStep(step=number, raised=edge.outcome or None, taken=edge.taken if branches else None)

    def _leaves(self, form: Effects, way: list[Leg]) -> int | None:
        """On a path, find the last node at which the program can still branch off to a step that shows the last phase
        of the claim. Return the number of the leg that leaves this node.
        """
        last = {key for key, phase in form.showing.items() if phase == form.whole - 1}
        able = {node for node, _ in last}
        waiting = list(able)
        while waiting:
            for before in self.graph.back[waiting.pop()]:
                if before not in able:
                    able.add(before)
                    waiting.append(before)
        return next((n for n in reversed(range(len(way))) if way[n].node in able), None)


def _undone(form: Effects, way: list[Leg]) -> int | None:
    """Return the index of the last leg that undoes a phase of a claim after an earlier leg has shown this phase."""
    found, shown = None, form.first
    for index, leg in enumerate(way):
        table = form.tables.get((leg.node, leg.edge))
        after = shown if table is None else table[shown]
        if after < shown:
            found = index
        shown = after
    return found
