"""Jobs on the pump: what they require, the fault that is planted, and the television camera."""

from collections.abc import Mapping

import numpy as np
import pytest
from msgspec.structs import replace

import handeye
from handeye.cell.camera import TURRET
from handeye.core.faults import Fault
from handeye.core.resources import plans
from handeye.core.variation import WorldSpec
from handeye.env import program_policy
from handeye.env.environment import AssemblyEnv
from handeye.env.evaluation import play
from handeye.env.jobs import PLANNED
from handeye.env.spaces import components
from handeye.env.television import NONE_YET, Television
from handeye.env.verdict import REWARDS, verdict
from handeye.ports.camera import DIGITISE, WIDE
from handeye.results.judging import findings_so_far
from handeye.runs.runner import Runner
from handeye.runs.setup import Setup
from handeye.runs.snapshot import Checkpoint
from handeye.runs.starts import planted
from handeye.tasks import task

PUMP_JOBS = [job for job in PLANNED if job.task == "water_pump"]


@pytest.fixture(scope="module")
def begun() -> Runner:
    """The pump's cell, in which a program that does not even need a camera begins."""
    plan = handeye.plan("OPEN 1\n").record
    return Runner(Checkpoint(setup=Setup(plan=plan, world=WorldSpec(seed=0), camera="ray")))


@pytest.mark.slow
def test_every_name_in_a_job_is_that_of_a_finding(begun: Runner) -> None:
    found = [*findings_so_far(begun)]
    for job in PUMP_JOBS:
        names = {*job.goal, *(name for group in job.steps.values() for name in group)}
        assert [name for name in names if not any(each.startswith(name) for each in found)] == []
        assert {*job.limits} <= {*found}
        required = [name for name in found if job.requires(name)]
        assert [name for name in required if name in ("hand", "pins", "rotor")] == (
            [] if job.goal else ["pins", "hand", "rotor"]
        )


@pytest.mark.slow
def test_a_pump_that_was_never_begun_is_a_false_done(begun: Runner) -> None:
    job = PUMP_JOBS[0]
    found = verdict(job, begun, done=True)
    assert (found.outcome, found.reward, found.reached) == ("false done", REWARDS["false done"], ())
    assert verdict(job, begun, done=False).outcome == "not done"
    assert verdict(job, begun, done=True, stopped="it broke").outcome == "stopped"


@pytest.mark.slow
def test_a_planted_fault_changes_nothing_before_its_stage(begun: Runner) -> None:
    begun = Runner(begun.checkpoint(begun.history[0]))
    begun.step()
    start = begun.checkpoint()
    fault = Fault(name="screw.4.loose", value=1.0, stage=1)
    runner = Runner(planted(start, fault))
    assert runner.setup.world.faults == (fault,)
    here, there = runner.cell.capture(), begun.cell.capture()
    assert np.array_equal(here.physics, there.physics)
    assert {name: here.mechanisms[name] for name in there.mechanisms} == there.mechanisms
    state = here.mechanisms["mishaps"]["mishaps"]
    runner.arm_cell.begin_stage(1)
    assert runner.cell.capture().mechanisms["mishaps"]["mishaps"] != state


def commanded(**values: float) -> Mapping[str, float]:
    env = AssemblyEnv("handeye/Pump-v0", pictures=True)
    return {part.name: 0.0 for part in env.components} | values


@pytest.mark.slow
def test_a_picture_arrives_when_camera_and_digitiser_are_ready(begun: Runner) -> None:
    drive, camera = begun.context.drive, begun.arm_cell.devices.camera
    assert camera is not None
    television = Television(drive, camera, begun.time + 0.2)
    television.command(commanded(look=1.0))
    periods = 0
    while television.seen()["picture_age"][0] == NONE_YET:
        drive.brake(drive.period)
        television.expose()
        periods += 1
    assert periods == round((0.2 + DIGITISE) * 60)
    assert television.seen()["picture"].max() > 0
    drive.brake(drive.period)
    assert television.seen()["picture_age"][0] == pytest.approx(1 / 60)
    television.command(commanded(set_aim=1.0, pan=0.3, tilt=-0.2))
    assert [*television.seen()["camera"]] == [0.3, -0.2]
    before = camera.state().lens  # type: ignore[attr-defined]
    television.command(commanded(set_lens=1.0))
    assert (before, camera.state().lens) == (0.05, WIDE)  # type: ignore[attr-defined]


LOOKING = """
        LENS    25
        AIM     PARK
        LOOK    NEAR
        OPEN    2
"""


@pytest.mark.slow
def test_a_program_takes_its_pictures_through_the_actions(
    begun: Runner, monkeypatch: pytest.MonkeyPatch
) -> None:
    plan = handeye.plan(LOOKING, taught=plans() / "water_pump.toml").record
    start = begun.checkpoint(begun.history[0])  # its camera is not calibrated
    start = replace(start, setup=replace(start.setup, plan=plan))
    env = AssemblyEnv("handeye/Pump-v0", action="torques", pictures=True, limit_s=60.0)
    monkeypatch.setattr(env, "_start", lambda _: start)
    monkeypatch.setattr(program_policy, "own_plan", lambda _: plan)
    found = play(env, program_policy.ProgramPolicy, 0)
    assert env._runner is not None
    camera = env._runner.arm_cell.devices.camera
    assert camera is not None
    assert found.referee["outcome"] == "false done"  # it came to its end, without a pump
    assert (camera.state().lens, camera.pots() != (0.0, 0.0)) == (WIDE, True)  # type: ignore[attr-defined]
    assert found.seconds > TURRET + DIGITISE


def test_commands_to_the_camera_are_there_only_with_pictures() -> None:
    with_, without = AssemblyEnv("handeye/Pump-v0", pictures=True), AssemblyEnv("handeye/Pump-v0")
    assert {"look", "pan"} <= {part.name for part in with_.components}
    assert without.components == components("hand", task("water_pump").arm, pictures=False)
    assert {*with_.observation_space} - {*without.observation_space} == {"camera", "picture", "picture_age"}  # type: ignore[misc]
