"""Opening, closing and CENTER go by the figures of the hand that the arm has, and not by anybody else's."""

from collections.abc import Callable
from dataclasses import replace

import numpy as np
import pytest
from fakes import FakeCell

from handeye.al import compile_text
from handeye.arm.model import GraspModel
from handeye.arm.robots.stanford import STANFORD
from handeye.core.source import Source
from handeye.core.units import INCH, JIFFY
from handeye.editor.samples import SAMPLE
from handeye.execution.context import ExecutionContext
from handeye.execution.executor import Executor
from handeye.planning.planner import make_plan
from handeye.ports.workcell import Sensed
from handeye.tasks.stanford_cell.dimensions import PARK
from handeye.touch.senses import SWITCH_FORCE

GRASP = GraspModel(speed=0.06, centring=0.03, settle=4)
ARM = replace(STANFORD, hand=replace(STANFORD.hand, grip=33.0, grasp=GRASP))
THICKNESS = 0.02
"""Of what stands between the fingers, which begin 5 cm apart, m."""


def carried_out(
    statement: str, thickness: Callable[[FakeCell], float] = lambda _: THICKNESS, settle: int = GRASP.settle
) -> tuple[FakeCell, list[Sensed]]:
    """A statement carried out by an arm with such a hand, and all that was sensed meanwhile."""
    arm = replace(ARM, hand=replace(ARM.hand, grasp=replace(GRASP, settle=settle)))
    program, diagnostics = compile_text(Source(name="grasp.al", text=statement), SAMPLE)
    assert program is not None, diagnostics
    plan, problems = make_plan(program, STANFORD, task="water_pump")
    assert plan is not None, problems
    cell, periods = FakeCell(np.array(PARK)), list[Sensed]()
    cell.hand.thickness = lambda _: thickness(cell)
    run = ExecutionContext(plan=plan, arm=arm, cell=cell.devices, camera=None, emit=lambda _: None)
    run.drive.watch = lambda period: periods.append(period.sensed)
    Executor(run=run).step()
    return cell, periods


@pytest.mark.parametrize(
    ("statement", "way", "speed", "settle"),
    [
        (f"OPEN {0.08 / INCH}", 0.03, GRASP.speed, GRASP.settle),
        ("CLOSE .1", 0.05 - THICKNESS, GRASP.speed, GRASP.settle),
        ("CENTER .1", 0.05 - THICKNESS, GRASP.centring, GRASP.settle // 2),
    ],
)
def test_the_fingers_go_at_the_speed_of_their_hand_and_press_as_long_as_it_says(
    statement: str, way: float, speed: float, settle: int
) -> None:
    _, periods = carried_out(statement)
    assert len([sensed for sensed in periods if not sensed.braked]) == pytest.approx(
        way / (speed * JIFFY) + settle, abs=1
    )


def test_a_program_that_ends_with_a_motion_leaves_the_arm_under_its_brakes() -> None:
    """Under its drives, the arm would still sway: in the world of seed 987000 at the high level, a link moved at
    1.5 mm/s, and the referee refuses more than 1.
    """
    _, periods = carried_out("CHANGE [0 0 1] .5")
    assert not periods[0].braked
    assert periods[-1].braked


@pytest.mark.parametrize("statement", ["OPEN 3", "CLOSE .1", "CENTER .1"])
def test_the_fingers_press_with_no_more_than_their_hand_can(statement: str) -> None:
    cell, _ = carried_out(statement)
    assert cell.hand.grip == 33.0


def test_fingers_that_centre_follow_an_object_that_stands_up_under_their_pressure() -> None:
    """A leaning pin stood up by .13 mm once both fingers pressed. Their set-point, .14 mm ahead of where they
    had first touched it, then pressed too weakly to close a switch, and the sound switches were reported as failed.
    """
    straight = THICKNESS - 1.5 * ARM.hand.grasp.lag(SWITCH_FORCE, ARM.hand.grip)
    pressed = list[float]()

    def thickness(cell: FakeCell) -> float:
        if cell.hand.goal < cell.hand.gap <= THICKNESS:
            pressed.append(cell.hand.gap)
        return straight if len(pressed) > 20 else THICKNESS

    _, periods = carried_out("CENTER .1", thickness, settle=60)
    assert all(periods[-1].touch)
    assert periods[-1].gap == pytest.approx(straight)
