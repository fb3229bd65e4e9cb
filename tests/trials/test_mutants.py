"""The mutants of a program, and the faults with which they are tried."""

import pytest
from conftest import Command

from handeye.al import compile_text
from handeye.core.resources import plans
from handeye.core.source import Source
from handeye.core.variation import WorldSpec
from handeye.editor.samples import SAMPLE
from handeye.planfile.store import read_plan
from handeye.program.program import Program
from handeye.proof.outcomes import OutcomeGraph
from handeye.tasks.water_pump.task import WATER_PUMP
from handeye.trials.mutants.purpose import faults_for
from handeye.trials.mutants.rules import Mutant, mutants

TEXT = """\
MOVE T
STOP [0 0 -40]
CHANGE [0 0 -1] 1
SKIPN 23
WAIT "NOTHING"
TRAVEL .2 .4
CLOSE .5
"""


def made(text: str = TEXT) -> dict[str, Mutant]:
    program, diagnostics = compile_text(Source(name="try.al", text=text), SAMPLE)
    assert program is not None, diagnostics
    return {each.name: each for each in mutants(program)}


def test_each_line_has_a_mutant_for_each_rule_that_applies_to_it() -> None:
    assert list(made()) == [
        "unguarded: line 3 CHANGE", "guard doubled: line 3 CHANGE", "error ignored: line 4 SKIPN",
        "not called: line 5 WAIT", "left out: line 6 TRAVEL", "limits doubled: line 6 TRAVEL",
        "not measured: line 7 CLOSE",
    ]  # fmt: skip


def test_a_mutant_differs_from_the_program_in_its_own_steps_only() -> None:
    program, _ = compile_text(Source(name="try.al", text=TEXT), SAMPLE)
    assert program is not None
    for mutant in mutants(program):
        pairs = zip(program.steps, mutant.program.steps, strict=True)
        assert mutant.steps == tuple(n for n, (one, other) in enumerate(pairs) if one != other)


def test_an_ignored_error_leads_where_the_better_branch_leads() -> None:
    found = made()["error ignored: line 4 SKIPN"]
    (test,) = found.steps
    step = found.program.steps[test]
    assert {way and found.program.steps[way].word for way in step.ways} == {"TRAVEL"}


def test_limits_are_doubled_about_their_middle() -> None:
    found = made()["limits doubled: line 6 TRAVEL"]
    operation = found.program.steps[found.steps[0]].operation
    assert [round(limit / 0.0254, 3) for limit in (operation.minimum, operation.maximum)] == [0.1, 0.5]  # type: ignore[union-attr]


def test_a_mutant_is_tried_with_the_faults_that_its_check_should_name() -> None:
    program = read_plan(plans() / "water_pump.plan.json").program
    found = {each.name: each for each in mutants(program)}
    assert "pin.1.removed" in named(program, found["left out: line 625 HEIGHT"])
    assert "gasket.removed" in named(program, found["left out: line 1002 INSPECT"])


def named(program: Program, mutant: Mutant) -> list[str]:
    world = WorldSpec(seed=0)
    graph = OutcomeGraph(program.steps)
    return [each.name for each in faults_for(mutant, program, graph, WATER_PUMP.faults(world), 9)]


@pytest.mark.slow
def test_the_command_says_which_mutants_the_proof_refuses(command: Command) -> None:
    code, out, _ = command("trials", "mutants", "--most", "0", "--only", "left out: line 625", "--jobs", "1")
    assert code == 0
    assert "left out: line 625 HEIGHT" in out
    assert "can leave unnoticed: pins, pins_tilt" in out
    assert "1 mutant: 1 refused" in out


@pytest.mark.parametrize(
    ("words", "said"),
    [
        (("--list", "--task", "insertion"), "declares no obligations"),
        (("--only", "line 625"), "the runs need --checkpoints DIR"),
        (("--most", "-1"), "must be 0 or more"),
    ],
)
@pytest.mark.slow
def test_the_command_says_what_it_cannot_do(command: Command, words: tuple[str, ...], said: str) -> None:
    code, _, err = command("trials", "mutants", *words)
    assert (code, said in err) == (2, True)
