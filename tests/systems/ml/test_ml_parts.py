"""The jobs that orient a bar and take parts out of a bin: their programs and referees."""

import json
import re
from collections.abc import Callable
from math import radians

import mujoco
import numpy as np
import pytest
from msgspec.structs import replace

from handeye.core.pose import rotation_x
from handeye.core.resources import plans
from handeye.core.variation import WorldSpec
from handeye.program.numbered import encode
from handeye.results.finishing import finished
from handeye.results.result import Result
from handeye.runs.advance import advance
from handeye.runs.host_seconds import Meter
from handeye.runs.runner import Runner
from handeye.runs.snapshot import Checkpoint
from handeye.systems.ml.bench.arm import RESOLVED
from handeye.systems.ml.bench.bars import DENSITY, LONG, WIDE, after, off_attitude, turned
from handeye.systems.ml.bin.hopper import BOXES, DEEP, HIGH
from handeye.systems.ml.bin.task import BIN, LIGHT, NARROW, Bin, Poured
from handeye.systems.ml.machine.spec import CYCLE, GRAM_FORCE, LINEAR
from handeye.systems.ml.orient.task import ASKED, ORIENT
from handeye.systems.ml.run.jobs import job_plan, job_setup
from handeye.systems.ml.typewriter.task import TYPEWRITER, Typewriter

Command = Callable[..., tuple[int, str, str]]
Y, Z = np.eye(3)[1:]
GAUGE_ERRORS = "strain.gain", "strain.drift", "strain.noise"


def begun(job: str, seed: int = 7, text: str = "", variant: str = "") -> Runner:
    plan = job_plan(job, variant)
    return Runner(Checkpoint(setup=job_setup(replace(plan, text=text or plan.text), WorldSpec(seed=seed))))


def done(runner: Runner) -> Result:
    return finished(runner, advance(runner), Meter(), judged=True)


def wrong_bar(runner: Runner, at: np.ndarray, quat: np.ndarray) -> list[str]:
    runner.cell.truth.data.joint("bar").qpos[:] = (*at, *quat)
    runner.cell.restore(runner.cell.capture())
    return [name for name, found in ORIENT.judge(runner.cell.truth).items() if not found.ok]


@pytest.mark.ml_row(48)
@pytest.mark.slow
def test_a_bar_in_an_unknown_attitude_is_turned_into_a_known_one(command: Command) -> None:
    """As trials count it: right is a program that says that it is done, and a referee that finds nothing wrong."""
    code, out, _ = command("trials", "orient", "--n", "2", "--seed", "1000", "--jobs", "1", "--json")
    told = json.loads(out)
    assert (code, told["n"], told["right"], told["silent_failures"]) == (0, 2, 2, 0)


def test_an_attitude_counts_for_either_end_and_any_side() -> None:
    assert off_attitude(rotation_x(radians(180)), Y, Z) == pytest.approx(0, abs=1e-6)
    assert off_attitude(rotation_x(radians(-4)), Y, Z) == pytest.approx(4)
    rolled = np.array([[0.0, 0, 1], [0, 1, 0], [-1, 0, 0]])  # a quarter turn about its length
    assert off_attitude(rolled, Y, Z) == pytest.approx(0, abs=1e-6)
    assert off_attitude(rolled @ rotation_x(radians(5)), Y, Z) == pytest.approx(5)


def test_the_referee_sees_a_bar_that_is_turned_shifted_or_not_held() -> None:
    runner = begun("orient")
    x, y, high = ASKED
    there = np.array([x * LINEAR, -y * LINEAR, high])
    level = turned("z", 0)
    assert wrong_bar(runner, there, level) == ["held"]
    assert wrong_bar(runner, there, turned("x", radians(2.9))) == ["held"]
    assert wrong_bar(runner, there, turned("x", radians(3.1))) == ["attitude", "held"]
    assert wrong_bar(runner, there, after(turned("y", radians(3.1)), level)) == ["attitude", "held"]
    assert wrong_bar(runner, there + np.array([0, 0.0011, 0]), level) == ["place", "held"]
    tips = runner.cell.truth.data.body("hand").xpos - [0, 0, 0.15]
    assert wrong_bar(runner, tips, level) == ["place"]  # the closed fingers touch it


@pytest.mark.slow
def test_an_empty_cradle_and_a_missing_stop_are_reported() -> None:
    runner = begun("orient")
    runner.cell.truth.data.joint("bar").qpos[:3] = (-0.2, 0.2, 0.007)
    runner.cell.restore(runner.cell.capture())
    result = done(runner)
    sentence = (
        "the hand holds no bar, holds a bar of another width, or does not hold the bar by its sides; or the "
        "fingers are weak"
    )
    assert (result.exit_code, result.message) == (1, f"{sentence} (done before: 0)")
    elsewhere = job_plan("orient").text.replace("86 MOVE 0 9000 -4500 -4000", "86 MOVE 0 9000 -4500 -2500")
    result = done(begun("orient", text=elsewhere))
    sentence = "the bar does not meet the stop, or the gauges do not feel the contact"
    assert (result.exit_code, result.message) == (1, f"{sentence} (done before: 0)")


@pytest.mark.ml_row(47)
@pytest.mark.slow
def test_three_parts_of_a_bin_are_taken_one_at_a_time_and_judged() -> None:
    result = done(begun("bin", 2, variant="3"))
    assert (result.exit_code, result.completed) == (0, True)
    assert all(check.ok for check in result.referee.values())
    assert {name: (result.figures or {})[name] for name in ("told_good", "told_bad")} == {
        "told_good": 2,
        "told_bad": 1,
    }


@pytest.mark.parametrize("task", [BIN, TYPEWRITER])
def test_a_pile_is_solved_with_dense_matrices(task: Bin | Typewriter) -> None:
    """MuJoCo 4.0.0 solves some piles wrongly with sparse ones, and throws a part out at 1000 rad/s."""
    assert not mujoco.mj_isSparse(task.recorded_scene(WorldSpec(seed=7), encode(job_plan(task.name))))


def numbers_of(text: str, *statements: str) -> list[int]:
    """The last number of each statement."""
    lines = dict(line.split(" ", 1) for line in text.splitlines() if line[:1].isdigit())
    return [int(lines[number].split()[-1]) for number in statements]


def felt(text: str, part: int, along: float) -> float:
    """Width (ML units) that the subroutine of `bin` feels when it closes the fingers on a part, and once more slowly;
    `along` is the place of the fingers on the bar (m from its middle).
    """
    first = (
        "10 PUT MT 11 9 4000",
        "20 MOVE 0 0 0 0 0 0 0 0 0 0 2756",
        "30 DELAY 90",
        "40 CALIB",
        "50 MOTOR 2 9684",
    )
    last = "60 BAL 8 730", "80 BAL 8 739", "90 PRINT 0 &1 0", "100 STOP"
    grip = [line for line in text.splitlines() if line[:1].isdigit() and 730 <= int(line.split()[0]) < 760]
    runner = begun("bin", 2, "\n".join((*first, *last, *grip)), variant="3")
    data = runner.cell.truth.data
    for number in (1, 2, 3):
        away = (0.25, 0.05 * number, 0.007)
        data.joint(f"part_{number}").qpos[:] = (*(away if number != part else (0, along, 0.009)), 1, 0, 0, 0)
    runner.cell.restore(runner.cell.capture())
    return (done(runner).figures or {})["told_good"]


def test_the_limits_of_width_and_weight_follow_from_the_errors_of_part_potentiometer_and_gauges() -> None:
    """The derivation that the program states, with the numbers of the worlds (mm, mm and rad)."""
    unit, arm = 25.4e-6, BIN.variation().quantities
    sigma = {name: arm[name].distribution.spread for name in ("parts.size", "slides.bend", "turns.bend")}
    bent = 3  # ML units, by 400 g
    off = 2 * (sigma["parts.size"] + sigma["slides.bend"] + 73 * sigma["turns.bend"]) * 1e-3 / unit + 2
    good, narrow = WIDE / unit - bent, (WIDE - NARROW) / unit - bent
    text = job_plan("bin").text
    most, least, lowest, highest = numbers_of(text, "435", "441", "437", "439")
    assert (most, least) == (pytest.approx(good + off, abs=1), pytest.approx(good - off, abs=1))
    assert (highest - 1, lowest) == (pytest.approx(narrow + off, abs=1), pytest.approx(narrow - off, abs=1))
    assert highest < least
    grams = DENSITY * WIDE**2 * LONG * 1000
    light, doubtful = numbers_of(text, "443", "445")
    assert (light + doubtful) / 2 == pytest.approx(grams * (1 + LIGHT) / 2, abs=0.5)
    for kind in (most, least, lowest, highest, light, doubtful):  # the typewriter has the same limits
        assert f" {kind}\n" in job_plan("typewriter").text


@pytest.mark.slow
def test_a_part_seems_as_wide_near_its_end_as_in_its_middle() -> None:
    text = job_plan("bin").text
    assert 537 <= felt(text, 1, along=0.023) <= 559  # 2 mm from the end of a good part
    assert 498 <= felt(text, 3, along=0.0) <= 520  # the middle of a narrow one


def test_the_fingers_hold_a_part_with_twice_the_force_that_it_needs() -> None:
    """The derivation that the program states, with the figures of the scene and of the worlds."""
    text, model = job_plan("bin").text, BIN.station(1, BIN.world(WorldSpec(seed=7))).bench.model
    slide, turn = model.geom("left_pad").friction[:2]
    arm = BIN.variation().quantities
    sigma = {name: arm[name].distribution.spread for name in ("parts.size", *GAUGE_ERRORS)}
    (rise,) = numbers_of(text, "400")
    servo, damping = 2 * np.pi * 50, 0.8  # rad/s and damping ratio, scenes/rectilinear_arm/README.md
    start = (
        np.exp(-damping * np.arccos(damping) / np.sqrt(1 - damping**2)) * servo * LINEAR / CYCLE
    )  # m/s2 a unit
    part = DENSITY * (WIDE + 2 * sigma["parts.size"] * 1e-3) ** 2 * LONG
    loads = part * np.array(
        [9.81 + start * rise, np.hypot(9.81, start * 79)]
    )  # N: lifted, carried at full speed
    corner = np.hypot(LONG / 2, WIDE / 2)
    forces = np.hypot(loads / 2 / slide, loads * corner / 2 / turn)
    finger, drive = model.joint("left_x").stiffness[0], model.actuator("separation").gainprm[0]
    left = 1 / (1 + finger / 2 / drive)  # share of the force that is left after a freeze
    gain, drift, noise = (2 * sigma[name] for name in GAUGE_ERRORS)
    hidden = (
        noise * (1 + 1 / np.sqrt(8)) + RESOLVED + drift / 6
    )  # N: the zero is the mean of 8 readings, 10 s ago
    (grams,) = numbers_of(text, "730")
    assert left == pytest.approx(2 / 3)
    factors = grams * GRAM_FORCE / (forces / left * (1 + gain) + hidden)
    assert factors == pytest.approx([2, 1.2], abs=0.02)
    assert "600" not in re.findall(r"LOAD 32 (\d+)", text)  # no other force


@pytest.mark.slow
@pytest.mark.parametrize(("usual", "least", "most"), [(False, 0.95, 1), (True, 0, 0.5)])
def test_a_part_that_is_held_aslant_does_not_creep_out_of_the_fingers(
    usual: bool, least: float, most: float
) -> None:
    """With the arm's usual contacts, the fingers lose over half of their force in a second, in which the part turns."""
    model = BIN.station(1, BIN.world(WorldSpec(seed=7))).bench.model
    model.opt.enableflags &= ~int(mujoco.mjtEnableBit.mjENBL_SLEEP)
    if usual:
        for name in ("left_bar", "left_pad", "right_bar", "right_pad"):
            model.geom(name).solimp[:] = model.geom("table").solimp
    model.body_gravcomp[model.body("part_1").id] = 1
    data = mujoco.MjData(model)
    mujoco.mj_kinematics(model, data)
    pads = (data.geom("left_pad").xpos + data.geom("right_pad").xpos) / 2
    data.joint("part_1").qpos[:] = (*pads, *turned("y", radians(10)))
    for finger in ("left", "right"):
        data.joint(f"{finger}_separation").qpos[0] = 0.008
    separation = data.actuator("separation")
    separation.ctrl[0] = 0.016
    while abs(data.sensor("left_x").data[0]) * 1e5 < 400 * GRAM_FORCE:
        separation.ctrl[0] -= 5e-6
        mujoco.mj_step(model, data)
    separation.ctrl[0] = data.ten_length[0]
    mujoco.mj_step(model, data, 50)
    before = data.sensor("left_x").data[0]
    mujoco.mj_step(model, data, 1000)
    assert least <= data.sensor("left_x").data[0] / before <= most


def test_no_part_that_slips_out_of_the_fingers_flies_over_the_wall() -> None:
    """The energy of the bent fingers lifts a light part less than the wall is high."""
    typewriter = (plans() / "typewriter.sym").read_text(encoding="utf-8")
    close = re.search(r"CLOSE: +LOAD LIMIT (\d+)\n.*\n +PUT MT 11 8 (\d+)\n", typewriter)
    assert close is not None
    closings = (numbers_of(job_plan("bin").text, "730", "732"), DEEP), ([*map(int, close.groups())], HIGH)
    for (grams, units), wall in closings:
        stiffness = 1 / (
            1 / 50_000 + 1 / 100_000
        )  # N/m: two gauges and the drive, scenes/rectilinear_arm/README.md
        force = grams * 9.81e-3 + units * 25.4e-6 * stiffness
        light = DENSITY * WIDE**2 * LONG * LIGHT
        assert force**2 / (2 * stiffness) / (light * 9.81) < wall - WIDE / 2


@pytest.mark.ml_row(47)
@pytest.mark.slow
def test_a_part_counts_only_when_it_has_left_the_hand() -> None:
    text = job_plan("bin").text
    assert "550 HAND 800" in text
    result = done(begun("bin", 2, text.replace("550 HAND 800", "550 DELAY 1"), variant="1"))
    assert result.message == "a part stays in the open hand (in the boxes: 0 good and 0 bad)"


@pytest.mark.ml_row(47)
def test_the_referee_of_the_bin_sees_a_wrong_part_passed_a_part_left_and_a_part_lost() -> None:
    station = BIN.hardware(job_plan("bin"), WorldSpec(seed=7), lambda _: None)
    poured = station.cell.truth.states["poured"]
    assert isinstance(poured, Poured)
    kinds = ["good" if quality == "good" else "bad" for quality in poured.qualities]
    assert {*kinds} == {"good", "bad"}

    def put(part: int, x: float) -> None:
        station.cell.truth.data.joint(f"part_{part + 1}").qpos[:] = (x, 0, 0.02 * part, 1, 0, 0, 0)

    def wrong() -> list[str]:
        station.cell.restore(station.cell.capture())
        return [name for name, found in BIN.judge(station.cell.truth).items() if not found.ok]

    for part, kind in enumerate(kinds):
        put(part, BOXES[kind] * LINEAR)
    station.hear(f"0 {kinds.count('good')} {kinds.count('bad')}")
    assert wrong() == []
    bad = kinds.index("bad")
    put(bad, BOXES["good"] * LINEAR)
    assert wrong() == ["passed", "told"]
    put(bad, 0.0)
    assert wrong() == ["left", "told"]
    put(bad, 0.35)
    assert wrong() == ["lost", "told"]
    put(bad, BOXES["bad"] * LINEAR)
    put(kinds.index("good"), BOXES["bad"] * LINEAR)
    assert wrong() == ["rejected", "told"]


@pytest.mark.slow
def test_a_bin_holds_one_to_twelve_parts(command: Command) -> None:
    for parts in ("0", "13"):
        code, _, said = command("ml", "bin", "--parts", parts, "--no-keep")
        assert (code, said.count("the bin holds 1 to 12 parts")) == (2, 1)
