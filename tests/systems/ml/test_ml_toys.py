"""The toy blocks and the toy train: their programs in worlds drawn from seeds, and their referees."""

import json
from collections.abc import Callable

import numpy as np
import pytest
from msgspec.structs import replace

from handeye.core.variation import WorldSpec
from handeye.results.finishing import finished
from handeye.results.result import Result
from handeye.runs.advance import advance
from handeye.runs.host_seconds import Meter
from handeye.runs.runner import Runner
from handeye.runs.snapshot import Checkpoint
from handeye.systems.ml.blocks.task import BLOCKS, SIDE, STACK
from handeye.systems.ml.machine.spec import LINEAR
from handeye.systems.ml.run.jobs import job_plan, job_setup
from handeye.systems.ml.train.task import PULLED, TRAIN
from handeye.systems.ml.train.vehicles import REACH

Command = Callable[..., tuple[int, str, str]]


def begun(job: str, seed: int = 7, text: str = "") -> Runner:
    plan = job_plan(job)
    if text:
        plan = replace(plan, text=text)
    return Runner(Checkpoint(setup=job_setup(plan, WorldSpec(seed=seed))))


def done(runner: Runner) -> Result:
    return finished(runner, advance(runner), Meter(), judged=True)


def put(runner: Runner, name: str, x: float, y: float, z: float) -> None:
    """Put a body somewhere without turning it, x and y of the slides (m)."""
    runner.cell.truth.data.joint(name).qpos[:] = (x, -y, z, 1, 0, 0, 0)


def wrong(runner: Runner) -> list[str]:
    runner.cell.restore(runner.cell.capture())
    task = {"blocks": BLOCKS, "train": TRAIN}[runner.setup.task]
    return [name for name, found in task.judge(runner.cell.truth).items() if not found.ok]


@pytest.mark.ml_row(46)
@pytest.mark.slow
@pytest.mark.parametrize("job", ["blocks", "train"])
def test_blocks_are_stacked_and_a_train_is_coupled_and_pulled(job: str, command: Command) -> None:
    """As trials count it: right is a program that says that it is done, and a referee that finds nothing wrong."""
    code, out, _ = command("trials", job, "--n", "1", "--seed", "7", "--jobs", "1", "--json")
    told = json.loads(out)
    assert (code, told["n"], told["right"], told["silent_failures"]) == (0, 1, 1, 0)


def test_the_referee_of_the_blocks_sees_a_shifted_a_missing_and_a_leaning_block() -> None:
    runner = begun("blocks")
    places = [(STACK[0] * LINEAR, STACK[1] * LINEAR, SIDE * (n + 0.5)) for n in range(3)]
    assert wrong(runner) == ["stacked", "heights", "placed"]  # they lie as they were laid
    halves = [float(runner.cell.truth.model.geom(f"block_{n}").size[2]) for n in (1, 2, 3)]
    heights = [halves[0], 2 * halves[0] + halves[1], 2 * halves[0] + 2 * halves[1] + halves[2]]
    for number, ((x, y, _), z) in enumerate(zip(places, heights, strict=True), 1):
        put(runner, f"block_{number}", x, y, z)
    assert wrong(runner) == []
    put(runner, "block_3", places[0][0] + 0.0021, places[0][1], heights[2])
    assert wrong(runner) == ["stacked"]
    runner.cell.truth.data.joint("block_3").qpos[:] = (
        *places[0][:2],
        heights[2],
        np.cos(0.02),
        np.sin(0.02),
        0,
        0,
    )
    assert "flat" in wrong(runner)


def test_the_referee_of_the_train_sees_a_peg_beside_its_hole_and_an_engine_that_stands() -> None:
    runner = begun("train")
    ahead = -3500 * LINEAR - PULLED
    for number, name in enumerate(("engine", "wagon_1", "wagon_2")):
        put(runner, name, 0.0, ahead + 2 * REACH * number, 0.0)
    assert wrong(runner) == []
    put(runner, "wagon_2", 0.0007, ahead + 4 * REACH, 0.0)
    assert wrong(runner) == ["coupled"]
    put(runner, "wagon_2", 0.0, ahead + 4 * REACH, 0.006)
    assert wrong(runner) == ["seated"]
    for number, name in enumerate(("engine", "wagon_1", "wagon_2")):
        put(runner, name, 0.0, ahead + PULLED + 2 * REACH * number, 0.0)
    assert wrong(runner) == ["pulled"]


@pytest.mark.slow
def test_a_hand_that_holds_nothing_and_a_hand_that_meets_something_are_reported() -> None:
    runner = begun("blocks")
    put(runner, "block_1", -0.2, 0.2, SIDE / 2)
    result = done(runner)
    assert (result.exit_code, result.message) == (
        1,
        "the hand holds no block or a block of the wrong size, or the fingers are weak (done before: 0)",
    )
    runner = begun("blocks")
    put(runner, "block_1", -4000 * LINEAR + 0.03, 2000 * LINEAR, SIDE / 2)
    result = done(runner)
    assert (result.exit_code, result.message) == (
        1,
        "the hand has met something on its way down (done before: 0)",
    )


@pytest.mark.slow
def test_a_peg_without_a_hole_is_reported() -> None:
    text = job_plan("train").text.replace("34 LOAD 3 -193", "34 LOAD 3 -450")
    result = done(begun("train", text=text))
    assert (result.exit_code, result.message) == (1, "the peg does not go into its hole (done before: 0)")
