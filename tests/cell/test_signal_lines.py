"""What is broken on a line shows in all that the line carries, from the moment it sets in."""

from collections.abc import Callable

import mujoco
import numpy as np
import pytest

from handeye.arm.kinematics import jacobian
from handeye.arm.robots.stanford import STANFORD
from handeye.cell.arm import SimulatedArm
from handeye.cell.defects import DEAD, PICTURE, Defect, DriftEffect, Effect, GainEffect, OffsetEffect, Stuck
from handeye.cell.signal_lines import DefectState, SignalLines, SignalLinesState
from handeye.cell.simulated import SimulatedCell
from handeye.core.errors import InvalidInput
from handeye.core.resources import scenes
from handeye.core.units import JIFFY
from handeye.ports.camera import COLUMNS, ROWS
from handeye.tasks.stanford_cell.dimensions import PARK
from handeye.tasks.water_pump.world.pump_world import PumpWorld

EFFECTS = {
    "stuck": (Stuck(), [5.0, 5.0, 5.0]),
    "stuck at a value": (Stuck(1.0), [1.0, 1.0, 1.0]),
    "shifted": (OffsetEffect(0.5), [5.5, 6.5, 7.5]),
    "drifting": (DriftEffect(0.5), [5.0, 6.5, 8.0]),
    "weak": (GainEffect(0.5), [2.5, 3.0, 3.5]),
    "dead": (DEAD, [0.0, 0.0, 0.0]),
}


def arrived(lines: SignalLines) -> list[float]:
    """What arrives of 5, 6 and 7, a second each apart."""
    found = []
    for value in (5.0, 6.0, 7.0):
        found.append(lines.carried("a", value))
        lines.before(1.0)
    return found


@pytest.mark.parametrize("name", EFFECTS)
def test_a_defect_changes_what_its_line_carries_and_no_other(name: str) -> None:
    effect, expected = EFFECTS[name]
    assert arrived(SignalLines([Defect(line="a", effect=effect)])) == expected
    assert arrived(SignalLines([Defect(line="b", effect=effect)])) == [5.0, 6.0, 7.0]


def test_defects_of_one_line_act_one_after_the_other() -> None:
    both = SignalLines([Defect(line="a", effect=OffsetEffect(1.0)), Defect(line="a", effect=GainEffect(2.0))])
    assert both.carried("a", 5.0) == 12.0


@pytest.mark.parametrize(("stage", "reading"), [(1, 5.0), (2, 0.0), (3, 0.0)])
def test_a_defect_sets_in_with_its_stage_or_with_a_later_one_where_that_was_passed_over(
    stage: int, reading: float
) -> None:
    lines = SignalLines([Defect(line="a", effect=DEAD, stage=2)])
    lines.begin_stage(stage)
    assert lines.carried("a", 5.0) == reading


def test_a_defect_that_has_set_in_stays_when_an_earlier_stage_is_done_again() -> None:
    lines = SignalLines([Defect(line="a", effect=Stuck(), stage=2)])
    lines.begin_stage(2)
    lines.carried("a", 5.0)
    lines.begin_stage(1)
    lines.begin_stage(2)
    assert lines.carried("a", 6.0) == 5.0


def test_a_frozen_picture_is_the_first_one_whatever_is_seen() -> None:
    lines = SignalLines([Defect(line=PICTURE, effect=Stuck())])
    first, second = (np.full((ROWS, COLUMNS), level, dtype=np.uint8) for level in (3, 9))
    assert [lines.carried_picture(each).max() for each in (first, second)] == [3, 3]


def test_lines_go_on_as_from_the_state_they_are_put_into() -> None:
    defects = [Defect(line="a", effect=effect) for effect in (Stuck(), DriftEffect(0.5))]
    lines, other = SignalLines(defects), SignalLines(defects)
    arrived(lines)
    other.restore(lines.state())
    assert arrived(other) == arrived(lines)


STATES: dict[str, tuple[str, tuple[DefectState, ...]]] = {
    "number of saved defects differs": ("a", ()),
    "the wrong size": ("a", (DefectState(seconds=0.0, first=b"abc"),)),
    "not a finite number": ("a", (DefectState(seconds=0.0, first=np.array(np.nan).tobytes()),)),
    "at an impossible time": ("a", (DefectState(seconds=-1.0),)),
    "impossibly bright": (PICTURE, (DefectState(seconds=0.0, first=bytes([16]) * ROWS * COLUMNS),)),
}


@pytest.mark.parametrize("words", STATES)
def test_a_state_that_lines_cannot_be_in_is_refused(words: str) -> None:
    line, states = STATES[words]
    lines = SignalLines([Defect(line=line, effect=Stuck())])
    with pytest.raises((ValueError, InvalidInput), match=words):
        lines.check(SignalLinesState(defects=states))


# -- an arm alone -------------------------------------------------------------------------------------


def arm(line: str, effect: Effect) -> tuple[SimulatedCell, SimulatedArm]:
    """An arm in its park position, with something broken."""
    model = mujoco.MjModel.from_xml_path(str(scenes() / "stanford_arm" / "stanford.xml"))
    model.opt.timestep = JIFFY / 16
    data, world, lines = (
        mujoco.MjData(model),
        PumpWorld.nominal(),
        SignalLines([Defect(line=line, effect=effect)]),
    )
    noise = world.generator("sensors")
    made = SimulatedArm(
        model, data, "", arm=STANFORD, posture=PARK, errors=world.arm, noise=noise, lines=lines
    )
    return SimulatedCell(model, data, arm=made, lines=lines, noise=noise), made


def test_a_potentiometer_off_reads_wrong_and_the_arm_stands_where_it_stood() -> None:
    cell, broken = arm("potentiometer.2", OffsetEffect(0.1))
    cell.advance(JIFFY)
    assert broken.read().q - PARK == pytest.approx([0, 0.1, 0, 0, 0, 0], abs=1e-4)
    assert cell.truth.data.qpos[broken.qpos] == pytest.approx(PARK, abs=1e-4)


def moved(line: str, effect: Effect) -> SimulatedArm:
    """The arm after a period under a torque."""
    cell, broken = arm(line, effect)
    broken.drive(np.full(6, 5.0))
    cell.advance(JIFFY)
    return broken


def test_a_dead_tachometer_reads_zero_while_the_joint_turns() -> None:
    rates = moved("tachometer.4", DEAD).read().qd
    assert rates[3] == 0.0
    assert (np.abs(np.delete(rates, 3)) > 1e-3).all()


def actuated(line: str, effect: Effect) -> np.ndarray:
    """Torques that the motors exert when each is told 1."""
    cell, broken = arm(line, effect)
    broken.drive(np.ones(6))
    cell.advance(JIFFY)
    return np.array([cell.truth.data.actuator(f"j{number}").force[0] for number in range(1, 7)])


def test_a_weak_drive_exerts_its_share_of_the_torque_it_is_told() -> None:
    assert actuated("drive.5", GainEffect(0.25)) == pytest.approx([1, 1, 1, 1, 0.25, 1])


def test_drives_off_zero_exert_what_the_force_at_the_hand_is_to_them() -> None:
    force = 2.0 * jacobian(STANFORD, PARK)[2]
    assert actuated("force.z", OffsetEffect(2.0)) == pytest.approx(1 + force, abs=1e-6)


def test_a_brake_that_slips_lets_the_arm_down() -> None:
    cell, broken = arm("brake.2", DEAD)
    for _ in range(10):
        cell.advance(JIFFY)
    sunk = np.abs(broken.read().q - PARK)
    assert sunk[1] > 0.005
    assert np.delete(sunk, 1).max() < 0.001


CAPTURED: dict[str, Callable[[], tuple[SimulatedCell, SimulatedArm]]] = {
    "stuck": lambda: arm("potentiometer.1", Stuck()),
    "drifting": lambda: arm("potentiometer.1", DriftEffect(0.1)),
}


@pytest.mark.parametrize("name", CAPTURED)
def test_a_cell_with_a_defect_is_put_back_to_the_byte(name: str) -> None:
    cell, broken = CAPTURED[name]()
    cell.advance(JIFFY)
    state = cell.capture()
    cell.restore(state)
    cell.advance(JIFFY)
    then = broken.read().q.tobytes()
    again, its = CAPTURED[name]()
    again.restore(state)
    again.advance(JIFFY)
    assert its.read().q.tobytes() == then
