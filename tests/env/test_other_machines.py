"""Environments of other machines than the arm of the pump: their ports, commands and periods, under the same rules."""

import subprocess
import sys
from typing import Any

import numpy as np
import pytest
from gymnasium.utils.env_checker import check_env, data_equivalence

from handeye.core.errors import InvalidInput
from handeye.core.pose import Array
from handeye.core.variation import WorldSpec
from handeye.env.environment import AssemblyEnv
from handeye.env.evaluation import play
from handeye.env.policies import check_policy, policy_maker
from handeye.env.spaces import encoded
from handeye.runs.runner import Runner
from handeye.runs.starts import StartStates

BLOCKS, CHESS = "handeye/Blocks-v0", "handeye/Chess-v0"
BOTH = pytest.mark.parametrize("name", [BLOCKS, CHESS])


def action(env: AssemblyEnv, **values: float) -> Array:
    """The action with these values, in their units; a dot in a name is written as two underscores."""
    return encoded(env.components, {name.replace("__", "."): value for name, value in values.items()})


def until_free(env: AssemblyEnv, **values: float) -> Any:
    """Repeat an action until no axis of the gantry is busy, and return the last observation."""
    for _ in range(500):
        seen = env.step(action(env, **values))[0]
        if 1 not in seen["status"]:
            return seen
    pytest.fail("an axis is busy for 10 s")


@pytest.mark.slow
@BOTH
def test_gymnasiums_own_checker_finds_nothing(name: str, monkeypatch: pytest.MonkeyPatch) -> None:
    env = AssemblyEnv(name)
    start = env._start(env._spec(7, {}))
    monkeypatch.setattr(env, "_start", lambda _: start)  # in each new world, teaching takes 2.5 s
    check_env(env, skip_render_check=True)


ELSEWHERE = """
import sys
import numpy as np
import handeye.env
from handeye.env.environment import AssemblyEnv
print([module for module in sys.modules if module.startswith("handeye.systems.sigma.")])
for name in sys.argv[1:]:
    env = AssemblyEnv(name)
    seen = [env.reset(seed=7)[0], *(env.step(np.full(env.action_space.shape, 0.25))[0] for _ in range(3))]
    print([{part: value.tolist() for part, value in each.items()} for each in seen])
"""


@pytest.mark.slow
def test_a_seed_gives_the_same_episode_to_the_bit_twice_and_in_another_process() -> None:
    systems, *said = subprocess.run(
        [sys.executable, "-c", ELSEWHERE, BLOCKS, CHESS], capture_output=True, text=True, check=True
    ).stdout.splitlines()
    assert systems == "[]"  # the environments of a system are named without loading it
    for name, there in zip((BLOCKS, CHESS), said, strict=True):
        env = AssemblyEnv(name)
        acted = np.full(len(env.components), 0.25)
        one, two = ([env.reset(seed=7)[0], *(env.step(acted)[0] for _ in range(3))] for _ in range(2))
        assert all(data_equivalence(a, b, exact=True) for a, b in zip(one, two, strict=True))
        assert there == str([{part: value.tolist() for part, value in each.items()} for each in one])


@pytest.mark.slow
@BOTH
def test_done_ends_an_episode_that_the_referee_judges_and_a_lie_costs_one(name: str) -> None:
    env = AssemblyEnv(name)
    first, _ = env.reset(seed=7)
    seen, *rest = env.step(action(env))
    assert rest == [0.0, False, False, {}]
    assert seen["clock"][0] - first["clock"][0] == pytest.approx(env.facts().period, abs=1e-9)
    _, reward, terminated, truncated, info = env.step(action(env, done=1.0))
    assert (reward, terminated, truncated) == (-1.0, True, False)
    assert (info["referee"]["outcome"], info["referee"]["reached"]) == ("false done", [])
    short = AssemblyEnv(name, limit_s=0.06)
    short.reset(seed=7)
    ended = [short.step(action(short))[1:4] for _ in range(round(0.06 / env.facts().period))]
    assert {*ended[:-1]} == {(0.0, False, False)}
    assert ended[-1] == (0.0, False, True)


@pytest.mark.parametrize(
    ("wrong", "told"),
    [
        (
            {"job": BLOCKS, "action": "torques"},
            "handeye/Blocks-v0 has no action 'torques'; its only action is hand",
        ),
        ({"job": CHESS, "pictures": True}, "handeye/Chess-v0 has no television camera"),
        ({"job": CHESS, "shaped": True}, "handeye/Chess-v0 has no shaped reward"),
        ({"job": BLOCKS, "world": {"set": {"block.turm": 0}}}, "did you mean `block.turn`"),
        ({"job": CHESS, "world": {"faults": ["hand.weak"]}}, "hand.weak"),
        ({"job": "handeye/Ches-v0"}, "did you mean `handeye/Chess-v0`?"),
    ],
)
def test_wrong_arguments_are_refused_in_a_sentence(wrong: dict[str, Any], told: str) -> None:
    with pytest.raises(InvalidInput) as refused:
        AssemblyEnv(**wrong)
    assert told in str(refused.value)


def test_each_has_the_program_of_its_own_job_as_a_policy() -> None:
    for name in (BLOCKS, CHESS):
        check_policy("program", policy_maker("program", name), name, "hand")
        with pytest.raises(InvalidInput, match="is made for handeye/Pin-v0, not for"):
            check_policy("scripted", policy_maker("scripted", name), name, "torques")
    with pytest.raises(InvalidInput, match=f"not for {CHESS}"):
        check_policy("program", policy_maker("program", "handeye/Pin-v0"), CHESS, "torques")


# -- blocks ---------------------------------------------------------------------------------------------------------


@pytest.mark.slow
def test_set_points_of_the_axes_move_the_arm_at_its_greatest_speed_and_stay_in_its_travel() -> None:
    env = AssemblyEnv(BLOCKS)
    first, info = env.reset(seed=7)
    assert {*first} == {"q", "gap", "goal", "force", "clock"}
    assert info["places"].shape == (5, 2)
    assert {"STACK", "PALLET", "DONE"} <= {*info["taught"]}
    fastest = np.array([1.0, 0.0, 0.0, 0.0, 0.0, 0.5, -1.0, 0.0])  # x, yaw, and the hand
    for _ in range(50):
        seen = env.step(fastest)[0]
    moved = seen["q"] - first["q"]
    assert (seen["goal"] - first["goal"])[[0, 5]] == pytest.approx((0.1, 0.25))  # .2 m/s, half of 1 rad/s
    assert moved[[0, 5]] == pytest.approx((0.1, 0.25), abs=0.02)  # the servos lag by .02 s
    assert (seen["goal"][-1], seen["gap"][0]) == (-0.02, pytest.approx(0.0, abs=0.002))
    for _ in range(130):
        seen = env.step(fastest)[0]
    assert seen["goal"][0] == 0.2


@pytest.mark.slow
def test_the_taught_program_acts_through_the_actions_as_it_acts_on_the_ports(
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    start = StartStates("palletise", "ray").before(0, WorldSpec(seed=7))
    assert start is not None
    runner, here, there = Runner(start), list[Array](), list[Array]()
    job = runner.system.job  # type: ignore[attr-defined]
    job.bench.after_period.append(lambda: here.append(job.axes.read().q))
    while runner.next is not None and runner.time < 3.5:  # to the stack, and close the hand
        runner.step()
    env = AssemblyEnv(BLOCKS, limit_s=runner.time)
    step = env.step

    def watched(action: Array) -> Any:
        seen, *rest = step(action)
        there.append(np.append(seen["q"], seen["gap"]))
        return seen, *rest

    monkeypatch.setattr(env, "step", watched)
    found = play(env, policy_maker("program", BLOCKS), 7)
    assert (found.referee["outcome"], found.seconds) == ("not done", round(runner.time, 6))
    assert len(here) == len(there) == found.steps
    assert np.array(there) == pytest.approx(np.array(here), abs=1e-6)
    assert abs(there[-1][:6] - env.facts().taught["STACK"]).max() < 2e-3  # type: ignore[attr-defined]


@pytest.mark.slow
def test_a_world_in_which_the_program_cannot_be_taught_has_no_start() -> None:
    env = AssemblyEnv(BLOCKS, world={"set": {"taught": 5.0}})
    assert env._start(env._spec(2, env._settings)) is None  # a person misses a height of 2 mm by 7 mm


# -- chess ----------------------------------------------------------------------------------------------------------


@pytest.mark.slow
def test_an_axis_goes_to_its_goal_and_takes_no_command_while_it_is_busy() -> None:
    env = AssemblyEnv(CHESS)
    first, _ = env.reset(seed=7)
    assert {*first} == {"status", "count", "stopped", "beam", "clock"}
    found = until_free(env, origin__x=1.0, origin__y=1.0, origin__z=1.0)
    assert [*found["count"]] == [0.0, 0.0, 0.0]
    assert found["clock"][0] * 50 == pytest.approx(
        round(found["clock"][0] * 50), abs=1e-9
    )  # as long as the questions may be
    assert found["stopped"][0] == pytest.approx(
        -400 * 0.0375, abs=2.0
    )  # from its place when the power came on
    begun = env.step(action(env, set__x=1.0, goal__x=30.0))[0]
    assert [*begun["status"]] == [1, 0, 0, 0]
    assert [*until_free(env, set__x=1.0, goal__x=90.0)["count"]] == [30.0, 0.0, 0.0]


@pytest.mark.slow
@pytest.mark.parametrize(("axis", "goal", "status"), [("y", 399.9, 2), ("z", 190.0, 3)])
def test_a_rail_that_ends_or_a_force_stops_an_axis_and_shows_for_one_step(
    axis: str, goal: float, status: int
) -> None:
    env, index = AssemblyEnv(CHESS), "xyz".index(axis)
    env.reset(seed=7)  # the axes stand 15 mm from their low ends, and have not been to them
    seen = until_free(env, **{f"set.{axis}": 1.0, f"goal.{axis}": goal})
    assert seen["status"][index] == status
    assert 150.0 < seen["stopped"][index] < seen["count"][index] < goal
    assert env.step(action(env))[0]["status"][index] == 0


@pytest.mark.slow
def test_the_program_finds_measures_and_reports_a_piece_through_the_actions() -> None:
    env = AssemblyEnv(CHESS, limit_s=7.0)
    play(env, policy_maker("program", CHESS), 28)
    assert env._runner is not None
    heard = env._runner.cell.truth.states["heard"]
    told = heard.heights  # type: ignore[attr-defined]
    assert len(told) == 1
    (piece,) = (each for each in heard.pieces if abs(each.x - told[0].x) < 10 and each.line == told[0].line)  # type: ignore[attr-defined]
    assert told[0].height == pytest.approx(piece.height, abs=0.6)


@pytest.mark.slow
def test_a_microcomputer_that_does_not_answer_stops_the_episode_for_good() -> None:
    env = AssemblyEnv(CHESS, world={"faults": ["dead.HAND1"]})
    env.reset(seed=7)
    _, reward, terminated, truncated, info = env.step(action(env))
    assert (reward, terminated, truncated, info["referee"]["outcome"]) == (0.0, True, False, "stopped")
    assert "NOANSWER" in info["referee"]["stopped"]
