"""The flow of a plan, as a graph of steps and edges."""

import json
from dataclasses import dataclass

from handeye.core.plain_text import one_line
from handeye.inspection.wording import conditions
from handeye.planfile.plan import Plan
from handeye.program.operation import Family
from handeye.program.program import Step


@dataclass(frozen=True, slots=True, kw_only=True)
class Node:
    """A step of the graph. The guards of the step are shown as notes."""

    step: int
    stage: int  # index
    line: str  # `12`, or `pins.al:12`
    text: str
    notes: tuple[str, ...]  # guards in words
    seconds: float | None
    kind: Family


@dataclass(frozen=True, slots=True, kw_only=True)
class FlowEdge:
    """An edge from a step to the next step. `end` is None at the end of the program. If the edge has a number `error`,
    the program takes the edge when the error with this number was raised.
    """

    start: int
    end: int | None
    error: int | None = None


@dataclass(frozen=True, slots=True, kw_only=True)
class Flow:
    """The graph of a plan or of one stage. If an edge leaves the stage, it ends at one of the steps in `outside`.
    These steps are not drawn.
    """

    name: str
    stages: tuple[str, ...]  # names of all stages of the whole plan
    nodes: tuple[Node, ...]  # in text order
    edges: tuple[FlowEdge, ...]
    outside: dict[int, str]  # steps that are not drawn although edges lead to them, with their stages


def flow(plan: Plan, stage: int | None = None) -> Flow:
    """Make the graph of a whole plan, or of the stage with the given number (from 1)."""
    steps = plan.program.steps
    shown = [n for n, step in enumerate(steps) if stage in (None, step.stage + 1)]
    edges = [edge for number in shown for edge in _edges(number, steps[number])]
    ends = {edge.end for edge in edges if edge.end is not None} - {*shown}
    return Flow(
        name=one_line(plan.program.name), stages=tuple(map(one_line, plan.program.stages)),
        nodes=tuple(_node(plan, number) for number in shown), edges=tuple(edges),
        outside={end: one_line(plan.program.stages[steps[end].stage]) for end in sorted(ends)},
    )  # fmt: skip


def flow_dot(graph: Flow) -> str:
    """Write a graph in the DOT language of Graphviz."""
    lines = [f"digraph {_quoted(graph.name)} {{", '  node [shape=box, style=rounded, fontname="monospace"]']
    for index in dict.fromkeys(node.stage for node in graph.nodes):
        lines += [f"  subgraph cluster_{index} {{", f"    label={_quoted(graph.stages[index])}"]
        for node in graph.nodes:
            if node.stage == index:
                label = "\n".join((f"{node.line}  {node.text}", *node.notes))
                lines.append(f"    {node.step} [label={_quoted(label)}]")
        lines.append("  }")
    lines += [f"  {end} [label={_quoted(name)}, shape=plaintext]" for end, name in graph.outside.items()]
    if any(edge.end is None for edge in graph.edges):
        lines.append('  end [label="end", shape=oval]')
    for edge in graph.edges:
        look = "" if edge.error is None else f' [label="{edge.error}", color=red, fontcolor=red]'
        lines.append(f"  {edge.start} -> {'end' if edge.end is None else edge.end}{look}")
    return "\n".join([*lines, "}"]) + "\n"


def _node(plan: Plan, number: int) -> Node:
    step, motion = plan.program.steps[number], plan.motions.get(number)
    return Node(
        step=number, stage=step.stage, line=step.place, text=one_line(step.text),
        notes=conditions(step.operation), kind=step.operation.family,
        seconds=None if motion is None else sum(motion.times),
    )  # fmt: skip


def _edges(number: int, step: Step) -> list[FlowEdge]:
    branch = step.operation.branch
    if branch is None or branch.error is None:
        return [FlowEdge(start=number, end=end) for end in dict.fromkeys(step.ways)]
    return [
        FlowEdge(start=number, end=step.next),
        FlowEdge(start=number, end=branch.target, error=branch.error),
    ]


def _quoted(text: str) -> str:
    return json.dumps(text, ensure_ascii=False)
