"""Reasons to stop, as users name them."""

import pytest
from short_runs import begin, plan_of
from stepper_bench import AIR, reset

from handeye.core.errors import InvalidInput
from handeye.debugger.breakpoints import breakpoint, stage_number, step_number
from handeye.planfile.plan import Plan
from handeye.results.pauses import pause_sentence
from handeye.runs.advance import AfterStage, AnyStop, BeforeStep, advance
from handeye.runs.runner import Runner

MACRO = """\
DEFINE TWICE
LM:     OPEN    .5
        OPEN    1

        STAGE   "first half"
        TWICE
LX:     TWICE
        STAGE   "second half"
LY:
        STOP    [0 0 -50]
        CHANGE  [0 0 -1] .1
        SKIPE   23
        OPEN    2
        OPEN    1
LZ:
"""

PLAN = plan_of(AIR)


@pytest.fixture(scope="module")
def built() -> Runner:
    return Runner(begin(AIR))


@pytest.fixture
def runner(built: Runner) -> Runner:
    return reset(built)


@pytest.fixture(scope="module")
def macro() -> Plan:
    return plan_of(MACRO)


def stopped(runner: Runner, *stops: AnyStop) -> tuple[str, int | None]:
    """Why the run stops, and before which line."""
    pause = advance(runner, stops)
    return pause_sentence(pause), None if runner.next is None else runner.next.line


@pytest.mark.slow
@pytest.mark.parametrize(
    ("text", "sentence", "line"),
    [
        ("10", "breakpoint at line 10", 10),
        ("9", "breakpoint at line 10", 10),
        ("L1", "breakpoint at label L1", 8),
        ("l3", "breakpoint at label L3", 15),
        ("AOJ", "breakpoint at AOJ", 14),
        ("skipe", "breakpoint at SKIPE", 11),
        ("search in the air", "breakpoint at stage 2, search in the air", 7),
        ("Search in", "breakpoint at stage 2, search in the air", 7),
    ],
)
def test_a_run_stops_before_the_place_that_is_named(
    runner: Runner, text: str, sentence: str, line: int
) -> None:
    assert stopped(runner, breakpoint(text, PLAN.program)) == (sentence, line)


@pytest.mark.slow
@pytest.mark.parametrize("text", ["error:23", "error 23", "ERROR: 23"])
def test_a_run_stops_behind_the_step_that_raised_the_error(runner: Runner, text: str) -> None:
    why = "breakpoint on error 23: the motion ended without meeting the force of its STOP"
    assert stopped(runner, breakpoint(text, PLAN.program)) == (why, 11)


@pytest.mark.slow
def test_a_break_that_was_met_does_not_stop_the_run_again_where_it_stands(runner: Runner) -> None:
    places = breakpoint("4", PLAN.program), breakpoint("AOJ", PLAN.program)
    assert stopped(runner, *places) == ("breakpoint at AOJ", 14)
    assert stopped(runner, *places, breakpoint("17", PLAN.program)) == ("breakpoint at line 18", 18)


@pytest.mark.slow
def test_a_run_goes_to_the_end_of_a_stage(runner: Runner) -> None:
    assert stopped(runner, AfterStage(stage=0, name="open the hand")) == (
        "stage 1, open the hand, has ended",
        7,
    )
    assert runner.between_stages
    searched = AfterStage(stage=1, name="search in the air")
    assert stopped(runner, searched) == ("stage 2, search in the air, has ended", 18)


@pytest.mark.slow
def test_a_run_goes_until_a_step(runner: Runner) -> None:
    assert stopped(runner, BeforeStep(steps=(3,))) == ("paused before step 3", 8)
    assert runner.position == 3


def test_a_label_in_a_macro_stands_for_a_step_of_each_call(macro: Plan) -> None:
    assert macro.program.labels == {"LM": [0, 2], "LX": [2], "LY": [4]}


def test_a_label_before_a_modifier_stands_for_the_motion(macro: Plan) -> None:
    assert macro.program.steps[macro.program.labels["LY"][0]].text.startswith("CHANGE")


NUMBERS = "1, 2, 3, 4, 5, 6, 7, 8, 9, 23, 24, 25, 30, 31, 32, 33, 50, 51, 52, 53, 54, 55, 57"


@pytest.mark.parametrize(
    ("text", "sentence"),
    [
        ("23", "line 23 is after the last step, which is on line 22"),
        ("99999999999", "the program has no label, instruction or stage `99999999999`"),
        ("L9", "the program has no label, instruction or stage `L9`; did you mean `L1`?"),
        ("AOK", "the program has no label, instruction or stage `AOK`; did you mean `AOJ`?"),
        ("STOP", "no step of the program begins with STOP"),
        ("shut the hnad", "the program has no label, instruction or stage `shut the hnad`; "
         "did you mean `shut the hand`?"),
        ("zzz", "the program has no label, instruction or stage `zzz`"),
        ("", "give an error (error:23), a line, a label, an instruction or a stage"),
        ("error:10", f"no step raises error `10`; the steps raise {NUMBERS}"),
        ("error:", f"no step raises error ``; the steps raise {NUMBERS}"),
    ],
)  # fmt: skip
def test_a_place_that_is_not_there_is_refused_in_a_sentence(text: str, sentence: str) -> None:
    with pytest.raises(InvalidInput) as refused:
        breakpoint(text, PLAN.program)
    assert str(refused.value) == sentence


def test_the_beginning_of_a_name_counts_before_a_piece_of_another() -> None:
    assert stage_number("s", plan_of('STAGE "hands"\nPARK\nSTAGE "shut"\nPARK').program) == 1


EVERY_STAGE = "the program has 1 `open the hand`, 2 `search in the air`, 3 `grasp nothing`, 4 `shut the hand`"


@pytest.mark.parametrize("text", ["2", "search in the air", "SEARCH", " se ", "air", "In The"])
def test_a_stage_is_found_by_its_number_its_name_or_a_piece_of_it(text: str) -> None:
    assert stage_number(text, PLAN.program) == 1


@pytest.mark.parametrize(
    ("text", "sentence"),
    [
        ("0", "there is no stage 0; the program has stages 1 to 4"),
        ("5", "there is no stage 5; the program has stages 1 to 4"),
        ("s", "2 stages begin with `s`: 2 `search in the air`, 4 `shut the hand`"),
        ("grab nothing", "there is no stage `grab nothing`; did you mean `grasp nothing`?"),
        ("hand", "2 stages contain `hand`: 1 `open the hand`, 4 `shut the hand`"),
        ("hnad", "there is no stage `hnad`; did you mean `open the hand` or `shut the hand`?"),
        ("", f"there is no stage ``; {EVERY_STAGE}"),
        ("zzz", f"there is no stage `zzz`; {EVERY_STAGE}"),
    ],
)
def test_a_stage_that_is_not_there_is_refused_in_a_sentence(text: str, sentence: str) -> None:
    with pytest.raises(InvalidInput) as refused:
        stage_number(text, PLAN.program)
    assert str(refused.value) == sentence


def test_a_step_is_found_by_its_number_or_its_label() -> None:
    assert [step_number(text, PLAN.program) for text in ("0", "12", "L2")] == [0, 12, 8]


@pytest.mark.parametrize(
    ("text", "sentence"),
    [
        ("14", "there is no step 14; the program has steps 0 to 13"),
        ("-9", "`-9` is neither the number of a step nor a label"),
        ("L4", "`L4` is neither the number of a step nor a label; did you mean `L1`?"),
    ],
)
def test_a_step_that_is_not_there_is_refused_in_a_sentence(text: str, sentence: str) -> None:
    with pytest.raises(InvalidInput) as refused:
        step_number(text, PLAN.program)
    assert str(refused.value) == sentence


def test_a_label_that_stands_for_several_steps_is_no_step(macro: Plan) -> None:
    with pytest.raises(
        InvalidInput, match=r"^several steps have the label `LM`: 0, 2; give the number of one of them$"
    ):
        step_number("LM", macro.program)
