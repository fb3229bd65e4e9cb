"""A plan made of several files holds their texts, and tells where in them its steps stand."""

import msgspec
import pytest

from handeye.al import AL, compile_text, sewn_of
from handeye.arm.robots.stanford import STANFORD
from handeye.core.diagnostics import Diagnostic
from handeye.core.errors import InvalidInput
from handeye.core.source import Source
from handeye.inspection.difference import difference
from handeye.inspection.difference_text import difference_text
from handeye.inspection.flow import flow, flow_dot
from handeye.inspection.inspection import inspection, inspection_text
from handeye.planfile.plan import Plan
from handeye.planfile.store import decode, encode
from handeye.planning.planner import plan_program
from handeye.program.taught import Taught

SCRIPT = "        REQUIRE lib/look.al\n        MOVE    T\n        RESTORE D\n"
LOOK = "        TRANS   T [25 38 4 90 90 0]\n        MOVE    T\n        SAVE    D\n"


def planned(look: str) -> tuple[Source, Plan | None, list[Diagnostic]]:
    source = sewn_of(Source(name="two.al", text=SCRIPT), {"lib/look.al": look})
    program, diagnostics = compile_text(source, Taught())
    assert program is not None, diagnostics
    return source, *plan_program(program, STANFORD, AL, task="water_pump")


def plan(look: str = LOOK) -> Plan:
    made = planned(look)[1]
    assert made is not None
    return made


def test_a_plan_keeps_the_texts_of_required_files_on_disk() -> None:
    made = plan()
    assert decode(encode(made), "two") == made
    assert made.program.required == {"lib/look.al": LOOK}


def test_a_plan_of_one_file_says_nothing_of_required_ones() -> None:
    program, _ = compile_text(Source(name="one.al", text="OPEN 1"), Taught())
    assert program is not None
    made, _ = plan_program(program, STANFORD, AL, task="water_pump")
    assert made is not None
    assert '"required"' not in encode(made)
    assert '"file"' not in encode(made)


def test_what_cannot_be_planned_is_shown_in_the_required_file() -> None:
    source, made, (problem,) = planned(LOOK.replace("25 38", "200 38"))
    text, start = source.find(problem.primary.span.start)
    assert made is None
    assert (problem.code, text.name, text.position(start)) == ("unreachable-position", "lib/look.al", (2, 17))


def test_an_inspection_names_the_file_of_a_line() -> None:
    lines = inspection_text(inspection(plan()))
    assert "line lib/look.al:2  MOVE T" in lines[3]
    assert "line 2              MOVE T" in lines[5]
    assert "D saved at line lib/look.al:3" in lines[5]


def test_a_drawing_names_the_file_of_a_line() -> None:
    assert '0 [label="lib/look.al:2  MOVE T"]' in flow_dot(flow(plan()))


def test_a_difference_names_the_file_of_a_line() -> None:
    lines = difference_text(difference(plan(), plan(LOOK + "        OPEN    1\n")))
    assert any("line lib/look.al:4  OPEN 1" in line for line in lines)


def test_a_step_of_a_file_whose_text_is_missing_is_no_sound_plan() -> None:
    made = plan()
    lost = msgspec.structs.replace(made, program=msgspec.structs.replace(made.program, required={}))
    with pytest.raises(
        InvalidInput,
        match=r"^two: step 0 .* is in 'lib/look\.al', whose text is not in the plan$",
    ):
        decode(encode(lost), "two")
