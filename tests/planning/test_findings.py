"""What the planner finds are facts; the language of the script puts them into words, and another language may too."""

from collections.abc import Iterable
from pathlib import PurePath

import pytest
from msgspec.structs import replace

from handeye.al import AL, compile_text
from handeye.arm.robots.stanford import STANFORD
from handeye.core.diagnostics import Diagnostic, Label
from handeye.core.source import Source, Span
from handeye.core.units import INCH, OUNCE_FORCE
from handeye.planning.planner import make_plan, plan_source
from handeye.program.diagnosis.plan_findings import (
    GoalBelowTable,
    NoConfiguration,
    PlanFinding,
    RunsInto,
    TooHeavy,
    TooWeak,
)
from handeye.program.diagnosis.reach import NamedArm, OutOfReach
from handeye.program.language import language_of
from handeye.program.program import Program
from handeye.program.taught import Taught

T = "TRANS T [25 38 4 90 90 0]\nMOVE T\n"


def found(text: str) -> list[PlanFinding]:
    program, diagnostics = compile_text(Source(name="test.al", text=text), Taught())
    assert program is not None, diagnostics
    return make_plan(program, STANFORD, task="water_pump")[1]


def test_a_position_too_far_away_is_told_with_its_reason_in_metres() -> None:
    (finding,) = found("TRANS T [200 38 4 90 90 0]\nMOVE T")
    assert isinstance(finding, NoConfiguration)
    assert (finding.step, finding.position, finding.along) == (0, "T", None)
    assert isinstance(finding.reason, OutOfReach)
    assert finding.reason.amount > finding.reason.limit


def test_a_goal_below_the_table_is_told_with_its_depth() -> None:
    assert found("TRANS T [25 38 -1 90 90 0]\nMOVE T") == [
        GoalBelowTable(step=0, position="T", depth=pytest.approx(INCH))
    ]


def test_a_guard_the_arm_cannot_meet_is_told_in_newtons() -> None:
    (finding,) = found(f"{T}STOP [0 0 -600]\nCHANGE [0 0 -1] 1")
    assert isinstance(finding, TooWeak)
    assert finding.guard
    assert finding.exerted == ((0, 0, -600 * OUNCE_FORCE), False)
    assert finding.most < 600 * OUNCE_FORCE


def test_a_load_is_told_with_the_step_that_declares_it() -> None:
    (finding,) = found(f"{T}LOAD 900\nMOVE T")
    assert isinstance(finding, TooHeavy)
    assert (finding.step, finding.declared) == (2, 1)


def test_what_the_hand_runs_into_is_told_with_how_deep_and_where() -> None:
    (finding,) = found(f"{T}CHANGE [0 0 -1] 5")
    assert isinstance(finding, RunsInto)
    assert (finding.step, finding.fixture, finding.at_end) == (1, None, True)


def test_a_wrong_position_is_found_once_however_often_it_is_gone_to() -> None:
    assert len(found("TRANS T [25 38 -1 90 90 0]\nMOVE T\nMOVE T")) == 1


def tersely(program: Program, arm: NamedArm, findings: Iterable[PlanFinding]) -> list[Diagnostic]:
    at = Label(span=Span(start=0, end=1))
    return [Diagnostic(code=f.code, message=f"{arm.name}: step {f.step}", primary=at) for f in findings]


TERSE = replace(AL, name="terse", phrase=tersely)


def test_a_language_is_found_by_the_ending_of_a_file() -> None:
    languages = {".al": AL, ".terse": TERSE}
    assert language_of(PurePath("lib/pins.terse"), languages) is TERSE
    assert language_of(PurePath("PINS.AL"), languages) is AL
    assert language_of(PurePath("pins.txt"), languages) is AL


def test_another_language_has_words_of_its_own_for_the_same_findings() -> None:
    source = Source(name="x.terse", text="TRANS T [25 38 -1 90 90 0]\nMOVE T")
    said = plan_source(source, Taught(), STANFORD, TERSE, task="water_pump")
    assert [(d.code, d.message) for d in said.diagnostics] == [("hand-through-table", "Stanford: step 0")]
    assert said.plan is None
