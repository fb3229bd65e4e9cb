"""A program that does without a sense goes by what it believes in its place, and the run says so."""

import numpy as np
import pytest
from fakes import FakeCell
from short_runs import FEEL, GRASP, plan_of

from handeye.arm.kinematics import forward
from handeye.arm.robots.stanford import STANFORD
from handeye.cli.world_options import ErrorOptions
from handeye.core import errors
from handeye.core.errors import InvalidInput
from handeye.core.variation import Overrides, WorldSpec
from handeye.execution.context import ExecutionContext
from handeye.execution.executor import ACTIONS
from handeye.program.events import (
    AnyEvent,
    ErrorRaised,
    GuardTripped,
    OperatorCalled,
    RunStarted,
    Saved,
    SearchAdvanced,
    StepStarted,
)
from handeye.program.senses import SENSES
from handeye.program.vision_operations import General, Inspect, Match, Specific
from handeye.runs.advance import advance, ended
from handeye.runs.checkpoint_file import decode, encode
from handeye.runs.runner import Runner
from handeye.runs.setup import Setup
from handeye.runs.snapshot import Checkpoint
from handeye.tasks import task
from handeye.trials.assembly import run_plan

WORLD = WorldSpec(seed=3)
ASIDE = WorldSpec(seed=3, overrides=Overrides(set={"fixtures.pin_holder.y": 0.003}))
"""The holder of the pins stands 3 mm aside, along the line of the fingers."""
SEEKING = """
TRANS   ABOVE [25 38 6 90 90 0]
        SEARCH  .2
L:      MOVE    ABOVE
        AOJ     L
"""
BELIEVING = """
TRANS   ABOVE [25 38 6 90 90 0]
        MOVE    ABOVE
        STOP    [0 0 -40]
        CHANGE  [0 0 -1] .2
        SKIPN   23
        WAIT    "MEETS NOTHING"
        STOP    [0 0 -40]
        CHANGE  [0 0 -1] .2
        SKIPE   23
        WAIT    "MEETS SOMETHING"
        ASSIGN  N 2
DOWN:   STOP    [0 0 -40]
        CHANGE  [0 0 -1] .2
        SKIPN   23
        JUMP    FREE
        SOJG    N DOWN
        WAIT    "MEETS SOMETHING AGAIN AND AGAIN"
FREE:   OPEN    1
"""
"""It should meet something, then nothing, and nothing once more; in fact it meets nothing at all."""


def begun(script: str, *without: str, world: WorldSpec = WORLD) -> Runner:
    setup = Setup(plan=plan_of(script), world=world, camera="ray", without=without)
    return Runner(Checkpoint(setup=setup))


def ran(script: str, *without: str) -> Runner:
    runner = begun(script, *without)
    advance(runner)
    return runner


def of(runner: Runner, kind: type[AnyEvent]) -> list[AnyEvent]:
    return [event for event in runner.events if isinstance(event, kind)]


@pytest.mark.slow
def test_without_centring_the_hand_does_not_give_way() -> None:
    """The arm may be pushed aside, and its joints feel that; its set-point stays where it was."""
    moved = []
    for without in ((), ("centring",)):
        runner = begun(GRASP, *without, world=ASIDE)
        for _ in range(3):  # OPEN, MOVE, CENTER
            before = runner.context.state.drive.q.copy()
            runner.step()
        hands = (forward(STANFORD, q)[:3, 3] for q in (before, runner.context.state.drive.q))
        moved.append(np.linalg.norm(np.subtract(*hands)))
    assert moved[0] > 0.002
    assert moved[1] < 1e-6


@pytest.mark.slow
def test_without_touch_the_fingers_close_blind_and_nothing_is_measured() -> None:
    runner = ran(GRASP, "touch")
    assert [event.difference for event in of(runner, Saved)] == [(0.0, 0.0, 0.0)]
    assert ended(runner).kind == "end"


@pytest.mark.slow
def test_without_search_there_is_one_try() -> None:
    runner = ran(SEEKING, "search")
    assert (of(runner, SearchAdvanced), ended(runner).error) == ([], errors.SEARCH_EXHAUSTED)


@pytest.mark.slow
def test_without_force_no_force_ends_a_motion_and_its_tests_are_taken_to_have_gone_well() -> None:
    assert ended(ran(BELIEVING)).message == "MEETS NOTHING"
    runner = ran(BELIEVING, "force")
    assert (ended(runner).kind, of(runner, GuardTripped), of(runner, ErrorRaised)) == ("end", [], [])


@pytest.mark.slow
def test_without_force_a_hand_on_the_table_is_noticed_by_its_joints() -> None:
    (call,) = of(ran(FEEL, "force"), OperatorCalled)
    assert call.error == errors.SERVO_LAG


def test_without_vision_a_part_lies_where_it_was_planned() -> None:
    plan = plan_of("OPEN 1\n")
    said: list[AnyEvent] = []
    run = ExecutionContext(
        plan=plan, arm=STANFORD, cell=FakeCell(task().park).devices, camera=None, emit=said.append,
        without=frozenset({"vision"}),
    )  # fmt: skip
    for operation in (
        General(part="BASE", picture="WIDE"),
        Specific(part="BASE", picture="WIDE"),
        Inspect(part="BASE", before="A", after="B"),
        Match(part="BASE", before="A", after="B"),
    ):
        assert ACTIONS[type(operation)](run, operation) is None
    assert (said, run.state.world.measured) == ([], {})


@pytest.mark.slow
def test_checkpoint_beginning_and_result_tell_what_was_lacking() -> None:
    found = run_plan(plan_of("OPEN 1\n"), world=WORLD, camera="ray", without=("vision", "touch"))
    (started,) = of(found.runner, RunStarted)
    kept = decode(encode(found.runner.checkpoint()), "it")
    assert started.lacking == found.result.without == kept.setup.without == ("vision", "touch")
    assert [warning.split(":")[0] for warning in found.result.warnings] == ["without vision", "without touch"]


def test_senses_are_told_from_errors_of_the_world() -> None:
    options = ErrorOptions(without=["touch,camera", "vision", "heads"])
    errors, spared = options.apart({"HEADS", "TOOLS"})
    assert (spared, errors.without) == (("vision", "touch", "HEADS"), ["camera"])
    with pytest.raises(
        InvalidInput,
        match=r"^`touch` is a sense, not an error of the world; this command runs no program",
    ):
        options.spec(0)


CHECKED = """
TRANS   ABOVE [25 38 6 90 90 0]
DEFINE LOOK2 GAP
        OPEN    GAP

DEFINE CHECK
        MOVE    ABOVE
        LOOK2   .5

        STAGE   "one"
        OPEN    1
        CHECK
        STAGE   "two"
        CHECK
        LOOK2   .7
"""
"""A check that ends a stage, and one that begins one."""


@pytest.mark.parametrize(
    ("without", "done"),
    [
        ((), ["OPEN", "MOVE", "OPEN", "MOVE", "OPEN", "OPEN"]),
        (("CHECK",), ["OPEN", "OPEN"]),
        (("LOOK2",), ["OPEN", "MOVE", "OPEN", "MOVE", "OPEN"]),
        (("CHECK", "LOOK2"), ["OPEN"]),
    ],
)
@pytest.mark.slow
def test_a_macro_that_the_run_goes_without_is_passed_over_where_a_stage_calls_it(
    without: tuple[str, ...], done: list[str]
) -> None:
    runner = ran(CHECKED, *without)
    assert [event.text.split()[0] for event in of(runner, StepStarted)] == done
    assert ended(runner).kind == "end"
    assert of(runner, RunStarted)[0].lacking == without


def test_no_error_of_the_world_has_the_name_of_a_sense() -> None:
    variation = task().variation()
    assert {*SENSES} & {*variation.quantities, *variation.groups} == set()
