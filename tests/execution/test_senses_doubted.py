"""A sense that is broken is noticed where it first matters, by its own error, which names it.

They are broken in the fake cell, whose other senses have no error. That none is doubted wrongly in drawn worlds is in
`test_senses_believed.py`.
"""

from collections.abc import Callable

import numpy as np
import pytest
from fake_runs import FakeRun, fake_run
from fakes import Wall
from msgspec.structs import replace

from handeye.core import errors
from handeye.core.errors import ERRORS
from handeye.core.pose import Array
from handeye.core.resources import plans
from handeye.core.units import DEGREE, INCH, OUNCE_INCH
from handeye.ports.camera import COLUMNS, ROWS
from handeye.ports.workcell import ArmReading, HandReading
from handeye.program.events import ErrorRaised
from handeye.program.program import Held

DOWN = "STOP [0 0 -12]\nCHANGE [0 0 -1] .5"


def reading(run: FakeRun, told: Callable[[ArmReading], ArmReading]) -> FakeRun:
    """The arm of a run reads otherwise."""
    right = run.cell.arm.read
    run.cell.arm.read = lambda: told(right())  # type: ignore[method-assign]
    return run


def only(values: Array, joint: int, value: float) -> Array:
    """Readings, but for that of one joint."""
    found = values.copy()
    found[joint] = value
    return found


def gripping(script: str, thickness: float, told: Callable[[HandReading], HandReading]) -> FakeRun:
    """A script about a thing of some thickness (in), carried out by a hand that reads otherwise."""
    run = fake_run(script)
    run.cell.hand.thickness = lambda _: thickness * INCH
    right = run.cell.hand.read
    run.cell.hand.read = lambda: told(right())  # type: ignore[method-assign]
    return run.go()


# -- finger switches ------------------------------------------------------------------------------------


@pytest.mark.parametrize(
    ("stuck", "who"),
    [
        ((True, True), "the switches of both fingers are"),
        ((True, False), "the switch of the +y finger is"),
        ((False, True), "the switch of the -y finger is"),
    ],
)
def test_switches_that_are_closed_on_nothing_are_told_when_the_hand_opens(
    stuck: tuple[bool, bool], who: str
) -> None:
    run = gripping("OPEN 2.5", 0.0, lambda read: replace(read, touch=stuck))
    assert run.errors == [errors.SWITCH_WRONG]
    assert run.told == f"{ERRORS[errors.SWITCH_WRONG]} ({who} closed although the fingers are open)"


@pytest.mark.parametrize("word", ["CLOSE .1", "CENTER .1"])
def test_a_switch_that_closes_before_the_fingers_do_is_told_before_they_close(word: str) -> None:
    run = fake_run(f"OPEN 2.5\n{word}")
    run.executor.step()
    run.cell.hand.read = lambda: HandReading(  # type: ignore[method-assign]
        gap=run.cell.hand.gap, touch=(True, False)
    )
    run.go()
    assert run.errors == [errors.SWITCH_WRONG]
    assert run.cell.hand.gap > 2.5 * INCH


def test_a_finger_that_stands_against_something_comes_off_and_is_believed() -> None:
    run = fake_run("OPEN 1\nCLOSE .1")
    run.executor.step()
    run.cell.hand.thickness = lambda _: 1.0 * INCH
    assert run.go().errors == []


def test_fingers_that_hold_something_may_close_again() -> None:
    assert gripping("OPEN 2\nCENTER .1\nCLOSE .1", 1.0, lambda read: read).errors == []


def test_a_switch_that_stays_open_on_something_is_told() -> None:
    run = gripping("OPEN 2\nCLOSE .1", 1.0, lambda read: replace(read, touch=(read.touch[0], False)))
    assert run.errors == [errors.SWITCH_WRONG]
    assert "the switch of the -y finger is open although something 1.00 in thick" in run.told


@pytest.mark.parametrize(("thick", "beside"), [(1.0, False), (1.3, True)])
def test_a_finger_whose_switch_stays_open_may_stand_beside_something_where_the_gap_is_too_wide(
    thick: float, beside: bool
) -> None:
    run = fake_run("OPEN 2\nMOVE T\nCLOSE .1", held={"PIN": Held(positions=("T",), boxes=(), thickness=INCH)})
    run.cell.hand.thickness = lambda _: thick * INCH
    right = run.cell.hand.read
    run.cell.hand.read = lambda: replace(right(), touch=(right().touch[0], False))  # type: ignore[method-assign]
    assert run.go().errors == [errors.SWITCH_WRONG]
    assert ("beside their tips" in run.told) == beside
    assert "motor" not in run.told  # the other switch shows its force


def test_a_finger_that_the_hand_does_not_come_off_has_no_switch_of_its_own() -> None:
    run = gripping("OPEN 2\nCENTER .1", 1.0, lambda read: replace(read, touch=(read.touch[0], False)))
    assert run.errors == [errors.SWITCH_WRONG]
    assert (
        "the switch of the +y finger is still closed after the hand moved 0.06 in towards the side of this finger"
        in run.told
    )
    assert run.told.endswith("the two switches are swapped, or the switch of the other finger stays open)")


def test_a_switch_that_takes_far_too_much_force_is_told_when_the_fingers_press_lightly() -> None:
    run = fake_run("OPEN 2\nCENTER .1")
    hand = run.cell.hand
    hand.thickness = lambda _: 1.0 * INCH
    right = hand.read
    # closed while the fingers go on closing, and open when they only press with what is left
    hand.read = lambda: replace(right(), touch=(right().touch[0], hand.goal < hand.gap - 2e-4))  # type: ignore[method-assign]
    assert run.go().errors == [errors.SWITCH_WRONG]
    assert (
        "the switch of the -y finger is open although the fingers are pressed together with 10 oz: the "
        "switch has failed, or" in run.told
    )


def test_fingers_that_close_on_nothing_are_no_matter_of_the_switches() -> None:
    run = gripping("OPEN 2\nCLOSE .1", 0.0, lambda read: read)
    assert run.errors == [errors.NOTHING_HELD]


# -- the gap --------------------------------------------------------------------------------------------


def test_a_gap_that_stays_as_the_hand_opens_is_told() -> None:
    run = gripping("OPEN 3", 0.0, lambda read: replace(read, gap=1.0 * INCH))
    assert run.errors == [errors.GAP_WRONG]
    assert run.told.endswith("(the gap reads 1.00 in; the fingers were driven to 3.00 in)")


@pytest.mark.parametrize("word", ["CLOSE .1", "CENTER .1"])
def test_a_gap_that_stays_as_the_hand_closes_is_told(word: str) -> None:
    run = gripping(f"OPEN 2\n{word}", 1.0, lambda read: replace(read, gap=2.0 * INCH))
    assert run.errors == [errors.GAP_WRONG]
    assert "the gap still reads 2.00 in" in run.told


def test_a_gap_that_changes_faster_than_fingers_move_is_told() -> None:
    run = fake_run("OPEN 2\nOPEN 2.1")
    run.executor.step()
    right = run.cell.hand.read
    run.cell.hand.read = lambda: replace(right(), gap=1.15 * right().gap)  # type: ignore[method-assign]
    run.executor.run.drive.hold(1)  # a step of its own sees the one before and after
    run.cell.hand.read = lambda: replace(right(), gap=1.3 * right().gap)  # type: ignore[method-assign]
    assert run.go().errors == [errors.GAP_WRONG]


@pytest.mark.parametrize("touching", [True, False])  # a weak grip closes no switch
@pytest.mark.parametrize(
    ("to", "why"), [(0.8, "the held part has slipped"), (1.3, "the held part has been pushed")]
)
def test_a_gap_that_jumps_while_something_is_held_may_be_that_of_the_fingers(
    to: float, why: str, touching: bool
) -> None:
    run = fake_run("OPEN 2\nCLOSE .1\nMOVE T")
    run.cell.hand.thickness = lambda _: 1.0 * INCH
    run.executor.step()
    run.executor.step()
    right, clock = run.cell.hand.read, run.cell.clock
    begun = clock.now
    run.cell.hand.read = lambda: replace(  # type: ignore[method-assign]
        right(), gap=(to if clock.now > begun else 1.0) * INCH, touch=(touching, touching)
    )
    assert run.go().errors == [errors.GAP_WRONG]
    assert f"the gap reading jumped from 1.00 in to {to:.2f} in: {why}" in run.told


@pytest.mark.parametrize(("factor", "wrong"), [(0.85, True), (0.98, False), (1.05, False), (1.15, True)])
def test_a_gap_that_is_not_that_of_what_is_held_is_told(factor: float, wrong: bool) -> None:
    pin = Held(positions=("T",), boxes=(), thickness=1.0 * INCH)
    run = fake_run("OPEN 2\nMOVE T\nCLOSE .1", held={"PIN": pin})
    run.cell.hand.thickness = lambda _: factor * INCH  # as it is read
    assert run.go().errors == [errors.GAP_WRONG] * wrong
    if wrong:
        assert run.told.endswith(
            f"in, but the fingers hold PIN, which is 1.00 in thick; the reading is {factor:.2f} times the thickness)"
        )


def test_what_is_too_thick_is_another_object_until_it_reads_the_same_again() -> None:
    pin = Held(positions=("T",), boxes=(), thickness=1.0 * INCH)
    close = "OPEN 2\nCLOSE .1 1.1\nSKIPN 7\nWHERE\n"
    run = fake_run(f"MOVE T\n{close}MOVE T\n{close}", held={"PIN": pin})
    run.cell.hand.thickness = lambda _: 1.3 * INCH
    assert run.go().errors == [errors.WRONG_THICKNESS, errors.GAP_WRONG]


# -- force ----------------------------------------------------------------------------------------------


def pushed(run: FakeRun, force: tuple[float, float, float]) -> FakeRun:
    """A run in which the drives of the arm push the hand by a force that nobody asked for (N)."""
    run.cell.arm.push = np.array(force)
    return run


@pytest.mark.parametrize(
    ("force", "at"),
    [((0, 0, 20), "MOVE"), ((0, 0, -20), "MOVE"), ((-20, 0, 0), "MOVE"), ((0, 0, 15), "CHANGE")],
)
def test_a_force_felt_in_free_air_is_told_where_it_bends_the_arm_or_should_be_felt(
    force: tuple[float, float, float], at: str
) -> None:
    run = pushed(fake_run(f"MOVE T\n{DOWN}"), force).go()
    assert run.errors == [errors.FORCE_WRONG]
    assert run.steps[-1].startswith(at)


def test_a_hand_that_comes_to_stand_on_something_is_no_matter_of_the_force_sense() -> None:
    run = fake_run("CHANGE Z 2\nMOVE T")
    run.executor.step()
    run.cell.arm.walls = [Wall(point=(0.0, 0.0, 6.3 * INCH))]
    assert run.go().errors == [errors.SERVO_LAG]


def test_a_load_that_was_not_declared_is_felt_in_free_air() -> None:
    assert pushed(fake_run(f"MOVE T\n{DOWN}"), (0, 0, -20)).go().errors == [errors.FORCE_WRONG]
    assert pushed(fake_run(f"LOAD 72\nMOVE T\n{DOWN}"), (0, 0, -20)).go().errors == [errors.NO_FORCE]


def test_what_leans_on_the_hand_after_a_motion_that_met_it_is_no_matter_of_the_force_sense() -> None:
    run = pushed(fake_run(f"MOVE T\nCHANGE [0 0 -1] .2\n{DOWN}"), (0, 0, 15)).go()
    assert run.errors == [errors.NO_FORCE]


PRESS = "STOP [0 0 -50]\nCHANGE [0 0 -1] 1\nSKIPN 23\nWHERE"


def bearing(script: str) -> FakeRun:
    """A script carried out by an arm that knows its weight, while something bears 15 N of this weight."""
    run = pushed(fake_run(f"TRANS U [25 38 7 90 90 0]\n{script}"), (0, 0, 15))
    run.cell.hand.thickness = lambda _: 0.5 * INCH
    run.executor.run.drive.state.links = np.ones(6)
    return run.go()


@pytest.mark.slow
@pytest.mark.parametrize(
    "before",
    [
        PRESS,  # it meets nothing: a held pin is now in a hole
        "FREE [1 1 0]\nCHANGE [0 0 1] 1",
        "CHANGE [0 0 1] 1\nTURN T 5",
        "OPEN 2\nCHANGE [0 0 1] 1\nCLOSE .4",  # what is grasped stands on something
    ],
)
def test_what_may_bear_the_hand_when_a_motion_begins_is_not_taken_for_its_weight(before: str) -> None:
    run = bearing(f"{before}\nMOVE T")
    assert run.steps[-1] == "MOVE T"
    assert run.errors in ([], [errors.NO_FORCE])
    assert run.executor.state.drive.weights is None


@pytest.mark.slow
@pytest.mark.parametrize(
    "before", ["CHANGE [0 0 1] 1", f"{PRESS}\nMOVE U", "OPEN 2\nCLOSE .4\nCHANGE [0 0 1] 1\nCLOSE .4"]
)
def test_from_the_air_it_is_taken_for_a_weight_that_has_changed(before: str) -> None:
    run = bearing(f"{before}\nMOVE T")
    assert run.errors[-1] == errors.FORCE_WRONG
    assert "to the drives, the weights of the links seem to have changed" in run.told


@pytest.mark.slow
def test_a_force_on_the_hand_over_the_top_is_that_of_a_top_which_stands_askew() -> None:
    """The program's own lines, from the motion over the flange to the touch."""
    script = (plans() / "water_pump.al").read_text(encoding="utf-8")
    over = script[script.index("        MOVE    FLANGE") :]
    lines = over[: over.index("        STOP")].replace("FLANGE", "T").splitlines()
    tested = "\n".join(line for line in lines if "RESTORE" not in line)
    run = bearing(f'CHANGE [0 0 1] 1\n{tested}\nWAIT "FLAT"\nASKEW: WAIT "ASKEW"')
    assert (run.errors, run.told) == ([errors.FORCE_WRONG], "ASKEW")


# -- the joints -----------------------------------------------------------------------------------------


def test_a_tachometer_that_reads_nothing_is_told_with_its_joint() -> None:
    run = reading(fake_run("CHANGE X 6"), lambda read: replace(read, qd=only(read.qd, 0, 0.0))).go()
    assert run.errors == [errors.JOINT_SENSE_WRONG]
    assert "column has moved" in run.told
    assert run.told.endswith("0.0 degrees by its tachometer)")


@pytest.mark.parametrize(("sd", "found"), [(0.03, [errors.JOINT_SENSE_WRONG]), (0.0, [errors.NO_FORCE])])
def test_a_tachometer_that_scatters_is_told_before_its_force_is_felt(sd: float, found: list[int]) -> None:
    """The joints of the fake arm are shaken without any friction: the widest swing that a sound arm can have."""
    run, rng = fake_run(DOWN), np.random.default_rng(1)
    run.executor.run.drive.state.friction = np.array([2.0, 3.0, 6.0, 0.5, 0.5, 0.25])
    reading(run, lambda read: replace(read, qd=read.qd + rng.normal(0, sd) * np.eye(6)[0])).go()
    assert run.errors == found
    if sd:
        assert "the tachometer reading of the column scatters by" in run.told


def test_a_potentiometer_that_jumps_is_told_with_its_joint() -> None:
    run = fake_run("MOVE T")
    reading(run, lambda read: replace(read, q=only(read.q, 2, read.q[2] + 0.02 * (run.cell.clock.now > 1))))
    run.go()
    assert run.errors == [errors.JOINT_SENSE_WRONG]
    assert "boom has moved" in run.told


def test_a_potentiometer_that_jumps_while_the_force_takes_its_zero_ends_the_motion_at_once() -> None:
    run = fake_run(DOWN)
    drive, late = run.executor.run.drive, 0.1
    drive.state.friction = np.array([2.0, 3.0, 6.0, 0.5, 0.5, 0.25])
    reading(
        run,
        lambda read: replace(read, q=only(read.q, 2, read.q[2] * (0.1 if run.cell.clock.now > late else 1))),
    )
    run.go()
    (raised,) = run.all(ErrorRaised)
    assert raised.number == errors.JOINT_SENSE_WRONG
    assert raised.time < late + 2 * drive.period


def shifting(turn: float, closing: float) -> FakeRun:
    """The hand lifts an object an inch thick. After .3 s the roll reads so much more (rad), and the gap so much less
    (m), from one servo period to the next.
    """
    run = fake_run("OPEN 2\nCLOSE .5\nCHANGE [0 0 1] 1")
    run.cell.hand.thickness = lambda _: 1.0 * INCH
    run.executor.step()
    run.executor.step()
    late, right = run.cell.clock.now + 0.3, run.cell.hand.read
    reading(
        run, lambda read: replace(read, q=only(read.q, 5, read.q[5] + turn * (run.cell.clock.now > late)))
    )
    run.cell.hand.read = lambda: replace(  # type: ignore[method-assign]
        right(), gap=right().gap - closing * (run.cell.clock.now > late)
    )
    return run.go()


@pytest.mark.slow
def test_an_object_that_shifts_in_the_fingers_may_throw_the_hand() -> None:
    assert shifting(0.9 * DEGREE, 0.4e-3).errors == []


@pytest.mark.slow
@pytest.mark.parametrize(
    ("turn", "closing"),
    [
        (0.9, 0.0),  # the object did not shift
        (0.9, 0.1e-3),  # the noise of the gap at the high level
        (0.9, -0.4e-3),  # the fingers were pushed apart, so they did no work
        (3.0, 0.4e-3),  # they did not do enough work
    ],
)
def test_a_roll_that_jumps_further_than_a_shifting_object_can_throw_it_is_doubted(
    turn: float, closing: float
) -> None:
    run = shifting(turn * DEGREE, closing)
    assert run.errors == [errors.JOINT_SENSE_WRONG]
    assert f"hand roll has moved {turn} degrees by its potentiometer" in run.told


def resting(told: Callable[[float], float]) -> FakeRun:
    """An arm that has stood a minute under its brakes; by then its column read so much more (rad), by the time (s)."""
    run = fake_run("MOVE T")
    reading(
        run, lambda read: replace(read, q=only(read.q, 0, read.q[0] + told(min(run.cell.clock.now, 60.0))))
    )
    run.executor.run.drive.brake(60.0)
    return run.go()


def test_a_potentiometer_that_drifts_under_the_brakes_is_told_by_the_next_motion() -> None:
    run = resting(lambda seconds: 0.01 * DEGREE * seconds)
    assert run.errors == [errors.JOINT_SENSE_WRONG]
    assert "column has moved 0.6 degrees by its potentiometer" in run.told
    assert run.told.endswith("although its brake is set: a sensor fails, or the brake slips)")


def test_an_arm_that_creeps_under_its_brakes_is_believed() -> None:
    assert resting(lambda seconds: 0.004 * DEGREE * seconds).errors == []


# -- the motor's current --------------------------------------------------------------------------------


DRIVE = "MOVE T\nTOOL 190\nTORQUE 42\nCHANGE [0 0 -1] .2"


def test_a_motor_that_shows_no_current_while_it_runs_is_told() -> None:
    run = fake_run(DRIVE).go()
    assert run.errors == [errors.CURRENT_WRONG]
    assert run.told.startswith(ERRORS[errors.CURRENT_WRONG])


def test_a_tachometer_that_a_chattering_tool_shakes_is_no_matter_of_the_joint() -> None:
    run = fake_run(DRIVE)
    run.cell.screwdriver.load = 7 * OUNCE_INCH
    reading(run, lambda read: replace(read, qd=read.qd + 0.03 * (run.cell.screwdriver.speed > 0)))
    assert run.go().errors == [errors.NO_TORQUE]


def test_a_motor_that_starts_and_meets_nothing_lacks_its_torque() -> None:
    run = fake_run(DRIVE)
    run.cell.screwdriver.load = 7 * OUNCE_INCH
    assert run.go().errors == [errors.NO_TORQUE]


STARTS = [0.05] * 4 + [0.0] * 20
"""Torques (N m) of a motor that starts and meets nothing."""


@pytest.mark.parametrize(
    ("torques", "told"),
    [
        (
            [0.5 * each for each in STARTS] + [0.185] * 999,
            "the sensor shows 3.5 oz-in, but the torque of the motor is 7.1 oz-in",
        ),
        (
            [2 * each for each in STARTS] + [0.74] * 999,
            "the sensor shows 104.8 oz-in, but the torque of the motor is 52.4 oz-in; the reading is 2.0 times",
        ),
        ([0.05, 0.03, 0.0, 0.0] + [0.02] * 60 + [0.37] * 999, "so it turns too slowly"),
        (
            [0.05] * 6 + [0.0] * 999,
            "was still speeding up after 1.5 times the usual time, so it turns too fast",
        ),
    ],
)
def test_a_current_that_is_not_that_of_a_known_torque_is_told(torques: list[float], told: str) -> None:
    run = fake_run(DRIVE)
    driver, shown = run.cell.screwdriver, iter(torques)
    clock, last = run.cell.devices.clock, [0.0, -1.0]

    def torque() -> float:
        if driver.speed and clock.now > last[1]:
            last[:] = next(shown), clock.now
        return last[0] if driver.speed else 0.0

    driver.torque = torque  # type: ignore[method-assign]
    assert run.go().errors == [errors.CURRENT_WRONG]
    assert told in run.told


@pytest.mark.parametrize(
    ("shown", "stands", "error"),
    [
        (30.0, True, errors.CURRENT_WRONG),  # the current ends there
        (10.0, True, errors.NO_TORQUE),  # a bit may slip
        (30.0, False, errors.NO_TORQUE),  # a thread that is hard to turn: the hand gets on
    ],
)
def test_a_current_that_ends_below_the_torque_stop_is_told_of_a_motor_that_is_held_fast(
    shown: float, stands: bool, error: int, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr("handeye.execution.servo_loop.PRESS_TIME", 1.0)
    run = fake_run("MOVE T\nTOOL 190\nTORQUE 42\nFORCE [0 0 -22]\nCHANGE [0 0 -1] .5")
    run.cell.screwdriver.load = shown * OUNCE_INCH
    run.cell.arm.walls = [Wall(point=(0.0, 0.0, (5.8 if stands else 0) * INCH))]
    assert run.go().errors == [error]
    if error == errors.CURRENT_WRONG:
        assert "the sensor shows only 30.0 of the commanded 42.0 oz-in" in run.told


@pytest.mark.parametrize(("running", "told"), [(5.0, ""), (20.0, "the thread is hard to turn")])
def test_a_screw_that_takes_its_torque_long_before_its_head_is_down_is_told(
    running: float, told: str
) -> None:
    run = fake_run("MOVE T\nTOOL 190\nTORQUE 42\nFORCE [0 0 -22]\nCHANGE [0 0 -1] .5")
    driver, arm, begun = run.cell.screwdriver, run.cell.arm, list[float]()

    def torque() -> float:
        begun.append(arm.tcp[2])
        return (running if begun[0] - arm.tcp[2] < 0.3 * INCH else 45.0) * OUNCE_INCH if driver.speed else 0.0

    driver.torque = torque  # type: ignore[method-assign]
    assert run.go().errors == ([errors.CURRENT_WRONG] if told else [])
    assert not told or told in run.told


# -- the camera -----------------------------------------------------------------------------------------


def test_a_picture_that_is_an_earlier_one_is_told() -> None:
    picture = np.arange(ROWS * COLUMNS, dtype=np.uint8).reshape(ROWS, COLUMNS) % 16
    run = fake_run("LOOK A\nLOOK B")
    run.cell.camera.pictures = [picture, picture.copy()]
    assert run.go().errors == [errors.PICTURE_WRONG]
    assert run.told.endswith("(picture B is the same as A, pixel by pixel)")


@pytest.mark.parametrize(
    ("sigma", "told"), [(1.0, ""), (2.2, "(picture A has noise of 2.2 levels; allowed: 1.6)")]
)
def test_a_picture_with_far_more_noise_than_a_sound_camera_has_is_told(sigma: float, told: str) -> None:
    scene = np.where(np.arange(COLUMNS) % 40 < 20, 5.0, 10.0)
    noisy = np.random.default_rng(5).normal(scene, sigma, (ROWS, COLUMNS))
    run = fake_run("LOOK A")
    run.cell.camera.pictures = [np.clip(np.rint(noisy), 0, 15).astype(np.uint8)]
    assert run.go().errors == ([errors.PICTURE_WRONG] if told else [])
    assert not told or run.told.endswith(told)


def test_a_picture_of_one_intensity_is_told() -> None:
    run = fake_run("LOOK A")
    run.cell.camera.pictures = [np.full((ROWS, COLUMNS), 7, np.uint8)]
    assert run.go().errors == [errors.PICTURE_WRONG]
