"""The program to look at."""

import msgspec
from short_runs import plan_of
from stepper_bench import AIR

from handeye.debugger.listing import excerpt, excerpt_lines, listing, listing_text

PLAN = plan_of(AIR)


def test_the_stages_of_a_plan_are_listed_with_their_steps() -> None:
    assert listing_text(PLAN.program)[:6] == [
        "  1  open the hand        2 steps  lines 4 to 5",
        "         0  line 4     OPEN .5",
        "         1  line 5     OPEN .4",
        "  2  search in the air    8 steps  lines 7 to 15",
        "         2  line 7     SEARCH .07",
        "         3  line 8     MOVE T",
    ]


def test_the_listing_is_data_as_well() -> None:
    first = msgspec.to_builtins(listing(PLAN.program))[0]
    assert (first["number"], first["name"], first["lines"]) == (1, "open the hand", (4, 5))
    assert first["steps"][1] == {"step": 1, "line": 5, "text": "OPEN .4"}


def test_every_step_of_a_plan_is_listed_once_and_by_its_number() -> None:
    steps = [step for stage in listing(PLAN.program) for step in stage.steps]
    assert [step.step for step in steps] == list(range(len(PLAN.program.steps)))


def test_a_stage_that_only_calls_a_macro_has_the_lines_of_the_macro() -> None:
    plan = plan_of('DEFINE M\nOPEN 1\nOPEN 2\n\nSTAGE "both"\nM\nOPEN 3\nSTAGE "macro"\nM\n')
    assert [stage.lines for stage in listing(plan.program)] == [(7, 7), (2, 3)]


def test_a_line_of_a_macro_is_listed_as_each_call_has_it() -> None:
    plan = plan_of("DEFINE M G\nOPEN G\n\nM 1\nM .5\n")
    assert [line.split("line ")[1] for line in listing_text(plan.program)[1:]] == [
        "2     OPEN 1",
        "2     OPEN .5",
    ]


def test_the_source_is_shown_as_in_the_script_with_the_line_where_the_run_stands() -> None:
    assert excerpt_lines(excerpt(PLAN.program, 8, 8, 1)) == [
        "    7          SEARCH  .07",
        "  → 8  L1:     MOVE    T               ;OVER THE TABLE",
        "    9          STOP    [0 0 -50]",
    ]


def test_an_excerpt_ends_where_the_script_does() -> None:
    assert [line.line for line in excerpt(PLAN.program, 1, None, 2)] == [1, 2, 3]
    assert [line.line for line in excerpt(PLAN.program, 22, None, 2)] == [20, 21, 22]


def test_control_characters_of_a_script_do_not_reach_the_terminal() -> None:
    plan = plan_of("OPEN 1 ;\x1b[31mred\n")
    assert excerpt(plan.program, 1, 1, 0)[0].text == "OPEN 1 ;\N{REPLACEMENT CHARACTER}[31mred"
