"""An environment is what Gymnasium asks for, sees only the ports, and believes nobody but the referee."""

import importlib
import subprocess
import sys
from collections.abc import Iterator
from pathlib import Path

import gymnasium
import numpy as np
import pytest
from conftest import Command
from gymnasium.utils.env_checker import check_env, data_equivalence

import handeye.env
from handeye.core.errors import InvalidInput, MissingExtra, PhysicsFailed
from handeye.core.pose import Array
from handeye.env.environment import AssemblyEnv
from handeye.env.jobs import ids
from handeye.env.spaces import Observation
from handeye.runs import starts
from handeye.runs.runner import Runner

PIN = "handeye/Pin-v0"


@pytest.fixture(scope="module")
def pin() -> Iterator[AssemblyEnv]:
    env = AssemblyEnv(PIN, limit_s=2.0)
    yield env
    env.close()


def still(env: AssemblyEnv, **values: float) -> Array:
    """The action that holds arm and pin, but for these components."""
    action = dict.fromkeys((part.name for part in env.components), 0.0) | {"grip": 1.0}
    return np.array([*(action | values).values()])


@pytest.mark.slow
@pytest.mark.parametrize("action", ["hand", "torques"])
def test_gymnasiums_own_checker_finds_nothing(action: str) -> None:
    check_env(gymnasium.make(PIN, action=action).unwrapped, skip_render_check=True)


@pytest.mark.parametrize("job", ids())
def test_an_environment_is_made_by_its_name_and_by_that_of_its_module(job: str) -> None:
    assert isinstance(gymnasium.make(job).unwrapped, AssemblyEnv)
    assert isinstance(gymnasium.make(f"handeye.env:{job}").unwrapped, AssemblyEnv)


MADE_ELSEWHERE = """
import sys
import numpy as np
import gymnasium
env = gymnasium.make("handeye.env:handeye/Pin-v0")
seen = [env.reset(seed=7)[0], env.step(np.full(env.action_space.shape, 0.25))[0]]
print([{name: value.tolist() for name, value in each.items()} for each in seen])
"""


@pytest.mark.slow
def test_a_seed_gives_the_same_episode_to_the_bit_twice_and_in_another_process(pin: AssemblyEnv) -> None:
    def played() -> list[Observation]:
        first, _ = pin.reset(seed=7)
        return [first, pin.step(np.full(len(pin.components), 0.25))[0]]

    one, two = played(), played()
    assert all(data_equivalence(a, b, exact=True) for a, b in zip(one, two, strict=True))
    said = subprocess.run(
        [sys.executable, "-c", MADE_ELSEWHERE], capture_output=True, text=True, check=True
    ).stdout
    assert said.strip() == str([{name: value.tolist() for name, value in each.items()} for each in one])


@pytest.mark.slow
def test_environments_in_processes_of_their_own_see_what_one_here_sees(pin: AssemblyEnv) -> None:
    many = gymnasium.make_vec(PIN, num_envs=2, vectorization_mode="async", vector_kwargs={"context": "spawn"})
    seen, _ = many.reset(seed=[7, 8])
    many.close()
    for number, seed in enumerate((7, 8)):
        here, _ = pin.reset(seed=seed)
        assert all(np.array_equal(here[name], seen[name][number]) for name in here)


@pytest.mark.slow
def test_a_world_comes_from_the_seed_and_later_ones_from_the_generator_it_seeds(pin: AssemblyEnv) -> None:
    def worlds() -> list[int]:
        return [pin.reset(seed=7)[1]["world"]["seed"], pin.reset()[1]["world"]["seed"]]

    first, second = worlds()
    assert (first, [first, second]) == (7, worlds())
    assert second != 7


@pytest.mark.slow
@pytest.mark.parametrize("action", ["hand", "torques"])
def test_random_actions_raise_nothing_and_are_never_believed(action: str) -> None:
    env, drawn = AssemblyEnv(PIN, action=action, limit_s=5.0), np.random.default_rng(0)  # type: ignore[arg-type]
    rewards = []
    for seed in (0, 4):  # worlds in which a pin that is let go does not fall into its hole
        seen, _ = env.reset(seed=seed)
        over = False
        while not over:
            assert env.observation_space.contains(seen)
            moved = drawn.uniform(env.action_space.low, env.action_space.high)
            moved[-1] = drawn.random() < 0.01
            seen, reward, terminated, truncated, info = env.step(moved)
            over = terminated or truncated
        rewards.append((reward, info["referee"]["right"]))
    assert max(rewards) <= (0.0, False)


@pytest.mark.slow
def test_the_referee_speaks_at_the_end_only(pin: AssemblyEnv) -> None:
    pin.reset(seed=0)
    _, reward, terminated, truncated, info = pin.step(still(pin))
    assert (reward, terminated, truncated, info) == (0.0, False, False, {})
    _, reward, terminated, truncated, info = pin.step(still(pin, done=1.0))
    assert (reward, terminated, truncated) == (-1.0, True, False)
    assert (info["referee"]["outcome"], info["referee"]["right"]) == ("false done", False)
    with pytest.raises(InvalidInput, match="the episode has ended; `reset` begins the next one"):
        pin.step(still(pin))


@pytest.mark.slow
def test_the_time_limit_truncates_and_pays_nothing(pin: AssemblyEnv) -> None:
    pin.reset(seed=0)
    ended = [pin.step(still(pin)) for _ in range(120)]
    assert not any(terminated or truncated for _, _, terminated, truncated, _ in ended[:-1])
    _, reward, terminated, truncated, info = ended[-1]
    assert (reward, terminated, truncated, info["referee"]["outcome"]) == (0.0, False, True, "not done")


@pytest.mark.slow
def test_a_cell_that_breaks_down_ends_the_episode(pin: AssemblyEnv, monkeypatch: pytest.MonkeyPatch) -> None:
    def failed(_: object, values: object) -> None:
        raise PhysicsFailed("the simulation became unstable")

    pin.reset(seed=0)
    monkeypatch.setattr(type(pin._controls), "act", failed)
    _, reward, terminated, truncated, info = pin.step(still(pin))
    assert (reward, terminated, truncated, info["referee"]["outcome"]) == (0.0, True, False, "stopped")
    assert info["referee"]["stopped"] == "the simulation became unstable"


@pytest.mark.slow
def test_an_observation_is_what_the_ports_read(pin: AssemblyEnv) -> None:
    pin.reset(seed=0)
    seen = pin.step(still(pin, **{"move.z": 0.5}))[0]
    assert pin._runner is not None
    read = pin._runner.arm_cell.devices.sense()
    assert (seen["q"] == read.q).all()
    assert (seen["qd"] == read.qd).all()
    assert (seen["gap"][0], seen["clock"][0], *seen["touch"]) == (read.gap, read.time, *read.touch)
    assert {*seen} == {"q", "qd", "torque", "gap", "touch", "screwdriver", "braked", "clock"}


@pytest.mark.slow
def test_set_points_of_the_hand_move_the_hand_as_far_as_they_say(pin: AssemblyEnv) -> None:
    from handeye.arm.kinematics import forward

    first, _ = pin.reset(seed=0)
    for _ in range(30):
        seen = pin.step(still(pin, **{"move.x": 0.5, "move.z": 0.25}))[0]
    for _ in range(20):
        seen = pin.step(still(pin))[0]
    arm = pin.facts().arm
    moved = (forward(arm, seen["q"]) - forward(arm, first["q"]))[:3, 3]
    assert moved == pytest.approx((0.03, 0.0, 0.015), abs=0.002)


@pytest.mark.slow
def test_a_start_is_made_once_in_a_world_and_again_if_its_file_is_damaged(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    kept = starts.StartStates("insertion", "ray", tmp_path)
    world = AssemblyEnv(PIN)._spec(0, {})
    made = kept.before(1, world)
    assert made is not None
    (later,) = (path for path in tmp_path.iterdir() if starts.read_checkpoint(path).position == made.position)
    with monkeypatch.context() as patch:
        patch.setattr(Runner, "step", lambda _: pytest.fail("the program ran again"))
        again = kept.before(1, world)
    assert again is not None
    assert starts.encode(again) == starts.encode(made)
    later.write_bytes(later.read_bytes()[:-9])
    mended = kept.before(1, world)
    assert mended is not None
    assert starts.encode(mended) == starts.encode(made)


def test_the_cache_command_counts_starts_and_removes_them(
    command: Command, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setenv("HANDEYE_CACHE", str(tmp_path))
    place = tmp_path / "starts" / f"{'0' * 32}.checkpoint"
    place.parent.mkdir()
    place.write_bytes(b"x" * 200_000)
    assert "1 start state of environments, 0.2 MB of at most 256 MB" in command("cache")[1]
    assert command("cache", "--clear")[:2] == (0, "0 calibrations and 1 start state removed\n")
    assert not place.exists()


@pytest.mark.slow
def test_a_world_in_which_the_program_stops_early_is_passed_over_and_named(
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    env = AssemblyEnv(PIN)
    begun = env._start(env._spec(0, env._settings))
    found = iter((None, begun))
    monkeypatch.setattr(env, "_start", lambda _: next(found))
    assert env.reset(seed=5)[1]["passed_over"] == [5]
    monkeypatch.setattr(env, "_start", lambda _: None)
    with pytest.raises(InvalidInput, match="in 20 worlds in a row the program stops before the start of"):
        env.reset(seed=5)


@pytest.mark.slow
def test_a_shaped_reward_is_privileged_and_sums_to_the_way_that_the_pin_has_come() -> None:
    env = AssemblyEnv(PIN, shaped=True)
    _, info = env.reset(seed=1)
    assert info["privileged"]
    rewards = [env.step(still(env, **{"move.z": -0.5}))[1] for _ in range(60)]
    assert sum(rewards) == pytest.approx(0.19 + 0.03, abs=0.01)  # .1 of the nose and of the way to the face


@pytest.mark.parametrize(
    ("wrong", "told"),
    [
        (
            {"job": "handeye/Pni-v0"},
            "there is no environment `handeye/Pni-v0`; did you mean `handeye/Pin-v0`?",
        ),
        ({"action": "joints"}, "there is no action 'joints'; the actions are hand and torques"),
        ({"job": 3}, "there is no environment `3`"),
        ({"limit_s": 0}, "limit_s must be more than 0 s, not 0"),
        ({"limit_s": "x"}, "limit_s must be more than 0 s, not 'x'"),
        ({"limit_s": [1]}, "limit_s must be more than 0 s, not [1]"),
        ({"level": "huge"}, "there is no level 'huge'"),
        ({"world": {"colour": 1}}, "there is no setting 'colour' of a world"),
        ({"world": {"set": {"arm.fricton": 0}}}, "did you mean `arm.friction`"),
        ({"world": "high"}, "`world` must be a dictionary of settings of a world, not 'high'"),
        ({"pictures": True}, "handeye/Pin-v0 has no television camera"),
        ({"job": "handeye/Pump-v0", "shaped": True}, "handeye/Pump-v0 has no shaped reward"),
        ({"render_mode": "human"}, "there is no render mode 'human'"),
    ],
)
def test_wrong_arguments_are_refused_in_a_sentence(wrong: dict[str, object], told: str) -> None:
    with pytest.raises(InvalidInput) as refused:
        AssemblyEnv(**wrong)  # type: ignore[arg-type]
    assert told in str(refused.value)


@pytest.mark.slow
@pytest.mark.parametrize("action", [np.zeros(3), np.full(13, np.nan), "still", ["a"] * 13, {"done": 1}])
def test_actions_that_are_none_are_refused(pin: AssemblyEnv, action: Array) -> None:
    pin.reset(seed=0)
    with pytest.raises(InvalidInput, match="an action of handeye/Pin-v0 must have 13 finite numbers"):
        pin.step(action)


def test_without_gymnasium_a_sentence_names_the_extra(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setitem(sys.modules, "gymnasium", None)
    monkeypatch.delitem(sys.modules, "handeye.env")
    with pytest.raises(MissingExtra, match=r"`handeye.env` needs gymnasium.*the extra `env` of handeye"):
        importlib.import_module("handeye.env")
    assert handeye.env is not None


@pytest.mark.parametrize(
    ("wrong", "told"),
    [
        ({"seed": -1}, "a seed must be a whole number"),
        ({"seed": 1.5}, "a seed must be a whole number"),
        ({"options": 3}, "`options` must be a dictionary"),
    ],
)
def test_a_reset_with_a_wrong_argument_is_refused_in_a_sentence(wrong: dict[str, object], told: str) -> None:
    with pytest.raises(InvalidInput, match=told):
        AssemblyEnv().reset(**wrong)  # type: ignore[arg-type]
