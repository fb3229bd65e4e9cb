"""Row 44: a plan is carried out again and again without being made again.

Straight motions go from where the hand is, so that their set-points are made just before each begins (`line.straight`).
Trigonometry that is left to the working phase is the servo's: where the hand is, what the arm weighs there.
"""

import sys
from collections.abc import Iterator
from contextlib import contextmanager
from functools import cache
from types import FrameType

import numpy as np
import pytest
from fakes import FakeCell

from handeye.al import compile_text
from handeye.arm.robots.stanford import STANFORD
from handeye.core.source import Source
from handeye.editor.samples import SAMPLE
from handeye.execution.context import ExecutionContext
from handeye.execution.executor import Executor
from handeye.planfile.plan import Plan
from handeye.planning.planner import make_plan
from handeye.program.events import AnyEvent, to_line
from handeye.tasks.water_pump.world.nominal import DRAWING

pytestmark = pytest.mark.slow

PLANNERS = {("planning.planner", "*"), ("planning.motions", "move_trajectory"), ("arm.ik", "solve")}
"""Makers of motions to places: the planner, the path over the goal, the joints that reach it."""

UNDISTURBED = "MOVE P\nMOVE T DIRECT\nPARK"
SHIFTED = "MOVE T\nCHANGE X .5\nSAVE H\nMOVE T\nRESTORE H"


def plan_of(text: str) -> Plan:
    program, diagnostics = compile_text(Source(name="twice.al", text=text), SAMPLE)
    assert program is not None, diagnostics
    plan, problems = make_plan(program, STANFORD, task="water_pump")
    assert plan is not None, problems
    return plan


def carried_out(plan: Plan) -> bytes:
    """Everything that happens when a plan is carried out, as bytes."""
    events: list[AnyEvent] = []
    cell = FakeCell(np.array(plan.motions[0].knots[0])).devices
    executor = Executor(
        run=ExecutionContext(plan=plan, arm=STANFORD, cell=cell, camera=DRAWING, emit=events.append)
    )
    while executor.state.at is not None:
        executor.step()
    assert executor.finish()
    return b"".join(map(to_line, events))


@contextmanager
def planners_called() -> Iterator[set[tuple[str, str]]]:
    """Which of the planners are called meanwhile, by whatever way."""
    called: set[tuple[str, str]] = set()

    def watch(frame: FrameType, event: str, _: object) -> None:
        module = frame.f_globals.get("__name__", "").removeprefix("handeye.")
        found = {(module, frame.f_code.co_name), (module, "*")} & PLANNERS
        called.update(found if event == "call" else ())

    before = sys.getprofile()
    sys.setprofile(watch)
    try:
        yield called
    finally:
        sys.setprofile(before)


@cache
def first_run(text: str) -> tuple[Plan, bytes, set[tuple[str, str]]]:
    """A plan, everything that happens when it is first carried out, and the planners called meanwhile."""
    plan = plan_of(text)
    with planners_called() as called:
        return plan, carried_out(plan), called


@pytest.mark.row(44)
def test_row_44_motions_to_places_are_not_planned_again() -> None:
    _, _, called = first_run(UNDISTURBED)
    assert called == set()


@pytest.mark.row(44)
@pytest.mark.parametrize("text", [UNDISTURBED, SHIFTED])
def test_row_44_a_second_run_of_a_plan_is_the_first_to_the_byte(text: str) -> None:
    plan, first, _ = first_run(text)
    assert carried_out(plan) == first


def test_planning_calls_all_that_makes_motions() -> None:
    with planners_called() as called:
        plan_of(UNDISTURBED)
    assert called == PLANNERS


def test_a_goal_that_was_shifted_gets_a_path_of_its_own_but_no_plan() -> None:
    _, _, called = first_run(SHIFTED)
    assert called == PLANNERS - {("planning.planner", "*")}
