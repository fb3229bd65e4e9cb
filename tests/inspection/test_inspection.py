"""A plan laid open: times, guards in the units of the script, and what was measured before a step."""

import json
from pathlib import Path

import pytest
from conftest import Command

from handeye.al import compile_text
from handeye.arm.robots.stanford import STANFORD
from handeye.core.resources import plans
from handeye.core.source import Source
from handeye.core.units import OUNCE_FORCE
from handeye.inspection.inspection import (
    InspectedStep,
    dependences,
    depends_text,
    inspection,
    inspection_text,
)
from handeye.inspection.wording import direction
from handeye.planfile.plan import Plan
from handeye.planfile.store import read_plan
from handeye.planning.planner import make_plan
from handeye.program.program import Program
from handeye.program.taught import Taught

PLACE = "        TRANS   T [25 38 4 90 90 0]\n"


def compiled(text: str) -> Program:
    program, diagnostics = compile_text(Source(name="test.al", text=text), Taught())
    assert program is not None, diagnostics
    return program


def step_of(text: str, number: int) -> InspectedStep:
    plan, problems = make_plan(compiled(text), STANFORD, task="water_pump")
    assert plan is not None, problems
    return next(s for stage in inspection(plan).stages for s in stage.steps if s.step == number)


@pytest.fixture(scope="module")
def pump() -> Plan:
    return read_plan(plans() / "water_pump.plan.json")


def line_of(pump: Plan, text: str, nth: int = 0) -> int:
    """The `nth` line of the script whose step has this text."""
    return sorted({step.line for step in pump.program.steps if step.text == text})[nth]


def depends(pump: Plan, text: str) -> list[str]:
    """What the first step of a text depends on."""
    first = next(number for number, step in enumerate(pump.program.steps) if step.text == text)
    return [depends_text(one) for one in dependences(pump.program)[first]]


@pytest.mark.parametrize(
    ("statements", "said"),
    [
        ("STOP [0 0 -50]\nCHANGE [0 0 -1] .6", "stops at 50 oz along -z, else error 23"),
        ("STOP 50\nCHANGE [0 0 -1] .6", "stops at 50 oz against the motion, else error 23"),
        ("TORQUE 42\nCHANGE [0 0 -1] .6", "stops at 42 oz-in of torque, else error 24"),
        (
            "STOP [0 0 -50] [0 0 20]\nCHANGE [0 0 -1] .6",
            "stops at 50 oz along -z or at 20 oz-in about z, else error 23",
        ),
        ("TOUCH 3\nMOVE T DIRECT\nCHANGE [0 0 -1] .6", "stops when either finger touches, else error 25"),
        ("FORCE [0 0 -22]\nCHANGE [1 0 0] .6", "presses with 22 oz along -z"),
        ("FORCE NIL [0 0 -22]\nCHANGE [1 0 0] .6", "turns with 22 oz-in about -z"),
        ("SPIN [1 1 0]\nCHANGE [0 0 -1] .6", "yields about x and y"),
        ("FREE [1 1 0]\nCHANGE [0 0 -1] .6", "yields along x and y"),
        ("VIA T T\nMOVE T", "via T, T"),
        ("CLOSE 2 2.4", "holds 2 in or more, else error 2; 2.4 in or less, else error 7"),
        ("TRAVEL 1.6 2.2", "moved 1.6 in to 2.2 in, else error 8"),
        ("HEIGHT B .04 .08", "is 0.04 in to 0.08 in above B, else error 9"),
    ],
)
def test_guards_are_told_in_the_units_of_the_script(statements: str, said: str) -> None:
    assert "; ".join(step_of(f"{PLACE}MOVE T\n{statements}\n", 1).conditions) == said


def test_the_force_that_a_step_presses_with_is_told_in_newtons() -> None:
    text = f"{PLACE}MOVE T\nFORCE [0 0 -22]\nCHANGE [1 0 0] .6\n"
    assert step_of(text, 0).press is None
    assert step_of(text, 1).press == (0.0, 0.0, -22 * OUNCE_FORCE)


def test_a_countdown_says_where_it_leads() -> None:
    step = step_of("ASSIGN N 2\nL: OPEN 1\nSOJG N L\nOPEN 2\n", 2)
    assert (step.counter, step.positive, step.next) == ("N", 1, 3)


def test_a_goal_that_was_kept_depends_on_where_that_was() -> None:
    text = f"{PLACE}MOVE T\nCHANGE Z -1\nHERE F\nMOVE F\nMOVE T\n"
    assert [depends_text(one) for one in step_of(text, 3).depends] == ["F defined at line 4"]
    assert step_of(text, 4).depends == ()


def test_what_is_saved_behind_a_countdown_is_known_where_it_leads_back() -> None:
    program = compiled(f"{PLACE}ASSIGN N 2\nL: MOVE T\nRESTORE H\nOPEN 1\nSAVE H\nSOJG N L\n")
    assert [depends_text(one) for one in dependences(program)[1]] == ["H saved at line 6"]


def test_a_slanting_direction_is_told_by_its_unit_vector() -> None:
    assert direction((3.0, 0.0, -4.0)) == "[0.6 0 -0.8]"


def test_the_time_of_a_plan_is_that_of_its_motions(pump: Plan) -> None:
    total = sum(sum(motion.times) for motion in pump.motions.values())
    found = inspection(pump)
    rounded = 1e-6 * len(pump.motions)
    assert found.seconds == pytest.approx(total, abs=rounded)
    assert sum(stage.seconds for stage in found.stages) == pytest.approx(total, abs=rounded)


def test_a_goal_on_a_part_depends_on_the_picture_that_located_it(pump: Plan) -> None:
    seen, search = line_of(pump, "SPECIFIC BASE CLOSE_UP"), line_of(pump, "SEARCH  .2")
    again = line_of(pump, "SPECIFIC BASE CLOSE_UP", 1)
    assert depends(pump, "MOVE    A") == [f"BASE seen at lines {seen}, {again}", f"search of line {search}"]


def test_a_goal_on_a_part_never_seen_is_as_planned(pump: Plan) -> None:
    assert depends(pump, "MOVE    S0") == ["PUMP as planned"]


def test_a_restored_goal_depends_on_what_was_saved_last_on_every_way_there(pump: Plan) -> None:
    assert f"Y1 saved at line {line_of(pump, 'SAVE    Y1')}" in depends(pump, "MOVE H0")  # of pin 1
    first, again = line_of(pump, "SAVE    DS"), line_of(pump, "SAVE    DS", 1)
    assert f"DS level saved at lines {first}, {again}" in depends(pump, "MOVE S2")  # of the first screw


def test_a_difference_that_nothing_has_saved_is_told_to_be_none() -> None:
    step = step_of(f"{PLACE}MOVE T\nRESTORE H\nSAVE H\n", 0)
    assert [depends_text(one) for one in step.depends] == ["H, never saved before"]


def test_a_loop_carries_what_was_saved_in_it_back_to_its_head() -> None:
    program = compiled(
        f"{PLACE}L: MOVE T\nRESTORE D\nSAVE D\nOPEN 1\nSKIPE 2\nJUMP L\nPARK\n".replace("PARK", "OPEN 2")
    )
    (restored,) = dependences(program)[0]
    assert (restored.name, restored.lines) == ("D", (4,))


def test_the_listing_fits_every_step_of_a_stage_on_a_line(pump: Plan) -> None:
    lines = inspection_text(inspection(pump), stage=11)
    assert lines[2] == " 11  turn the rotor: 21 steps, 11.8 s"
    assert (
        lines[11].split("  ")[-1].strip().rstrip("0123456789")
        == "stops at 15 oz against the motion, else error 23; AXIS defined at line "
    )
    assert len(lines) == 3 + 21


def test_inspect_as_json_has_every_step_once(pump: Plan, command: Command) -> None:
    code, out, _ = command("inspect", str(plans() / "water_pump.plan.json"), "--json")
    steps = [step["step"] for stage in json.loads(out)["stages"] for step in stage["steps"]]
    assert (code, steps) == (0, list(range(len(pump.program.steps))))


def test_inspect_shows_one_stage_by_its_name(command: Command) -> None:
    code, out, _ = command("inspect", str(plans() / "water_pump.plan.json"), "--stage", "check the gasket")
    assert code == 0
    (line,) = [line for line in out.splitlines() if "INSPECT PUMP" in line]
    assert line.endswith("  PUMP as planned")


def test_inspect_of_no_plan_is_refused_in_one_sentence(command: Command) -> None:
    Path("no.json").write_text("[]", encoding="utf-8")
    assert command("inspect", "no.json")[::2] == (
        2,
        'handeye: no.json is not a plan: it lacks "format": "handeye plan"\n',
    )


def test_the_schema_command_writes_the_schema(command: Command) -> None:
    assert command("schema", "-o", "s.json")[0] == 0
    assert Path("s.json").read_bytes() == (plans() / "plan.schema.json").read_bytes()
