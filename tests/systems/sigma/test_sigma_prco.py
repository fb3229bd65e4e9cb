"""The plate of the pump: worlds, the program in physics, its referee, planted mistakes, commands."""

import json
from collections.abc import Callable
from pathlib import Path
from typing import Final

import numpy as np
import pytest
from mal_bench import mal
from msgspec.structs import replace

from handeye.cell.threads import Threads
from handeye.core.errors import BadArgument, BadFile
from handeye.core.pose import pose
from handeye.core.variation import WorldSpec
from handeye.judge.finding import Findings
from handeye.program.numbered import encode
from handeye.results.finishing import finished
from handeye.results.result import Result
from handeye.runs.advance import advance
from handeye.runs.host_seconds import Meter
from handeye.runs.runner import Runner
from handeye.runs.snapshot import Checkpoint
from handeye.systems.sigma.gantries.witness import HEARD
from handeye.systems.sigma.gantries.world import GantryWorld
from handeye.systems.sigma.prco.drawing import BASE, MOST, NEST, PIN_DEPTH, PLATE, drawn
from handeye.systems.sigma.prco.driver import DriverState, HandDriver
from handeye.systems.sigma.prco.task import PRCO
from handeye.systems.sigma.prco.witness import PumpWitness
from handeye.systems.sigma.protocol import NUMBERS
from handeye.systems.sigma.run.jobs import job_plan, job_setup
from handeye.systems.sigma.run.plan import decode
from handeye.tasks.stanford_cell.screws import LENGTH

Command = Callable[..., tuple[int, str, str]]
WORLD: Final = WorldSpec(seed=11)
TEXT: Final = mal("prco")
ONE: Final = TEXT.replace("ALLSCREWS = 6", "ALLSCREWS = 1")


def begun(text: str, screws: int = 1, world: WorldSpec = WORLD) -> Runner:
    """The parts of a world before the first statement."""
    return Runner(Checkpoint(setup=job_setup(replace(job_plan("prco", screws), text=text), world)))


def ended(runner: Runner) -> Result:
    return finished(runner, advance(runner), Meter(), judged=True)


def wrong(findings: Findings) -> list[str]:
    return [name for name, found in findings.items() if not found.ok]


def test_parts_are_drawn_near_their_places_and_a_plan_keeps_their_job() -> None:
    for seed in range(20):
        pump = drawn(GantryWorld(WorldSpec(seed=seed)), MOST)
        assert (pump.screws, len(pump.phases)) == (MOST, MOST)
        assert max(abs(pump.nest.x - NEST.x), abs(pump.nest.y - NEST.y)) <= 0.5
    assert drawn(GantryWorld(), 1).nest == NEST
    with pytest.raises(BadArgument, match="the plate of the pump must have 1 to 6 screws, not 7"):
        drawn(GantryWorld(), 7)
    plan = job_plan("prco", 2)
    assert (decode(encode(plan), "kept"), plan.task) == (plan, "prco")


@pytest.mark.sigma_row(52)
@pytest.mark.slow
def test_two_arms_lay_the_plate_put_in_both_pins_and_drive_a_screw() -> None:
    runner = begun(ONE)
    result = ended(runner)
    assert (result.exit_code, wrong(PRCO.judge(runner.cell.truth))) == (0, [])
    assert result.referee["screws_clamp"].value > 100
    assert result.figures is not None


@pytest.mark.sigma_row(40)
@pytest.mark.slow
def test_a_kept_run_goes_on_to_the_same_events_while_the_screwdriver_turns() -> None:
    """Without plate and pins, the screw is too deep for its seat, and the program says so."""
    lines = [line for line in ONE.splitlines() if not 105 <= int(line.split()[0]) <= 300]
    text = "\n".join(lines)
    whole = begun(text)
    while whole.cell.truth.states["screwdriver"] == DriverState():
        advance(whole, steps=20)
    second = Runner(whole.checkpoint())
    result = ended(whole)
    assert result.exit_code == 1
    assert "SCREW         1             IS NOT AT ITS SEAT" in _heard(whole).heard.lines
    assert ended(second).figures == result.figures
    assert second.events == whole.events


def _heard(runner: Runner) -> PumpWitness:
    witness = next(part for part in runner.cell.truth.mechanisms if part.name == HEARD)
    assert isinstance(witness, PumpWitness)
    return witness


def test_the_referee_sees_each_part_that_is_wrong_and_a_wrong_count() -> None:
    runner = begun(ONE)
    witness, data = _heard(runner), runner.cell.truth.data
    (threads,) = (part for part in runner.cell.truth.mechanisms if isinstance(part, Threads))
    pump = drawn(GantryWorld(WORLD), 1)

    def found() -> list[str]:
        runner.cell.restore(runner.cell.capture())
        return wrong(PRCO.judge(runner.cell.truth))

    assert found() == ["plate", "pins", "screws", "screws_depth", "screws_clamp"]
    base = data.joint("base").qpos
    place = np.array(base[:3])
    data.joint("plate").qpos[:3] = place + np.array((0, 0, BASE[2])) / 1000
    for number, at in enumerate(pump.base_pins, 1):
        deep = np.array((at.x, at.y, BASE[2] - PIN_DEPTH)) / 1000
        data.joint(f"pin_{number}").qpos[:3] = place + deep
    assert found() == ["screws", "screws_depth", "screws_clamp", "counted"]
    hole = pump.base_taps[0]
    seat = place + np.array((hole.x, hole.y, BASE[2] + PLATE[2] - LENGTH - 0.15)) / 1000
    threads.take(0, 0, pose(np.eye(3), seat))
    witness.hear("PINS          2             SCREWS        1             SECONDS       8.5")
    assert found() == []
    witness.hear("PINS          2             SCREWS        2             SECONDS       8.5")
    assert found() == ["counted"]
    witness.hear("PINS          2             SCREWS        1             SECONDS       8.5")
    for raised, refused in (
        (0.0002, ["screws_clamp", "counted"]),
        (0.0005, ["screws_depth", "screws_clamp", "counted"]),
    ):
        data.joint("thread_slide0").qpos[0] += raised
        assert found() == refused
        data.joint("thread_slide0").qpos[0] -= raised
    data.joint("pin_1").qpos[2] += 0.001
    assert found() == ["pins", "counted"]
    with pytest.raises(BadFile, match="touched"):
        witness.check(replace(witness.state(), touched_ms=-1))


def test_the_screwdriver_follows_its_device_and_no_other() -> None:
    driver = HandDriver()
    speeds = []
    for hand, value in (("HAND1", 1), ("HAND2", 1), ("HAND2", 2), ("HAND2", 7), ("HAND2", 0)):
        driver.actuated(NUMBERS[hand], (0, value, 0, 0))
        speeds.append(driver.speed)
    assert speeds == [0.0, 20.0, -20.0, 0.0, 0.0]
    with pytest.raises(BadFile, match="screwdriver"):
        driver.check(DriverState(value=-1))


def test_the_result_of_a_users_own_program_has_the_fields_of_an_assembly(
    command: Command, tmp_path: Path
) -> None:
    file = tmp_path / "own.mal"
    file.write_text('10 PRINT "PINS", 0, "SCREWS", 0\n', encoding="utf-8")
    code, out, _ = command("sigma", "prco", str(file), "--seed", "11", "--no-keep", "--json")
    found = json.loads(out)
    assert (code, found["completed"], found["task"], found["seed"]) == (3, True, "prco", 11)
    refused = [name for name, each in found["referee"].items() if not each["ok"]]
    assert refused == ["plate", "pins", "screws", "screws_depth", "screws_clamp"]
    assert found["figures"]["simulated_s"] >= 0


@pytest.mark.parametrize("words", ["nowhere.mal", "--video a.gif", "--out a --no-keep"])
def test_an_assembly_that_cannot_be_is_refused_in_a_sentence(words: str, command: Command) -> None:
    code, _, err = command("sigma", "prco", *words.split())
    assert (code, "Traceback" in err) == (2, False)
