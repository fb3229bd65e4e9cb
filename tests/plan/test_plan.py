"""The plan as a file: whole, diffable, and refused with one clear sentence when it is not sound."""

import json
from pathlib import Path

import pytest

from handeye.al import compile_text
from handeye.arm.stanford import STANFORD
from handeye.errors import InvalidInput
from handeye.plan.plan import VERSION, Plan, decode, encode, read_plan, write_plan
from handeye.plan.planner import make_plan
from handeye.plan.taught import Taught, load_taught
from handeye.resources import plans
from handeye.source import Source, read_source

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
    plan, problems = make_plan(program, STANFORD)
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


def test_planning_the_same_script_twice_gives_the_same_bytes() -> None:
    assert encode(planned(SCRIPT)) == encode(planned(SCRIPT))


def test_the_committed_pump_plan_is_what_the_script_compiles_to() -> None:
    script = plans() / "water_pump.al"
    program, _ = compile_text(read_source(script), load_taught(script.with_suffix(".toml")))
    assert program is not None
    plan, problems = make_plan(program, STANFORD)
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
    assert refusal(encode(plan)[:500]).startswith("p.json is not a plan, or is cut short: ")


def test_a_plan_of_a_newer_version_is_refused(plan: Plan) -> None:
    newer = encode(plan).replace(f'"version": {VERSION}', '"version": 99')
    assert refusal(newer) == f"p.json has plan format version 99; this handeye reads up to version {VERSION}"


def test_a_plan_with_an_extra_field_is_refused(plan: Plan) -> None:
    extra = encode(plan).replace('"speed":', '"colour": "red", "speed":')
    assert "unknown field `colour`" in refusal(extra)


def test_a_step_that_leads_nowhere_is_refused(plan: Plan) -> None:
    data = json.loads(encode(plan))
    data["program"]["steps"][0]["next"] = 77
    assert refusal(json.dumps(data)) == "p.json: step 0 (line 2) leads to step 77; the plan has steps 0 to 3"


def test_another_json_file_is_refused() -> None:
    assert refusal("{}") == 'p.json is not a plan: it does not say "format": "handeye plan"'


def test_bytes_that_are_no_text_are_refused() -> None:
    assert refusal(b"\xff\xfe\x00").startswith("p.json is not a plan, or is cut short")


def test_a_missing_plan_is_named(tmp_path: Path) -> None:
    with pytest.raises(InvalidInput, match=r"none\.json cannot be read: No such file or directory$"):
        read_plan(tmp_path / "none.json")


def test_a_failed_write_leaves_nothing_behind(plan: Plan, tmp_path: Path) -> None:
    with pytest.raises(InvalidInput, match="cannot be written"):
        write_plan(tmp_path / "no_folder" / "a.json", plan)
    assert list(tmp_path.iterdir()) == []
