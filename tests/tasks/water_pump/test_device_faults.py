"""Every fault of a device breaks a line by which that device of the pump's cell is read or driven."""

import re
from functools import cache

import numpy as np
import pytest
from driving import Drive, tick

from handeye.cell.physics_stepper import asleep
from handeye.cell.signal_lines import SignalLinesState
from handeye.core.errors import ERRORS, SERVO_LAG
from handeye.core.faults import UNKNOWN, Fault, is_call
from handeye.core.resources import plans
from handeye.core.variation import Overrides, WorldSpec
from handeye.planfile.store import read_plan
from handeye.program.flow_operations import Wait
from handeye.program.motion_operations import Move
from handeye.tasks.stanford_cell.dimensions import dimensions
from handeye.tasks.water_pump.cell import build_cell
from handeye.tasks.water_pump.faults.devices import defects, device_faults
from handeye.tasks.water_pump.faults.shared_expectations import PINNED, SCREWED, names
from handeye.tasks.water_pump.task import WATER_PUMP
from handeye.tasks.water_pump.world.pump_world import PumpWorld

PROGRAM = read_plan(plans() / "water_pump.plan.json").program
CALLS = {step.operation.message for step in PROGRAM.steps if isinstance(step.operation, Wait)}
"""All that the program calls the operator with."""
FAULTS: tuple[Fault, ...] = tuple(fault.usual() for fault in device_faults())


@cache
def carried() -> list[tuple[str, bool]]:
    """Lines that all faults together break, and whether each has carried something when every device has worked."""
    cell = build_cell(PumpWorld.draw(WorldSpec(seed=3, faults=FAULTS)), camera="ray")
    cell.begin_stage(11)
    for _ in range(2):
        tick(cell.devices, Drive(torque=np.zeros(6), gap=0.03, grip=10.0))
        cell.advance(1.2)  # after which the computer is no longer late
    assert cell.devices.camera is not None
    cell.devices.camera.lens(0.05)
    cell.devices.camera.digitise()
    state = cell.truth.states["lines"]
    assert isinstance(state, SignalLinesState)
    broken = zip(defects(FAULTS), state.defects, strict=True)
    return [(defect.line, own.first is not None) for defect, own in broken]


@pytest.mark.slow
def test_every_line_that_a_fault_breaks_is_one_that_a_device_uses() -> None:
    assert [line for line, used in carried() if not used] == []


@pytest.mark.slow
def test_a_fault_goes_on_while_everything_in_the_cell_is_asleep() -> None:
    fault = Fault(name="potentiometer.1.drift", value=1e-4)
    cell = build_cell(PumpWorld.draw(WorldSpec(seed=3, faults=(fault,))), camera="ray")
    cell.devices.arm.drive(None)
    cell.advance(2.0)
    assert asleep(cell.truth.data)
    state = cell.truth.states["lines"]
    assert isinstance(state, SignalLinesState)
    assert state.defects[0].seconds == pytest.approx(2.0)


def test_the_catalogue_has_every_fault_of_a_device() -> None:
    assert {fault.name for fault in device_faults()} <= WATER_PUMP.faults(WorldSpec(seed=0)).kinds.keys()


def test_a_fault_at_its_usual_size_is_one_that_can_be_had() -> None:
    WATER_PUMP.faults(WorldSpec(seed=0)).check(FAULTS)


def test_of_every_fault_it_is_said_how_it_is_noticed_by_errors_and_calls_there_are() -> None:
    for kind in WATER_PUMP.faults(WorldSpec(seed=0)).kinds.values():
        assert kind.expected != UNKNOWN, kind.name
        assert {*kind.expected.errors} <= ERRORS.keys(), kind.name
        for call in kind.expected.calls:
            assert any(is_call(call, message) for message in CALLS), (kind.name, call)


LATER = WorldSpec(seed=0, overrides=Overrides(set={"pump.screws": 7.0}))


def test_no_fault_has_more_than_three_names() -> None:
    for kind in WATER_PUMP.faults(WorldSpec(seed=0)).kinds.values():
        assert len(names(kind.expected)) <= 3, kind.name


def test_something_is_in_the_way_only_where_the_hand_is_pushed_or_the_crank_turned_into_it() -> None:
    found = [
        kind.name
        for kind in WATER_PUMP.faults(WorldSpec(seed=0)).kinds.values()
        if SERVO_LAG in kind.expected.errors
    ]
    assert found == ["arm.pushed.x", "arm.pushed.y", "arm.pushed.z", "rotor.turned"]


def test_what_is_not_felt_where_it_was_on_the_pump_may_be_a_pump_that_has_moved() -> None:
    moved = WATER_PUMP.faults(WorldSpec(seed=0)).kind("base.moved.x").expected
    felt = (
        "IS GONE: NO HEAD",
        "DOES NOT STAND AS IT WAS DRIVEN",
        "NOT WHERE IT WAS PUT: ",
    )
    told = [message for message in CALLS if any(words in message for words in felt) and "PIN" not in message]
    assert len(told) == 3 * len(SCREWED) + 3
    assert all(moved.called(message) for message in told)


def test_a_call_stands_for_all_parts_where_it_leaves_the_part_open() -> None:
    assert is_call("NO SCREW AT S{number}", "NO SCREW AT S4")
    assert not is_call("NO SCREW AT S{number}", "NO SCREW")
    assert not is_call("NO SCREW AT S{number}", "THERE IS NO SCREW AT S4")


def test_of_a_later_make_what_the_program_does_not_use_is_the_only_unknown() -> None:
    unknown = [name for name, kind in WATER_PUMP.faults(LATER).kinds.items() if kind.expected == UNKNOWN]
    assert {name.split(".")[1] for name in unknown} == {"7"}


def test_what_is_said_of_screws_goes_by_the_order_in_which_the_program_drives_them() -> None:
    goals = [step.operation.goal for step in PROGRAM.steps if isinstance(step.operation, Move)]
    driven = [int(goal[1:]) + 1 for goal in goals if re.fullmatch(r"H\d", goal)]
    assert tuple(dict.fromkeys(driven)) == SCREWED  # and once more in the last stage
    assert tuple(int(k) + 1 for k in dimensions().all("base.screw_holes.pinned")) == PINNED
