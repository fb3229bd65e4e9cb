"""The jobs that orient a bar and take parts out of a bin: their programs and referees."""

import json
from collections.abc import Callable
from math import radians

import mujoco
import numpy as np
import pytest
from msgspec.structs import replace

from handeye.core.pose import rotation_x
from handeye.core.variation import WorldSpec
from handeye.results.finishing import finished
from handeye.results.result import Result
from handeye.runs.advance import advance
from handeye.runs.host_seconds import Meter
from handeye.runs.runner import Runner
from handeye.runs.snapshot import Checkpoint
from handeye.systems.ml.bench.bars import after, off_attitude, turned
from handeye.systems.ml.bin.hopper import BOXES
from handeye.systems.ml.bin.task import BIN, Poured
from handeye.systems.ml.machine.spec import LINEAR
from handeye.systems.ml.orient.task import ASKED, ORIENT
from handeye.systems.ml.run.jobs import job_plan, job_setup

Command = Callable[..., tuple[int, str, str]]
Y, Z = np.eye(3)[1:]


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
@pytest.mark.parametrize("seed", [1000, 1001])
def test_a_bar_in_an_unknown_attitude_is_turned_into_a_known_one(seed: int) -> None:
    result = done(begun("orient", seed))
    assert (result.exit_code, result.completed) == (0, True)
    assert all(check.ok for check in result.referee.values())


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
    sentence = "the hand does not hold a bar of the right width by its sides, or the fingers are weak"
    assert (result.exit_code, result.message) == (1, f"{sentence} (done before: 0)")
    elsewhere = job_plan("orient").text.replace("86 MOVE 0 9000 -4500 -4000", "86 MOVE 0 9000 -4500 -2500")
    result = done(begun("orient", text=elsewhere))
    sentence = "the bar does not meet the stop, or the gauges do not feel the contact"
    assert (result.exit_code, result.message) == (1, f"{sentence} (done before: 0)")


@pytest.mark.slow
def test_trials_are_counted(command: Command) -> None:
    code, out, _ = command("trials", "orient", "--n", "1", "--seed", "7", "--jobs", "1", "--json")
    assert (code, json.loads(out)["right"]) == (0, 1)


@pytest.mark.slow
def test_three_parts_of_a_bin_are_taken_one_at_a_time_and_judged() -> None:
    result = done(begun("bin", 2, variant="3"))
    assert (result.exit_code, result.completed) == (0, True)
    assert all(check.ok for check in result.referee.values())
    assert {name: (result.figures or {})[name] for name in ("told_good", "told_bad")} == {
        "told_good": 2,
        "told_bad": 1,
    }


def test_the_pile_is_solved_with_dense_matrices() -> None:
    """MuJoCo 4.0.0 solves some piles wrongly with sparse ones, and throws a part out at 1000 rad/s."""
    assert not mujoco.mj_isSparse(BIN.scene(WorldSpec(seed=7)))


@pytest.mark.slow
def test_a_part_counts_only_when_it_has_left_the_hand() -> None:
    text = job_plan("bin").text
    assert "550 HAND 1200" in text
    result = done(begun("bin", 2, text.replace("550 HAND 1200", "550 DELAY 1"), variant="1"))
    assert result.message == "a part stays in the open hand (in the boxes: 0 good and 0 bad)"


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
        assert (code, said.count("the bin takes from 1 to 12 parts")) == (2, 1)
