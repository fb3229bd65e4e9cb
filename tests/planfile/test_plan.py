"""The plan as a file: whole, diffable, and refused with one clear sentence when it is not sound."""

import json
from pathlib import Path

import pytest

from handeye.al import compile_text
from handeye.arm.robots.stanford import STANFORD
from handeye.core.errors import InvalidInput
from handeye.core.resources import plans
from handeye.core.source import Source, read_source
from handeye.planfile.plan import Plan
from handeye.planfile.store import decode, encode, read_plan, write_plan
from handeye.planning.planner import make_plan
from handeye.program.taught import Taught, load_taught

SCRIPT = """\
        TRANS   T [25 38 4 90 90 0]
        MOVE    T
        STOP    [0 0 -50]
        CHANGE  [0 0 -1] .6
        SKIPE   23
        OPEN    1
"""


def planned(text: str) -> Plan:
    program, diagnostics = compile_text(Source(name="test.al", text=text), Taught())
    assert program is not None, diagnostics
    plan, problems = make_plan(program, STANFORD, task="water_pump")
    assert plan is not None, problems
    return plan


@pytest.fixture(scope="module")
def plan() -> Plan:
    return planned(SCRIPT)


def test_a_plan_survives_being_written_and_read(plan: Plan, tmp_path: Path) -> None:
    write_plan(tmp_path / "a.plan.json", plan)
    assert read_plan(tmp_path / "a.plan.json") == plan


def test_each_step_stands_on_a_line_of_its_own(plan: Plan) -> None:
    lines = encode(plan).splitlines()
    assert sum('"operation":' in line for line in lines) == len(plan.program.steps)


def test_a_field_is_written_only_where_it_says_something() -> None:
    assert not [name for name in ("moment", "spin", "touch", "via") if f'"{name}"' in encode(planned(SCRIPT))]
    turning = planned("TRANS T [25 38 4 90 90 0]\nMOVE T\nSPIN 1 X\nSTOP NIL [0 0 20]\nCHANGE Z -1")
    assert decode(encode(turning), "p.json") == turning
    change = json.loads(encode(turning))["program"]["steps"][1]["operation"]
    assert set(change) == {"op", "displacement", "guards", "spin"}
    assert [set(guard) for guard in change["guards"]] == [{"guard", "moment"}]


def test_a_step_knows_where_its_statement_and_its_modifiers_stand(plan: Plan) -> None:
    whole, lines = plan.program.whole, SCRIPT.split("\n")
    change = plan.program.steps[1]
    (stop,) = change.modifiers
    for words, said in ((change, "CHANGE  [0 0 -1] .6"), (stop, "STOP    [0 0 -50]")):
        start, end = words.span
        assert lines[words.line - 1][start:end] == said
        span = whole.span(words.file, words.line, words.span)
        assert SCRIPT[span.start : span.end] == said


def test_another_figure_in_one_line_changes_no_other_step(plan: Plan) -> None:
    longer = planned(SCRIPT.replace("-50", "-50.000"))
    changed = [a != b for a, b in zip(plan.program.steps, longer.program.steps, strict=True)]
    assert changed == [False, True, False, False]


def test_planning_the_same_script_twice_gives_the_same_bytes() -> None:
    assert encode(planned(SCRIPT)) == encode(planned(SCRIPT))


def test_the_committed_pump_plan_is_what_the_script_compiles_to() -> None:
    script = plans() / "water_pump.al"
    program, _ = compile_text(read_source(script), load_taught(script.with_suffix(".toml")))
    assert program is not None
    plan, problems = make_plan(program, STANFORD, task="water_pump")
    assert problems == []
    assert plan is not None
    committed = read_plan(plans() / "water_pump.plan.json")
    assert committed.program == plan.program
    assert committed.motions.keys() == plan.motions.keys()


def refusal(text: str | bytes) -> str:
    with pytest.raises(InvalidInput) as caught:
        decode(text, "p.json")
    return str(caught.value)


def test_a_truncated_plan_is_refused(plan: Plan) -> None:
    assert refusal(encode(plan)[:500]).startswith("p.json is not a plan, or was cut short: ")


def test_a_plan_with_an_extra_field_is_refused(plan: Plan) -> None:
    extra = encode(plan).replace('"speed":', '"colour": "red", "speed":')
    assert "unknown field `colour`" in refusal(extra)


def test_a_step_that_leads_nowhere_is_refused(plan: Plan) -> None:
    data = json.loads(encode(plan))
    data["program"]["steps"][0]["next"] = 77
    assert refusal(json.dumps(data)) == "p.json: step 0 (line 2) leads to step 77; the plan has steps 0 to 3"


@pytest.mark.parametrize(
    ("step", "field", "value", "said"),
    [
        (2, "positive", 77, "step 2 (line 3) leads to step 77; the plan has steps 0 to 2"),
        (0, "value", 5000, "step 0 (line 1) has value 5000; it must be from 0 to 1000"),
    ],
)
def test_a_count_that_cannot_be_carried_out_is_refused(step: int, field: str, value: int, said: str) -> None:
    data = json.loads(encode(planned("ASSIGN N 2\nL: OPEN 1\nSOJG N L")))
    data["program"]["steps"][step]["operation"][field] = value
    assert refusal(json.dumps(data)) == f"p.json: {said}"


def edited(plan: Plan, path: str, value: object) -> str:
    """The plan's text with one value replaced; `path` is dotted."""
    data = json.loads(encode(plan))
    *way, last = path.split(".")
    place = data
    for key in way:
        place = place[int(key) if isinstance(place, list) else key]
    place[int(last) if isinstance(place, list) else last] = value
    return json.dumps(data)


CHANGE = "program.steps.1.operation"
GUARD = f"{CHANGE}.guards.0"


@pytest.mark.parametrize(
    ("path", "value", "said"),
    [
        ("program.steps", [], "it has no steps"),
        ("speed", 0, "its speed is 0; it must be a fraction of the arm's limits, above 0 and at most 1"),
        (
            "program.steps.1.span",
            [8, 80],
            "step 1 (line 4) is at characters 8 to 80 of line 4, which has 27 characters",
        ),
        ("program.steps.1.modifiers.0.line", 9, "step 1 (line 4) is at characters 8 to 25 of line 9"),
        ("program.steps.0.operation.via", ["X"], "step 0 (line 2) uses position X"),
        (
            "program.steps.0.operation.via",
            ["T"],
            "step 0 (line 2) has 4 knots and 3 segments, but needs 5 knots and 4 segments",
        ),
        (
            "motions.0.times",
            [0.0, 0.0, 0.0],
            "step 0 (line 2) has a planned motion with impossible times or joints",
        ),
        ("motions.0.knots.1", [0.0] * 5, "its motions have different numbers of joints: 5 and 6"),
        (
            "motions.0.times",
            [1.0],
            "step 0 (line 2) has 4 knots and 1 segment, but needs 4 knots and 3 segments",
        ),
        (
            "motions.0.times",
            [1.0, -1.0, 1.0],
            "step 0 (line 2) has a planned motion with impossible times or joints",
        ),
        (f"{CHANGE}.displacement", [0, 0, 0], "step 1 (line 4) has a displacement of size 0"),
        (f"{CHANGE}.displacement", [0, 0, 1e300], "step 1 (line 4) has a displacement of size 1e+300"),
        (f"{CHANGE}.speed", 1e-30, "step 1 (line 4) has speed 1e-30"),
        (
            f"{GUARD}",
            {"guard": "touch", "fingers": 7},
            "step 1 (line 4) has fingers 7; it must be from 1 to 3",
        ),
        (f"{GUARD}", {"guard": "moment", "moment": [0, 0, 0]}, "step 1 (line 4) has a moment of size 0"),
        (f"{GUARD}", {"guard": "against", "force": 1e9}, "step 1 (line 4) has force 1e+09"),
        (f"{CHANGE}.moment", [0, 0, 1e9], "step 1 (line 4) has a moment of size 1e+09"),
        ("program.steps.3.operation.gap", 1e30, "step 3 (line 6) has gap 1e+30"),
        (
            "program.steps.3.operation",
            {"op": "lens", "focal_length": 0.077},
            "step 3 (line 6) has focal_length 0.077; it must be 0.025 or 0.05",
        ),
        ("program.steps.3.operation", {"op": "aim", "target": "X"}, "step 3 (line 6) aims at X"),
        (
            "program.steps.3.operation",
            {"op": "look", "picture": "../x"},
            "step 3 (line 6) uses the picture name '../x'",
        ),
        ("program.steps.3.operation", {"op": "search", "step": 1, "limit": -1}, "step 3 (line 6) has step 1"),
    ],
)
def test_an_edited_plan_that_cannot_be_carried_out_is_refused(
    plan: Plan, path: str, value: object, said: str
) -> None:
    assert refusal(edited(plan, path, value)).startswith(f"p.json: {said}")


@pytest.mark.parametrize(
    ("path", "value", "said"),
    [
        ("program.steps.0.operation.via", ["T"] * 9, "Expected `array` of length <= 4"),
        (
            GUARD,
            {"guard": "smell"},
            "Invalid value 'smell' - at `$.program.steps[1].operation.guards[0].guard`",
        ),
        (f"{CHANGE}.stop", {"force": [0, 0, 1]}, "Object contains unknown field `stop`"),
    ],
)
def test_a_plan_that_is_not_of_its_types_is_refused(plan: Plan, path: str, value: object, said: str) -> None:
    assert refusal(edited(plan, path, value)).startswith(f"p.json is not a valid plan: {said}")


FIXTURE = {"at": [0, 0, 0, 0], "boxes": [[0, 0, 0, 1, 1, 1]]}


@pytest.mark.parametrize(
    ("path", "value", "said"),
    [
        (
            "program.fixtures",
            {"F": FIXTURE | {"at": [1e9, 0, 0, 0]}},
            "fixture F has a coordinate above 100 m or rad",
        ),
        (
            "program.fixtures",
            {"F": FIXTURE | {"boxes": [[0, 0, 0, 1, 1, 0]]}},
            "fixture F has an empty box",
        ),
        (
            "program.held",
            {"H": {"positions": ["X"], "boxes": []}},
            "the plan says that H is held at the position X, but the plan has no X",
        ),
        ("program.held", {"H": {"positions": [], "boxes": [[0, 0, 0, 1, 1, 1e9]]}}, "H has an empty box"),
    ],
)
def test_a_plan_with_surroundings_that_cannot_be_is_refused(
    plan: Plan, path: str, value: object, said: str
) -> None:
    assert refusal(edited(plan, path, value)).startswith(f"p.json: {said}")


def test_surroundings_survive_being_written_and_read(plan: Plan) -> None:
    pump = read_plan(plans() / "water_pump.plan.json")
    assert pump.program.fixtures.keys() >= {"RACK", "FAR_BLOCK"}
    assert decode(encode(pump), "p.json") == pump
    assert '"fixtures"' not in encode(plan)


def test_another_json_file_is_refused() -> None:
    assert refusal("{}") == 'p.json is not a plan: it lacks "format": "handeye plan"'


def test_bytes_that_are_no_text_are_refused() -> None:
    assert refusal(b"\xff\xfe\x00").startswith("p.json is not a plan, or was cut short")


def test_a_missing_plan_is_named(tmp_path: Path) -> None:
    with pytest.raises(InvalidInput, match=r"none\.json: there is no such file$"):
        read_plan(tmp_path / "none.json")


def test_a_failed_write_leaves_nothing_behind(plan: Plan, tmp_path: Path) -> None:
    with pytest.raises(InvalidInput, match="cannot be written"):
        write_plan(tmp_path / "no_folder" / "a.json", plan)
    assert list(tmp_path.iterdir()) == []
