"""What a change in a script did, step by step; and nothing for a change that does nothing."""

import json
from collections.abc import Callable
from pathlib import Path

import pytest
from conftest import Command
from msgspec.structs import replace

from handeye.al import compile_text
from handeye.arm.robots.stanford import STANFORD
from handeye.core.resources import plans
from handeye.core.source import Source
from handeye.core.units import INCH
from handeye.inspection.difference import Difference, difference
from handeye.inspection.difference_text import difference_text
from handeye.planfile.plan import Plan
from handeye.planfile.store import read_plan
from handeye.planning.planner import make_plan
from handeye.program.taught import Taught

SCRIPT = """\
        TRANS   T [25 38 4 90 90 0]
        TRANS   U [30 38 4 90 90 0]
        STAGE   "try"
        SEARCH  .2
L:      MOVE    T
        STOP    [0 0 -50]
        CHANGE  [0 0 -1] .6
        SKIPE   23
        AOJ     L
        STAGE   "go on"
        OPEN    1
        MOVE    U
        CLOSE   .5
"""


def planned(text: str) -> Plan:
    program, diagnostics = compile_text(Source(name="test.al", text=text), Taught())
    assert program is not None, diagnostics
    plan, problems = make_plan(program, STANFORD, task="water_pump")
    assert plan is not None, problems
    return plan


def changed(old: str, new: str) -> Difference:
    assert old in SCRIPT
    return difference(planned(SCRIPT), planned(SCRIPT.replace(old, new)))


def told(found: Difference) -> list[str]:
    return [" ".join(line.split()) for line in difference_text(found) if line]


def test_a_plan_does_the_same_as_itself() -> None:
    pump = read_plan(plans() / "water_pump.plan.json")
    assert difference(pump, pump).same


def test_comments_and_columns_make_no_difference() -> None:
    assert changed("OPEN    1\n", "OPEN 1 ;a little\n\n; and a line more\n").same


def test_a_force_is_told_as_it_was_and_as_it_is() -> None:
    assert told(changed("-50", "-70"))[:3] == [
        "try",
        "~ 2 line 7 CHANGE [0 0 -1] .6",
        "guard: stops at 50 oz along -z, else error 23 -> stops at 70 oz along -z, else error 23",
    ]


def test_a_moved_position_is_told_with_the_motions_it_changes() -> None:
    found = changed("[30 38", "[32 38")
    (place,) = found.places
    assert (place.name, place.kind, place.turn) == ("U", "moved", 0)
    assert place.shift == pytest.approx((2 * INCH, 0, 0))
    (step,) = found.steps
    assert (step.kind, step.text) == ("replanned", "MOVE U")
    assert step.motion is not None
    assert step.motion.joint is not None


def test_a_turned_position_is_told_in_degrees() -> None:
    assert told(changed("[30 38 4 90 90 0]", "[30 38 4 100 90 0]"))[0] == "~ position U: turned by 10 deg"


def test_a_position_that_goes_to_another_part_is_told() -> None:
    plan = planned(SCRIPT)
    positions = plan.program.positions
    there = replace(positions["T"], of="BASE", at=positions["U"].at)
    other = replace(plan, program=replace(plan.program, positions={**positions, "T": there}))
    assert told(difference(plan, other))[0] == "~ position T: now relative to another part"


def test_a_plan_at_another_speed_for_another_arm_is_told() -> None:
    plan = planned(SCRIPT)
    found = told(difference(plan, replace(plan, arm="other", arm_digest="0123", speed=0.5)))
    assert found[:3] == [
        "~ arm: Stanford -> other", f"~ arm_digest: {plan.arm_digest} -> 0123", "~ speed: 0.4 -> 0.5",
    ]  # fmt: skip


def test_an_added_step_does_not_change_those_behind_it() -> None:
    found = changed("        MOVE    U", "        OPEN    2\n        MOVE    U")
    assert [(s.kind, s.before, s.after, s.text) for s in found.steps] == [("added", None, 6, "OPEN 2")]


def test_a_removed_step_does_not_change_those_behind_it() -> None:
    found = changed("        OPEN    1\n", "")
    assert [(s.kind, s.before, s.after, s.text) for s in found.steps] == [("removed", 5, None, "OPEN 1")]


def test_a_statement_written_anew_is_a_changed_step() -> None:
    found = changed("CLOSE   .5", "CLOSE   .5 .9")
    (step,) = found.steps
    assert (step.kind, step.changes[0]) == ("changed", ("statement", "CLOSE .5", "CLOSE .5 .9"))


def test_a_label_put_elsewhere_changes_where_a_loop_goes() -> None:
    found = changed("SEARCH  .2\nL:      MOVE    T", "SEARCH  .2\n        MOVE    T\nL:      OPEN    1")
    assert ("then", "step 1", "step 2") in [change for step in found.steps for change in step.changes]


COUNTED = "ASSIGN N 2\nL: OPEN 1\nOPEN 2\nSOJG N L\n"


def test_a_countdown_that_leads_elsewhere_is_told() -> None:
    shorter = "ASSIGN N 2\nOPEN 1\nL: OPEN 2\nSOJG N L\n"
    (step,) = difference(planned(COUNTED), planned(shorter)).steps
    assert step.changes == (("while N is positive", "step 1", "step 2"),)


def test_a_step_put_before_a_countdown_does_not_change_it() -> None:
    steps = difference(planned(COUNTED), planned(f"OPEN 3\n{COUNTED}")).steps
    assert [(step.kind, step.text) for step in steps] == [("added", "OPEN 3")]


def test_a_step_put_into_another_stage_is_told() -> None:
    found = changed(
        '        STAGE   "go on"\n        OPEN    1\n', '        OPEN    1\n        STAGE   "go on"\n'
    )
    assert [change for step in found.steps for change in step.changes] == [("stage", "go on", "try")]


def test_a_stage_renamed_is_one_gone_and_one_new() -> None:
    found = changed('"go on"', '"leave"')
    assert (found.stages_removed, found.stages_added, found.steps) == (("go on",), ("leave",), ())


def test_taking_a_difference_the_other_way_swaps_added_and_removed() -> None:
    one, other = planned(SCRIPT), planned(SCRIPT.replace("        CLOSE   .5\n", ""))
    kinds = [[s.kind for s in difference(*pair).steps] for pair in ((one, other), (other, one))]
    assert kinds == [["removed"], ["added"]]


def test_diff_exits_with_one_when_plans_differ(command: Command, planned: Callable[[str], str]) -> None:
    Path("old.json").write_bytes(Path(planned(SCRIPT)).read_bytes())
    new = planned(SCRIPT.replace("OPEN    1", "OPEN    2"))
    assert [command("diff", "old.json", "old.json")[0], command("diff", "old.json", new)[0]] == [0, 1]
    assert command("diff", "old.json", "nowhere.json")[0] == 2


def test_diff_as_json_names_the_steps(command: Command, planned: Callable[[str], str]) -> None:
    Path("old.json").write_bytes(Path(planned(SCRIPT)).read_bytes())
    new = planned(SCRIPT.replace("OPEN    1", "OPEN    2"))
    (step,) = json.loads(command("diff", "old.json", new, "--json")[1])["steps"]
    assert (step["kind"], step["changes"]) == ("changed", [["statement", "OPEN 1", "OPEN 2"]])
