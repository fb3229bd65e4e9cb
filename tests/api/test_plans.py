"""A script becomes a plan that shows itself; its mistakes are values."""

from base64 import b64encode
from collections.abc import Callable
from pathlib import Path

import pytest

import handeye
from handeye.api.plans import DRAWN
from handeye.core.errors import InvalidInput

SCRIPT = 'STAGE "go & see"\nOPEN 1\nMOVE P\nSTAGE "shut"\nCLOSE .5\n'
TAUGHT = "[positions]\nP = { at = [25, 38, 6, 90, 90, 0] }\n"


@pytest.fixture(scope="module")
def plan() -> handeye.Plan:
    return handeye.plan(SCRIPT, taught=TAUGHT)


def test_a_text_is_planned_as_the_file_of_it_is(plan: handeye.Plan, tmp_path: Path) -> None:
    (tmp_path / "script.al").write_text(SCRIPT, encoding="utf-8")
    (tmp_path / "script.toml").write_text(TAUGHT, encoding="utf-8")
    assert handeye.plan(tmp_path / "script.al") == handeye.plan(str(tmp_path / "script.al")) == plan


def test_positions_may_be_taught_by_another_file(plan: handeye.Plan, tmp_path: Path) -> None:
    (tmp_path / "other.toml").write_text(TAUGHT, encoding="utf-8")
    assert handeye.plan(SCRIPT, taught=tmp_path / "other.toml") == plan


def test_a_plan_that_was_saved_is_the_same(plan: handeye.Plan, tmp_path: Path) -> None:
    file = plan.save(tmp_path / "a.plan.json")
    assert handeye.plan(file) == plan
    assert hash(handeye.plan(file)) == hash(plan)


def test_a_plan_stands_for_itself(plan: handeye.Plan) -> None:
    assert handeye.plan(plan) is plan
    assert handeye.plan(plan.record) == plan


def test_a_plan_tells_its_stages_and_steps(plan: handeye.Plan) -> None:
    assert [(stage.number, stage.name, len(stage.steps)) for stage in plan.stages] == [
        (1, "go & see", 2),
        (2, "shut", 1),
    ]
    assert [(step.line, step.text) for step in plan.steps] == [(2, "OPEN 1"), (3, "MOVE P"), (5, "CLOSE .5")]
    assert plan.seconds == plan.stages[0].seconds > 0
    assert repr(plan) == "<Plan script: 2 stages, 3 steps, 1 motion>"


def test_errors_of_a_script_are_values_with_their_places() -> None:
    with pytest.raises(handeye.ScriptError, match=r"(?s)OPNE.*NOWHERE") as caught:
        handeye.plan("OPNE 3\nMOVE NOWHERE\n")
    assert isinstance(caught.value, InvalidInput)
    assert [(d.code, d.severity, d.file, d.line, d.column, d.end) for d in caught.value.diagnostics] == [
        ("unknown-instruction", "error", "script.al", 1, 1, 5),
        ("unknown-position", "error", "script.al", 2, 6, 13),
    ]
    assert str(caught.value.diagnostics[0]).splitlines()[3] == "1│ OPNE 3"


def test_warnings_are_kept_with_the_plan() -> None:
    (found,) = handeye.plan("OPEN 1\nJUMP L\nCLOSE 0\nL: OPEN 2\n").diagnostics
    assert (found.severity, found.line) == ("warning", 3)


def test_the_page_of_a_plan_escapes_what_a_script_says(tmp_path: Path) -> None:
    name = tmp_path / "<b>.al"
    name.write_text(
        'STAGE "<script>alert(1)</script>"\nOPEN 1\nJUMP L\nCLOSE 0\nL: OPEN 2\n', encoding="utf-8"
    )
    page = handeye.plan(name)._repr_html_()
    assert "&lt;script&gt;alert(1)&lt;/script&gt;" in page
    assert "&lt;b&gt;" in page
    assert "<script" not in page
    assert "<b>.al" not in page


def test_the_page_of_a_plan_has_a_row_a_stage_and_its_warnings(plan: handeye.Plan) -> None:
    assert plan._repr_html_().count("<tr>") == 3
    assert "warning[" in handeye.plan("OPEN 1\nJUMP L\nCLOSE 0\nL: OPEN 2\n")._repr_html_()


def test_the_flow_of_a_plan_or_of_a_stage_is_a_drawing(plan: handeye.Plan) -> None:
    assert "MOVE P" in plan.flow().svg
    assert "MOVE P" not in plan.flow("shut").svg
    assert repr(plan.flow(2)) == "<FlowDrawing flow of script, shut: 1 step>"
    with pytest.raises(InvalidInput, match=r"^there is no stage 3; the program has stages 1 to 2$"):
        plan.flow(3)


def test_a_drawing_is_a_picture_whose_style_reaches_nothing_else(plan: handeye.Plan) -> None:
    page = plan.flow()._repr_html_()
    assert "<style" not in page
    assert 'alt="flow of script: 3 steps"' in page
    assert b64encode(plan.flow().svg.encode()).decode() in page


def test_a_short_plan_is_shown_with_its_flow_and_a_long_one_without(plan: handeye.Plan) -> None:
    assert plan.flow()._repr_html_().splitlines()[1] in plan._repr_html_()
    assert "<img" not in handeye.plan("OPEN 1\n" * (DRAWN + 1))._repr_html_()


def test_a_notebook_shows_the_mistakes_of_a_script_and_no_traceback() -> None:
    with pytest.raises(handeye.ScriptError) as caught:
        handeye.plan("OPNE 3\n")
    assert caught.value._render_traceback_() == str(caught.value).splitlines()


@pytest.mark.parametrize("wrong", [None, 3, "", b"OPEN 1\n", ["OPEN 1"]])
def test_what_is_no_script_is_refused_in_one_sentence(wrong: object) -> None:
    with pytest.raises(InvalidInput, match=r"^a script must be a file or a text, not "):
        handeye.plan(wrong)


@pytest.mark.parametrize("name", ["a" * 5000, "a\0b"])
@pytest.mark.parametrize(
    "use", [handeye.plan, handeye.open, lambda name: handeye.plan("OPEN 1\n").save(name)]
)
def test_a_name_that_no_file_can_have_is_refused_in_one_sentence(
    name: str, use: Callable[[str], object]
) -> None:
    with pytest.raises(InvalidInput, match=r"^[^\n]* cannot be used as a file: [^\n]*$"):
        use(name)


def test_a_byte_order_mark_is_no_part_of_a_text(plan: handeye.Plan) -> None:
    assert handeye.plan("\ufeffOPEN 1\n") == handeye.plan("OPEN 1\n")


def test_a_line_without_an_end_is_the_name_of_a_file() -> None:
    with pytest.raises(
        InvalidInput,
        match=r"^OPEN 1: there is no such file; a script given as text must contain a line break$",
    ):
        handeye.plan("OPEN 1")


def test_a_plan_that_was_saved_takes_no_positions(plan: handeye.Plan, tmp_path: Path) -> None:
    file = plan.save(tmp_path / "a.plan.json")
    with pytest.raises(InvalidInput, match=r"omit `taught=\.\.\.`$"):
        handeye.plan(file, taught=TAUGHT)
    with pytest.raises(InvalidInput, match=r"omit `taught=\.\.\.`$"):
        handeye.plan(plan, taught=TAUGHT)


def test_a_plan_replaces_no_other_file(plan: handeye.Plan, tmp_path: Path) -> None:
    (tmp_path / "notes").write_text("mine", encoding="utf-8")
    with pytest.raises(InvalidInput, match="exists and is not a plan"):
        plan.save(tmp_path / "notes")
