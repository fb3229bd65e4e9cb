"""Motors: pulse trains, what the rotor makes of them, origin and emergency, and the study of an axis."""

import json
import xml.etree.ElementTree as ElementTree
from collections.abc import Callable
from pathlib import Path

import numpy as np
import pytest
from sigma_bench import LoggedBus

from handeye.core.distributions import random_numbers
from handeye.ports.microbus import Status
from handeye.systems.sigma.motors.pulses import (
    CLOCK_HZ,
    CURVES,
    EMERGENCY,
    Train,
    constant,
    profile,
    stop,
    stopped,
)
from handeye.systems.sigma.motors.rotor import POLE, Drive, by_balance, by_sine
from handeye.systems.sigma.motors.study import study
from handeye.systems.sigma.protocol import (
    NUMBERS,
    SLOWEST,
    STEP_MM,
    STEPS_PER_TURN,
    limit_speed,
    move,
    move_slow,
    origin,
    position,
    signed,
)

Command = Callable[..., tuple[int, str, str]]
FULL = CURVES[1]  # up to 15 000 steps/s, as the paper has it
Z = Drive(mass=2.5)


def speeds(train: Train) -> np.ndarray:
    """Steps/s before each pulse."""
    return np.asarray(CLOCK_HZ / train.pulses.dividers)


def means(values: np.ndarray, count: int) -> np.ndarray:
    """Means over groups of values: the rounding of a divider is no change of speed."""
    return values[: len(values) // count * count].reshape(-1, count).mean(axis=1)


@pytest.mark.sigma_row(15)
def test_short_medium_and_long_moves_have_their_shapes() -> None:
    short, medium, long = (profile(steps, FULL) for steps in (8, 1000, 8000))
    assert {*speeds(short)} == {1000.0}
    assert np.flatnonzero(speeds(medium) == speeds(medium).max()).mean() == pytest.approx(500, abs=2)
    assert (speeds(medium) > 0.999 * medium.peak).sum() < 60
    flat = speeds(long) > 0.999 * long.peak
    assert long.peak == 15_000
    assert flat.sum() > 3900


@pytest.mark.sigma_row(15)
def test_a_flat_part_is_made_by_one_divider_so_that_15000_becomes_15038() -> None:
    dividers = profile(8000, FULL).pulses.dividers
    assert {*dividers[2100:5900]} == {133}
    assert pytest.approx(15_038, abs=1) == CLOCK_HZ / 133


@pytest.mark.sigma_row(16)
def test_no_train_is_faster_than_its_limit_and_each_has_its_steps() -> None:
    drawn = random_numbers(0, "limits")
    for _ in range(40):
        steps, limit = int(drawn.integers(1, 9_000)), int(drawn.integers(SLOWEST, 16_000))
        train = profile(steps, CURVES[int(drawn.integers(len(CURVES)))], limit)
        dividers = train.pulses.dividers
        assert len(dividers) == steps
        assert train.top <= limit
        assert dividers.min() >= CLOCK_HZ / train.top - 1  # a divider is a whole number


@pytest.mark.sigma_row(16)
def test_a_motor_that_is_limited_goes_no_faster() -> None:
    bus = LoggedBus()
    bus.send(limit_speed("X1", round(100 / STEP_MM)))
    bus.send(move("X1", 6000))
    begun = bus.now
    bus.settled("X1")
    seconds = (bus.now - begun) / 1e6
    assert bus.true_place("X1") == 10_000
    assert 6000 * STEP_MM / seconds == pytest.approx(98.7, abs=0.5)


@pytest.mark.sigma_row(17)
@pytest.mark.parametrize(
    ("steps", "top", "milliseconds"),
    [
        (8, 1000, 8.0),
        (9, 1226, 8.1),
        (267, 3994, 106.9),
        (1333, 8698, 274.9),
        (2667, 12262, 402.2),
        (4000, 15000, 500.0),
        (8000, 15000, 766.7),
    ],
)
def test_moves_take_the_times_of_the_table(steps: int, top: float, milliseconds: float) -> None:
    train = profile(steps, FULL)
    assert train.peak == pytest.approx(top, abs=1)
    assert 1000 * train.pulses.seconds == pytest.approx(milliseconds, abs=1)


@pytest.mark.sigma_row(17)
def test_on_the_bus_a_move_takes_the_time_of_its_train_by_its_own_clock() -> None:
    for fault, share in ((), 1.0), (("clock:X1:20",), 1.02):
        bus = LoggedBus(*fault)
        bus.send(move("X1", 2667, 1))
        begun = bus.now
        bus.settled("X1")
        assert (bus.now - begun) / 1000 == pytest.approx(402.2 * share, abs=1)


@pytest.mark.sigma_row(17)
def test_a_longer_move_takes_longer() -> None:
    ends = [profile(steps, CURVES[0]).pulses.end for steps in range(1, 7000, 37)]
    assert ends == sorted(ends)


@pytest.mark.sigma_row(18)
@pytest.mark.parametrize("curve", CURVES)
def test_the_speed_has_no_jump_over_start_stop_speed_and_its_slope_none_at_the_joints(curve: object) -> None:
    train = profile(30_000, curve)  # type: ignore[arg-type]
    paces = speeds(train)
    assert paces[0] <= train.start * 1.01
    assert np.abs(np.diff(paces)).max() <= 0.06 * train.start + 110  # one divider more at the top
    window = 0.01  # s
    times = np.arange(0, train.pulses.seconds, window)
    places = np.interp(times * CLOCK_HZ, train.pulses.ticks, np.arange(1, len(train.pulses) + 1))
    slopes = np.diff(places, 2) / window**2
    assert np.abs(slopes).max() < 1.6 * train.acceleration  # a raised cosine's is pi/2
    joint = round((train.peak - train.start) / train.acceleration / window)
    assert np.abs(slopes[joint - 2 : joint + 1]).max() < 0.25 * train.acceleration + 4_000  # rounded dividers
    assert np.abs(np.diff(slopes[1:-1])).max() < 0.35 * train.acceleration + 4_000


@pytest.mark.sigma_row(19)
def test_a_turn_is_15_mm() -> None:
    turn = STEPS_PER_TURN * STEP_MM  # mm
    assert (turn, STEP_MM) == (pytest.approx(15.0), 0.0375)
    bus = LoggedBus()
    bus.send(move("X1", STEPS_PER_TURN))
    bus.settled("X1")
    assert (bus.true_place("X1") - 4000) * STEP_MM == pytest.approx(15.0)
    followed = by_sine(profile(STEPS_PER_TURN, CURVES[0]).pulses, Z)
    assert followed.rotor[-1] * STEP_MM == pytest.approx(15.0, abs=0.005)


@pytest.mark.sigma_row(20)
@pytest.mark.parametrize("steps", [1, 8, 50, 3000])
def test_a_slow_move_has_one_speed_throughout(steps: int) -> None:
    train = constant(steps, 800.0, CURVES[0])
    assert {*train.pulses.dividers} == {2500}


@pytest.mark.sigma_row(20)
def test_a_slow_move_over_the_bus_goes_at_its_speed() -> None:
    bus = LoggedBus()
    bus.send(move_slow("Z1", 533, 10.0))
    begun = bus.now
    bus.settled("Z1")
    assert 533 * STEP_MM / (bus.now - begun) * 1e6 == pytest.approx(10.0, rel=0.001)


@pytest.mark.sigma_row(45)
def test_a_constant_speed_over_start_stop_speed_begins_with_a_ramp_and_loses_no_pole() -> None:
    ramped, jumped = (constant(4000, 8000.0, CURVES[0], ramped=way) for way in (True, False))
    assert (speeds(ramped)[0], speeds(jumped)[0]) == (pytest.approx(1000, abs=5), 8000.0)
    assert by_sine(ramped.pulses, Drive(mass=12.0)).kept
    assert not by_sine(jumped.pulses, Drive(mass=12.0)).kept


@pytest.mark.sigma_row(21)
def test_an_emergency_at_top_speed_takes_800_steps_on_the_steepest_curve() -> None:
    train = stop(15_000.0, FULL)
    assert (len(train.pulses), len(train.pulses) * STEP_MM) == (800, pytest.approx(30.0))
    assert train.pulses.seconds == pytest.approx(0.1, abs=0.001)
    slopes = np.diff(means(speeds(train), 50)) / np.diff(means(train.pulses.ticks / CLOCK_HZ, 50))
    assert slopes[:-2] == pytest.approx(-EMERGENCY, rel=0.02)


@pytest.mark.sigma_row(21)
def test_z_follows_the_steepest_stop_and_slips_if_its_pulses_are_cut_off() -> None:
    train = profile(8000, FULL)
    right, cut = (stopped(train, FULL, 800_000, cut=way) for way in (False, True))
    assert by_sine(right, Z).kept
    slipped = by_sine(cut, Z)
    assert not slipped.kept
    assert abs(slipped.rotor[-1] - len(cut)) > POLE


@pytest.mark.sigma_row(13)
@pytest.mark.parametrize("mass", [12.0, 8.0, 2.5])
def test_a_stop_from_50_mm_s_keeps_step_so_that_the_count_is_right_to_a_step(mass: float) -> None:
    pulses = stopped(constant(2000, 50.0 / STEP_MM, CURVES[0]), CURVES[0], 600_000)
    followed = by_sine(pulses, Drive(mass=mass, load=9.0))
    assert followed.kept
    assert abs(len(pulses) - followed.rotor[-1]) < 1


@pytest.mark.sigma_row(21)
def test_over_the_bus_the_end_of_the_rail_stops_a_motor_on_the_steepest_curve() -> None:
    bus = LoggedBus()
    bus.send(move("X1", 20_000, 1))
    bus.settled("X1")
    assert bus.status(NUMBERS["X1"]) is Status.RAIL
    assert bus.true_place("X1") == pytest.approx(16_000 + 800, abs=10)
    crash = signed(bus.ask(position("X1", at_abort=True), 2))
    assert crash + 4000 == 16_000


@pytest.mark.sigma_row(22)
@pytest.mark.parametrize("start", [-3, 0, 1, 500, 4000, 15_990])
def test_origin_finds_the_same_place_from_any_start(start: int) -> None:
    bus = LoggedBus()
    bus.machine.memory.starts[NUMBERS["X1"]] = start
    bus.motor(NUMBERS["X1"]).memory.low = start <= 0
    bus.touched(NUMBERS["X1"])
    for _ in range(2):
        bus.send(origin("X1"))
        bus.settled("X1")
        assert (bus.status(NUMBERS["X1"]), bus.true_place("X1")) == (Status.FREE, 1)
        assert signed(bus.ask(position("X1"), 2)) == 0


@pytest.mark.sigma_row(22)
def test_origin_goes_backward_until_the_switch_acts_and_forward_until_it_is_released() -> None:
    bus, places = LoggedBus(), []
    bus.send(origin("X1"))
    while bus.status(NUMBERS["X1"]) is Status.BUSY:
        bus.wait(bus.now + 5_000)
        places.append(bus.true_place("X1"))
    lowest = places.index(min(places))
    assert places[: lowest + 1] == sorted(places[: lowest + 1], reverse=True)
    assert places[lowest:] == sorted(places[lowest:])
    assert -40 < min(places) < -20
    assert not bus.interrupt


@pytest.mark.sigma_row(22)
def test_origin_without_a_switch_gives_up() -> None:
    bus = LoggedBus()
    del bus.machine.memory.starts[NUMBERS["X1"]]
    bus.send(origin("X1"))
    bus.settled("X1")
    assert (bus.status(NUMBERS["X1"]), bus.interrupt) == (Status.RAIL, True)


def _drawn(seed: int) -> tuple[Train, Drive]:
    """A move and what it moves, up to what can start at start/stop speed."""
    drawn = random_numbers(seed, "axis")
    load, weak = float(drawn.uniform(0, 40)), float(drawn.uniform(0.3, 1.1))
    drive = Drive(mass=float(drawn.uniform(2, 13)), load=load, top_force=20 * weak)
    return profile(int(drawn.integers(9, 9000)), CURVES[int(drawn.integers(0, 4))]), drive


@pytest.mark.slow
def test_balance_and_sine_agree_on_sixty_drawn_moves_and_nearly_on_the_poles_lost() -> None:
    pairs = []
    for seed in range(60):
        train, drive = _drawn(seed)
        pairs.append((by_balance(train.pulses, drive), by_sine(train.pulses, drive)))
    assert [balance.kept for balance, _ in pairs] == [sine.kept for _, sine in pairs]
    lost = [(balance.lost, sine.lost) for balance, sine in pairs if not sine.kept]
    assert len(lost) >= 5
    assert all(balance == pytest.approx(sine, abs=8) for balance, sine in lost)


def test_the_masses_of_supersigma_keep_step_and_a_rotor_that_is_asked_too_much_slips() -> None:
    for mass in (12.0, 8.0, 2.5):
        assert study(mass=mass, steps=8000).kept
    overloaded = study(mass=12.0, steps=8000, curve=1, load=30.0)
    assert (overloaded.kept, overloaded.margin < 1) == (False, True)


def test_a_rotor_under_half_of_its_pull_out_force_hangs_a_third_of_a_step_behind() -> None:
    pulses = profile(STEPS_PER_TURN, CURVES[0]).pulses
    followed = by_sine(pulses, Drive(mass=2.5, load=100.0))
    assert STEPS_PER_TURN - followed.rotor[-1] == pytest.approx(1 / 3, abs=0.01)


def test_an_emergency_of_x_at_top_speed_loses_steps() -> None:
    assert not study(mass=12.0, steps=8000, stop_after=0.4).kept
    assert study(mass=2.5, steps=8000, stop_after=0.4).kept


def test_the_study_is_a_command_with_a_drawing(command: Command) -> None:
    code, out, _ = command("sigma", "axis", "--mass", "8", "--out", "axis.svg")
    assert code == 0
    assert "8000 steps (300 mm), long: 803.7 ms, at most 13333.3 steps/s (500 mm/s)" in out
    assert "the rotor follows each pulse" in out
    root = ElementTree.fromstring(Path("axis.svg").read_text("utf-8"))  # noqa: S314 - our own
    assert len([element for element in root.iter() if element.tag.endswith("path")]) == 4


def test_a_study_that_loses_steps_has_exit_code_1(command: Command) -> None:
    code, out, _ = command("sigma", "axis", "--curve", "1", "--load", "30", "--json")
    found = json.loads(out)["figures"]
    assert (code, found["lost"] > 10, found["lost_by_balance"] > 10) == (1, True, True)


@pytest.mark.parametrize(
    ("words", "why"),
    [
        ("--mass 0", "a moved mass must be above 0 and at most 1000 kg, not 0"),
        ("--steps 0", "a move must have 1 to 65535 steps, not 0"),
        ("--curve 9", "there is no curve 9; the curves are 0 to 4"),
        ("--slow 900", "a constant speed must be between 1 and 562.5 mm/s, not 900"),
        ("--load nan", "a load must be 0 N or more"),
        (
            "--stop-after 5000",
            "the move takes 803.7 ms; the stop must be within that time, not after 5000 ms",
        ),
        ("--cut", "--cut applies only to an emergency stop: give --stop-after too"),
    ],
)
def test_a_study_of_nothing_is_refused_in_a_sentence(words: str, why: str, command: Command) -> None:
    code, _, err = command("sigma", "axis", *words.split())
    assert code == 2
    assert why in " ".join(err.split())
