"""The flow of a plan, drawn: every step once, every way, nothing on top of anything else."""

import xml.etree.ElementTree as ElementTree
from itertools import combinations
from pathlib import Path

import pytest
from conftest import Command

from handeye.al import compile_text
from handeye.arm.robots.stanford import STANFORD
from handeye.core.resources import plans
from handeye.core.source import Source
from handeye.inspection.drawing import flow_svg
from handeye.inspection.flow import Flow, flow, flow_dot
from handeye.inspection.layout import Layout, layout
from handeye.planfile.plan import Plan
from handeye.planfile.store import read_plan
from handeye.planning.planner import make_plan
from handeye.program.taught import Taught

PUMP = str(plans() / "water_pump.plan.json")


def graph_of(text: str, stage: int | None = None) -> Flow:
    program, diagnostics = compile_text(Source(name="test.al", text=text), Taught())
    assert program is not None, diagnostics
    plan, problems = make_plan(program, STANFORD, task="water_pump")
    assert plan is not None, problems
    return flow(plan, stage)


@pytest.fixture(scope="module")
def pump() -> Plan:
    return read_plan(Path(PUMP))


@pytest.fixture(scope="module")
def placed(pump: Plan) -> Layout:
    return layout(flow(pump))


def test_a_test_leads_two_ways_and_says_on_which_error() -> None:
    graph = graph_of("OPEN 1\nSKIPE 2\nCLOSE .5\nOPEN 2\n")
    assert {(e.start, e.end, e.error) for e in graph.edges} == {
        (0, 1, None),
        (1, 2, None),
        (1, 3, 2),
        (2, 3, None),
        (3, None, None),
    }


def test_a_countdown_leads_on_and_back() -> None:
    graph = graph_of("ASSIGN N 2\nL: OPEN 1\nSOJG N L\nOPEN 2\n")
    assert {(e.start, e.end) for e in graph.edges} == {(0, 1), (1, 2), (2, 3), (2, 1), (3, None)}
    assert "back" in {route.kind for route in layout(graph).routes}


def test_ways_out_of_a_stage_are_named_after_where_they_lead() -> None:
    graph = graph_of('STAGE "one"\nOPEN 1\nSTAGE "two"\nOPEN 2\n', stage=1)
    assert ([node.step for node in graph.nodes], graph.outside) == ([0], {1: "two"})


def test_every_step_and_every_way_of_the_pump_is_drawn_once(pump: Plan, placed: Layout) -> None:
    graph = flow(pump)
    assert [box.node.step for box in placed.boxes] == list(range(len(pump.program.steps)))
    assert {route.edge for route in placed.routes} == set(graph.edges)
    assert len(placed.routes) == len(graph.edges)


def test_no_step_lies_on_another(placed: Layout) -> None:
    spots = [(box.x, box.y, box.height) for box in placed.boxes]
    assert [
        (one, other)
        for one, other in combinations(spots, 2)
        if one[0] == other[0] and 0 <= other[1] - one[1] < one[2]
    ] == []


def test_everything_lies_on_the_page(placed: Layout) -> None:
    for route in placed.routes:
        assert all(0 <= x <= placed.width and 0 <= y <= placed.height for x, y in route.points)


def test_loops_run_on_the_left_and_each_way_beside_a_column_in_a_lane_of_its_own(placed: Layout) -> None:
    box = {b.node.step: b for b in placed.boxes}
    back = [route for route in placed.routes if route.kind == "back"]
    assert back
    assert all(route.points[1][0] < box[route.edge.start].x for route in back)
    lines = [
        (r.points[1][0], *sorted((r.points[1][1], r.points[2][1])))
        for r in placed.routes
        if r.kind in ("back", "skip")
    ]
    assert [
        (one, other)
        for one, other in combinations(lines, 2)
        if one[0] == other[0] and one[1] < other[2] and other[1] < one[2]
    ] == []


def test_a_loop_is_not_broken_over_two_columns(placed: Layout) -> None:
    box = {b.node.step: b for b in placed.boxes}
    looping = [r.edge for r in placed.routes if r.edge.end is not None and r.edge.end < r.edge.start]
    assert [e for e in looping if e.end is not None and box[e.start].x != box[e.end].x] == []


def test_the_drawing_is_sound_xml_whatever_the_script_says() -> None:
    svg = flow_svg(graph_of('STAGE "<a> & \'b\'"\nWAIT "</svg> & <"\nOPEN 1\n'))
    root = ElementTree.fromstring(svg)  # noqa: S314 # our own text
    texts = [element.text for element in root.iter("{http://www.w3.org/2000/svg}text")]
    assert 'WAIT "</svg> & <"' in texts


def test_an_error_way_carries_its_number_in_the_drawing_and_in_dot(pump: Plan) -> None:
    graph = flow(pump, 11)
    assert '<text class="e"' in flow_svg(graph)
    test = next(node.step for node in graph.nodes if pump.program.steps[node.step].text.split()[0] == "SKIPE")
    assert f'  {test} -> {test + 2} [label="23", color=red, fontcolor=red]' in flow_dot(graph).splitlines()


def test_the_same_plan_gives_the_same_drawing(pump: Plan) -> None:
    assert flow_svg(flow(pump)) == flow_svg(flow(pump))


def test_inspect_draws_into_a_file_or_onto_standard_output(command: Command) -> None:
    assert command("inspect", PUMP, "--graph", "svg", "--stage", "4", "-o", "pins.svg")[:2] == (0, "")
    code, out, _ = command("inspect", PUMP, "--graph", "dot")
    assert (code, out[:21]) == (0, 'digraph "water_pump" ')
    assert Path("pins.svg").read_text(encoding="utf-8").startswith("<svg ")


def test_an_output_without_a_drawing_is_refused(command: Command) -> None:
    code, _, err = command("inspect", PUMP, "-o", "x.txt")
    assert (code, err) == (2, "handeye: --out needs --graph svg or --graph dot\n")


def test_a_drawing_as_json_is_refused(command: Command) -> None:
    code, _, err = command("inspect", PUMP, "--graph", "svg", "--json")
    assert (code, err) == (2, "handeye: --graph and --json cannot be given together\n")
