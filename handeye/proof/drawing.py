"""Draws a proof as a flow: the steps on which the proof rests, and the paths between them."""

from collections.abc import Container
from dataclasses import replace
from textwrap import wrap
from typing import Final

from handeye.inspection.flow import Flow, FlowEdge, Node, flow
from handeye.planfile.plan import Plan
from handeye.program.graph import Graph
from handeye.proof.proof import Proof

WIDTH: Final = 43  # characters of a note


def proof_flow(proof: Proof, plan: Plan) -> Flow:
    """Return a flow chart with only the steps on which a proof rests. An edge of the flow chart stands for all paths
    from one of these steps to the next. The notes of a step name the findings that rest on this step. If some path to
    the end does not show that a claim is true, the chart also contains the last step at which this path could have
    branched off to a step that shows it.
    """
    notes, graph = _notes(proof), Graph(plan.program.steps)
    whole = flow(plan)
    nodes = [_noted(node, notes[node.step]) for node in whole.nodes if node.step in notes]
    edges = [edge for node in nodes for edge in _next(graph, node.step, notes)]
    return replace(whole, nodes=tuple(nodes), edges=tuple(edges), outside={})


def _notes(proof: Proof) -> dict[int, list[str]]:
    """Return the notes on each drawn step. Some notes name the findings that rest on the step. Other notes name
    findings that are not shown: beyond this step, a path to the end passes no step that would show them.
    """
    found: dict[int, dict[str, None]] = {}
    for finding in proof.findings:
        for number in finding.claims:
            claim = proof.claims[number]
            if claim.verdict == "shown":
                for step in claim.passed:
                    if step is not None:
                        found.setdefault(step, {})[finding.finding] = None
            elif claim.verdict == "avoided":
                at = claim.way[-1 if claim.leaves is None else claim.leaves].step
                found.setdefault(at, {})[f"not shown: {finding.finding}"] = None
    return {step: list(names) for step, names in found.items()}


def _noted(node: Node, names: list[str]) -> Node:
    return replace(node, notes=tuple(wrap(", ".join(names), WIDTH)))


def _next(graph: Graph, start: int, drawn: Container[int]) -> list[FlowEdge]:
    """Return the edges from a drawn step to the drawn steps that can come next."""
    ends: dict[int | None, None] = {}
    seen: set[int] = set()
    waiting = [start]
    while waiting:
        for target in graph.onward[waiting.pop()]:
            if target is None or target in drawn:
                ends[target] = None
            elif target not in seen and graph.steps[target].operation.calls is None:
                seen.add(target)
                waiting.append(target)
    return [FlowEdge(start=start, end=end) for end in ends]
