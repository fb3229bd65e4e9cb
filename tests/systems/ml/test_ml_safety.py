"""Safety: emergencies, the pump, interlocks, the panic button, and tools."""

import pytest
from level_bench import Rig, pressed, rig

from handeye.systems.ml.errors import MlError
from handeye.systems.ml.machine.surroundings import Stimulus
from handeye.systems.ml.realtime.happenings import EmergencyStopped, ToolSwitched
from handeye.systems.ml.realtime.safety import CAUSES


def moving(*stimuli: Stimulus) -> Rig:
    """An arm on its way to y = 4000 and yaw = 4000, which executes statement 288."""
    arm = rig(*stimuli)
    arm.right.statement(288)
    arm.right.start({3: 4000, 9: 4000})
    return arm


def guard(arm: Rig, upper: int) -> None:
    """Give sensor 5 an upper emergency limit."""
    arm.right.write("ST", 5, 14, upper)
    arm.right.write("ST", 5, 15, 1)


def stopped(arm: Rig) -> tuple[str, int, int]:
    """Cause, number and statement in EM."""
    cause, number, statement = (arm.right.read("EM", 1, word) for word in (1, 2, 3))
    return CAUSES[cause], number, statement


@pytest.mark.ml_row(24)
def test_an_emergency_limit_freezes_all_motors_and_switches_the_pump_off() -> None:
    arm = moving(pressed(1400, motor=3, beyond=1000))
    guard(arm, 1300)
    while not arm.right.posted:
        arm.machine.cycle()
    held = [arm.right.position(motor) for motor in arm.right.motors]
    goals = [arm.right.goal(motor) for motor in arm.right.motors]
    arm.pass_cycles(20)
    assert held == goals == [arm.right.position(motor) for motor in arm.right.motors]
    assert 1000 <= arm.right.position(3) <= 1079
    assert (arm.right.posted, arm.right.enabled, arm.arms["right"].memory.powered) == (
        "emergency",
        False,
        False,
    )
    assert stopped(arm) == ("SENSOR", 5, 288)
    assert arm.right.stopped == "sensor 5 is outside its emergency limits"
    with pytest.raises(MlError, match=r"^M15: the pump of the right arm is off; ENABLE switches it on$"):
        arm.right.start({3: 0})
    assert len(arm.seen(EmergencyStopped)) == 1


@pytest.mark.ml_row(24)
def test_an_emergency_limit_is_compared_like_an_expected_one_and_sensor_leaves_it_alone() -> None:
    arm = moving(pressed(1299))
    guard(arm, 1300)
    arm.right.open()
    arm.right.expect(5, -32000, 32000)
    arm.pass_cycles(3)
    assert arm.right.enabled
    arm.right.write("ST", 5, 14, 1299)
    arm.pass_cycles(1)
    assert not arm.right.enabled


def test_a_reading_outside_both_limits_sets_the_flag_and_is_an_emergency() -> None:
    arm = moving(pressed(1400, since=5))
    guard(arm, 1300)
    arm.right.expect(5, -10, 10)
    arm.pass_cycles(6)
    assert (list(arm.right.flags), stopped(arm)) == ([5], ("SENSOR", 5, 288))


@pytest.mark.ml_row(25)
@pytest.mark.ml_row(54)
@pytest.mark.parametrize(
    ("channel", "cause", "number", "text"),
    [
        ("panic", "PANIC", 1, "the panic button is pressed"),
        ("door", "INTERLOCK", 2, "the door of the room is open"),
        ("table_1", "INTERLOCK", 3, "the fuse of work table 1 has blown"),
        ("table_2", "INTERLOCK", 4, "the fuse of work table 2 has blown"),
        ("machine_check", "CLASS", 6, "the System/7 reports a machine check"),
        ("power", "CLASS", 7, "the System/7 reports a power or temperature warning"),
    ],
)
def test_the_panic_button_and_every_interlock_stop_a_motion_within_a_cycle(
    channel: str, cause: str, number: int, text: str
) -> None:
    arm = moving()
    arm.pass_cycles(10)
    before = arm.right.position(3)
    arm.arms["right"].switch(channel, 1)
    arm.machine.cycle()
    assert not arm.right.enabled
    arm.pass_cycles(20)
    assert 0 < arm.right.position(3) - before <= 79
    assert arm.right.goal(3) == arm.right.position(3)
    assert (stopped(arm), arm.right.stopped) == ((cause, number, 288), text)
    with pytest.raises(MlError, match=rf"^M14: the pump stays off: {text}$"):
        arm.right.enable()
    arm.arms["right"].switch(channel, 0)
    arm.right.enable()
    assert (arm.right.enabled, arm.right.stopped) == (True, "")


@pytest.mark.ml_row(26)
def test_enable_after_an_emergency_moves_nothing() -> None:
    arm = moving()
    arm.pass_cycles(10)
    arm.right.emergency("PROGRAM", 288)
    arm.pass_cycles(5)
    before = [arm.right.position(motor) for motor in arm.right.motors]
    arm.right.enable()
    arm.pass_cycles(50)
    assert [arm.right.position(motor) for motor in arm.right.motors] == before
    assert arm.move({3: 0}) > 0
    assert arm.right.position(3) == 0


@pytest.mark.ml_row(26)
def test_enable_forgets_goals_that_were_written_while_the_pump_was_off() -> None:
    arm = rig()
    arm.right.disable()
    arm.right.write("MT", 3, 4, 500)
    arm.right.write("MT", 3, 5, 500)
    arm.right.enable()
    arm.pass_cycles(20)
    assert arm.right.position(3) == 0


def test_disable_freezes_first_and_enable_twice_does_nothing() -> None:
    arm = moving()
    arm.pass_cycles(10)
    arm.right.enable()
    assert arm.right.goal(3) == 4000
    arm.right.disable()
    assert arm.right.goal(3) == arm.right.position(3)
    assert not arm.arms["right"].memory.powered
    assert arm.right.stopped == ""


@pytest.mark.ml_row(44)
def test_a_word_of_do_switches_a_tool_at_the_next_cycle() -> None:
    arm = rig()
    arm.right.write("DO", 1, 1, 1)
    assert arm.arms["right"].memory.outputs["screwdriver"] == 0
    arm.machine.cycle()
    assert arm.arms["right"].memory.outputs == {
        "screwdriver": 1.0,
        "vacuum": 0.0,
        "feeder": 0.0,
        "reverse": 0.0,
    }
    arm.right.write("DO", 1, 1, 2)
    arm.pass_cycles(2)
    assert arm.arms["right"].memory.outputs == {
        "screwdriver": 0.0,
        "vacuum": 1.0,
        "feeder": 0.0,
        "reverse": 0.0,
    }
    assert [(event.tool, event.on) for event in arm.seen(ToolSwitched)] == [
        ("screwdriver", True), ("screwdriver", False), ("vacuum", True)
    ]  # fmt: skip


@pytest.mark.ml_row(44)
def test_outputs_are_tested_while_the_pump_is_off_only() -> None:
    arm = rig()
    for test in (lambda: arm.right.digital_out(1, 1, 1), lambda: arm.right.analog_out(2, 100)):
        with pytest.raises(
            MlError,
            match=r"^M15: outputs can be tested only while the pump is off; DISABLE switches it "
            "off$",
        ):
            test()
    arm.right.disable()
    arm.right.digital_out(1, 5, 4)
    arm.right.digital_out(1, 2, 2)
    arm.right.analog_out(2, 100)
    assert (arm.right.read("DO", 1, 1), arm.right.read("AO", 2, 1)) == (6, 100)


@pytest.mark.ml_row(45)
def test_an_emergency_switches_every_tool_off_within_a_cycle_and_enable_none_on() -> None:
    arm = moving()
    arm.right.write("DO", 1, 1, 5)
    arm.pass_cycles(5)
    arm.arms["right"].switch("door", 1)
    arm.machine.cycle()
    assert set(arm.arms["right"].memory.outputs.values()) == {0.0}
    arm.arms["right"].switch("door", 0)
    arm.right.enable()
    arm.pass_cycles(5)
    assert set(arm.arms["right"].memory.outputs.values()) == {0.0}


@pytest.mark.ml_row(56)
def test_without_the_pump_the_electric_motors_hold() -> None:
    held = {spec.name for spec in rig().arms["right"].specs if spec.holds}
    assert held == {"yaw", "pitch", "separation", "angle"}


def test_a_division_by_zero_in_a_table_is_a_program_check() -> None:
    for table, line, word in (("MT", 3, 14), ("ST", 5, 5)):
        arm = moving()
        arm.right.write(table, line, word, 0)
        arm.machine.cycle()
        assert (stopped(arm), arm.right.enabled) == (("CLASS", 5, 288), False)


def test_an_emergency_of_one_arm_leaves_the_other_on() -> None:
    arm = rig(sides=("right", "left"))
    arm.left.start({3: 4000})
    arm.right.emergency("PROGRAM", 1)
    arm.pass_cycles(500)
    assert (arm.left.enabled, arm.left.position(3), arm.right.enabled) == (True, 4000, False)
