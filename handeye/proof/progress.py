"""Finds how far the program has shown a claim at each node: how many phases of the claim every path to the node
shows.
"""

from dataclasses import dataclass, field
from heapq import heappop, heappush
from typing import Final

import numpy as np

from handeye.proof.evidence import Answer, Evidence, Passed
from handeye.proof.hand_places import HandPlaces
from handeye.proof.obligation import Claim
from handeye.proof.outcomes import END, OutcomeGraph

Table = tuple[int, ...]  # for each number of shown phases, the number after a step
EdgeKey = tuple[int, int]  # node, and number of its edge
UNREACHED: Final = 127


@dataclass(frozen=True, slots=True)
class Effects:
    """The effects of a program's steps on a claim: which steps show the claim, and which undo it. With `generous`, a
    step whose place is not known counts as showing the claim, and never as undoing it. Without `generous`, a step
    whose place is not known counts as undoing the claim, and never as showing it.
    """

    claim: Claim
    places: HandPlaces
    generous: bool
    tables: dict[EdgeKey, Table] = field(init=False)
    showing: dict[EdgeKey, int] = field(init=False)  # the phase that an edge shows

    def __post_init__(self) -> None:
        tables, showing = {}, {}
        graph = self.places.graph
        kinds = {
            kind
            for phase in self.claim.phases
            for one in (*phase.by, *phase.undone)
            for kind in one.operations
        }
        for node in sorted(node for kind in kinds for node in graph.kinds.get(kind, ())):
            for number, edge in enumerate(graph.edges[node]):
                passed = Passed(self.places, node, edge.outcome)
                table = self._table(passed)
                if table is not None:
                    tables[node, number] = table
                    phases = [n for n in range(len(self.claim.phases)) if table[n] == n + 1]
                    if phases:
                        showing[node, number] = phases[-1]
        object.__setattr__(self, "tables", tables)
        object.__setattr__(self, "showing", showing)

    @property
    def whole(self) -> int:
        """Number of the phases."""
        return len(self.claim.phases)

    @property
    def first(self) -> int:
        """Number of phases of the claim that are true when the program begins, before any step shows them."""
        return self.whole if self.claim.at_first else 0

    def _table(self, passed: Passed) -> Table | None:
        phases = self.claim.phases
        by = [self._any(passed, phase.by) for phase in phases]
        lost = [
            any(self._undoes(each.shown(passed)) for each in phase.undone)
            or any(self._undoes(each.failed(passed)) for each in (*phase.undone, *phase.by))
            for phase in phases
        ]
        if not any(by) and not any(lost):
            return None
        table = []
        for shown in range(self.whole + 1):
            left = next((n for n in range(shown) if lost[n]), shown)
            table.append(left + 1 if left < self.whole and by[left] else left)
        return tuple(table)

    def _any(self, passed: Passed, kinds: tuple[Evidence, ...]) -> bool:
        enough: set[Answer] = {"yes", "maybe"} if self.generous else {"yes"}
        return any(each.shown(passed) in enough for each in kinds)

    def _undoes(self, answer: Answer) -> bool:
        return answer == "yes" or (answer == "maybe" and not self.generous)


def least_shown(graph: OutcomeGraph, effects: list[Effects]) -> list[int]:
    """For each claim, count the phases that each path to the end of the program shows, and return the smallest count.
    The search ignores the values of counters and assumes that every branch is possible. UNREACHED means that no path
    leads to the end of the program.
    """
    by_edge: dict[EdgeKey, list[tuple[int, Table]]] = {}
    for number, one in enumerate(effects):
        for key, table in one.tables.items():
            by_edge.setdefault(key, []).append((number, table))
    shown = np.full((len(graph.nodes), len(effects)), UNREACHED, np.int8)
    end = np.full(len(effects), UNREACHED, np.int8)
    if graph.nodes:
        shown[0] = [one.first for one in effects]
    waiting = [(0, 0)] if graph.nodes else []
    while waiting:
        _, node = heappop(waiting)
        for number, edge in enumerate(graph.edges[node]):
            after = shown[node]
            if (node, number) in by_edge:
                after = after.copy()
                for claim, table in by_edge[node, number]:
                    after[claim] = table[after[claim]]
            there = end if edge.to == END else shown[edge.to]
            if (after < there).any():
                np.minimum(there, after, out=there)
                if edge.to != END:
                    heappush(waiting, (graph.nodes[edge.to][0], edge.to))
    return [int(least) for least in end]
